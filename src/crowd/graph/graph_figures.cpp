#include <base/error.h>
#include <base/median.h>
#include <base/text.h>
#include <base/threads.h>
#include <crowd/graph/graph_figures.h>
#include <crowd/graph/pose_distance.h>
#include <crowd/graph/rigs.h>

#include <tbb/parallel_for.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
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

constexpr std::size_t kMostTransitions = 20'000'000;

constexpr double kRounding = 1e-6;  // relative, and in metres or metres per second

struct MovePoses {
    std::optional<PoseTrack> track;  ///< of the move's clip, or of a longer part of its recording
    int entry = 0;                   ///< frames of the track
    int exit = 0;
};

MovePoses poses_of(const Scene& scene, const GraphMove& move, const std::vector<GraphRig>& rigs,
                   const RecordedMove& recorded) {
    if (!recorded.skeleton || move.rig < 0) return {};
    try {
        const auto joints = joints_of(rigs[static_cast<std::size_t>(move.rig)], *recorded.skeleton);
        return {pose_track(*recorded.clip, *recorded.skeleton, move.rig, joints), recorded.entry, recorded.exit};
    } catch (const std::invalid_argument& error) {
        throw InputError(scene.file, "clip " + in_quotes(scene.clips[static_cast<std::size_t>(move.clip)].name),
                         std::string(error.what()) + ", which rig " + std::to_string(move.rig) +
                             " of the graph counts; build the graph again");
    }
}

/// The root's velocity at both ends of a move, metres per second, with the heading of the stance along +x.
struct EndVelocities {
    glm::dvec2 entry;
    glm::dvec2 exit;
};

EndVelocities velocities_of(const RecordedMove& recorded, const GraphMove& move) {
    // The stances are what joins the moves, so they stand for the ends whatever the samples say.
    const auto at = [&](int i) -> glm::dvec2 {
        if (i == recorded.entry) return move.entry.position;
        if (i == recorded.exit) return move.exit.position;
        const mobb::Disk& disk = recorded.clip->samples()[static_cast<std::size_t>(i)];
        return {disk.x, disk.y};
    };
    const double dt = recorded.clip->dt();
    return {mobb::Rotation::from_degrees(-move.entry.heading_deg)((at(recorded.entry + 1) - at(recorded.entry)) / dt),
            mobb::Rotation::from_degrees(-move.exit.heading_deg)((at(recorded.exit) - at(recorded.exit - 1)) / dt)};
}

/// The joints that a rig names may be more in one skeleton than in another, where several have one name.
void check_comparable(const Scene& scene, const std::vector<GraphMove>& moves, const std::vector<MovePoses>& poses) {
    std::unordered_map<int, std::size_t> first;  // of each rig
    for (std::size_t m = 0; m < moves.size(); ++m) {
        if (!poses[m].track) continue;
        const std::size_t other = first.try_emplace(poses[m].track->rig, m).first->second;
        if (poses[m].track->joints == poses[other].track->joints) continue;
        const auto name = [&](std::size_t move) {
            return in_quotes(scene.clips[static_cast<std::size_t>(moves[move].clip)].name);
        };
        throw InputError(scene.file.string(), "clip " + name(m),
                         "has another number of joints that count than clip " + name(other) +
                             ", of the same rig; build the graph again");
    }
}

/// The move itself, or of a turned one that of which it is a variant: sources hold no turns.
std::size_t as_recorded(const MotionGraph& graph, int move) {
    const std::optional<TurnedMove>& turned = graph.moves[static_cast<std::size_t>(move)].turned;
    return static_cast<std::size_t>(turned ? turned->move : move);
}

TransitionSpread spread_of(const std::vector<std::pair<int, int>>& transitions, const std::vector<double>& values) {
    TransitionSpread out;
    std::vector<double> measured;
    for (std::size_t i = 0; i < transitions.size(); ++i) {
        if (values[i] < 0) continue;
        measured.push_back(values[i]);
        if (out.before >= 0 && values[i] <= out.largest) continue;
        out.largest = values[i];
        out.before = transitions[i].first;
        out.after = transitions[i].second;
    }
    out.count = measured.size();
    if (measured.empty()) return out;
    out.median = median(std::move(measured));
    return out;
}

}  // namespace

