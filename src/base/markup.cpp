#include <base/markup.h>
#include <base/text.h>

#include <array>
#include <cstddef>

namespace mobbscope {

std::string escaped(std::string_view text) {
    constexpr std::string_view kSpecial = "&<>\"'";
    constexpr std::array kEntities{"&amp;", "&lt;", "&gt;", "&quot;", "&#39;"};
    const std::string clean = cleaned(text);
    std::string out;
    for (std::size_t i = 0; i < clean.size(); ++i) {
        // U+FFFE and U+FFFF are no characters of XML.
        const std::string_view three = std::string_view(clean).substr(i, 3);
        if (three == "\xef\xbf\xbe" || three == "\xef\xbf\xbf") {
            out += '?';
            i += 2;
            continue;
        }
        const std::size_t special = kSpecial.find(clean[i]);
        special == kSpecial.npos ? out += clean[i] : out += kEntities[special];
    }
    return out;
}

}  // namespace mobbscope
