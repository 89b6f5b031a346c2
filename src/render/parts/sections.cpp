#include <base/text.h>
#include <render/drawlist/cut.h>
#include <render/drawlist/palette.h>
#include <render/drawlist/pen.h>
#include <render/parts/sections.h>

#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace mobbscope {

namespace {

constexpr float kFill = 0.2f;  // opacity of sections

/// The times of the planes that cut something.
std::vector<double> planes_of(const FloorExtent& s, const ValueRange& slab) {
    std::vector<double> out{slab.least};
    if (slab.most > slab.least) out.push_back(slab.most);
    std::erase_if(out, [&](double t) { return t < s.t0 || t > s.t1; });
    return out;
}

void fill_polygon(DrawList& list, std::span<const glm::vec3> corners, Rgba fill, DrawOrder order) {
    for (std::size_t i = 2; i < corners.size(); ++i) {
        const glm::vec3 u = 0.5f * (corners[i - 1] - corners[0]), v = 0.5f * (corners[i] - corners[0]);
        BoxInstance part = annotation_sheet(corners[0] + u + v, u, v, fill, order);
        part.triangle = true;
        list.boxes.push_back(part);
    }
}

}  // namespace

std::optional<DrawnSlab> slab_of_view(const ViewState& view, const DrawnSpace& space) {
    if (!view.slab || view.show != Show::space_time) return std::nullopt;
    return DrawnSlab{space.point(0, 0, view.slab->least).z, space.point(0, 0, view.slab->most).z, view.cut_boxes};
}

void add_slab_planes(DrawList& list, const FloorExtent& s, const ValueRange& slab, float scale) {
    const LineStyle style{.color = list.palette.axis, .width = 1.2f * scale, .hidden = 0.4f};
    Pen pen(list, {DrawLayer::time_cursor, 1});
    for (const double t : planes_of(s, slab)) {
        const std::array corners{list.space.point(s.x0, s.y0, t), list.space.point(s.x1, s.y0, t),
                                 list.space.point(s.x1, s.y1, t), list.space.point(s.x0, s.y1, t)};
        pen.path(
            4, [&](int i) { return corners[static_cast<std::size_t>(i) % 4]; }, style);
    }
    if (!list.slab || !list.slab->cuts_boxes) return;
    for (const BoxInstance& box : list.boxes) {
        if (box.edge.a <= 0 || !is_seen(list.slab, box)) continue;
        Pen edge_pen(list, box.order);
        for (const float height : {list.slab->low, list.slab->high}) {
            const std::vector<glm::vec3> corners = level_section(box, height);
            const LineStyle edge{.color = box.edge, .width = box.width, .dash = box.dash, .hidden = 0.38f};
            edge_pen.path(
                static_cast<int>(corners.size()),
                [&](int i) { return corners[static_cast<std::size_t>(i) % corners.size()]; }, edge);
        }
    }
}

std::vector<LabelRequest> slab_labels(const DrawList& list, const FloorExtent& s, const ValueRange& slab, float size) {
    std::vector<LabelRequest> out;
    const glm::dvec2 corner = axis_corner(s, -list.projection.right);
    for (const double t : planes_of(s, slab)) {
        const auto anchor = list.projection.project(list.space.point(corner.x, corner.y, t));
        if (!anchor) continue;
        LabelRequest label;
        label.text = to_thousandth(t) + " s";
        label.role = TextRole::tick;
        label.face = FontFace::mono;
        label.size = size;
        label.color = list.palette.text;
        label.anchor = *anchor;
        label.directions = {{1, 0}, {1, -1}, {1, 1}};
        label.distance = 0.5f * size;
        out.push_back(label);
    }
    return out;
}

void add_sections(DrawList& list, std::span<const BoxInstance> boxes, float height, float drawn_at, float scale) {
    std::int64_t index = 0;
    for (const BoxInstance& box : boxes) {
        if (box.edge.a <= 0) continue;
        std::vector<glm::vec3> corners = level_section(box, height);
        if (corners.empty()) continue;
        for (glm::vec3& corner : corners) corner.z = drawn_at;
        const DrawOrder order{DrawLayer::findings, box.order.level, index};
        if (box.fill.a > 0) fill_polygon(list, corners, with_alpha(box.fill, kFill), order);
        const LineStyle edge{.color = with_alpha(box.edge, 1),
                             .width = 1.8f * std::max(box.width, scale),
                             .dash = box.dash,
                             .hidden = 1};
        Pen(list, order)
            .path(
                static_cast<int>(corners.size()),
                [&](int i) { return corners[static_cast<std::size_t>(i) % corners.size()]; }, edge);
        index += 8;
    }
}

}  // namespace mobbscope
