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
    obb2d,  ///< an oriented rectangle extruded in time: a MOBB node (paper, Section 3)
    obb3d,  ///< a free oriented box: a UMOBB node (paper, Section 4)
};

/// As in files: "obb2d", "obb3d".
std::string_view name(BoxKind kind);

/// An oriented box. Every box is complete in three dimensions; an obb2d has (0, 0, 1) as its third axis, so that it can
/// be tested against an obb3d. Lengths are metres; time is mixed in by the tree's time scale w (m/s).
struct Box {
    BoxKind kind = BoxKind::obb2d;
    glm::dvec3 center{0};
    std::array<glm::dvec3, 3> axes{glm::dvec3{1, 0, 0}, glm::dvec3{0, 1, 0}, glm::dvec3{0, 0, 1}};  ///< orthonormal
    glm::dvec3 half{0};  ///< half extents along the axes, >= 0
};

/// Space-time volume in m^2*s: the box's volume divided by w.
inline double volume(const Box& box, double time_scale) {
    return 8.0 * box.half.x * box.half.y * box.half.z / time_scale;
}

/// The eight corners in (x, y, w*t), index bits giving the sign along axis 0, 1, 2 (a set bit is +).
inline std::array<glm::dvec3, 8> corners(const Box& box) {
    std::array<glm::dvec3, 8> out;
    for (unsigned i = 0; i < 8; ++i) {
        const double s0 = (i & 1u) ? box.half.x : -box.half.x;
        const double s1 = (i & 2u) ? box.half.y : -box.half.y;
        const double s2 = (i & 4u) ? box.half.z : -box.half.z;
        out[i] = box.center + s0 * box.axes[0] + s1 * box.axes[1] + s2 * box.axes[2];
    }
    return out;
}

}  // namespace mobb
