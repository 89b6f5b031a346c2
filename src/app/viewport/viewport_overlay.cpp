#include <app/viewport/viewport_overlay.h>
#include <base/text.h>
#include <explain/query_sentence.h>
#include <render/drawlist/draw_list.h>
#include <render/parts/node_boxes.h>
#include <render/parts/paths.h>
#include <scene/drawn_agent.h>
#include <scene/motion_graph.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace mobbscope::app {

namespace {

constexpr int kRingSides = 48;

std::vector<glm::vec3> ring(const DrawnSpace& space, const mobb::Disk& disk, double time) {
    std::vector<glm::vec3> out;
    for (int i = 0; i < kRingSides; ++i) {
        const double angle = 2 * std::numbers::pi * i / kRingSides;
        out.push_back(space.point(disk.x + disk.r * std::cos(angle), disk.y + disk.r * std::sin(angle), time));
    }
    return out;
}

std::string numbers(const char* format, double a, double b) {
    char text[96];
    std::snprintf(text, sizeof text, format, a, b);
    return text;
}

/// The agent as pictures name it, whether or not it is in the present one.
DrawnAgent drawn_agent_of(const FittedScene& fitted, const PlacedAgent& who) {
    return {fitted.placed(who), who.name, who.name, Rgba(1), 0};
}

void describe_node(Described& out, const DrawnAgent& agent, int index) {
    const mobb::PlacedTree& tree = agent.placed;
    const mobb::Node& node = tree.node(index);
    out.name = node_name(agent, index);
    const mobb::Box world = world_box(tree, index);
    const bool upright = mobb::info(world.kind).axes != mobb::BoxAxes::space_time;
    out.facts = {{"node", std::to_string(index) + (node.is_leaf() ? ", leaf" : "") + ", " +
                              std::string(mobb::info(world.kind).title)},
                 {"level", std::to_string(node.level)},
                 {"samples", std::to_string(node.first) + ".." + std::to_string(node.end() - 1) + " (" +
                                 std::to_string(node.count) + ")"},
                 {"time", numbers("%.3f..%.3f s", tree.begin(node), tree.end(node))},
                 {"centre", numbers("%.3f, %.3f m", world.center.x, world.center.y)},
                 {upright ? "sides" : "sides 1, 2", numbers("%.3f x %.3f m", 2 * world.half[0], 2 * world.half[1])}};
    if (world.kind == mobb::BoxKind::moving && world.half.z > 0) {
        const glm::dvec2 velocity = world.drift * (tree.time_scale() / world.half.z);
        out.facts.emplace_back("velocity", numbers("%.3f, %.3f m/s", velocity.x, velocity.y));
    }
    if (!upright) out.facts.emplace_back("side 3", numbers("%.3f m", 2 * world.half[2], 0));
    const double volume = mobb::volume(node.box, tree.time_scale());
    double cylinders = 0;
    for (int i = node.first; i < node.end(); ++i) {
        const double r = tree.tree().clip().samples()[static_cast<std::size_t>(i)].r;
        cylinders += std::numbers::pi * r * r * tree.tree().clip().dt();
    }
    out.facts.emplace_back("volume", numbers("%.4g m\u00B2\u00B7s", volume, 0));
    if (volume > 0) out.facts.emplace_back("tightness", numbers("%.3f", cylinders / volume, 0));
}

void describe_sample(Described& out, const DrawnAgent& agent, int index) {
    const mobb::PlacedClip& clip = agent.clip();
    const mobb::Disk disk = clip.disk(index);
    out.name = agent.name + ", sample " + std::to_string(index);
    out.facts = {{"time", numbers("%.3f..%.3f s", clip.time(index), clip.time(index + 1))},
                 {"place", numbers("%.3f, %.3f m", disk.x, disk.y)},
                 {"radius", numbers("%.3f m", disk.r, 0)}};
    if (index + 1 < clip.count()) {
        const mobb::Disk next = clip.disk(index + 1);
        out.facts.emplace_back("speed",
                               numbers("%.2f m/s", std::hypot(next.x - disk.x, next.y - disk.y) / clip.clip().dt(), 0));
    }
}

void describe_path(Described& out, const FittedScene& fitted, const PlacedAgent& who) {
    const mobb::PlacedTree tree = fitted.placed(who);
    const mobb::PlacedClip& clip = tree.placed_clip();
    out.name = who.name;
    out.facts = {{"clip", fitted.scene().clips[static_cast<std::size_t>(who.clip)].name},
                 {"samples", std::to_string(clip.count())},
                 {"time", numbers("%.3f..%.3f s", clip.time(0), clip.time(clip.count()))},
                 {"starts at", numbers("%.3f, %.3f m", clip.disk(0).x, clip.disk(0).y)},
                 {"tree", std::to_string(tree.tree().nodes().size()) + " nodes, " +
                              std::to_string(tree.tree().depth()) + " levels"}};
}

void describe_clip(Described& out, const SceneClip& clip) {
    double length = 0;
    const auto samples = clip.clip->samples();
    for (std::size_t i = 1; i < samples.size(); ++i) {
        length += std::hypot(samples[i].x - samples[i - 1].x, samples[i].y - samples[i - 1].y);
    }
    out.name = clip.name;
    out.facts = {{"source", clip.source.value_or("samples in the scene")},
                 {"samples", std::to_string(clip.clip->count())},
                 {"lasts", numbers("%.3f s at %.5g a second", clip.clip->duration(), 1 / clip.clip->dt())},
                 {"path", numbers("%.2f m, %.2f m/s", length, length / clip.clip->duration())}};
    if (!clip.facts.root.empty()) out.facts.emplace_back("root", clip.facts.root);
    for (const std::string& warning : clip.facts.warnings) out.facts.emplace_back("note", warning);
}

}  // namespace