std::vector<std::pair<int, int>> transitions_of(const MotionGraph& graph) {
    const std::vector<std::vector<int>> begin_in = moves_by_hub(graph);
    std::size_t transitions = 0;
    for (const GraphMove& move : graph.moves) transitions += begin_in[static_cast<std::size_t>(move.to)].size();
    if (transitions > kMostTransitions) {
        throw InputError("the graph has " + std::to_string(transitions) + " joins, more than the " +
                         std::to_string(kMostTransitions) + " that are measured; give it fewer moves a hub");
    }
    std::vector<std::pair<int, int>> out;
    out.reserve(transitions);
    for (int m = 0; m < static_cast<int>(graph.moves.size()); ++m) {
        const int hub = graph.moves[static_cast<std::size_t>(m)].to;
        for (const int next : begin_in[static_cast<std::size_t>(hub)]) out.emplace_back(m, next);
    }
    return out;
}

RecordedMove recorded_move(const Scene& scene, const GraphMove& move, Importer& importer) {
    const SceneClip& clip = scene.clips[static_cast<std::size_t>(move.clip)];
    const int count = clip.clip->count();
    // A path that was put at the origin cannot be lengthened in front.
    if (!clip.skeleton || !clip.source || !clip.options.trim ||
        clip.options.origin.value_or(Origin::keep) != Origin::keep) {
        return {clip.clip, clip.skeleton, 0, count};
    }
    const double dt = clip.clip->dt();
    const int reach = window_offsets(dt).back();
    const auto [begin, end] = *clip.options.trim;
    const int in_front = static_cast<int>(std::min<double>(reach, std::floor(begin / dt + kRounding)));
    ImportOptions options = clip.options;
    options.trim = {std::max(0.0, begin - in_front * dt), end + (reach + 1) * dt};
    const ImportedClip longer = importer.clips(scene.file.parent_path() / *clip.source, options).front();
    return {longer.clip, longer.skeleton, in_front, in_front + count};
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
        const double seconds = clip.clip->until_next();
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

Transitions each_transition(const Scene& scene, const Progress& progress) {
    MotionGraph graph = *scene.graph;
    if (graph.rigs.empty()) set_rigs(graph, rigs_of(scene));
    Importer importer;
    std::vector<MovePoses> poses;
    std::vector<EndVelocities> velocities;
    for (std::size_t m = 0; m < graph.moves.size(); ++m) {
        if (progress) progress(m, graph.moves.size());
        const GraphMove& move = graph.moves[m];
        const RecordedMove recorded = recorded_move(scene, move, importer);
        poses.push_back(poses_of(scene, move, graph.rigs, recorded));
        velocities.push_back(velocities_of(recorded, move));
    }
    check_comparable(scene, graph.moves, poses);

    Transitions out{transitions_of(graph), {}, {}};
    out.pose_distance.assign(out.moves.size(), -1);
    out.root_speed.resize(out.moves.size());
    limit_worker_threads();
    tbb::parallel_for(std::size_t{0}, out.moves.size(), [&](std::size_t i) {
        const std::size_t a = as_recorded(graph, out.moves[i].first);
        const std::size_t b = as_recorded(graph, out.moves[i].second);
        out.root_speed[i] = glm::distance(velocities[a].exit, velocities[b].entry);
        const std::optional<PoseTrack>& before = poses[a].track;
        const std::optional<PoseTrack>& after = poses[b].track;
        if (!before || !after || before->rig != after->rig || before->dt != after->dt) return;
        out.pose_distance[i] = joined_distance(*before, poses[a].exit, graph.moves[a].exit.heading_deg, *after,
                                               poses[b].entry, graph.moves[b].entry.heading_deg);
    });
    return out;
}

TransitionMeasures measure_transitions(const Scene& scene, const Progress& progress) {
    const Transitions all = each_transition(scene, progress);
    return {all.moves.size(), spread_of(all.moves, all.pose_distance), spread_of(all.moves, all.root_speed)};
}

bool exceeds(double measured, double bound) { return measured > bound * (1 + kRounding) + kRounding; }

bool exceeds(const TransitionSpread& measured, double bound) {
    return measured.count > 0 && exceeds(measured.largest, bound);
}

}  // namespace mobbscope
