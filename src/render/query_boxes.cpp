#include <render/query_boxes.h>
#include <render/world_box.h>

#include <algorithm>

namespace mobbscope {

OutcomeStyle outcome_style(BoxState state, const Palette& palette) {
    switch (state) {
        case BoxState::apart_in_time:
            return {palette.apart_in_time, {4, 4, 4, 4}, 1.0f};
        case BoxState::separated:
            return {palette.separated, kSolid, 1.2f};
        case BoxState::overlap:
            return {palette.overlap, {10, 4, 2, 4}, 1.2f};
        case BoxState::hit:
            return {palette.hit, kSolid, 2.2f};
        case BoxState::level:
        case BoxState::under_test:
        case BoxState::annotation:
            break;
    }
    return {palette.text, kSolid, 2.2f};
}

namespace {

constexpr float kForgotten = 24;  // steps until an earlier pair is as faint as it gets

/// The farther from the pair under test, in the tree or in steps, the fainter.
float strength(const NodeProgress& node, int step) {
    if (node.open) return node.state == BoxState::hit ? 0.4f : 0.32f;
    const float age = std::min(1.0f, static_cast<float>(step - node.event) / kForgotten);
    return (node.refined ? 0.16f : 0.45f) * (1 - 0.7f * age);
}

}  // namespace

PairOutline pair_outline(const ViewState& view) {
    return view.tested_before ? PairOutline::owner : PairOutline::outcome;
}

OutcomeStyle pair_style(PairOutline outline, const Subject& side, mobb::Outcome outcome, const Palette& palette) {
    constexpr float kWidth = 2.2f;
    if (outline == PairOutline::owner) return {outlining(side.color, palette), kSolid, kWidth};
    OutcomeStyle style = outcome_style(box_state(outcome), palette);
    style.width = kWidth;
    return style;
}

void add_query_boxes(DrawList& list, std::span<const Subject> sides, const QueryProgress& progress, PairOutline outline,
                     float scale) {
    for (std::size_t side = 0; side < 2; ++side) {
        const Subject& subject = sides[side];
        const std::span<const NodeProgress> before =
            outline == PairOutline::owner ? progress.nodes[side] : std::span<const NodeProgress>();
        for (const NodeProgress& node : before) {
            const OutcomeStyle style = outcome_style(node.state, list.palette);
            BoxInstance box = node_box(subject, node.node, list.space);
            box.state = node.state;
            box.edge = faded(style.color, strength(node, progress.step), list.palette);
            // Boxes around the one that matters stay in the background.
            box.width = (node.open ? std::min(style.width, 1.2f) : style.width) * scale;
            box.dash = style.dash * scale;
            list.boxes.push_back(box);
        }
        BoxInstance box = node_box(subject, side == 0 ? progress.event.a : progress.event.b, list.space);
        box.state = BoxState::under_test;
        box.fill = with_alpha(subject.color, 0.17f);
        const OutcomeStyle style = pair_style(outline, subject, progress.event.outcome, list.palette);
        box.edge = style.color;
        box.width = style.width * scale;
        box.dash = style.dash * scale;
        box.order.layer = 2;
        list.boxes.push_back(box);
    }
}

}  // namespace mobbscope
