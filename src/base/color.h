/// Colours as numbers.
#pragma once

#include <glm/vec4.hpp>

#include <cstdint>

namespace mobbscope {

/// Red, green, blue and opacity, 0..1, straight alpha, as stored in the picture (no colour management).
using Rgba = glm::vec4;

/// 0xRRGGBB.
inline Rgba hex(std::uint32_t rgb, float alpha = 1) {
    const auto channel = [&](unsigned shift) { return static_cast<float>((rgb >> shift) & 255u) / 255.0f; };
    return {channel(16), channel(8), channel(0), alpha};
}

}  // namespace mobbscope
