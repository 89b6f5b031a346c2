/// Who collides with whom in a scene or a run.
#pragma once

#include <mobb_tracks/people_conflicts.h>
#include <scene/crowd_run.h>
#include <scene/scene.h>

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace mobbscope {

/// "2 conflicts among 22 agents, 1.3 s in all": a conflict is a pair of people.
std::string conflict_count(std::size_t conflicts, std::size_t people, double seconds);

/// Why the speeds in a scene's files are nobody's (SourceFacts::doubt), each once: no count of conflicts stands without
/// it.
std::vector<std::string> doubts_in(const Scene& scene);
/// Adds the doubt of one of its clips, if there is one that is not among them yet.
void add_doubt(std::vector<std::string>& doubts, const SceneClip& clip);

/// A conflict of a scene or a run, with the paths on which its worst contact begins.
struct SceneConflict {
    PlacedAgent a, b;              ///< PlacedAgent::agent is the agent's index, of a run in CrowdRun::agents
    int a_play = -1, b_play = -1;  ///< of a run: indices into CrowdAgent::plays
    /// Of a run: the clip of the joint that leads to the play, if the path is that joint; else null.
    mobb::ClipPtr a_joint{}, b_joint{};
    mobb::PeopleConflict facts;

    double begin() const { return facts.worst().t0; }  ///< of that contact, global seconds
};

/// Where the two touch first in that contact: x, y, and when; none if one of them is not there. `scene`: of the
/// conflict.
std::optional<glm::dvec3> place_of(const Scene& scene, const SceneConflict& conflict);
/// "17 and 42: 0.123 m deep, from 13.40 to 13.80 s; they meet once more".
std::string sentence(const SceneConflict& conflict);

/// The most that are kept at once, some 600 bytes each.
inline constexpr std::size_t kMostSceneConflicts = 1'000'000;

/// For mobb::ConflictSearch::spend: throws InputError where that is more than the budget (base/budget.h).
std::function<void(std::size_t bytes)> spend_on_conflicts();

/// All of them, worst first: of a scene between its agents, of a run between its people, over all that they play.
/// `progress` is told of paths. Throws InputError if there are more than kMostSceneConflicts.
std::vector<SceneConflict> conflicts_in(const Scene& scene, const Progress& progress = {});

/// Whether `a` made the conflict of a run, or else `b`: whose play was forced, of two such plays the one that was
/// chosen last, when the other was committed to its own.
bool made_by_a(const CrowdRun& run, const SceneConflict& conflict);

/// Whether one of the two plays of a run was forced: no other may collide, so else an answer was wrong, or the run was
/// edited.
bool was_forced(const CrowdRun& run, const SceneConflict& conflict);

}  // namespace mobbscope
