#include <base/text.h>
#include <import/clip/sample_times.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace mobbscope {

namespace {

constexpr double kWorthSaying = 1e-3;  // share of a sample
constexpr std::string_view kNotSure = " % of each sample's ";

/// Seconds between a time and the next double.
double rounding_at(double time) {
    const double size = std::abs(time);
    return std::nextafter(size, std::numeric_limits<double>::infinity()) - size;
}

}  // namespace

std::string coarse_times(double dt, double start, double duration) {
    const double share = mobb::unsure_time(start, duration) / dt;
    if (!(share > kWorthSaying)) return "";
    const double latest = std::abs(start) + duration;
    return "up to " + figure(100 * share, 2) + std::string(kNotSure) + brief(dt) +
           " s is not sure where it starts at " + brief(start) + " s: doubles tell times apart by " +
           figure(rounding_at(latest), 2) + " s there, and what two samples share for at most 1e-9 s is not tested";
}

void warn_of_coarse_times(const mobb::Clip& clip, double start, std::vector<ImportWarning>& warnings) {
    const auto is_known = [](const ImportWarning& one) { return one.text.find(kNotSure) != std::string::npos; };
    const std::string text = coarse_times(clip, start);
    if (text.empty() || std::ranges::any_of(warnings, is_known)) return;
    warnings.push_back({text + "; start nearer to 0, or give a larger dt"});
}

void check_file_times(double dt, double latest) {
    // A clip says itself that its dt is too small.
    if (!(dt > mobb::kLeastDt) || std::abs(latest) <= mobb::most_start(dt, 0)) return;
    throw std::invalid_argument("its times reach " + brief(latest) + " s, where doubles tell times apart by " +
                                figure(rounding_at(latest), 2) + " s, and its samples are " + brief(dt) +
                                " s apart; count times from a later moment");
}

std::string rounded_time_hint(double time) {
    constexpr double kFine = 1e-6;  // seconds
    const double rounding = rounding_at(time);
    return rounding < kFine ? ""
                            : " (doubles tell such times apart by " + figure(rounding, 2) +
                                  " s; count times from a later moment if that is why)";
}

}  // namespace mobbscope
