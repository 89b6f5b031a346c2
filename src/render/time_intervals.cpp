#include <render/query_boxes.h>
#include <render/query_progress.h>
#include <render/time_intervals.h>

#include <algorithm>

namespace mobbscope {

namespace {

// Pixels at scale 1.
constexpr float kIntervalBar = 5;
constexpr float kFirst = 9;  // from the axis to the middle of A's bar: clear of the ticks
constexpr float kNext = 8;   // from there to B's

}  // namespace

void add_time_intervals(DrawList& list, const Stage& stage, std::span<const Subject> sides,
                        const mobb::Trace::Event& event, float scale) {
    if (time_on_end(list.lens)) return;
    const glm::dvec2 foot = axis_corner(stage, list.lens.right);
    const float pixels = list.lens.pixels_per_metre(list.space.point(foot.x, foot.y, 0.5 * (stage.t0 + stage.t1)));
    if (pixels <= 0) return;
    const auto add = [&](float aside, double from, double to, const OutcomeStyle& style) {
        const glm::vec3 shift = list.lens.right * (aside * scale / pixels);
        LineInstance line;
        line.from = list.space.point(foot.x, foot.y, from) + shift;
        line.to = list.space.point(foot.x, foot.y, to) + shift;
        line.color = style.color;
        line.width = style.width * scale;
        line.dash = style.dash * scale;
        line.hidden = 1;
        line.order = {9, 1, static_cast<std::int64_t>(list.lines.size())};
        list.lines.push_back(line);
    };
    double end = stage.t1;
    double begin = stage.t0;
    for (std::size_t side = 0; side < 2; ++side) {
        const mobb::PlacedTree& tree = sides[side].placed;
        const mobb::Node& node = tree.node(side == 0 ? event.a : event.b);
        add(kFirst + kNext * static_cast<float>(side), tree.begin(node), tree.end(node),
            {outlining(sides[side].color, list.palette), kSolid, kIntervalBar});
        end = std::min(end, tree.end(node));
        begin = std::max(begin, tree.begin(node));
    }
    if (event.outcome != mobb::Outcome::disjoint_in_time) return;
    // In the text's colour, as the gap in the scene is: a thin grey line between the bars is not seen.
    const Dash dash = outcome_style(BoxState::apart_in_time, list.palette).dash;
    add(kFirst + 0.5f * kNext, end, begin, {list.palette.text, dash, 1.8f});
}

}  // namespace mobbscope