std::optional<ImVec2> ShownPicture::at(glm::vec3 point) const {
    const auto pixel = list.projection.project(point);
    if (!pixel) return std::nullopt;
    return ImVec2{corner.x + pixel->x, corner.y + pixel->y};
}

void draw_line(Ui& ui, const ShownPicture& picture, std::span<const glm::vec3> points, bool closed, ImU32 color,
               float width) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImU32 ground = to_im(with_alpha(ui.style.palette.background, 0.75f));
    const std::size_t count = points.size() - (closed ? 0 : 1);
    for (const bool front : {false, true}) {
        for (std::size_t i = 0; i < count; ++i) {
            const auto from = picture.at(points[i]);
            const auto to = picture.at(points[(i + 1) % points.size()]);
            if (from && to) draw.AddLine(*from, *to, front ? color : ground, front ? width : width + ui.px(2));
        }
    }
}

void draw_highlight(Ui& ui, const ShownPicture& picture, const Selection& what, ImU32 color, float width) {
    const Session& session = ui.session;
    if (!what.on_path() || !index_in_view(session.fitted(), session.view(), what.path)) return;
    const auto who = placed_agent_of(session.fitted(), what.path);
    if (!who) return;
    const DrawnAgent agent = drawn_agent_of(session.fitted(), *who);
    const DrawnSpace& space = picture.list.space;
    const mobb::PlacedClip& clip = agent.clip();
    if (picture.list.moment) {
        const std::optional<int> then =
            what.kind == Selection::Kind::sample ? what.index : sample_at(agent, *picture.list.moment);
        // A node is no thing of one moment.
        if (!then || what.kind == Selection::Kind::node) return;
        draw_line(ui, picture, ring(space, clip.disk(*then), 0), true, color, width);
        return;
    }
    const auto middle = [&](int sample) { return 0.5 * (clip.time(sample) + clip.time(sample + 1)); };
    if (what.kind == Selection::Kind::node) {
        const auto corners = box_corners(node_box(agent, what.index, space));
        for (const auto& [a, b] : kBoxEdges) {
            const std::array edge{corners[a], corners[b]};
            draw_line(ui, picture, edge, false, color, width);
        }
    } else if (what.kind == Selection::Kind::sample) {
        draw_line(ui, picture, ring(space, clip.disk(what.index), middle(what.index)), true, color, width);
    } else {
        for (const int end : {0, clip.count() - 1}) {
            draw_line(ui, picture, ring(space, clip.disk(end), middle(end)), true, color, width);
        }
    }
}

void draw_candidate(Ui& ui, const ShownPicture& picture) {
    const Session& session = ui.session;
    const FollowedChoice* followed = session.choice();
    if (!followed || !session.view().candidates || session.candidate < 0) return;
    const auto& candidates = followed->choice.candidates;
    if (static_cast<std::size_t>(session.candidate) >= candidates.size()) return;
    const Candidate& candidate = candidates[static_cast<std::size_t>(session.candidate)];
    const GraphMove& move = session.scene().graph->moves[static_cast<std::size_t>(candidate.move)];
    const mobb::PlacedClip way(*session.scene().clips[static_cast<std::size_t>(move.clip)].clip, candidate.placement);
    std::vector<glm::vec3> points;
    for (int i = 0; i < way.count(); ++i) {
        const mobb::Disk disk = way.disk(i);
        points.push_back(picture.list.space.point(disk.x, disk.y, picture.list.moment ? 0 : way.time(i)));
    }
    draw_line(ui, picture, points, false, ui.style.accent, ui.px(3.5f));
}

void draw_other_of_conflict(Ui& ui, const ShownPicture& picture) {
    const Session& session = ui.session;
    const std::vector<SceneConflict>* found = session.conflicts();
    if (!found || session.conflict < 0 || session.view().follow.empty() || !session.view().time) return;
    const SceneConflict& conflict = (*found)[static_cast<std::size_t>(session.conflict)];
    const bool near = std::abs(*session.view().time - conflict.begin()) < 2;
    if (!near || conflict.a.name != session.view().follow) return;
    const Selection other{Selection::Kind::path, {conflict.b.agent, -1, 0}, -1};
    draw_highlight(ui, picture, other, to_im(ui.style.palette.hit), ui.px(2.5f));
}

Described describe(const FittedScene& fitted, const Selection& what) {
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
    if (what.kind == Selection::Kind::node) describe_node(out, drawn_agent_of(fitted, *who), what.index);
    if (what.kind == Selection::Kind::sample) describe_sample(out, drawn_agent_of(fitted, *who), what.index);
    return out;
}

}  // namespace mobbscope::app
