/// (scene, view state, size) -> pixels. Knows no window.
#pragma once

#include <scene/fitted_scene.h>
#include <scene/view_state.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace mobbscope {

/// Rows from top to bottom, 4 bytes a pixel (RGBA, straight alpha).
struct Image {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba;
};

/// Object ids, one pair of 32-bit numbers a pixel, rows from top to bottom. (0, 0) is nothing. The first number is
/// 1 + the participant's index; the second tells disks from boxes (see object_id.h).
struct IdImage {
    int width = 0;
    int height = 0;
    std::vector<std::uint32_t> rg;
};

}  // namespace mobbscope
