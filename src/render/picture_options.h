/// How a picture is made, beside what it shows.
#pragma once

#include <render/image.h>
#include <render/palette.h>
#include <render/renderer.h>

#include <optional>

namespace mobbscope {

struct PictureOptions {
    PictureSize size{1280, 720};
    double scale = 0;                  ///< of text and lines, as build_draw_list takes it
    int samples = kPictureSamples;     ///< per pixel of the scene: 1, 2, 4 or 8
    std::optional<Rgba> background{};  ///< instead of the theme's; opacity below 1: seen through where nothing is drawn
};

}  // namespace mobbscope
