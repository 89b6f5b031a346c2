/// Dates and times of day as tables write them.
#pragma once

#include <optional>
#include <string_view>

namespace mobbscope {

/// Seconds: of "2021-06-01T12:00:00.5" or "01.06.2021 12:00:00.5", with a blank in place of the T, with "Z" or "+02:00"
/// behind, or of the date alone since the beginning of 1970 (without a zone: UTC); of "12:00:00.5" and "12:00" since
/// midnight. Nothing for other texts.
std::optional<double> seconds_of_clock(std::string_view text);

/// Whether it is a time of day without a date.
bool is_time_of_day(std::string_view text);

}  // namespace mobbscope
