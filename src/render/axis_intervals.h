/// Why a box test ended as it did: what both boxes cover along every axis that it tries.
#pragma once

#include <mobb/trace.h>
#include <render/subject.h>

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
std::vector<AxisInterval> axis_intervals(std::span<const Subject> sides, const mobb::Trace::Event& event);

}  // namespace mobbscope
