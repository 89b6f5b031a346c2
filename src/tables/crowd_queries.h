/// The queries of Table 1: those that a crowd asks at its choice points (paper, Section 5).
#pragma once

#include <crowd/simulate.h>
#include <tables/workload.h>

namespace mobbscope {

/// With these the queries are like the paper's: some 80 % end at the roots, and 0.45 test their boxes. More than half
/// are apart in time, so its agents knew more of each other than what plays now.
inline constexpr double kAskedWithin = 1;  ///< metres: how near a committed motion comes to a candidate's, at any time
inline constexpr double kChosenAhead = 2.5;  ///< seconds before its begin at which a move is chosen

/// Lets a crowd play the scene's graph, or without one its clips whole and back to back, and takes a sample of
/// `queries` of the pairs of a candidate and another agent's committed motion within kAskedWithin (0: all of them).
/// `options.ahead` becomes kChosenAhead. Throws InputError as simulate does.
Workload crowd_queries(Scene scene, SimulateOptions options, int queries, const SimulationProgress& progress = {});

}  // namespace mobbscope
