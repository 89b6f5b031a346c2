#include <base/numbers_in_text.h>
#include <base/text.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace mobbscope {

namespace {

/// The longer before those that they begin with.
constexpr std::array<std::string_view, 12> kUnits{
    "m\u00B2\u00B7s", "m\u00B2", "m/s", "ms", "m", "ns", "s", "%/s", "%", "KiB", "\u00B0/s", "\u00B0"};

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

std::size_t end_of_digits(std::string_view text, std::size_t at) {
    while (at < text.size() && is_digit(text[at])) ++at;
    return at;
}

/// Where whole digits end that are in groups: "65,536".
std::size_t end_of_groups(std::string_view text, std::size_t at) {
    std::size_t end = end_of_digits(text, at);
    if (end - at > 3) return end;
    while (end < text.size() && text[end] == ',' && end_of_digits(text, end + 1) == end + 4) end += 4;
    return end;
}

/// Where the number that begins with this digit ends: "12", "65,536", "0.183", "1.2e+07".
std::size_t end_of_number(std::string_view text, std::size_t at) {
    std::size_t end = end_of_groups(text, at);
    if (end + 1 < text.size() && text[end] == '.' && is_digit(text[end + 1])) end = end_of_digits(text, end + 1);
    if (end + 1 >= text.size() || text[end] != 'e') return end;
    const std::size_t power = end + (text[end + 1] == '+' || text[end + 1] == '-' ? 2 : 1);
    return power < text.size() && is_digit(text[power]) ? end_of_digits(text, power) : end;
}

/// By how much a number that is shown so may be off: half of its last digit.
double rounded_by(std::string_view number) {
    const std::size_t power_at = number.find('e');
    const std::string_view digits = number.substr(0, power_at);
    const std::size_t point = digits.find('.');
    const auto decimals = point == std::string_view::npos ? 0 : static_cast<int>(digits.size() - point - 1);
    const int power = power_at == std::string_view::npos
                          ? 0
                          : static_cast<int>(parse_double(number.substr(power_at + 1)).value_or(0));
    return 0.5 * std::pow(10.0, power - decimals) * (1 + 1e-9);
}

std::string_view unit_at(std::string_view text) {
    if (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    for (const std::string_view unit : kUnits) {
        if (text.starts_with(unit) && (text.size() == unit.size() || !is_letter(text[unit.size()]))) return unit;
    }
    return "";
}

}  // namespace

std::string grouped(std::size_t count) {
    std::string out = std::to_string(count);
    for (std::size_t at = out.size(); at > 3; at -= 3) out.insert(at - 3, ",");
    return out;
}

std::vector<NumberInText> ShownNumbers::in(std::string_view text) {
    std::vector<NumberInText> out;
    for (std::size_t i = 0; i < text.size();) {
        if (!is_digit(text[i])) {
            // A word goes on to its end, with the digits in it.
            const bool word = is_letter(text[i]);
            ++i;
            while (word && i < text.size() && (is_letter(text[i]) || is_digit(text[i]))) ++i;
            continue;
        }
        const std::size_t end = end_of_number(text, i);
        const bool of_name = end < text.size() && is_letter(text[end]);
        const bool has_sign = i > 0 && (text[i - 1] == '-' || text[i - 1] == '+') &&
                              (i == 1 || (!is_digit(text[i - 2]) && !is_letter(text[i - 2])));
        std::string number(text.substr(i, end - i));
        std::erase(number, ',');
        const std::optional<double> size = of_name ? std::nullopt : parse_double(number);
        if (size) {
            const double value = has_sign && text[i - 1] == '-' ? -*size : *size;
            const double off = rounded_by(number);
            const auto exact = std::ranges::find_if(exact_, [&](double each) { return std::abs(each - value) <= off; });
            out.push_back({has_sign ? i - 1 : i, end, value, std::string(unit_at(text.substr(end)))});
            if (exact != exact_.end()) {
                out.back().value = *exact;
                exact_.erase(exact);
            }
        }
        i = end;
        while (of_name && i < text.size() && (is_letter(text[i]) || is_digit(text[i]))) ++i;
    }
    return out;
}

}  // namespace mobbscope
