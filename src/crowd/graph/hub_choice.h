/// Chooses the hubs of a motion graph: moments that recur, so that the moves between them cover much of the recordings.
#pragma once

#include <crowd/graph/cut_search.h>
#include <scene/motion_graph.h>

#include <cstdint>
#include <vector>

namespace mobbscope {

/// How a motion graph is cut out of recordings.
struct GraphOptions {
    /// Of every transition. A cut may differ from its hub by half of each bound, two cuts at one hub by a whole one.
    GraphBounds bounds{0.16, 0.6};
    double least_seconds = 1;  ///< that a move lasts, over 0
    double most_seconds = 4;   ///< at least least_seconds
    double warp = 0.3;         ///< seconds over which a move is warped at either end, 0 or more; 0: not at all
    int hubs = 8;              ///< most hubs that a rig gets, at least 1
    int moves = 16;            ///< most moves from one hub to another, at least 1
    int candidates = 400;      ///< moments looked at as hubs, for each rig, at least 1
    int least_moves = 3;       ///< hubs and moves that all lead to each other stay if they have so many moves
    std::uint64_t seed = 1;    ///< decides which moments are looked at
    bool whole = false;        ///< takes clips whole instead: graph_of_whole_clips
};

/// A moment, and the places in the recordings that are like it.
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

/// A greedy choice among the candidates, all of one rig: takes the one that adds most to the seconds of the pieces that
/// lead to each other, again and again, up to options.hubs; ends when another would add less than a second.
std::vector<Hub> choose_hubs(const std::vector<Recording>& recordings, const std::vector<Hub>& candidates,
                             const GraphOptions& options);

}  // namespace mobbscope
