#include <base/error.h>
#include <base/text.h>
#include <import/tracks/xml_text.h>

#include <algorithm>
#include <cmath>

namespace mobbscope {

std::string_view xml_root(std::string_view text) {
    while (true) {
        text.remove_prefix(std::min(text.find('<'), text.size()));
        if (text.size() < 2) return "";
        const bool is_comment = text.starts_with("<!--");
        if (!is_comment && text[1] != '?' && text[1] != '!') break;
        // Comments may hold anything; a document type with brackets is none of these files.
        const std::string_view end = is_comment ? "-->" : ">";
        const std::size_t at = text.find(end, 2);
        text.remove_prefix(at == std::string_view::npos ? text.size() : at + end.size());
    }
    text.remove_prefix(1);
    return text.substr(0, text.find_first_of(" \t\r\n/>"));
}

XmlText::XmlText(std::string_view text, const std::string& file) : text_(text), file_(file) {
    // An attribute of five bytes takes 40, and there is a copy of the text.
    constexpr std::size_t kOfByte = 20;
    spent_.add(kOfByte * text.size(), "its elements", file);
    const pugi::xml_parse_result result = document_.load_buffer(text.data(), text.size());
    if (result) return;
    throw InputError(file, at_line(line_at(static_cast<std::size_t>(result.offset))),
                     "is not XML: " + lower(result.description()) + "; the file may be cut off");
}

int XmlText::line_at(std::size_t offset) {
    offset = std::min(offset, text_.size());
    if (offset < counted_) {
        counted_ = 0;
        line_ = 1;
    }
    line_ += static_cast<int>(std::ranges::count(text_.substr(counted_, offset - counted_), '\n'));
    counted_ = offset;
    return line_;
}

void XmlText::fail(pugi::xml_node element, const std::string& message) {
    const int line = line_of(element);
    throw InputError(file_, at_line(line) + ", <" + shortened(cleaned(element.name()), 40) + ">", message);
}

std::string_view XmlText::text(pugi::xml_node element, const char* attribute) {
    const pugi::xml_attribute found = element.attribute(attribute);
    if (!found) fail(element, "has no " + std::string(attribute) + "; add it");
    return found.value();
}

double XmlText::number(pugi::xml_node element, const char* attribute, double largest) {
    const std::string_view value = text(element, attribute);
    const std::optional<double> number = parse_double(value);
    if (!number) {
        fail(element,
             std::string(attribute) + " is " + in_quotes(value) + ", which is no finite number; write it like 0.25");
    }
    if (std::abs(*number) > largest)
        fail(element, std::string(attribute) + " is " + in_quotes(value) + ", beyond " + format_double(largest));
    return *number;
}

}  // namespace mobbscope
