#include <app/document/described.h>
#include <base/text.h>
#include <explain/query_sentence.h>
#include <mobb/kinds.h>
#include <mobb/level_figures.h>
#include <render/parts/node_boxes.h>
#include <scene/path_figures.h>

#include <cmath>
#include <utility>

namespace mobbscope::app {

namespace {

void describe_node(Described& out, const DrawnAgent& agent, int index) {
    const mobb::PlacedTree& tree = agent.placed;
    const mobb::Node& node = tree.node(index);
    out.name = node_name(agent, index);
    const mobb::Box world = world_box(tree, index);
    const mobb::BoxInfo& shape = mobb::info(world.kind);
    const bool tilted = shape.axes == mobb::BoxAxes::space_time;
    out.facts = {{"node", std::to_string(index) + (tree.tree().is_leaf(index) ? ", leaf" : "") + ", " +
                              std::string(shape.title)},
                 {"level", std::to_string(tree.tree().level(index))},
                 {"samples", std::to_string(node.first) + ".." + std::to_string(node.end() - 1) + " (" +
                                 std::to_string(node.count) + ")"},
                 {"time", formatted("%.3f..%.3f s", tree.begin(node), tree.end(node))},
                 {"centre", formatted("%.3f, %.3f m", world.center.x, world.center.y)}};
    out.exact = {{"time", {tree.begin(node), tree.end(node)}}, {"centre", {world.center.x, world.center.y}}};
    const auto add = [&](const std::string& key, const std::string& value, std::vector<double> exact) {
        out.facts.emplace_back(key, value);
        out.exact[key] = std::move(exact);
    };
    if (shape.round) add("radius", formatted("%.3f m", world.half[0]), {world.half[0]});
    if (!shape.round)
        add(tilted ? "sides 1, 2" : "sides", formatted("%.3f x %.3f m", 2 * world.half[0], 2 * world.half[1]),
            {2 * world.half[0], 2 * world.half[1]});
    if (shape.moves && world.half.z > 0) {
        const glm::dvec2 velocity = world.drift * (tree.time_scale() / world.half.z);
        add("velocity", formatted("%.3f, %.3f m/s", velocity.x, velocity.y), {velocity.x, velocity.y});
    }
    if (tilted) add("side 3", formatted("%.3f m", 2 * world.half[2]), {2 * world.half[2]});
    const double volume = mobb::volume(tree.tree().box(index), tree.time_scale());
    const double cylinders = mobb::cylinder_volume(tree.tree().clip(), {node.first, node.count});
    add("volume", figure(volume) + " m\u00B2\u00B7s", {volume});
    if (volume > 0) add("tightness", formatted("%.1f %%", 100 * cylinders / volume), {100 * cylinders / volume});
}

/// "standard placements"
std::string workload_title(QueryWorkload::Kind workload) {
    return workload == QueryWorkload::Kind::placements ? "standard placements" : "the scene's queries";
}

void describe_sample(Described& out, const DrawnAgent& agent, int index) {
    const mobb::PlacedClip& clip = agent.clip();
    const mobb::Disk disk = clip.disk(index);
    out.name = agent.name + ", sample " + std::to_string(index);
    out.facts = {{"time", formatted("%.3f..%.3f s", clip.time(index), clip.time(index + 1))},
                 {"place", formatted("%.3f, %.3f m", disk.x, disk.y)},
                 {"radius", formatted("%.3f m", disk.r)}};
    out.exact = {{"time", {clip.time(index), clip.time(index + 1)}}, {"place", {disk.x, disk.y}}, {"radius", {disk.r}}};
    if (index + 1 < clip.count()) {
        const mobb::Disk next = clip.disk(index + 1);
        const double speed = std::hypot(next.x - disk.x, next.y - disk.y) / clip.clip().dt();
        out.facts.emplace_back("speed", formatted("%.2f m/s", speed));
        out.exact["speed"] = {speed};
    }
}

void describe_path(Described& out, const FittedScene& fitted, const PlacedAgent& who) {
    const mobb::PlacedTree tree = fitted.placed(who);
    const mobb::PlacedClip& clip = tree.placed_clip();
    out.name = who.name + disk_words(who);
    out.facts = {{"clip", fitted.scene().clips[static_cast<std::size_t>(who.clip)].name},
                 {"samples", std::to_string(clip.count())},
                 {"time", formatted("%.3f..%.3f s", clip.time(0), clip.time(clip.count()))},
                 {"first place", formatted("%.3f, %.3f m", clip.disk(0).x, clip.disk(0).y)},
                 {"tree", std::to_string(tree.tree().nodes().size()) + " nodes, " +
                              std::to_string(tree.tree().depth()) + " levels"}};
    out.exact = {{"time", {clip.time(0), clip.time(clip.count())}}, {"first place", {clip.disk(0).x, clip.disk(0).y}}};
    if (who.agent < 0) return;
    const std::string& floor = fitted.scene().agents[static_cast<std::size_t>(who.agent)].floor;
    if (!floor.empty()) out.facts.emplace_back("floor", floor);
}

void describe_clip(Described& out, const SceneClip& clip) {
    const PathFigures figures = figures_of(*clip.clip);
    out.name = clip.name;
    out.facts = {{"source", clip.source.value_or("samples in the scene")},
                 {"samples", std::to_string(clip.clip->count())},
                 {"lasts", formatted("%.3f s at %.4g a second", clip.clip->duration(), 1 / clip.clip->dt())},
                 {"motion", clip.clip->motion() == mobb::Motion::held ? "held: stays until the next sample"
                                                                      : "linear: runs to the next sample"},
                 {"path", formatted("%.2f m, %.2f m/s", figures.length, figures.mean_speed)}};
    out.exact = {{"lasts", {clip.clip->duration(), 1 / clip.clip->dt()}},
                 {"path", {figures.length, figures.mean_speed}}};
    if (!clip.body.empty()) out.facts.emplace_back("body", body_words(clip));
    if (!clip.facts.root.empty()) out.facts.emplace_back("root", clip.facts.root);
    for (const ImportWarning& warning : clip.facts.warnings) out.facts.emplace_back("note", said(warning));
}

}  // namespace

DrawnAgent drawn_agent_of(const FittedScene& fitted, const PlacedAgent& who) {
    return {fitted.placed(who), who.name, who.name, Rgba(1), 0};
}

Described describe(const Workspace& workspace, const Selection& what) {
    const FittedScene& fitted = workspace.fitted();
    Described out;
    switch (what.kind) {
        case Selection::Kind::none:
            return out;
        case Selection::Kind::clip:
            describe_clip(out, fitted.scene().clips[static_cast<std::size_t>(what.index)]);
            return out;
        case Selection::Kind::query: {
            const SceneQuery query = fitted.queries()[static_cast<std::size_t>(what.index)];
            out.name = query.a.name + " against " + query.b.name;
            return out;
        }
        case Selection::Kind::path:
        case Selection::Kind::node:
        case Selection::Kind::sample:
            break;
    }
    const auto who = placed_agent_of(fitted, what.path);
    if (!who) return out;
    if (what.kind == Selection::Kind::path) describe_path(out, fitted, *who);
    if (what.kind == Selection::Kind::node) {
        describe_node(out, drawn_agent_of(fitted, *who), what.index);
        const std::shared_ptr<const TreeCost> cost = workspace.cost_of(who->clip);
        if (cost && !cost->shares.empty()) {
            const double share = cost->shares[static_cast<std::size_t>(what.index)];
            out.facts.emplace_back("cost",
                                   figure(100 * share, 2) + " % of all box tests in " + workload_title(cost->workload));
            out.exact["cost"] = {100 * share};
        }
        if (const BlameInScene* blame = workspace.blame()) {
            const std::int64_t overlaps = blame->of(who->clip, what.index);
            out.facts.emplace_back("to blame", counted(overlaps, "avoidable overlap", "avoidable overlaps"));
        }
    }
    if (what.kind == Selection::Kind::sample) describe_sample(out, drawn_agent_of(fitted, *who), what.index);
    return out;
}

std::string lines_of(const Described& what) {
    std::string out = what.name + '\n';
    for (const auto& [key, value] : what.facts) out.append(key).append(1, '\t').append(value).append(1, '\n');
    return out;
}

}  // namespace mobbscope::app
