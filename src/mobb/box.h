/// Boxes in space-time (x, y, w*t).
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <string_view>

namespace mobb {

/// What a box is, and so which test two boxes get.
enum class BoxKind : std::uint8_t {
    obb2d,   ///< an oriented rectangle extruded in time: a MOBB node (paper, Section 3)
    obb3d,   ///< a free oriented box: a UMOBB node (paper, Section 4)
    moving,  ///< an oriented rectangle whose centre moves at a constant velocity, as in TPR-trees (Saltenis et al.
             ///< 2000)
    aabb,    ///< a rectangle along x and y, of the clip and again of the world, extruded in time
};

/// As in files: "obb2d", "obb3d", "moving", "aabb".
std::string_view name(BoxKind kind);

/// An oriented box, or one sheared along time. Every box is complete in three dimensions; all but an obb3d have (0, 0,
/// 1) as their third axis, so that an obb2d can be tested against an obb3d. Lengths are metres; time is mixed in by the
/// tree's time scale w (m/s).
struct Box {
    BoxKind kind = BoxKind::obb2d;
    glm::dvec3 center{0};
    std::array<glm::dvec3, 3> axes{glm::dvec3{1, 0, 0}, glm::dvec3{0, 1, 0}, glm::dvec3{0, 0, 1}};  ///< orthonormal
    glm::dvec3 half{0};   ///< half extents along the axes, >= 0
    glm::dvec2 drift{0};  ///< a moving box: how far its rectangle moves from the middle of its time to the end; else 0
};

/// From the centre to the middles of the faces on the positive sides: half the edges of the box.
inline std::array<glm::dvec3, 3> half_edges(const Box& box) {
    return {box.half.x * box.axes[0], box.half.y * box.axes[1],
            box.half.z * box.axes[2] + glm::dvec3(box.drift.x, box.drift.y, 0)};
}

/// Space-time volume in m^2*s: the box's volume divided by w.
inline double volume(const Box& box, double time_scale) {
    return 8.0 * box.half.x * box.half.y * box.half.z / time_scale;
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
