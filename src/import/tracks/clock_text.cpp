#include <base/text.h>
#include <import/tracks/clock_text.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <string>
#include <utility>

namespace mobbscope {

namespace {

constexpr double kSecondsOfDay = 86400;

/// Takes two or four digits off the front.
std::optional<int> take_digits(std::string_view& text, std::size_t count) {
    const std::string_view digits = text.substr(0, count);
    if (digits.size() < count || digits.find_first_not_of("0123456789") != std::string_view::npos) return std::nullopt;
    text.remove_prefix(count);
    return parse_int(digits);
}

bool take_sign(std::string_view& text, std::string_view among) {
    if (text.empty() || among.find(text.front()) == std::string_view::npos) return false;
    text.remove_prefix(1);
    return true;
}

/// "2021-06-01", with slashes too, and "01.06.2021".
std::optional<double> take_date(std::string_view& text) {
    std::string_view rest = text;
    const bool day_first = text.find('.') == 2;
    const std::string_view sign = day_first ? "." : "-/";
    auto year = take_digits(rest, day_first ? 2 : 4);
    if (!year || !take_sign(rest, sign)) return std::nullopt;
    const auto month = take_digits(rest, 2);
    if (!month || !take_sign(rest, sign)) return std::nullopt;
    auto day = take_digits(rest, day_first ? 4 : 2);
    if (!day) return std::nullopt;
    if (day_first) std::swap(year, day);
    const std::chrono::year_month_day date{std::chrono::year(*year), std::chrono::month(static_cast<unsigned>(*month)),
                                           std::chrono::day(static_cast<unsigned>(*day))};
    if (!date.ok()) return std::nullopt;
    text = rest;
    return kSecondsOfDay * static_cast<double>(std::chrono::sys_days(date).time_since_epoch().count());
}

/// "12:00", "12:00:00" and "12:00:00.5" (or with a comma).
std::optional<double> take_time(std::string_view& text) {
    std::string_view rest = text;
    const auto hour = take_digits(rest, 2);
    if (!hour || *hour > 24 || !take_sign(rest, ":")) return std::nullopt;
    const auto minute = take_digits(rest, 2);
    if (!minute || *minute > 59) return std::nullopt;
    double seconds = 0;
    if (take_sign(rest, ":")) {
        const auto second = take_digits(rest, 2);
        if (!second || *second > 60) return std::nullopt;
        seconds = *second;
        if (take_sign(rest, ".,")) {
            const std::size_t end = std::min(rest.find_first_not_of("0123456789"), rest.size());
            const std::optional<double> part = parse_double("0." + std::string(rest.substr(0, end)));
            if (end == 0 || !part) return std::nullopt;
            seconds += *part;
            rest.remove_prefix(end);
        }
    }
    text = rest;
    return 3600.0 * *hour + 60.0 * *minute + seconds;
}

/// "Z", " UTC", "+02:00" or "+0200": seconds ahead of UTC.
std::optional<double> take_zone(std::string_view& text) {
    if (text.empty() || text == "Z" || text == "z" || text == " UTC") {
        text = {};
        return 0;
    }
    const double sign = text.front() == '-' ? -1 : 1;
    if (!take_sign(text, "+-")) return std::nullopt;
    const auto hours = take_digits(text, 2);
    take_sign(text, ":");
    const auto minutes = text.empty() ? std::optional(0) : take_digits(text, 2);
    if (!hours || !minutes) return std::nullopt;
    return sign * (3600.0 * *hours + 60.0 * *minutes);
}

}  // namespace

std::optional<double> seconds_of_clock(std::string_view text) {
    const std::optional<double> date = take_date(text);
    if (date && text.empty()) return date;
    if (date && !take_sign(text, "Tt ")) return std::nullopt;
    const std::optional<double> time = take_time(text);
    const std::optional<double> zone = time ? take_zone(text) : std::nullopt;
    if (!zone || !text.empty()) return std::nullopt;
    return date.value_or(0) + *time - *zone;
}

bool is_time_of_day(std::string_view text) { return take_time(text).has_value(); }

}  // namespace mobbscope
