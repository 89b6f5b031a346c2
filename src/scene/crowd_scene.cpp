#include <import/skeleton/motion.h>
#include <scene/crowd_scene.h>
#include <scene/motion_graph.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope {

namespace {

int clip_of(const Scene& run, const Play& play) { return run.graph->moves[static_cast<std::size_t>(play.move)].clip; }

mobb::PlacedClip placed_in(const Scene& run, const Play& play) {
    return {*run.clips[static_cast<std::size_t>(clip_of(run, play))].clip, play.placement};
}

/// The clip with one more sample, which is that disk in the world.
mobb::ClipPtr with_disk(const mobb::PlacedClip& clip, const mobb::Disk& to) {
    std::vector<mobb::Disk> samples(clip.clip().samples().begin(), clip.clip().samples().end());
    const glm::dvec2 at = clip.rotation().inverse()(glm::dvec2(to.x, to.y) - clip.placement().translate);
    samples.push_back({at.x, at.y, to.r});
    return std::make_shared<const mobb::Clip>(clip.dt(), std::move(samples), clip.clip().motion());
}

/// The skeleton with its last pose once more.
std::shared_ptr<const Skeleton> with_last_pose(const Skeleton& skeleton) {
    auto out = std::make_shared<Skeleton>(skeleton);
    const auto joints = static_cast<std::ptrdiff_t>(skeleton.joints.size());
    out->positions.insert(out->positions.end(), skeleton.positions.end() - joints, skeleton.positions.end());
    out->rotations.insert(out->rotations.end(), skeleton.rotations.end() - joints, skeleton.rotations.end());
    return out;
}

/// Adds a play of a person to a scene. `present`: the one at the scene's time.
void add_play(Scene& out, const Scene& run, int run_agent, std::size_t play, std::size_t present) {
    const CrowdAgent& person = run.crowd->agents[static_cast<std::size_t>(run_agent)];
    Agent agent;
    agent.name = person.name;
    if (play < present) agent.name += " -" + std::to_string(present - play);
    if (play > present) agent.name += " +" + std::to_string(play - present);
    agent.clip = clip_of(run, person.plays[play]);
    if (const auto joint = joint_behind(run, person, play)) {
        SceneClip clip = run.clips[static_cast<std::size_t>(agent.clip)];
        clip.name += " (" + agent.name + ')';
        // What no file has.
        clip.source.reset();
        if (clip.skeleton) clip.skeleton = with_last_pose(*clip.skeleton);
        clip.clip = with_disk(placed_in(run, person.plays[play]), joint->clip->samples().back());
        agent.clip = static_cast<int>(out.clips.size());
        out.clips.push_back(std::move(clip));
    }
    agent.placement = person.plays[play].placement;
    agent.run_agent = run_agent;
    agent.play = static_cast<int>(play);
    out.agents.push_back(std::move(agent));
}

}  // namespace

bool is_run(const Scene& scene) { return scene.crowd && scene.agents.empty(); }

double run_time(const Scene& run, const ViewState& view) { return view.time.value_or(0.5 * run.crowd->seconds); }

std::size_t play_at(const CrowdAgent& agent, double time) {
    const auto begins_later = [](double t, const Play& play) { return t < play.placement.start; };
    const auto after = std::upper_bound(agent.plays.begin(), agent.plays.end(), time, begins_later);
    return static_cast<std::size_t>(std::max<std::ptrdiff_t>(std::distance(agent.plays.begin(), after) - 1, 0));
}

mobb::Disk runs_on_to(const mobb::PlacedClip& clip, const mobb::PlacedClip& next) {
    return next.is_linear() ? next.disk(0) : clip.disk(clip.end() - 1);
}

std::optional<PlayJoint> joint_behind(const Scene& run, const CrowdAgent& agent, std::size_t play) {
    const mobb::PlacedClip clip = placed_in(run, agent.plays[play]);
    if (!clip.is_linear() || play + 1 == agent.plays.size()) return std::nullopt;
    const int last = clip.end() - 1;
    const std::vector<mobb::Disk> ends{clip.disk(last), runs_on_to(clip, placed_in(run, agent.plays[play + 1]))};
    return PlayJoint{std::make_shared<const mobb::Clip>(clip.dt(), ends, mobb::Motion::linear),
                     {{0, 0}, 0, clip.frame().start + last * clip.dt()}};
}

bool is_joints_alone(const Scene& run, const CrowdAgent& agent, std::size_t play) {
    const mobb::PlacedClip clip = placed_in(run, agent.plays[play]);
    if (!clip.is_linear() || clip.count() > 1) return false;
    return play + 1 < agent.plays.size() || (play > 0 && placed_in(run, agent.plays[play - 1]).is_linear());
}

std::optional<int> run_agent_by_name(const CrowdRun& crowd, std::string_view name) {
    const auto at = std::ranges::find(crowd.agents, name, &CrowdAgent::name);
    if (at == crowd.agents.end()) return std::nullopt;
    return static_cast<int>(at - crowd.agents.begin());
}

Scene scene_at(const Scene& run, double time, CrowdWindow window) {
    Scene out = run;
    const int people = static_cast<int>(run.crowd->agents.size());
    out.agents.reserve(static_cast<std::size_t>(people));
    const auto present_of = [&](int person) {
        return play_at(run.crowd->agents[static_cast<std::size_t>(person)], time);
    };
    for (int person = 0; person < people; ++person) add_play(out, run, person, present_of(person), present_of(person));
    if (window.before <= 0 && window.after <= 0) return out;
    const auto ends = [&](const Play& play) { return play.placement.start + placed_in(run, play).clip().until_next(); };
    for (int person = 0; person < people; ++person) {
        const std::vector<Play>& plays = run.crowd->agents[static_cast<std::size_t>(person)].plays;
        const std::size_t present = present_of(person);
        std::size_t first = present;
        while (first > 0 && ends(plays[first - 1]) > time - window.before) --first;
        for (std::size_t i = first; i < plays.size(); ++i) {
            if (i > present && plays[i].placement.start >= time + window.after) break;
            if (i != present) add_play(out, run, person, i, present);
        }
    }
    return out;
}

FittedScene fitted_at(const FittedScene& run, const ViewState& view) {
    CrowdWindow window{view.time_window, view.time_window};
    if (view.show != Show::space_time) {
        const bool with_ways = run.scene().crowd->agents.size() <= kMostWithWays;
        window = with_ways ? CrowdWindow{kWaySeconds, kWaySeconds} : CrowdWindow{};
    }
    return {scene_at(run.scene(), run_time(run.scene(), view), window), run.options(), &run};
}

}  // namespace mobbscope
