#include <base/text.h>
#include <render/image/diff_options.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string_view>

namespace mobbscope {

namespace {

/// "1.2%" with the unit "%" as 1.2; nothing for other texts.
std::optional<double> number_with(std::string_view unit, std::string_view text) {
    if (!text.ends_with(unit)) return std::nullopt;
    return parse_double(text.substr(0, text.size() - unit.size()));
}

}  // namespace

std::int64_t DiffOptions::allowed(std::int64_t pixels) const {
    // Rounding must not take a pixel off what is a whole number.
    const double share = pixel_fraction * static_cast<double>(pixels) + 1e-6;
    // A few of few are most of them.
    const std::int64_t least = pixel_fraction > 0 ? std::min(least_pixels, pixels / 1000) : least_pixels;
    return std::max(least, static_cast<std::int64_t>(share));
}

void set_threshold(DiffOptions& options, const std::string& text) {
    std::optional<double> level;
    const std::size_t slash = text.find('/');
    if (slash != std::string::npos) {
        const auto above = parse_double(std::string_view(text).substr(0, slash));
        const auto below = parse_double(std::string_view(text).substr(slash + 1));
        if (above && below && *below > 0) level = *above * 255 / *below;
    } else if (const auto percent = number_with("%", text)) {
        level = *percent * 255 / 100;
    } else if (const auto number = parse_double(text)) {
        level = *number > 0 && *number < 1 ? *number * 255 : *number;
    }
    if (!level || !(*level >= 0 && *level <= 255)) {
        throw std::invalid_argument(in_quotes(text) +
                                    " is not a tolerance; give levels from 0 to 255 such as 3, or 3/255, or 1.2%");
    }
    options.channel_tolerance = options.tile_tolerance = *level;
}

void set_allowance(DiffOptions& options, const std::string& text) {
    constexpr double kMostPixels = 1e12;
    if (const auto pixels = number_with("px", text)) {
        const auto whole = static_cast<std::int64_t>(std::clamp(*pixels, -1.0, kMostPixels));
        if (whole >= 0 && static_cast<double>(whole) == *pixels) {
            options.least_pixels = whole;
            options.pixel_fraction = 0;
            return;
        }
    }
    const auto percent = number_with("%", text);
    const auto ppm = number_with("ppm", text);
    const auto share = percent ? *percent / 100 : ppm ? *ppm / 1e6 : parse_double(text);
    // A bare 1 is as likely one pixel or one per cent.
    if (!share || !(*share >= 0 && *share <= 1) || (!percent && !ppm && *share == 1)) {
        throw std::invalid_argument(
            in_quotes(text) + " is not a number of pixels; give one such as 12px, or a share such as 20ppm or 0.1%");
    }
    options.least_pixels = 0;
    options.pixel_fraction = *share;
}

}  // namespace mobbscope
