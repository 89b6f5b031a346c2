/// How a picture is made, beside what it shows.
#pragma once

#include <render/drawlist/palette.h>
#include <render/image/image.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace mobbscope {

/// Samples per pixel of a picture's scene: smooth edges at a quarter of the cost of drawing it larger.
inline constexpr int kPictureSamples = 4;

struct PictureOptions {
    PictureSize size{1280, 720};
    double scale = 0;                  ///< of text and lines, as build_draw_list takes it
    int samples = kPictureSamples;     ///< per pixel of the scene: 1, 2, 4 or 8
    std::optional<Rgba> background{};  ///< instead of the theme's; opacity below 1: seen through where nothing is drawn
    /// The agent that is selected, by the name that views have for it: of many it stands out and the rest dims. Empty:
    /// none.
    std::string selected{};
    bool controls = false;  ///< with what folds its overlays, as a window has it
};

/// The smallest and largest side of a picture, and the most pixels that it may have.
inline constexpr int kMinSide = 64;
inline constexpr int kMaxSide = 8192;
inline constexpr int kMaxPixels = 7680 * 4320;

/// Throws std::invalid_argument, saying what is allowed, unless a picture of this size can be made.
void check(PictureSize size);

/// Of a picture that is drawn: 8K with one sample, 5K with four. More would take over 2 GB: some 30 bytes a pixel and
/// 18 a sample.
inline constexpr std::int64_t kMostDrawn = std::int64_t{3} * kMaxPixels;  // pixels times samples and two
/// The same, and that so many samples of each pixel can be kept.
void check(const PictureOptions& options);

/// "1280x720". Throws std::invalid_argument if it is no such text or check refuses it.
PictureSize parse_size(const std::string& text);

/// The theme's palette; an opaque background replaces its own.
Palette palette_for(Theme theme, const PictureOptions& options);

/// "1", "2", "4" or "8". Throws std::invalid_argument saying what is allowed.
int parse_samples(const std::string& text);

/// "#RRGGBB", "#RRGGBBAA" or "transparent". Throws std::invalid_argument saying what is allowed.
Rgba parse_background(const std::string& text);

/// Pixels, but for `scale`: of line widths and all that is given at 1280x720.
struct Metrics {
    float scale = 1;
    float text = 12;
    float small = 11;
    float pad = 14;  ///< along the picture's edges
};

/// What a caller may ask for.
inline constexpr double kLeastScale = 0.5;
inline constexpr double kMostScale = 8;

/// Text and lines have one size from small windows up to 1280x720; they grow with larger pictures, but slower, and
/// shrink with tiny ones, but stay readable.
inline double usual_scale(PictureSize size) {
    constexpr double kSmall = 400'000;
    constexpr double kLarge = 1280.0 * 720.0;
    const double pixels = static_cast<double>(size.width) * size.height;
    if (pixels < kSmall) return std::max(std::sqrt(pixels / kSmall), 0.8);
    return std::clamp(std::sqrt(pixels / kLarge), 1.0, 4.0);
}

/// `scale`: of text and lines, kLeastScale..kMostScale; 0: the usual.
inline Metrics metrics_of(PictureSize size, double scale = 0) {
    Metrics m;
    m.scale = static_cast<float>(scale > 0 ? scale : usual_scale(size));
    m.text = std::round(12 * m.scale);
    m.small = std::round(11 * m.scale);
    m.pad = std::round(std::min(14 * m.scale, 0.05f * static_cast<float>(std::min(size.width, size.height))));
    return m;
}

}  // namespace mobbscope
