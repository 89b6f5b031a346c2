/// Who collides with whom in a scene or a run, as sides of queries.
#pragma once

#include <crowd/conflicts.h>
#include <scene/crowd_run.h>
#include <scene/fitted_scene.h>

#include <vector>

namespace mobbscope {

/// Two paths that collide: of a run two plays of different people.
struct SceneConflict {
    Participant a, b;  ///< Participant::agent is the agent's index, of a run in CrowdRun::agents
    Conflict facts;

    double begin() const { return facts.intervals.front().t0; }  ///< of the contact, global seconds
};

/// All of them, by when they begin: of a scene between its participants, of a run between all that its people play.
/// `progress` is told of pairs.
std::vector<SceneConflict> conflicts_in(const FittedScene& fitted, const Progress& progress = {});

}  // namespace mobbscope
