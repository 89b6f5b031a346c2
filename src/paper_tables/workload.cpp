#include <base/random.h>
#include <crowd/graph/build_graph.h>
#include <paper_tables/workload.h>

#include <glm/common.hpp>

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

namespace mobbscope {

namespace {

/// The middle of the rectangle along x and y that the centres span.
glm::dvec2 middle(const mobb::Clip& clip) {
    glm::dvec2 low{std::numeric_limits<double>::infinity()};
    glm::dvec2 high = -low;
    for (const mobb::Disk& disk : clip.samples()) {
        low = glm::min(low, {disk.x, disk.y});
        high = glm::max(high, {disk.x, disk.y});
    }
    return (low + high) / 2.0;
}

}  // namespace

Workload workload_of_scene(const Scene& scene) {
    Workload workload;
    workload.fit = scene.fit;
    for (const SceneClip& clip : scene.clips) workload.clips.push_back(clip.clip);
    const std::size_t count = std::min(query_count(scene), static_cast<std::size_t>(kMaxQueries));
    workload.queries.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const SceneQuery query = query_at(scene, i);
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

double mean_duration(const Workload& workload) {
    if (workload.clips.empty()) return 0;
    double sum = 0;
    for (const mobb::ClipPtr& clip : workload.clips) sum += clip->duration();
    return sum / static_cast<double>(workload.clips.size());
}

Workload crowd_queries(Scene scene, int count, const CrowdDraw& draw) {
    if (!scene.graph) scene.graph = std::make_shared<const MotionGraph>(graph_of_whole_clips(scene));
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

std::vector<WorkloadQuery> random_queries(const std::vector<mobb::ClipPtr>& clips, int count, const QueryDraw& draw) {
    std::vector<glm::dvec2> middles;
    for (const mobb::ClipPtr& clip : clips) middles.push_back(middle(*clip));
    Uniform uniform(draw.seed);
    std::vector<WorkloadQuery> queries;
    queries.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
        WorkloadQuery query;
        query.clip_a = uniform.below(static_cast<int>(clips.size()));
        query.clip_b = uniform.below(static_cast<int>(clips.size()));
        const auto a = static_cast<std::size_t>(query.clip_a);
        const auto b = static_cast<std::size_t>(query.clip_b);
        const double x = uniform.within(-draw.range, draw.range);
        const double y = uniform.within(-draw.range, draw.range);
        query.b.rotate_deg = uniform.within(0, 360);
        query.b.start = uniform.within(-draw.offset * clips[b]->duration(), draw.offset * clips[a]->duration());
        query.a.translate = -middles[a];
        query.b.translate = glm::dvec2{x, y} - mobb::Rotation::from_degrees(query.b.rotate_deg)(middles[b]);
        queries.push_back(query);
    }
    return queries;
}

}  // namespace mobbscope
