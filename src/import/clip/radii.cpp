#include <base/error.h>
#include <base/file.h>
#include <base/text.h>
#include <import/clip/radii.h>
#include <mobb/clip.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace mobbscope {

namespace {

constexpr std::string_view kRadiusForms =
    "give metres like 0.25, a column of the CSV, or a file (.csv) of ids and radii";

bool may_begin_name(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || (c & 0x80) != 0; }

/// What begins like a word, so that a mistyped number is none.
bool is_column_name(std::string_view text) {
    const std::string word = lower(text);
    return !text.empty() && may_begin_name(text.front()) && trimmed(text) == text && is_utf8(text) && word != "nan" &&
           word != "inf" && word != "infinity";
}

/// A field without the quotes around it.
std::string unquoted(std::string_view field) {
    if (field.size() < 2 || field.front() != '"' || field.back() != '"') return std::string(field);
    std::string out(field.substr(1, field.size() - 2));
    for (std::size_t at = out.find("\"\""); at != std::string::npos; at = out.find("\"\"", at + 1)) out.erase(at, 1);
    return out;
}

/// The two values of a line; a key may hold commas.
std::pair<std::string, std::string_view> key_and_value(const TextLines& lines) {
    const std::size_t comma = lines.line().rfind(',');
    if (comma == std::string_view::npos) lines.fail("has no comma; give a key and a radius, such as 17,0.3");
    return {unquoted(trimmed(lines.line().substr(0, comma))), trimmed(lines.line().substr(comma + 1))};
}

}  // namespace

double RadiusTable::of(const std::string& key) const {
    const auto at = radii.find(key);
    if (at != radii.end()) return at->second;
    if (others) return *others;
    throw std::invalid_argument(file + " has no radius for " + (by_class ? "class " : "id ") + in_quotes(key) +
                                "; add a row, or one of * for all others");
}

RadiusTable read_radii(const std::filesystem::path& file) {
    const std::string text = read_file(file);
    RadiusTable out{file.string()};
    TextLines lines(text, out.file);
    const auto header = [&] {
        return lines.next() ? key_and_value(lines) : std::pair<std::string, std::string_view>();
    };
    const auto [what, radius] = header();
    out.by_class = what == "class";
    if ((!out.by_class && what != "id") || (radius != "radius" && radius != "r")) {
        throw InputError(out.file, at_line(std::max(lines.number(), 1)),
                         "a file of radii begins with the line id,radius or class,radius");
    }
    while (lines.next()) {
        const auto [key, value] = key_and_value(lines);
        if (key.empty()) lines.fail("has no " + what + "; name one, or * for all others");
        const std::optional<double> metres = parse_double(value);
        if (!metres || *metres < 0 || *metres > mobb::kMaxLength) {
            lines.fail(in_quotes(value) + " is not a radius; give metres from 0 to " + format_double(mobb::kMaxLength));
        }
        const bool is_new = key == "*" ? !out.others : !out.radii.contains(key);
        if (!is_new) lines.fail(in_quotes(key) + " stands twice; remove one");
        if (key == "*") {
            out.others = metres;
        } else {
            out.radii.emplace(key, *metres);
        }
    }
    if (out.radii.empty() && !out.others) lines.fail("there is no row after the header; add radii");
    return out;
}

Radius radius_from_text(std::string_view text) {
    if (const std::optional<double> metres = parse_double(text)) return *metres;
    const std::filesystem::path file{std::string(text)};
    if (lower_extension(file) == ".csv") return std::make_shared<const RadiusTable>(read_radii(file));
    if (is_column_name(text)) return RadiusColumn{std::string(text)};
    throw std::invalid_argument(in_quotes(text) + " is not a radius; " + std::string(kRadiusForms));
}

std::string radius_text(const Radius& radius) {
    if (const double* metres = std::get_if<double>(&radius)) return format_double(*metres);
    if (const RadiusColumn* column = std::get_if<RadiusColumn>(&radius)) return column->name;
    return std::get<std::shared_ptr<const RadiusTable>>(radius)->file;
}

double metres_of(const Radius& radius, const std::string& id, const std::string& label) {
    if (const double* metres = std::get_if<double>(&radius)) return *metres;
    if (const RadiusColumn* column = std::get_if<RadiusColumn>(&radius)) {
        throw std::invalid_argument("radius " + in_quotes(column->name) +
                                    " names a column, as a CSV has; give metres, or a file (.csv) of ids and radii");
    }
    const RadiusTable& table = *std::get<std::shared_ptr<const RadiusTable>>(radius);
    const std::string& key = table.by_class ? label : id;
    if (key.empty()) {
        throw std::invalid_argument("radii by " + std::string(table.by_class ? "class" : "id") + " (" + table.file +
                                    ") are none of this file, which has no " + (table.by_class ? "classes" : "ids") +
                                    "; give metres");
    }
    return table.of(key);
}

}  // namespace mobbscope
