/// Boxes in space-time (x, y, w*t).
#pragma once

#include <mobb/kinds.h>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <numbers>

namespace mobb {

/// An oriented box, or one sheared along time; of a round kind the cylinder inside it: half.x is its radius.
/// Every box is complete in three dimensions; all but an obb3d have (0, 0, 1) as their third axis, so that an obb2d can
/// be tested against an obb3d. Lengths are metres; time is mixed in by the tree's time scale w (m/s).
struct Box {
    BoxKind kind = BoxKind::obb2d;
    glm::dvec3 center{0};
    std::array<glm::dvec3, 3> axes{glm::dvec3{1, 0, 0}, glm::dvec3{0, 1, 0}, glm::dvec3{0, 0, 1}};  ///< orthonormal
    glm::dvec3 half{0};   ///< half extents along the axes, >= 0
    glm::dvec2 drift{0};  ///< a box that moves: how far it moves from the middle of its time to the end; else 0
};

/// What an upright box is at any time, on the floor, metres: a rectangle, or the square around a disk.
struct Rectangle {
    glm::dvec2 center{0};
    glm::dvec2 axis{1, 0};  ///< of unit length; the second one is perpendicular to it
    glm::dvec2 half{0};     ///< half extents along the axis and across it, >= 0
};

constexpr bool is_upright(BoxKind kind) { return info(kind).is_upright(); }

/// A quarter turn, counter-clockwise.
inline glm::dvec2 perpendicular(glm::dvec2 v) { return {-v.y, v.x}; }

/// The upright box over a rectangle from t0 to t1 (w*t).
inline Box over_time(BoxKind kind, const Rectangle& rectangle, double t0, double t1) {
    const glm::dvec2 u = rectangle.axis, v = perpendicular(u);
    Box box;
    box.kind = kind;
    box.center = {rectangle.center, (t0 + t1) / 2};
    box.axes = {glm::dvec3{u.x, u.y, 0}, glm::dvec3{v.x, v.y, 0}, glm::dvec3{0, 0, 1}};
    box.half = {rectangle.half, (t1 - t0) / 2};
    return box;
}

/// The rectangle of an upright box.
inline Rectangle rectangle_of(const Box& box) {
    return {glm::dvec2(box.center), glm::dvec2(box.axes[0]), glm::dvec2(box.half)};
}

/// From the centre to the middles of the faces on the positive sides: half the edges of the box.
inline std::array<glm::dvec3, 3> half_edges(const Box& box) {
    return {box.half.x * box.axes[0], box.half.y * box.axes[1],
            box.half.z * box.axes[2] + glm::dvec3(box.drift.x, box.drift.y, 0)};
}

/// Space-time volume in m^2*s: the box's volume divided by w; of a round one, that of its cylinder.
inline double volume(const Box& box, double time_scale) {
    const double of_box = 8.0 * box.half.x * box.half.y * box.half.z / time_scale;
    return info(box.kind).round ? std::numbers::pi / 4 * of_box : of_box;
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
