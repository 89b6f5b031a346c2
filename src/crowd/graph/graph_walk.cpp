#include <base/error.h>
#include <base/text.h>
#include <crowd/graph/graph_walk.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace mobbscope {

namespace {

constexpr double kLeastStep = 0.1;  // metres: shorter steps are sway, not a direction

glm::dvec2 center(const mobb::Disk& disk) { return {disk.x, disk.y}; }

double distance(glm::dvec2 a, glm::dvec2 b) { return std::hypot(b.x - a.x, b.y - a.y); }

Stance stance_at_begin(const mobb::Clip& clip) {
    const auto samples = clip.samples();
    const glm::dvec2 first = center(samples.front());
    for (const mobb::Disk& disk : samples) {
        if (distance(first, center(disk)) >= kLeastStep) return {first, heading_of(center(disk) - first)};
    }
    return {first, 0};
}

Stance stance_at_end(const mobb::Clip& clip) {
    const auto samples = clip.samples();
    const glm::dvec2 last = center(samples.back());
    // The pose after the last sample: one more step like the last one.
    const glm::dvec2 step = samples.size() > 1 ? last - center(samples[samples.size() - 2]) : glm::dvec2{0};
    for (std::size_t i = samples.size(); i-- > 0;) {
        if (distance(center(samples[i]), last) >= kLeastStep)
            return {last + step, heading_of(last - center(samples[i]))};
    }
    return {last + step, stance_at_begin(clip).heading_deg};
}

bool is_near(const Stance& stance) {
    return std::abs(stance.position.x) <= kMostStance && std::abs(stance.position.y) <= kMostStance;
}

void check_move(const Scene& scene, const GraphMove& move) {
    const SceneClip& clip = scene.clips[static_cast<std::size_t>(move.clip)];
    if (is_near(move.entry) && is_near(move.exit)) return;
    throw InputError(clip.source.value_or(scene.file.string()), "clip " + in_quotes(clip.name),
                     "begins or ends more than " + short_double(kMostStance) + " m from the origin; move it there");
}

}  // namespace

std::vector<std::vector<int>> moves_by_hub(const MotionGraph& graph) {
    std::vector<std::vector<int>> by_hub(graph.hubs.size());
    for (std::size_t i = 0; i < graph.moves.size(); ++i) {
        by_hub[static_cast<std::size_t>(graph.moves[i].from)].push_back(static_cast<int>(i));
    }
    return by_hub;
}

mobb::Placement following(const Scene& scene, int before, const mobb::Placement& placed, int next) {
    const GraphMove& from = scene.graph->moves[static_cast<std::size_t>(before)];
    const GraphMove& to = scene.graph->moves[static_cast<std::size_t>(next)];
    const double duration = scene.clips[static_cast<std::size_t>(from.clip)].clip->duration();
    return following(placed, from.exit, duration, to.entry);
}

MotionGraph graph_of_whole_clips(const Scene& scene) {
    MotionGraph graph;
    graph.hubs = {{"any"}};
    graph.bounds = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    for (std::size_t i = 0; i < scene.clips.size(); ++i) {
        const mobb::Clip& clip = *scene.clips[i].clip;
        const GraphMove move{static_cast<int>(i), 0, 0, stance_at_begin(clip), stance_at_end(clip)};
        check_move(scene, move);
        graph.moves.push_back(move);
    }
    return graph;
}

}  // namespace mobbscope
