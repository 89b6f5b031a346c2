/// Pictures that are seen through where nothing is drawn.
#pragma once

#include <base/color.h>
#include <render/image/image.h>

namespace mobbscope {

/// A picture on an opaque ground.
struct OnGround {
    const Image& image;
    Rgba ground;
};

/// The same picture on two grounds of different lightness gives what was drawn and how much it covers; that over
/// `background`, with straight alpha. Laid over the first ground, what is drawn is the first picture again, within
/// rounding.
Image with_transparent_background(const OnGround& first, const OnGround& second, Rgba background);

}  // namespace mobbscope
