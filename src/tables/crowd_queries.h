/// The queries of Table 1: those that a crowd asks at its choice points (paper, Section 5).
#pragma once

#include <crowd/simulate.h>
#include <tables/workload.h>

namespace mobbscope {

/// Lets a crowd play the scene's graph, or without one its clips whole and back to back, and takes a sample of
/// `queries` of what it asked (0: all). Throws InputError as simulate does.
Workload crowd_queries(Scene scene, const SimulateOptions& options, Recorded recorded, int queries,
                       const SimulationProgress& progress = {});

}  // namespace mobbscope
