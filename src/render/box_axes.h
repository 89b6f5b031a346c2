/// The axes that a box test tries: their directions, their names, and what boxes cover along them.
#pragma once

#include <mobb/box.h>
#include <mobb/trace.h>

#include <string>

namespace mobbscope {

/// What a box covers along an axis, metres.
struct Projection {
    double min = 0;
    double max = 0;
    double middle() const { return 0.5 * (min + max); }
    /// Counted from another place.
    Projection minus(double origin) const { return {min - origin, max - origin}; }
};

/// `axis`: unit.
Projection project(const mobb::Box& box, glm::dvec3 axis);

/// Whether the test tries that axis: it skips edge-edge axes that are too short. Both boxes in one frame.
bool is_tried(const mobb::Box& a, const mobb::Box& b, mobb::TestKind test, int axis);

/// The direction of axis number `axis` of a box test (see mobb::Separation), unit; of one that it tries. Both boxes in
/// one frame; of an aabb test in the world's directions.
glm::dvec3 test_axis(const mobb::Box& a, const mobb::Box& b, mobb::TestKind test, int axis);

/// Where an axis comes from: an axis of A's box, one of B's, one of each, across both, or none: the world's. -1: none.
struct AxisOrigin {
    int a = -1;
    int b = -1;
};
AxisOrigin axis_origin(mobb::TestKind test, int axis);

/// "long", "middle" or "short": how far the box reaches along its axis `axis`, among the 2 or 3 that the test knows.
std::string axis_word(const mobb::Box& box, mobb::TestKind test, int axis);

}  // namespace mobbscope
