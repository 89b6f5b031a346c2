/// How near two placed clips come to each other, moment by moment.
#pragma once

#include <explain/value_columns.h>
#include <mobb/clip.h>
#include <mobb/query.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace mobbscope {

/// A pair of samples that share time. Between two events of held clips nothing moves; disks of linear clips run.
struct ClearancePiece {
    mobb::Approach approach;
    double t0 = 0;  ///< what they share, global seconds [t0, t1)
    double t1 = 0;
    double clearance = 0;  ///< the least over that time, metres; below 0 exactly where the pair collides
    double least_at = 0;   ///< global seconds: when, the earliest
    int a_sample = 0;
    int b_sample = 0;
};

/// Of a piece at a global time in it, metres.
double clearance_at(const ClearancePiece& piece, double time);

struct Clearance {
    std::vector<ClearancePiece> pieces;  ///< in order of time, every pair that the direct search would measure
    std::optional<std::size_t> least;    ///< the piece that is nearest, the earliest of equals; none without pieces
    std::optional<std::size_t> contact;  ///< the first piece that collides
    double contact_time = 0;             ///< global seconds: when it begins to
};

/// Takes time linear in the samples that share time.
Clearance clearance_over_time(const mobb::PlacedClip& a, const mobb::PlacedClip& b);

/// The sum of two samples' radii at the time at which a trace measures their distance, metres (mobb::Approach::least).
double measured_radii(const mobb::PlacedClip& a, const mobb::PlacedClip& b, int i, int j);

/// How deep two samples that collide overlap at the most, metres.
double most_overlap(const mobb::PlacedClip& a, const mobb::PlacedClip& b, int i, int j);

/// [t0, t1) in so many columns of equal width. t1 > t0, columns >= 1.
std::vector<ValueColumn> columns_of(const Clearance& clearance, double t0, double t1, int columns);

}  // namespace mobbscope
