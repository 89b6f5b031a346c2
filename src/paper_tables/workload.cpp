#include <base/error.h>
#include <crowd/graph/build_graph.h>
#include <paper_tables/workload.h>
#include <scene/motion_graph.h>

#include <algorithm>
#include <memory>
#include <utility>

namespace mobbscope {

Workload workload_of_scene(const Scene& scene) {
    Workload workload;
    workload.fit = scene.fit;
    for (const SceneClip& clip : scene.clips) workload.clips.push_back(clip.clip);
    const std::size_t count = std::min(query_count(scene), static_cast<std::size_t>(kMaxQueries));
    workload.queries.reserve(count);
    const AskedPairs pairs(scene);
    for (std::size_t i = 0; i < count; ++i) {
        const SceneQuery query = query_at(scene, pairs, i);
        workload.queries.push_back({query.a.clip, query.b.clip, query.a.placement, query.b.placement});
    }
    return workload;
}

std::vector<mobb::Tree> trees_of(const Workload& workload, const mobb::FitOptions& options) {
    std::vector<mobb::Tree> trees;
    trees.reserve(workload.clips.size());
    for (const mobb::ClipPtr& clip : workload.clips) trees.emplace_back(clip, options);
    return trees;
}

PlacedPair<mobb::PlacedClip> placed(const Workload& workload, const WorkloadQuery& query) {
    return {{*workload.clips[static_cast<std::size_t>(query.clip_a)], query.a},
            {*workload.clips[static_cast<std::size_t>(query.clip_b)], query.b}};
}

PlacedPair<mobb::PlacedTree> placed(const std::vector<mobb::Tree>& trees, const WorkloadQuery& query) {
    return {{trees[static_cast<std::size_t>(query.clip_a)], query.a},
            {trees[static_cast<std::size_t>(query.clip_b)], query.b}};
}

PlacedPair<mobb::PlacedBlocks> placed(const BlocksOf& of, const WorkloadQuery& query) {
    const auto side = [&](int clip, const mobb::Placement& placement) {
        return mobb::PlacedBlocks(*of.trees[static_cast<std::size_t>(clip)].blocks(), placement);
    };
    return {side(query.clip_a, query.a), side(query.clip_b, query.b)};
}

double mean_duration(const Workload& workload) {
    if (workload.clips.empty()) return 0;
    double sum = 0;
    for (const mobb::ClipPtr& clip : workload.clips) sum += clip->duration();
    return sum / static_cast<double>(workload.clips.size());
}

Workload crowd_queries(Scene scene, int count, const CrowdDraw& draw) {
    if (!scene.graph) scene.graph = std::make_shared<const MotionGraph>(graph_of_whole_clips(scene));
    check_moves(scene, *scene.graph, scene.file.string());
    const mobb::FitOptions fit = scene.fit;
    const FittedScene fitted(std::move(scene), fit);
    SimulateOptions options;
    options.seed = draw.seed;
    options.ahead = draw.ahead;
    options.plan = 0;
    QuerySample sample(Recorded::all, static_cast<std::size_t>(count), draw.seed, draw.within);
    // Nobody looks ahead there, so nobody who has to turn on the way would keep clear of walls.
    const MoveSet moves(fitted, kTurnsAtOnce);
    simulate(moves, options, &sample);
    return workload_of_scene(sample.workload(moves));
}

}  // namespace mobbscope
