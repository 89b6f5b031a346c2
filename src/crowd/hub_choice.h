/// Which moments become hubs: those that recur most, so that much of the recordings lies between them.
#pragma once

#include <crowd/cut_search.h>
#include <crowd/graph_options.h>

#include <cstddef>
#include <vector>

namespace mobbscope {

/// A moment and where recordings come by it.
struct Hub {
    HubMoment moment;
    std::vector<Cut> cuts;
};

/// A part of a recording from a cut at one hub to a cut at another, or at the same.
struct Piece {
    int from = 0;  ///< index into the hubs
    int to = 0;
    Cut begin;
    Cut end;  ///< of the same recording, later
};

/// Every part of the recordings that lasts as long as a move may, ordered by recording, begin and end. Parts in which
/// the path jumps, as captures do where they are damaged, are left out.
std::vector<Piece> pieces_between(const std::vector<Recording>& recordings, const std::vector<Hub>& hubs,
                                  const GraphOptions& options);

/// Takes hub after hub of one rig, each the candidate that lets pieces which lead to each other cover the most seconds
/// more; ends at options.hubs, or when another would add less than a second. `candidates`: all of one rig.
std::vector<Hub> choose_hubs(const std::vector<Recording>& recordings, const std::vector<Hub>& candidates,
                             const GraphOptions& options);

}  // namespace mobbscope
