#include <mobb/query.h>
#include <render/drawlist/pen.h>
#include <render/parts/node_boxes.h>
#include <render/parts/paths.h>
#include <render/query/query_boxes.h>

#include <algorithm>

namespace mobbscope {

namespace {

constexpr float kForgotten = 24;  // steps until an earlier pair is as faint as it gets

/// The farther from the pair under test, in the tree or in steps, the fainter.
float strength(const NodeProgress& node, int step) {
    if (node.open) return node.outcome == mobb::Outcome::hit ? 0.4f : 0.32f;
    const float age = std::min(1.0f, static_cast<float>(step - node.event) / kForgotten);
    return (node.refined ? 0.16f : 0.45f) * (1 - 0.7f * age);
}

// Pixels at scale 1.
constexpr float kIntervalBar = 5;
constexpr float kFirst = 9;  // from the axis to the middle of A's bar: clear of the ticks
constexpr float kNext = 8;   // from there to B's

}  // namespace

BoxState box_state(mobb::Outcome outcome) {
    switch (outcome) {
        case mobb::Outcome::disjoint_in_time:
            return BoxState::apart_in_time;
        case mobb::Outcome::separated:
            return BoxState::separated;
        case mobb::Outcome::hit:
            return BoxState::hit;
        case mobb::Outcome::overlap:
        case mobb::Outcome::no_hit:
            break;
    }
    return BoxState::overlap;
}

BoxState state_found(const QueryProgress& progress) {
    return progress.avoidable ? BoxState::avoidable : box_state(progress.event.outcome);
}

LineStyle outcome_style(BoxState state, const Palette& palette) {
    switch (state) {
        case BoxState::apart_in_time:
            return {palette.apart_in_time, 1.0f, {4, 4, 4, 4}};
        case BoxState::separated:
            return {palette.separated, 1.2f};
        case BoxState::overlap:
            return {palette.overlap, 1.2f, {10, 4, 2, 4}};
        case BoxState::avoidable:
            return {palette.avoidable, 1.2f, {2, 3, 2, 3}};
        case BoxState::hit:
            return {palette.hit, 2.2f};
        case BoxState::level:
        case BoxState::under_test:
        case BoxState::annotation:
            break;
    }
    return {palette.text, 2.2f};
}

PairOutline pair_outline(const ViewState& view) {
    return view.past == Past::pair ? PairOutline::outcome : PairOutline::owner;
}

LineStyle pair_style(PairOutline outline, const DrawnAgent& side, BoxState found, const Palette& palette) {
    constexpr float kOutlineWidth = 2.2f;
    if (outline == PairOutline::owner) return {outlining(side.color, palette), kOutlineWidth};
    LineStyle style = outcome_style(found, palette);
    style.width = kOutlineWidth;
    return style;
}

void add_query_boxes(DrawList& list, std::span<const DrawnAgent> sides, const QueryProgress& progress,
                     PairOutline outline, float scale) {
    for (std::size_t side = 0; side < 2; ++side) {
        const DrawnAgent& agent = sides[side];
        if (agent.hidden) continue;
        for (const NodeProgress& node : progress.nodes[side]) {
            const LineStyle style = outcome_style(box_state(node.outcome), list.palette);
            BoxInstance box = node_box(agent, node.node, list.space);
            box.state = box_state(node.outcome);
            box.edge = faded(style.color, strength(node, progress.step), list.palette);
            // Boxes around the one that matters stay in the background.
            box.width = (node.open ? std::min(style.width, 1.2f) : style.width) * scale;
            box.dash = style.dash * scale;
            list.boxes.push_back(box);
        }
        BoxInstance box = node_box(agent, side == 0 ? progress.event.a : progress.event.b, list.space);
        box.state = BoxState::under_test;
        box.fill = with_alpha(agent.color, 0.17f);
        const LineStyle style = scaled(pair_style(outline, agent, state_found(progress), list.palette), scale);
        box.edge = style.color;
        box.width = style.width;
        box.dash = style.dash;
        box.order.layer = DrawLayer::subject;
        list.boxes.push_back(box);
    }
}

void add_time_intervals(DrawList& list, const FloorExtent& floor_extent, std::span<const DrawnAgent> sides,
                        const mobb::Trace::Event& event, float scale) {
    if (time_on_end(list.projection)) return;
    const glm::dvec2 foot = axis_corner(floor_extent, list.projection.right);
    const float pixels =
        list.projection.pixels_per_metre(list.space.point(foot.x, foot.y, 0.5 * (floor_extent.t0 + floor_extent.t1)));
    if (pixels <= 0) return;
    Pen pen(list, {DrawLayer::findings, 1});
    const auto add = [&](float aside, double from, double to, const LineStyle& style) {
        const glm::vec3 shift = list.projection.right * (aside * scale / pixels);
        pen.line(list.space.point(foot.x, foot.y, from) + shift, list.space.point(foot.x, foot.y, to) + shift,
                 scaled(style, scale));
    };
    double end = floor_extent.t1;
    double begin = floor_extent.t0;
    for (std::size_t side = 0; side < 2; ++side) {
        const mobb::PlacedTree& tree = sides[side].placed;
        const mobb::Node& node = tree.node(side == 0 ? event.a : event.b);
        add(kFirst + kNext * static_cast<float>(side), tree.begin(node), tree.end(node),
            {.color = outlining(sides[side].color, list.palette), .width = kIntervalBar, .hidden = 1});
        end = std::min(end, tree.end(node));
        begin = std::max(begin, tree.begin(node));
    }
    if (event.outcome != mobb::Outcome::disjoint_in_time) return;
    // In the text's colour, as the gap in the scene is: a thin grey line between the bars is not seen.
    const Dash dash = outcome_style(BoxState::apart_in_time, list.palette).dash;
    add(kFirst + 0.5f * kNext, end, begin, {list.palette.text, 1.8f, dash, 1});
}

Emphasis emphasis_of(const ViewState& view, std::span<const DrawnAgent> agents, double begin, double end,
                     const QueryProgress* progress) {
    Emphasis out;
    if (view.time && *view.time >= begin && *view.time <= end) {
        out.cursor = view.time;
        for (const DrawnAgent& agent : agents) {
            out.at_cursor.push_back(agent.hidden ? std::nullopt : sample_at(agent, *view.time));
        }
    }
    if (!progress) return out;
    const mobb::Trace::Event& event = progress->event;
    if (event.outcome == mobb::Outcome::hit && !event.pairs.empty()) {
        const auto& pair = event.pairs.back();
        out.hits = {pair.i, pair.j};
        out.hit_time = mobb::contact_of(agents[0].clip(), pair.i, agents[1].clip(), pair.j).time;
    }
    for (const DrawnAgent& agent : agents) {
        const mobb::Node& node = agent.placed.node(agent.index == 0 ? event.a : event.b);
        out.dims = out.dims || (view.disks && !agent.hidden && node.count < agent.clip().count());
    }
    return out;
}

}  // namespace mobbscope
