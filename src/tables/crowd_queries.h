/// The queries of Table 1: those that a crowd asks at its choice points (paper, Section 5).
#pragma once

#include <crowd/simulate.h>
#include <tables/workload.h>

namespace mobbscope {

/// How near a committed motion comes to a candidate's on the floor, at any time, for the pair to be asked. Within 3 m
/// the roots reject some 80 % of the queries, as in the paper.
inline constexpr double kAskedWithin = 3;

/// Lets a crowd play the scene's graph, or without one its clips whole and back to back, and takes a sample of
/// `queries` of the pairs of a candidate and another agent's committed motion within kAskedWithin (0: all of them).
/// Throws InputError as simulate does.
Workload crowd_queries(Scene scene, const SimulateOptions& options, int queries,
                       const SimulationProgress& progress = {});

}  // namespace mobbscope
