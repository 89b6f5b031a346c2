#include <base/budget.h>
#include <base/error.h>
#include <base/file.h>
#include <base/text.h>
#include <conflicts/conflicts.h>
#include <mobb/predicate.h>
#include <mobb/traversal.h>
#include <scene/crowd_scene.h>
#include <scene/motion_graph.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>

namespace mobbscope {

namespace {

/// Something that is walked, and by whom.
struct Walked {
    PlacedAgent path;
    int person = 0;         ///< from 0: the agent of the scene or the run, or the clip that stands for one
    int play = -1;          ///< of a run: index into CrowdAgent::plays
    mobb::ClipPtr joint{};  ///< of a run: the path is the joint that leads to the play; else null
};

std::vector<Walked> walked_in(const Scene& scene) {
    std::vector<Walked> out;
    if (!is_run(scene)) {
        int person = -1;
        for (PlacedAgent& path : placed_members(scene)) {
            if (path.member <= 0) ++person;
            out.push_back({std::move(path), person});
        }
        return out;
    }
    int person = 0;
    for (const CrowdAgent& agent : scene.crowd->agents) {
        std::optional<PlayJoint> joint;
        for (std::size_t i = 0; i < agent.plays.size(); ++i) {
            const Play& play = agent.plays[i];
            const int clip = scene.graph->moves[static_cast<std::size_t>(play.move)].clip;
            const int number = static_cast<int>(i);
            // A choice is of the way to the move, too.
            if (joint) {
                out.push_back({{agent.name, clip, joint->placement, person}, person, number, joint->clip});
            }
            if (!is_joints_alone(scene, agent, i))
                out.push_back({{agent.name, clip, play.placement, person}, person, number});
            joint = joint_behind(scene, agent, i);
        }
        ++person;
    }
    return out;
}

}  // namespace

std::function<void(std::size_t bytes)> spend_on_conflicts() {
    return [spent = std::make_shared<Spent>()](std::size_t bytes) {
        if (!spent->try_cover(bytes))
            throw InputError("too many pairs of the crowd meet for the memory; leave agents out, or give --trim");
    };
}

std::string conflict_count(std::size_t conflicts, std::size_t people, double seconds) {
    return counted(conflicts, "conflict", "conflicts") + " among " + counted(people, "agent", "agents") + ", " +
           figure(seconds) + " s in all";
}

void add_doubt(std::vector<std::string>& doubts, const SceneClip& clip) {
    const std::string& doubt = clip.facts.doubt;
    // Clips of one file stand together: the last one is the one that is most likely.
    if (doubt.empty() || (!doubts.empty() && doubts.back() == doubt)) return;
    if (std::ranges::find(doubts, doubt) == doubts.end()) doubts.push_back(doubt);
}

std::vector<std::string> doubts_in(const Scene& scene) {
    std::vector<std::string> out;
    for (const SceneClip& clip : scene.clips) add_doubt(out, clip);
    return out;
}

std::vector<SceneConflict> conflicts_in(const Scene& scene, const Progress& progress) {
    const std::vector<Walked> walked = walked_in(scene);
    std::vector<mobb::PlacedClip> crowd;
    std::vector<int> person_of;
    for (const Walked& one : walked) {
        const mobb::ClipPtr& clip = one.joint ? one.joint : path_of(scene, one.path);
        crowd.emplace_back(*clip, one.path.placement);
        person_of.push_back(one.person);
    }
    mobb::ConflictSearch search;
    const std::vector<int> floors = is_run(scene) ? std::vector<int>() : floors_of(scene);
    search.floor_of = floors;
    search.progress = progress;
    search.spend = spend_on_conflicts();
    const mobb::PeopleConflicts conflicts(std::move(crowd), person_of, search);
    if (conflicts.size() > kMostSceneConflicts) {
        throw InputError(shown_name(scene.file), "it has " + std::to_string(conflicts.size()) +
                                                     " conflicts, more than the " +
                                                     std::to_string(kMostSceneConflicts) +
                                                     " that a list holds; mobbscope conflicts writes them all");
    }
    std::vector<SceneConflict> out;
    out.reserve(conflicts.size());
    for (std::size_t i = 0; i < conflicts.size(); ++i) {
        if (progress) progress(i, conflicts.size());
        mobb::PeopleConflict found = conflicts[i];
        const Walked& a = walked[static_cast<std::size_t>(found.begins.a)];
        const Walked& b = walked[static_cast<std::size_t>(found.begins.b)];
        out.push_back({a.path, b.path, a.play, b.play, a.joint, b.joint, std::move(found)});
    }
    return out;
}

std::optional<glm::dvec3> place_of(const Scene& scene, const SceneConflict& conflict) {
    const double time = conflict.begin();
    const auto disk_of = [&](const PlacedAgent& who, const mobb::ClipPtr& joint) -> std::optional<mobb::Disk> {
        const mobb::PlacedClip placed(joint ? *joint : *path_of(scene, who), who.placement);
        const int sample = mobb::first_ending_after(placed, 0, placed.count(), time);
        if (sample >= placed.count()) return std::nullopt;
        return mobb::swept(placed, sample).at(time);
    };
    const auto a = disk_of(conflict.a, conflict.a_joint);
    const auto b = disk_of(conflict.b, conflict.b_joint);
    if (!a || !b) return std::nullopt;
    const double share = a->r + b->r > 0 ? a->r / (a->r + b->r) : 0.5;
    return glm::dvec3(a->x + share * (b->x - a->x), a->y + share * (b->y - a->y), time);
}

std::string sentence(const SceneConflict& conflict) {
    const auto& worst = conflict.facts.worst();
    std::string text = conflict.a.name + " and " + conflict.b.name + ": " +
                       with_unit(-conflict.facts.deepest.least_clearance, "m") +
                       formatted(" deep, from %.2f to %.2f s", worst.t0, worst.t1);
    const std::size_t others = conflict.facts.intervals.size() - 1;
    if (others > 0) text += "; they meet " + (others == 1 ? "once" : counted(others, "time", "times")) + " more";
    return text;
}

namespace {

const Play& play_of(const CrowdRun& run, const PlacedAgent& who, int play) {
    return run.agents[static_cast<std::size_t>(who.agent)].plays[static_cast<std::size_t>(play)];
}

}  // namespace

bool made_by_a(const CrowdRun& run, const SceneConflict& conflict) {
    // Choices of one time are made in the order of agents.
    const auto blame = [](const Play& play, int agent) {
        return std::tuple(play.kind == PlayKind::forced, play.chosen_at, agent);
    };
    const auto a = blame(play_of(run, conflict.a, conflict.a_play), conflict.a.agent);
    return a > blame(play_of(run, conflict.b, conflict.b_play), conflict.b.agent);
}

bool was_forced(const CrowdRun& run, const SceneConflict& conflict) {
    return play_of(run, conflict.a, conflict.a_play).kind == PlayKind::forced ||
           play_of(run, conflict.b, conflict.b_play).kind == PlayKind::forced;
}

}  // namespace mobbscope
