/// The one place that decides a hit (paper, Eq. 1; for swept disks, its alternative of Section 3). Every leaf and the
/// direct search use these functions, in double and without fused multiply-add, so all of them agree bit for bit. The
/// mobb::mobb target brings -ffp-contract=off for that; whoever compiles these headers without it must give it too.
#pragma once

#include <mobb/clip.h>

#include <glm/vec2.hpp>

#include <algorithm>
#include <cfloat>
#include <cmath>

#if defined(__FAST_MATH__)
#error "mobb promises the same answer everywhere: do not build with -ffast-math"
#endif
static_assert(FLT_EVAL_METHOD == 0, "doubles must be evaluated as doubles");

namespace mobb {

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

/// A disk over a hold interval [begin, end) of global time, seconds: centre and radius run linearly. A held one stays.
struct SweptDisk {
    Disk from;
    Disk to;
    double begin = 0;
    double end = 0;

    /// At a time in the interval; as stored at its ends.
    Disk at(double time) const {
        if (time <= begin) return from;
        if (time >= end) return to;
        const double s = (time - begin) / (end - begin);
        return {from.x + s * (to.x - from.x), from.y + s * (to.y - from.y), from.r + s * (to.r - from.r)};
    }
};

/// Two swept disks over the time that they share, as s runs from 0 to 1. With d the way from one centre to the other
/// and r the sum of the radii, f(s) = |d|^2 - r^2 = A s^2 + B s + C is below 0 exactly where the disks overlap.
/// Symmetric in its arguments to the last bit, but for the sign of `d` and `d_change`.
class Approach {
  public:
    /// They must share time.
    Approach(const SweptDisk& a, const SweptDisk& b) : t0(std::max(a.begin, b.begin)), t1(std::min(a.end, b.end)) {
        const Disk a0 = a.at(t0), a1 = a.at(t1), b0 = b.at(t0), b1 = b.at(t1);
        d = {a0.x - b0.x, a0.y - b0.y};
        r = a0.r + b0.r;
        const glm::dvec2 d1{a1.x - b1.x, a1.y - b1.y};
        const double r1 = a1.r + b1.r;
        d_change = {d1.x - d.x, d1.y - d.y};
        r_change = r1 - r;
        A = d_change.x * d_change.x + d_change.y * d_change.y - r_change * r_change;
        B = 2 * (d.x * d_change.x + d.y * d_change.y - r * r_change);
        C = d.x * d.x + d.y * d.y - r * r;
        at_end = d1.x * d1.x + d1.y * d1.y - r1 * r1;
    }

    /// Whether the disks overlap at some time. Decides without a division.
    bool collides() const { return C < 0 || at_end < 0 || (A > 0 && -2 * A < B && B < 0 && B * B > 4 * A * C); }

    /// Whether neither moves against the other.
    bool is_still() const { return d_change == glm::dvec2(0) && r_change == 0; }
    double time(double s) const { return s >= 1 ? t1 : t0 + s * (t1 - t0); }
    double squared_distance(double s) const {
        const double x = d.x + s * d_change.x;
        const double y = d.y + s * d_change.y;
        return x * x + y * y;
    }
    double radii(double s) const { return r + s * r_change; }

    /// Metres between the disks; < 0: how deep they overlap.
    double clearance(double s) const { return std::sqrt(squared_distance(s)) - radii(s); }
    /// An s at which the clearance is least, the earliest but for rounding. Not where f is, if the radii change.
    double nearest() const {
        const double along = d.x * d_change.x + d.y * d_change.y;
        const double speed_squared = d_change.x * d_change.x + d_change.y * d_change.y;
        if (speed_squared <= r_change * r_change) return clearance(1) < clearance(0) ? 1 : 0;
        const double aside = std::abs(d.x * d_change.y - d.y * d_change.x);
        const double beyond = aside * r_change / std::sqrt(speed_squared - r_change * r_change);
        return std::clamp((beyond - along) / speed_squared, 0.0, 1.0);
    }
    /// The earliest s at which f is least.
    double least() const {
        if (A > 0) return std::clamp(-B / (2 * A), 0.0, 1.0);
        return at_end < C ? 1 : 0;
    }
    /// Where f is below 0, of disks that collide. One range of s: |d| is convex and r a line that is nowhere below 0.
    struct Range {
        double begin = 0;
        double end = 1;
    };
    Range overlap() const {
        // The roots of f without cancellation; where f hardly dips below 0 rounding may leave none.
        const auto in_range = [](double s) { return std::clamp(s, 0.0, 1.0); };
        const double root = std::sqrt(std::max(B * B - 4 * A * C, 0.0));
        const double q = B > 0 ? -B - root : -B + root;
        const double by_c = q != 0 ? in_range(2 * C / q) : 0;
        const double by_a = A != 0 ? in_range(q / (2 * A)) : 1;
        Range out;
        // From the root at which f falls to the one at which it rises.
        if (C >= 0) out.begin = B > 0 ? by_a : by_c;
        if (at_end >= 0) out.end = std::max(out.begin, B > 0 ? by_c : by_a);
        return out;
    }

    double t0, t1;           ///< global seconds
    glm::dvec2 d, d_change;  ///< metres: at s = 0, and what is added until s = 1
    double r, r_change;      ///< likewise
    double A, B, C;          ///< m^2
    double at_end;           ///< f(1), from the disks at the end
};

}  // namespace mobb
