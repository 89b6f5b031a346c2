#include <render/drawlist/pen.h>
#include <render/query/floor_boundary.h>

namespace mobbscope {

namespace {

constexpr int kBoundaryCells = 128;  // of a side: lines go exactly where answers change, so that few suffice

}  // namespace

FloorLines floor_boundary(const FittedScene& fitted, const SceneQuery& query) {
    MapOrder order;
    order.width = order.height = kBoundaryCells;
    const mobb::PlacedTree a = fitted.placed(query.a), b = fitted.placed(query.b);
    choose_ranges(a.placed_clip(), b.placed_clip(), order);
    const mobb::Disk begin = b.placed_clip().disk(0);
    const glm::dvec2 from(begin.x, begin.y);
    FloorLines out;
    for (const MapLine& line : map_placements(fitted, query, order).boundary)
        out.emplace_back(from + line.from, from + line.to);
    return out;
}

LineStyle boundary_style(const Palette& palette, float scale) {
    return {palette.hit, 2 * scale, kSolid, 0.35f, 0.5f * scale};
}

void add_floor_boundary(DrawList& list, const FloorLines& lines, const DrawnAgent& b, float height, float scale) {
    constexpr int kFloorLevel = 2;  // above the grid and the paths' traces
    Pen pen(list, {DrawLayer::surroundings, kFloorLevel, static_cast<std::int64_t>(list.lines.size())});
    const auto at = [&](glm::dvec2 place) {
        const glm::vec3 point = list.space.point(place.x, place.y, 0);
        return glm::vec3(point.x, point.y, height);
    };
    const LineStyle style = boundary_style(list.palette, scale);
    for (const auto& [from, to] : lines) pen.line(at(from), at(to), style);
    const mobb::Disk begin = b.clip().disk(0);
    LineStyle ring = style;
    ring.color = b.color;
    constexpr int kPieces = 32;
    pen.ring(at({begin.x, begin.y}), static_cast<float>(0.35 * begin.r + 0.05), {1, 0, 0}, {0, 1, 0}, kPieces, ring);
}

}  // namespace mobbscope
