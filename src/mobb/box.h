/// Boxes in space-time (x, y, w*t).
#pragma once

#include <mobb/kinds.h>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <numbers>

namespace mobb {

/// An oriented box, or one sheared along time. A block is the leaning cylinder inside its box: half.x is its radius.
/// Every box is complete in three dimensions; all but an obb3d have (0, 0, 1) as their third axis, so that an obb2d can
/// be tested against an obb3d. Lengths are metres; time is mixed in by the tree's time scale w (m/s).
struct Box {
    BoxKind kind = BoxKind::obb2d;
    glm::dvec3 center{0};
    std::array<glm::dvec3, 3> axes{glm::dvec3{1, 0, 0}, glm::dvec3{0, 1, 0}, glm::dvec3{0, 0, 1}};  ///< orthonormal
    glm::dvec3 half{0};   ///< half extents along the axes, >= 0
    glm::dvec2 drift{0};  ///< a moving box or block: how far it moves from the middle of its time to the end; else 0
};

/// From the centre to the middles of the faces on the positive sides: half the edges of the box.
inline std::array<glm::dvec3, 3> half_edges(const Box& box) {
    return {box.half.x * box.axes[0], box.half.y * box.axes[1],
            box.half.z * box.axes[2] + glm::dvec3(box.drift.x, box.drift.y, 0)};
}

/// Space-time volume in m^2*s: the box's volume divided by w; of a block, that of its cylinder.
inline double volume(const Box& box, double time_scale) {
    const double of_box = 8.0 * box.half.x * box.half.y * box.half.z / time_scale;
    return box.kind == BoxKind::block ? std::numbers::pi / 4 * of_box : of_box;
}

/// The eight corners in (x, y, w*t), index bits giving the sign along axis 0, 1, 2 (a set bit is +).
inline std::array<glm::dvec3, 8> corners(const Box& box) {
    const std::array<glm::dvec3, 3> edges = half_edges(box);
    std::array<glm::dvec3, 8> out;
    for (unsigned i = 0; i < 8; ++i) {
        out[i] = box.center;
        for (unsigned k = 0; k < 3; ++k) out[i] += ((i >> k) & 1u ? 1.0 : -1.0) * edges[k];
    }
    return out;
}

}  // namespace mobb
