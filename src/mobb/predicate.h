/// The one place that decides a hit (paper, Eq. 1). Every leaf and the direct search use these functions, in double and
/// without fused multiply-add, so all of them agree bit for bit. The mobb::mobb target brings -ffp-contract=off for
/// that; whoever compiles these headers without it must give it too.
#pragma once

#include <mobb/clip.h>

#include <algorithm>
#include <cfloat>

#if defined(__FAST_MATH__)
#error "mobb promises the same answer everywhere: do not build with -ffast-math"
#endif
static_assert(FLT_EVAL_METHOD == 0, "doubles must be evaluated as doubles");

namespace mobb {

/// Two half-open time intervals overlap if they share more than this many seconds; sharing an end point is not
/// overlapping.
inline constexpr double kMinOverlap = 1e-9;

inline bool overlap_in_time(double begin_a, double end_a, double begin_b, double end_b) {
    return std::min(end_a, end_b) - std::max(begin_a, begin_b) > kMinOverlap;
}

/// Squared distance of the centres, m^2. Symmetric in its arguments to the last bit.
inline double squared_distance(const Disk& a, const Disk& b) {
    const double dx = a.x - b.x;
    const double dy = a.y - b.y;
    return dx * dx + dy * dy;
}

/// Touching is not colliding.
inline bool collide(const Disk& a, const Disk& b) {
    const double reach = a.r + b.r;
    return squared_distance(a, b) < reach * reach;
}

}  // namespace mobb
