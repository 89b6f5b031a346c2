/// Who comes too close to whom: every pair of a crowd that collides, found through the trees.
#pragma once

#include <mobb/placed_tree.h>
#include <mobb/query.h>
#include <scene/crowd_run.h>
#include <scene/fitted_scene.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace mobbscope {

/// Two members of a crowd that collide (mobb/predicate.h).
struct Conflict {
    int a = 0;  ///< index into the crowd; less than b
    int b = 0;
    std::vector<mobb::Interval> intervals;  ///< all that they collide over, earliest first; at least one
    /// Metres: the least of distance of centres minus radii over the pairs of samples that overlap in time; at most 0.
    double least_clearance = 0;
    double time = 0;  ///< global seconds: when it is so; of held clips when that pair's overlap begins; the earliest
    int a_sample = 0;
    int b_sample = 0;
};

struct Conflicts {
    std::vector<Conflict> found;    ///< by a, then b
    std::int64_t pairs_tested = 0;  ///< that were asked of the trees, or searched directly
};

/// Every pair of the crowd that collides. Search::trees asks the trees of those whose paths come near each other
/// (near_pairs). Search::direct measures every pair of samples of every pair of members. Both find the same. `progress`
/// is told of pairs. The trees may be of any kind.
Conflicts find_conflicts(std::span<const mobb::PlacedTree> crowd, Search search, const Progress& progress = {});

/// Pairs (a, b) of indices into the crowd, a < b, of those whose disks may meet; it leaves out no pair that collides
/// (mobb/predicate.h). In order, each once. Time and memory grow with the number of samples and with how many are near
/// each other, not with the square of the crowd.
std::vector<std::pair<int, int>> near_pairs(std::span<const mobb::PlacedTree> crowd);

/// Two paths that collide: of a run two plays of different people.
struct SceneConflict {
    PlacedAgent a, b;  ///< PlacedAgent::agent is the agent's index, of a run in CrowdRun::agents
    Conflict facts;

    double begin() const { return facts.intervals.front().t0; }  ///< of the contact, global seconds
};

/// All of them, by when they begin: of a scene between its agents, of a run between all that those play.
/// `progress` is told of pairs.
std::vector<SceneConflict> conflicts_in(const FittedScene& fitted, const Progress& progress = {});

}  // namespace mobbscope
