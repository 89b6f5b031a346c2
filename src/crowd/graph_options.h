/// How a motion graph is cut out of recordings.
#pragma once

#include <scene/motion_graph.h>

#include <cstdint>

namespace mobbscope {

struct GraphOptions {
    /// Of every joint. Half a bound to a hub on either side makes a whole one from side to side.
    GraphBounds bounds{0.16, 0.6};
    double least_seconds = 1;  ///< that a move lasts, over 0
    double most_seconds = 4;   ///< at least least_seconds
    int hubs = 8;              ///< most hubs that a rig gets, at least 1
    int moves = 16;            ///< most moves from one hub to another, at least 1
    int candidates = 400;      ///< moments looked at as hubs, for each rig, at least 1
    int least_moves = 3;       ///< hubs and moves that all lead to each other stay if they have so many moves
    std::uint64_t seed = 1;    ///< decides which moments are looked at
};

}  // namespace mobbscope
