/// Why a box test ended as it did: what both boxes cover along every axis that it tries.
#pragma once

#include <mobb/box.h>
#include <mobb/trace.h>
#include <scene/drawn_agent.h>

#include <span>
#include <string>
#include <vector>

namespace mobbscope {

/// Metres along a unit axis in (x, y, w*t), counted from the middle of A's box. Of moving boxes: at the moment of their
/// common time when they are nearest along the axis.
struct AxisInterval {
    int axis = 0;      ///< as mobb::Separation counts them
    std::string name;  ///< "A long", "B short", "A long x B short", "x"
    double a_min = 0, a_max = 0;
    double b_min = 0, b_max = 0;
    double gap = 0;  ///< between the two; below 0: how far they overlap
};

/// Of a box test, in the order in which its test tries the axes, also those after the one that separates;
/// edge-edge axes that it skips are left out. Empty for another event. `sides`: A and B.
std::vector<AxisInterval> axis_intervals(std::span<const DrawnAgent> sides, const mobb::Trace::Event& event);

/// The axis that separated two boxes, unit, in the world's (x, y, w*t). Requires a box test that ended so.
glm::dvec3 separating_axis(const mobb::PlacedTree& a, const mobb::PlacedTree& b, const mobb::Trace::Event& event);

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
/// one frame; of an aabb test in the world's directions, of a block test from centre to centre when they are nearest.
glm::dvec3 test_axis(const mobb::Box& a, const mobb::Box& b, mobb::TestKind test, int axis);

/// Where an axis comes from: an axis of A's box, one of B's, one of each, across both, or neither's. -1: none.
struct AxisOrigin {
    int a = -1;
    int b = -1;
};
AxisOrigin axis_origin(mobb::TestKind test, int axis);

/// "long", "middle" or "short": how far the box reaches along its axis `axis`, among the 2 or 3 that the test knows.
std::string axis_word(const mobb::Box& box, mobb::TestKind test, int axis);

/// Two boxes in one frame of (x, y, w*t).
struct BoxPair {
    mobb::Box a, b;
};

/// The boxes as a test along an axis sees them. Those that move: at the moment of their common time when they are
/// nearest, without extent in time. `axis`: unit.
BoxPair as_tested(const BoxPair& boxes, mobb::TestKind test, glm::dvec3 axis);

}  // namespace mobbscope
