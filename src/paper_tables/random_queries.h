/// Queries between clips at random places, for measurements. Needs clips alone, so that it can also be compiled beside
/// an earlier state of the library (bench/compare).
#pragma once

#include <mobb/clip.h>

#include <cstdint>
#include <vector>

namespace mobbscope {

struct WorkloadQuery {
    int clip_a = 0;  ///< index into the clips
    int clip_b = 0;
    mobb::Placement a, b;
};

/// How far apart the two clips of a query may be. The defaults give the paper's 0.83 box tests of the roots a query:
/// with offsets of up to `offset` clip lengths, 1 / offset of the queries overlap in time.
struct QueryDraw {
    double range = 3.5;   ///< metres > 0: each coordinate within +-this; of real long clips some 28 % then collide
    double offset = 1.2;  ///< clip lengths, >= 1: B begins within this many of its own before A, or of A's after
    std::uint64_t seed = 1;
};

/// `count` queries: A is at the origin from time 0; B is turned by any angle about the middle of the rectangle that its
/// path spans, which then is within `range` of the middle of A's. The same for the same seed on every machine.
std::vector<WorkloadQuery> random_queries(const std::vector<mobb::ClipPtr>& clips, int count, const QueryDraw& draw);

}  // namespace mobbscope
