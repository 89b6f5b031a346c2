/// A stored run made again, choice by choice.
#pragma once

#include <crowd/simulation/choice.h>

#include <cstddef>
#include <cstdint>
#include <optional>

namespace mobbscope {

/// One side of a query about a candidate: what an agent plays, or might play.
struct AskedSide {
    int agent = 0;
    int move = 0;  ///< among those of the MoveSet
    bool is_joint = false, is_planned = false;
    mobb::ClipPtr clip;
    mobb::Placement placement;
};

/// A query that a choice depends on.
struct DecidingQuery {
    AskedSide candidate, other;
    bool collides = false;  ///< the answer now
};

/// The first play of a run that is not what the simulator chooses.
struct RunDifference {
    FollowedChoice remade;                ///< with clips and blockers; of a first play where it is placed, if anywhere
    std::optional<std::size_t> played{};  ///< the candidate that the run plays; none: it is none of them
    std::optional<double> due{};          ///< global seconds: when the simulator chooses, if that is another time
    std::optional<OtherAnswer> other{};   ///< with which the run's move is taken; none: no single answer is known
    /// Of that answer, if it is about a collision; without one what rules out the candidate that the run plays.
    std::optional<DecidingQuery> query{};
};

struct RunCheck {
    std::int64_t plays = 0;  ///< that come out, up to the difference
    std::optional<RunDifference> difference{};
};

/// Makes every play of a run again, in the order in which they were chosen, each from what the run has all agents
/// committed to by then; ends at the first that does not come out (comes_out_as), or was chosen at another time.
/// `progress` is told of plays. `moves`: of a scene with a crowd.
RunCheck check_run(const MoveSet& moves, const Progress& progress = {});

}  // namespace mobbscope
