/// Which samples of two placed clips share time, and a scan for those that are near, where both have one dt.
#pragma once

#include <mobb/clip.h>
#include <mobb/predicate.h>

#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mobb {

/// How the samples of two sources of equal dt meet: sample j of B shares time with sample j + shift of A and, if it
/// meets two, with the next one. Nothing is known of sources of different dt, nor where rounded times could make
/// kMinOverlap decide otherwise for one pair than for another.
struct SampleShift {
    int shift = 0;
    int partners = 0;  ///< 1 or 2; 0: nothing is known

    SampleShift() = default;
    /// Of frames whose samples are `dt_a` and `dt_b` seconds apart.
    SampleShift(const PlacedFrame& a, double dt_a, const PlacedFrame& b, double dt_b) {
        if (dt_a != dt_b) return;
        const double dt = dt_a;
        const double later = b.start - a.start;
        const double samples = later / dt;
        constexpr double kFarthest = 1e9;  // twice as many samples as a clip may have: int still holds the sums
        if (!(std::abs(samples) < kFarthest)) return;
        const int rounded = static_cast<int>(samples);
        const int whole = rounded - (rounded > samples ? 1 : 0);
        // Each time is rounded twice, and so are `later` and what is left of it.
        const double times = std::abs(a.start) + std::abs(b.start) + a.duration + b.duration;
        const double rounding = 4 * std::numeric_limits<double>::epsilon() * times;
        const double with_next = later - whole * dt;
        const double with_first = dt - with_next;
        const auto is_known = [&](double overlap) { return std::abs(overlap - kMinOverlap) > rounding; };
        if (!is_known(with_first) || !is_known(with_next)) return;
        const bool first = with_first > kMinOverlap;
        const bool next = with_next > kMinOverlap;
        shift = whole + (first ? 0 : 1);
        partners = (first ? 1 : 0) + (next ? 1 : 0);
    }

    bool is_known() const { return partners > 0; }
    /// Whether two ranges of samples share time: what overlap_in_time says of their times.
    bool overlap(int first_a, int end_a, int first_b, int end_b) const {
        return (first_b + shift < end_a) & (end_b + shift + partners - 1 > first_a);
    }
};

/// Takes disks of B, as stored, into the frame in which those of A are stored.
struct StoredRelation {
    Rotation rotation;
    glm::dvec2 translate{0, 0};  ///< metres
    double slack = 0;            ///< metres: how much nearer the predicate may see two disks than this relation does
};

/// Of `count` disks b[0], b[1], ... how many come before the first that may collide with a partner: disk k has a[k] for
/// a partner and, if it has two, a[k + 1]. Never passes over a pair for which the predicate says that it collides.
int count_apart(const Disk* a, const Disk* b, int count, int partners, const StoredRelation& relation);

}  // namespace mobb
