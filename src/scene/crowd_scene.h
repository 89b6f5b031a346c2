/// A run as a scene: what its agents play around a time, as agents that pictures and panels show.
#pragma once

#include <scene/crowd_run.h>
#include <scene/fitted_scene.h>
#include <scene/scene.h>

#include <optional>
#include <string_view>

namespace mobbscope {

/// Seconds of a run before and after a time.
struct CrowdWindow {
    double before = 0;
    double after = 0;
};

/// Whether a scene is a run as its file holds it: with a crowd, and no agents that were made of it yet.
bool is_run(const Scene& scene);

/// The time of a run that a view shows: its own, or the middle of the run.
double run_time(const Scene& run, const ViewState& view);

/// The play of an agent at a time: index into CrowdAgent::plays; before the first the first, after the last the last.
std::size_t play_at(const CrowdAgent& agent, double time);

/// What the last disk of a linear clip becomes by the time that the clip behind it in a chain begins: the first one of
/// that, if it is linear too; else it stays. In the world.
mobb::Disk runs_on_to(const mobb::PlacedClip& clip, const mobb::PlacedClip& next);

/// What a person does from the last sample of a linear play until the next play begins: a linear clip of two samples,
/// placed in the world. Nothing behind a held play or the last one, `play`: index into CrowdAgent::plays.
struct PlayJoint {
    mobb::ClipPtr clip;
    mobb::Placement placement;
};
std::optional<PlayJoint> joint_behind(const Scene& run, const CrowdAgent& agent, std::size_t play);

/// Whether a play takes no time itself: a linear clip of one sample that runs on from there, or to which the play
/// before ran and which is the last.
bool is_joints_alone(const Scene& run, const CrowdAgent& agent, std::size_t play);

/// Where an agent of a run stands in CrowdRun::agents, by name; none if there is no such agent.
std::optional<int> run_agent_by_name(const CrowdRun& crowd, std::string_view name);

/// The run with an agent for every play that is on between `time` - before and `time` + after. The first agents are the
/// people in their order, each with its play at the time (or nearest to it) and under its own name, whatever the
/// window; behind them the plays before ("17 -1") and after it ("17 +1"), by person and time. Agent::run_agent and
/// Agent::play say whose they are. A linear play that another follows has a clip of its own, behind those of the run:
/// with one more sample, what its last one runs on to, so that the person is there at any time. Requires is_run.
Scene scene_at(const Scene& run, double time, CrowdWindow window);

/// The same with trees, which are shared: what a picture of a run in that view is of. A moment of more than
/// kMostWithWays people holds the plays of that moment alone; of fewer those of kWaySeconds around it too, as their
/// ways are drawn. Requires is_run(run.scene()).
FittedScene fitted_at(const FittedScene& run, const ViewState& view);

inline constexpr std::size_t kMostWithWays = 200;
inline constexpr double kWaySeconds = 1.5;

}  // namespace mobbscope
