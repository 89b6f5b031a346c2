/// The queries of Table 2: clips at random places, headings and times (paper, Section 5).
#pragma once

#include <tables/workload.h>

#include <cstdint>

namespace mobbscope {

/// How far apart the two clips of a query may be. The defaults give the paper's 0.83 box tests of the roots a query:
/// with offsets of up to `offset` clip lengths, 1 / offset of the queries overlap in time.
struct QueryDraw {
    double translation = 3.5;  ///< metres: each coordinate within +-this; of real long clips some 28 % then collide
    double offset = 1.2;       ///< clip lengths, >= 1: B begins within this many of its own before A, or of A's after
    std::uint64_t seed = 1;
};

/// `count` queries: A is at the origin from time 0; B is turned by any angle about the middle of the rectangle that its
/// path spans, which then is within `translation` of the middle of A's. The same for the same seed on every machine.
std::vector<WorkloadQuery> random_queries(const std::vector<mobb::ClipPtr>& clips, int count, const QueryDraw& draw);

}  // namespace mobbscope
