#include <explain/axis_intervals.h>
#include <render/drawlist/pen.h>
#include <render/parts/node_boxes.h>
#include <render/query/query_boxes.h>
#include <render/query/separation_gap.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace mobbscope {

namespace {

/// What both cover; where they share nothing, the gap between them.
Projection shared(Projection a, Projection b) {
    const double low = std::max(a.min, b.min);
    const double high = std::min(a.max, b.max);
    return {std::min(low, high), std::max(low, high)};
}

}  // namespace

std::optional<SeparationGap> separation_gap(std::span<const DrawnAgent> sides, const mobb::Trace::Event& event) {
    if (event.outcome != mobb::Outcome::separated) return std::nullopt;
    const BoxPair boxes{world_box(sides[0].placed, event.a), world_box(sides[1].placed, event.b)};
    const glm::dvec3 axis = test_axis(boxes.a, boxes.b, event.test, event.axis);
    const auto [a, b] = as_tested(boxes, event.test, axis);
    // One direction level with the floor where there is a choice, so that the rectangles stand upright.
    const bool upright_axis = std::abs(axis.z) > 0.999;
    const glm::dvec3 across = upright_axis ? glm::normalize(glm::cross(axis, glm::dvec3(0, 1, 0)))
                                           : glm::normalize(glm::cross(axis, glm::dvec3(0, 0, 1)));
    const glm::dvec3 along = glm::cross(across, axis);
    const Projection on_a = project(a, axis);
    const Projection on_b = project(b, axis);
    const bool b_beyond = on_b.middle() > on_a.middle();
    const Projection u = shared(project(a, across), project(b, across));
    const Projection v = shared(project(a, along), project(b, along));
    const glm::dvec3 middle = across * u.middle() + along * v.middle();
    // A sliver of shared extent would leave rectangles too thin to see.
    const auto half = [](Projection p, Projection x, Projection y) {
        const double least = 0.3 * std::min(x.max - x.min, y.max - y.min);
        return std::max(0.5 * (p.max - p.min), least);
    };
    SeparationGap gap;
    gap.from = middle + axis * (b_beyond ? on_a.max : on_a.min);
    gap.to = middle + axis * (b_beyond ? on_b.min : on_b.max);
    gap.across = across * half(u, project(a, across), project(b, across));
    gap.along = along * half(v, project(a, along), project(b, along));
    return gap;
}

glm::vec3 add_separation_gap(DrawList& list, const SeparationGap& gap, double time_scale, float scale) {
    const Rgba color = outcome_style(BoxState::separated, list.palette).color;
    const auto drawn = [&](glm::dvec3 p) { return list.space.point(p.x, p.y, p.z / time_scale); };
    const auto style = [&](float width) {
        return scaled({.color = color, .width = width, .hidden = 0.55f, .cap = 0.5f * width}, scale);
    };
    Pen pen(list, {DrawLayer::findings});
    for (const glm::dvec3& middle : {gap.from, gap.to}) {
        const glm::dvec3 corners[4] = {middle - gap.across - gap.along, middle + gap.across - gap.along,
                                       middle + gap.across + gap.along, middle - gap.across + gap.along};
        pen.path(
            4, [&](int i) { return drawn(corners[i % 4]); }, style(1.8f));
        list.boxes.push_back(annotation_sheet(drawn(middle), list.space.extent(gap.across, time_scale),
                                              list.space.extent(gap.along, time_scale), with_alpha(color, 0.10f),
                                              pen.order()));
    }
    pen.line(drawn(gap.from), drawn(gap.to), style(2.6f));
    return 0.5f * (drawn(gap.from) + drawn(gap.to));
}

std::optional<TimeGap> time_gap(std::span<const DrawnAgent> sides, const mobb::Trace::Event& event,
                                const DrawnSpace& space) {
    if (event.outcome != mobb::Outcome::disjoint_in_time) return std::nullopt;
    const mobb::PlacedTree& a = sides[0].placed;
    const mobb::PlacedTree& b = sides[1].placed;
    const bool a_first = a.begin(a.node(event.a)) <= b.begin(b.node(event.b));
    const double end = a_first ? a.end(a.node(event.a)) : b.end(b.node(event.b));
    const double begin = a_first ? b.begin(b.node(event.b)) : a.begin(a.node(event.a));
    const glm::dvec3 middle = 0.5 * (world_box(a, event.a).center + world_box(b, event.b).center);
    return TimeGap{space.point(middle.x, middle.y, end), space.point(middle.x, middle.y, begin),
                   std::max(0.0, begin - end)};
}

void add_time_gap(DrawList& list, const TimeGap& gap, float scale) {
    const Dash dash = outcome_style(BoxState::apart_in_time, list.palette).dash;
    Pen(list, {DrawLayer::findings}).line(gap.from, gap.to, scaled({list.palette.text, 1.8f, dash, 0.6f}, scale));
}

}  // namespace mobbscope
