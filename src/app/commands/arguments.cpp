#include <app/commands/arguments.h>
#include <base/text.h>

#include <optional>
#include <stdexcept>

namespace mobbscope::app {

namespace {

[[noreturn]] void refuse(std::string_view text, std::string_view what, const std::string& wanted) {
    throw std::invalid_argument(std::string(what) + " cannot be " + in_quotes(text) + ": give " + wanted);
}

}  // namespace

double number_in(std::string_view text, std::string_view what, double low, double high) {
    const std::optional<double> value = parse_double(trimmed(text));
    if (!value || *value < low || *value > high) {
        refuse(text, what, "a number from " + brief(low) + " to " + brief(high));
    }
    return *value;
}

int whole_number_in(std::string_view text, std::string_view what, int low, int high) {
    const std::optional<int> value = parse_int(trimmed(text));
    if (!value || *value < low || *value > high) {
        refuse(text, what, "a whole number from " + std::to_string(low) + " to " + std::to_string(high));
    }
    return *value;
}

glm::dvec2 two_numbers(std::string_view text, std::string_view what) {
    const std::string_view both = trimmed(text);
    const std::size_t blank = both.find(' ');
    const std::optional<double> x = parse_double(both.substr(0, blank));
    const std::optional<double> y =
        blank == std::string_view::npos ? std::nullopt : parse_double(trimmed(both.substr(blank)));
    if (!x || !y) refuse(text, what, "two numbers, such as 1.5 -2");
    return {*x, *y};
}

std::pair<std::string_view, std::string_view> name_and_word(std::string_view text, std::string_view what) {
    const std::string_view both = trimmed(text);
    const std::size_t blank = both.rfind(' ');
    if (blank == std::string_view::npos) refuse(text, what, "a name and a number, such as A 12");
    return {trimmed(both.substr(0, blank)), both.substr(blank + 1)};
}

}  // namespace mobbscope::app
