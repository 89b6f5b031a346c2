/// Where two pictures differ, for the eye.
#pragma once

#include <render/image.h>

#include <cstdint>
#include <span>

namespace mobbscope {

/// In the place of a pixel's difference: it was not compared.
inline constexpr std::int16_t kNotCompared = -1;

/// Of the reference's size, opaque. A faint grey ghost of the reference, blue where nothing was compared; pixels that
/// differ by more than the tolerance glow orange to white, the more the brighter, in a red halo that lets a single one
/// be seen in a large picture. `differences`: of each pixel, row by row, 0..255 or kNotCompared.
Image heat_map(const Image& reference, std::span<const std::int16_t> differences, double tolerance);

}  // namespace mobbscope
