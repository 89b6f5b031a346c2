#include <picture_tests/markup.h>

#include <base/text.h>

#include <cstddef>

namespace mobbscope::picture_tests {

std::string escaped(std::string_view text) {
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
        switch (clean[i]) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '"':
                out += "&quot;";
                break;
            case '\'':
                out += "&#39;";
                break;
            default:
                out += clean[i];
        }
    }
    return out;
}

std::string base64(std::string_view bytes) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const auto byte = [&](std::size_t k) {
            return i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u;
        };
        const unsigned group = byte(0) << 16 | byte(1) << 8 | byte(2);
        for (unsigned k = 0; k < 4; ++k) {
            out += i + k <= bytes.size() ? kDigits[group >> (18 - 6 * k) & 63u] : '=';
        }
    }
    return out;
}

}  // namespace mobbscope::picture_tests
