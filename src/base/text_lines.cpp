#include <base/error.h>
#include <base/text.h>
#include <base/text_lines.h>

namespace mobbscope {

std::string at_line(int line) { return "line " + std::to_string(line); }

TextLines::TextLines(std::string_view text, const std::string& file) : rest_(text), file_(file) {
    if (rest_.starts_with("\xff\xfe") || rest_.starts_with("\xfe\xff")) {
        throw InputError(file_, at_line(1), "is UTF-16 text; save it as UTF-8");
    }
    if (rest_.starts_with("\xef\xbb\xbf")) rest_.remove_prefix(3);
    if (rest_.find('\n') == std::string_view::npos && rest_.find('\r') != std::string_view::npos) {
        throw InputError(file_, at_line(1), "lines end with carriage returns alone; save it with line feeds");
    }
}

bool TextLines::next() {
    while (!rest_.empty()) {
        const std::size_t end = rest_.find('\n');
        line_ = trimmed(rest_.substr(0, end));
        rest_ = end == std::string_view::npos ? std::string_view{} : rest_.substr(end + 1);
        ++number_;
        if (line_.find('\0') != std::string_view::npos)
            fail("holds a NUL byte; this is no text file, or a damaged one");
        if (!line_.empty()) return true;
    }
    return false;
}

void TextLines::fail(const std::string& message) const { throw InputError(file_, at_line(number_), message); }

}  // namespace mobbscope
