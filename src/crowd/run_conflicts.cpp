#include <crowd/run_conflicts.h>
#include <scene/crowd_run.h>
#include <scene/crowd_scene.h>
#include <scene/motion_graph.h>

#include <algorithm>
#include <cstddef>

namespace mobbscope {

namespace {

/// Everything that is walked in it.
std::vector<Participant> paths_of(const FittedScene& fitted) {
    const Scene& scene = fitted.scene();
    if (!is_run(scene)) return fitted.participants();
    std::vector<Participant> out;
    for (std::size_t person = 0; person < scene.crowd->agents.size(); ++person) {
        const CrowdAgent& agent = scene.crowd->agents[person];
        for (const Play& play : agent.plays) {
            const int clip = scene.graph->moves[static_cast<std::size_t>(play.move)].clip;
            out.push_back({agent.name, clip, play.placement, static_cast<int>(person)});
        }
    }
    return out;
}

}  // namespace

std::vector<SceneConflict> conflicts_in(const FittedScene& fitted, const Progress& progress) {
    const std::vector<Participant> paths = paths_of(fitted);
    std::vector<mobb::PlacedTree> trees;
    trees.reserve(paths.size());
    for (const Participant& path : paths) trees.push_back(fitted.placed(path));
    std::vector<SceneConflict> out;
    for (const Conflict& found : find_conflicts(trees, Search::trees, progress).found) {
        const Participant& a = paths[static_cast<std::size_t>(found.a)];
        const Participant& b = paths[static_cast<std::size_t>(found.b)];
        // A person's plays join; a hair of overlap in time is no meeting.
        if (is_run(fitted.scene()) && a.agent == b.agent) continue;
        out.push_back({a, b, found});
    }
    std::stable_sort(out.begin(), out.end(),
                     [](const SceneConflict& a, const SceneConflict& b) { return a.begin() < b.begin(); });
    return out;
}

}  // namespace mobbscope
