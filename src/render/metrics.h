/// How large text, lines and gaps are in a picture.
#pragma once

#include <render/image.h>

#include <algorithm>
#include <cmath>

namespace mobbscope {

/// Pixels, but for `scale`: of line widths and all that is given at 1280x720.
struct Metrics {
    float scale = 1;
    float text = 12;
    float small = 11;
    float pad = 14;  ///< along the picture's edges
};

/// Text and lines grow with the picture, but slower, and stay readable in small ones.
inline Metrics metrics_of(PictureSize size) {
    const double pixels = static_cast<double>(size.width) * size.height;
    Metrics m;
    m.scale = static_cast<float>(std::clamp(std::sqrt(pixels / (1280.0 * 720.0)), 0.8, 4.0));
    m.text = std::round(12 * m.scale);
    m.small = std::round(11 * m.scale);
    m.pad = std::round(std::min(14 * m.scale, 0.05f * static_cast<float>(std::min(size.width, size.height))));
    return m;
}

}  // namespace mobbscope
