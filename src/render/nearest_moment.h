/// The moment that a test of two moving boxes looks at.
#pragma once

#include <mobb/box.h>

namespace mobbscope {

/// Two boxes in one frame of (x, y, w*t).
struct BoxPair {
    mobb::Box a, b;
};

/// Two moving boxes at the moment of their common time when they are nearest along an axis: rectangles without extent
/// in time. `axis`: unit, on the floor.
BoxPair at_nearest_moment(const BoxPair& boxes, glm::dvec3 axis);

}  // namespace mobbscope
