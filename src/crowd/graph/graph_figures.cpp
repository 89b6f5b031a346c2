#include <crowd/graph/graph_figures.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace mobbscope {

namespace {

double step(const mobb::Disk& from, glm::dvec2 to) { return std::hypot(to.x - from.x, to.y - from.y); }

/// Of the first step and of the last, metres per second.
struct EndSpeeds {
    double begin;
    double end;
};

EndSpeeds end_speeds(const mobb::Clip& clip, const GraphMove& move) {
    const auto samples = clip.samples();
    const glm::dvec2 second = samples.size() > 1 ? glm::dvec2{samples[1].x, samples[1].y} : move.exit.position;
    return {step(samples.front(), second) / clip.dt(), step(samples.back(), move.exit.position) / clip.dt()};
}

}  // namespace

double way_of(const mobb::Clip& clip, const GraphMove& move) {
    const auto samples = clip.samples();
    double way = step(samples.back(), move.exit.position);
    for (std::size_t i = 1; i < samples.size(); ++i) way += step(samples[i - 1], {samples[i].x, samples[i].y});
    return way;
}

GraphFigures graph_figures(const Scene& scene) {
    const MotionGraph& graph = *scene.graph;
    GraphFigures out;
    for (const GraphHub& hub : graph.hubs) out.hubs.push_back({hub.name});
    const std::vector<int> component = hub_components(graph);
    out.components.resize(static_cast<std::size_t>(*std::max_element(component.begin(), component.end())) + 1);
    for (std::size_t h = 0; h < component.size(); ++h) {
        out.components[static_cast<std::size_t>(component[h])].hubs.push_back(static_cast<int>(h));
    }

    std::unordered_map<std::string, std::size_t> sources;
    for (const GraphMove& move : graph.moves) {
        const SceneClip& clip = scene.clips[static_cast<std::size_t>(move.clip)];
        const auto from = static_cast<std::size_t>(move.from);
        const auto to = static_cast<std::size_t>(move.to);
        const double seconds = clip.clip->duration();
        const EndSpeeds speeds = end_speeds(*clip.clip, move);
        out.hubs[from].begin += 1;
        out.hubs[from].speed += speeds.begin;
        out.hubs[to].end += 1;
        out.hubs[to].speed += speeds.end;
        if (component[from] == component[to]) {
            ComponentFigures& of = out.components[static_cast<std::size_t>(component[from])];
            of.moves += 1;
            of.seconds += seconds;
        }
        const std::string file = clip.source.value_or("");
        const auto [found, is_new] = sources.try_emplace(file, out.sources.size());
        if (is_new) out.sources.push_back({file});
        out.sources[found->second].moves += 1;
        out.sources[found->second].seconds += seconds;
        out.moves += 1;
        out.seconds += seconds;
    }
    for (std::size_t h = 0; h < out.hubs.size(); ++h) {
        HubFigures& hub = out.hubs[h];
        if (hub.begin == 0) out.dead_ends.push_back(static_cast<int>(h));
        if (hub.begin + hub.end > 0) hub.speed /= static_cast<double>(hub.begin + hub.end);
        out.choices += static_cast<double>(hub.end) * static_cast<double>(hub.begin);
    }
    out.choices /= static_cast<double>(out.moves);
    out.seconds_between_choices = out.seconds / static_cast<double>(out.moves);
    return out;
}

}  // namespace mobbscope
