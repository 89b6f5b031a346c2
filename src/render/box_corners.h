/// The corners of a box that is drawn.
#pragma once

#include <render/draw_list.h>

#include <array>

namespace mobbscope {

/// By the sign along each axis: bit i of the index is set where it is positive along extent i.
inline std::array<glm::vec3, 8> box_corners(const BoxInstance& box) {
    std::array<glm::vec3, 8> out;
    for (unsigned bits = 0; bits < 8; ++bits) {
        out[bits] = box.center;
        for (unsigned axis = 0; axis < 3; ++axis) out[bits] += box.extents[axis] * ((bits >> axis) & 1u ? 1.0f : -1.0f);
    }
    return out;
}

/// The pairs of corners that an edge joins.
inline constexpr std::array<std::array<unsigned, 2>, 12> kBoxEdges{
    {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3}, {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};

}  // namespace mobbscope
