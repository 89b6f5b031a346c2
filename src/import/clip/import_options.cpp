#include <base/text.h>
#include <import/clip/import_options.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <type_traits>

namespace mobbscope {

namespace {

std::string text_of(const std::string& value) { return value; }
std::string text_of(double value) { return format_double(value); }
std::string text_of(const Radius& value) { return radius_text(value); }
std::string text_of(Origin value) { return std::string(name(value)); }
std::string text_of(mobb::Motion value) { return std::string(name(value)); }
std::string text_of(bool value) { return value ? "yes" : "no"; }
std::string text_of(const std::pair<double, double>& value) {
    return format_double(value.first) + ' ' + format_double(value.second);
}

void read_text(const ImportOption&, std::string_view text, std::optional<std::string>& to) { to = std::string(text); }

void read_text(const ImportOption& option, std::string_view text, std::optional<double>& to) {
    to = parse_double(text);
    if (!to) throw std::invalid_argument(std::string(option.key) + " is a number, not " + in_quotes(text));
}

void read_text(const ImportOption&, std::string_view text, std::optional<std::pair<double, double>>& to) {
    const std::size_t between = std::min(text.find_first_of(" :"), text.size());
    const std::optional<double> begin = parse_double(text.substr(0, between));
    const std::optional<double> end = parse_double(trimmed(text.substr(std::min(between + 1, text.size()))));
    if (!begin || !end) {
        throw std::invalid_argument("trim is two times in seconds, such as 0.5 3.2, not " + in_quotes(text));
    }
    to = {*begin, *end};
}

void read_text(const ImportOption&, std::string_view text, std::optional<Radius>& to) { to = radius_from_text(text); }

void read_text(const ImportOption&, std::string_view text, std::optional<Origin>& to) {
    to = origin_from_name(text);
    if (!to) throw std::invalid_argument("origin is keep, start or start_heading, not " + in_quotes(text));
}

void read_text(const ImportOption&, std::string_view text, std::optional<mobb::Motion>& to) {
    to = mobb::motion_from_name(text);
    if (!to) throw std::invalid_argument("motion is held or linear, not " + in_quotes(text));
}

void read_text(const ImportOption& option, std::string_view text, std::optional<bool>& to) {
    if (text != "yes" && text != "no")
        throw std::invalid_argument(std::string(option.key) + " is yes or no, not " + in_quotes(text));
    to = text == "yes";
}

}  // namespace

const ImportOption* import_option(std::string_view key) {
    const auto at = std::ranges::find(kImportOptions, key, &ImportOption::key);
    return at == std::end(kImportOptions) ? nullptr : at;
}

std::string option_text(const ImportOptions& options, const ImportOption& option) {
    return std::visit([&](auto member) { return options.*member ? text_of(*(options.*member)) : std::string(); },
                      option.member);
}

void set_option(ImportOptions& options, const ImportOption& option, std::string_view text) {
    ImportOptions next = options;
    const std::string_view value = trimmed(text);
    std::visit(
        [&](auto member) {
            (next.*member).reset();
            if (!value.empty()) read_text(option, value, next.*member);
        },
        option.member);
    check(next);
    options = std::move(next);
}

std::string unit_word(double metres) {
    for (const char* named : {"m", "cm", "in"}) {
        if (metres_per_unit(named) == metres) return named;
    }
    return format_double(metres);
}

OptionOffer origin_offer() {
    return {"origin",
            "keep",
            "where the file has it",
            false,
            {{"keep", "keep: where the file has it"},
             {"start", "start: begins at the origin"},
             {"start_heading", "start_heading: begins at the origin, along +x"}}};
}

OptionOffer motion_option_offer(mobb::Motion taken, const std::string& why) {
    return {"motion",
            std::string(name(taken)),
            why,
            false,
            {{"held", "held until the next"}, {"linear", "linear to the next"}}};
}

const OptionOffer* ImportOffer::find(std::string_view key) const {
    const auto at = std::ranges::find(options, key, &OptionOffer::key);
    return at == options.end() ? nullptr : &*at;
}

}  // namespace mobbscope
