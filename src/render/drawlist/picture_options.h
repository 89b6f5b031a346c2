/// How a picture is made, beside what it shows.
#pragma once

#include <render/drawlist/palette.h>
#include <render/image/image.h>

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
    /// The camera's target comes of a common framing: the scene keeps out of the words, as without a target.
    bool framed = false;
};

/// The theme's palette; an opaque background replaces its own.
Palette palette_for(Theme theme, const PictureOptions& options);

/// "1", "2", "4" or "8". Throws std::invalid_argument saying what is allowed.
int parse_samples(const std::string& text);

/// "#RRGGBB", "#RRGGBBAA" or "transparent". Throws std::invalid_argument saying what is allowed.
Rgba parse_background(const std::string& text);

}  // namespace mobbscope
