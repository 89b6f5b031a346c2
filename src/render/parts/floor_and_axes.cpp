#include <render/parts/floor_and_axes.h>
#include <render/text/labels.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace mobbscope {

namespace {

constexpr double kCells = 6;  // at least so many along the longer side of the floor
constexpr double kTicks = 5;

/// Half the length of a tick on the axis, pixels at scale 1.
constexpr float kTick = 4;

struct Edge {
    glm::dvec2 from, to;
    glm::dvec2 outward;
};

std::array<Edge, 4> edges(const FloorExtent& s) {
    return {Edge{{s.x0, s.y0}, {s.x1, s.y0}, {0, -1}}, Edge{{s.x0, s.y1}, {s.x1, s.y1}, {0, 1}},
            Edge{{s.x0, s.y0}, {s.x0, s.y1}, {-1, 0}}, Edge{{s.x1, s.y0}, {s.x1, s.y1}, {1, 0}}};
}

/// The grid's step or the multiple of it at which labels along an edge of the floor have room. `run`: the edge in
/// pixels.
double label_step(const std::vector<double>& values, double step, glm::vec2 run, float size) {
    std::size_t longest = 0;
    for (const double v : values) longest = std::max(longest, tick_text(v, step).size());
    const float wide = Font::of(FontFace::mono).width("0", size) * static_cast<float>(longest) + size;
    const float high = 1.5f * size;
    const float spaces = static_cast<float>(std::max<std::size_t>(values.size(), 2) - 1);
    for (const double multiple : {1.0, 2.0, 5.0, 10.0}) {
        const glm::vec2 between = run / spaces * static_cast<float>(multiple);
        if (between.x >= wide || between.y >= high) return multiple * step;
    }
    return 20 * step;
}

void add_line(DrawList& list, glm::vec3 from, glm::vec3 to, Rgba color, float width, int level) {
    LineInstance line;
    line.from = from;
    line.to = to;
    line.color = color;
    line.width = width;
    line.order = {0, level, static_cast<std::int64_t>(list.lines.size())};
    list.lines.push_back(line);
}

constexpr float kGlass = 0.1f;  // opacity

}  // namespace

FloorExtent floor_extent_of(glm::dvec3 min, glm::dvec3 max) {
    FloorExtent floor_extent;
    const double wide = std::max({max.x - min.x, max.y - min.y, 1e-6});
    floor_extent.step = nice_step(wide, kCells);
    const auto below = [&](double v) { return std::floor(v / floor_extent.step - 1e-6) * floor_extent.step; };
    const auto above = [&](double v) { return std::ceil(v / floor_extent.step + 1e-6) * floor_extent.step; };
    floor_extent.x0 = below(min.x);
    floor_extent.y0 = below(min.y);
    floor_extent.x1 = above(max.x);
    floor_extent.y1 = above(max.y);
    floor_extent.lowest = min.z;
    floor_extent.t0 = min.z;
    floor_extent.t1 = max.z;
    floor_extent.time_step = nice_step(std::max(max.z - min.z, 1e-6), kTicks);
    return floor_extent;
}

std::vector<glm::vec3> floor_corners(const FloorExtent& s, const DrawnSpace& space) {
    std::vector<glm::vec3> out;
    for (const double t : {s.t0, s.t1}) {
        for (const double x : {s.x0, s.x1}) {
            for (const double y : {s.y0, s.y1}) out.push_back(space.point(x, y, t));
        }
    }
    return out;
}

bool floor_on_edge(const ViewProjection& projection) { return std::abs(projection.back.z) < 0.02f; }

bool time_on_end(const ViewProjection& projection) { return std::abs(projection.back.z) > 0.995f; }

glm::dvec2 axis_corner(const FloorExtent& s, glm::vec3 right) {
    // A side seen end-on has both its corners equally far to the left; the farther from the viewer is taken, so that
    // what is drawn across from the axis lies behind the scene.
    const glm::vec2 back(right.y, -right.x);
    const auto choose = [](float along, float towards_viewer, double low, double high) {
        if (std::abs(along) > 1e-4f) return along > 0 ? low : high;
        return towards_viewer > 0 ? low : high;
    };
    return {choose(right.x, back.x, s.x0, s.x1), choose(right.y, back.y, s.y0, s.y1)};
}

void add_floor_grid(DrawList& list, const FloorExtent& s, float scale) {
    const DrawnSpace& space = list.space;
    for (const double x : ticks(s.x0, s.x1, s.step)) {
        add_line(list, space.point(x, s.y0, s.t0), space.point(x, s.y1, s.t0), list.palette.grid, scale, 0);
    }
    for (const double y : ticks(s.y0, s.y1, s.step)) {
        add_line(list, space.point(s.x0, y, s.t0), space.point(s.x1, y, s.t0), list.palette.grid, scale, 0);
    }
}

void add_time_axis(DrawList& list, const FloorExtent& s, float scale) {
    if (time_on_end(list.projection)) return;
    const DrawnSpace& space = list.space;
    const glm::dvec2 foot = axis_corner(s, list.projection.right);
    const auto at = [&](double t) { return space.point(foot.x, foot.y, t); };
    // Seen edge-on there is no grid behind the scene, so its ticks run all the way across.
    const bool across = floor_on_edge(list.projection);
    const bool along_x = std::abs(list.projection.right.x) > std::abs(list.projection.right.y);
    const glm::dvec2 opposite =
        along_x ? glm::dvec2(foot.x == s.x0 ? s.x1 : s.x0, foot.y) : glm::dvec2(foot.x, foot.y == s.y0 ? s.y1 : s.y0);
    for (const double t : ticks(s.t0, s.t1, s.time_step)) {
        if (across) add_line(list, at(t), space.point(opposite.x, opposite.y, t), list.palette.grid, scale, 0);
        const float pixels = list.projection.pixels_per_metre(at(t));
        if (pixels <= 0) continue;
        const float half = kTick * scale / pixels;
        add_line(list, at(t) - list.projection.right * half, at(t) + list.projection.right * half, list.palette.axis,
                 1.2f * scale, 1);
    }
    if (across) {
        for (const double v : ticks(along_x ? s.x0 : s.y0, along_x ? s.x1 : s.y1, s.step)) {
            const glm::dvec2 p = along_x ? glm::dvec2(v, foot.y) : glm::dvec2(foot.x, v);
            add_line(list, space.point(p.x, p.y, s.t0), space.point(p.x, p.y, s.t1), list.palette.grid, scale, 0);
        }
    }
    add_line(list, at(s.t0), at(s.t1), list.palette.axis, 1.2f * scale, 1);
}

void add_time_cursor(DrawList& list, const FloorExtent& s, double time, float scale) {
    const DrawnSpace& space = list.space;
    const glm::vec3 corners[4] = {space.point(s.x0, s.y0, time), space.point(s.x1, s.y0, time),
                                  space.point(s.x1, s.y1, time), space.point(s.x0, s.y1, time)};
    for (int i = 0; i < 4; ++i) {
        LineInstance line;
        line.from = corners[i];
        line.to = corners[(i + 1) % 4];
        line.color = list.palette.accent;
        line.width = 1.3f * scale;
        line.hidden = 0.3f;
        line.order = {8, 0, i};
        list.lines.push_back(line);
    }
    BoxInstance sheet;
    sheet.center = 0.5f * (corners[0] + corners[2]);
    sheet.extents = {0.5f * (corners[1] - corners[0]), 0.5f * (corners[3] - corners[0]), glm::vec3(0)};
    sheet.state = BoxState::annotation;
    sheet.fill = with_alpha(list.palette.accent, 0.035f);
    sheet.edge = Rgba(0);
    sheet.pickable = false;
    sheet.order = {8, 0, 0};
    list.boxes.push_back(sheet);
}

std::string longest_tick(const FloorExtent& s) {
    std::string longest;
    for (const double t : ticks(s.t0, s.t1, s.time_step)) {
        const std::string text = tick_text(t, s.time_step) + " s";
        if (text.size() > longest.size()) longest = text;
    }
    return longest;
}

std::string longest_distance(const FloorExtent& s) {
    std::string longest;
    for (const double v : {s.x0, s.x1, s.y0, s.y1}) {
        const std::string text = tick_text(v, s.step);
        if (text.size() > longest.size()) longest = text;
    }
    return longest;
}

std::vector<LabelRequest> floor_and_axis_labels(const DrawList& list, const FloorExtent& s, bool floor, bool time_axis,
                                                float size) {
    std::vector<LabelRequest> out;
    const DrawnSpace& space = list.space;
    const ViewProjection& projection = list.projection;
    LabelRequest label;
    label.face = FontFace::mono;
    label.size = size;
    label.color = list.palette.quiet_text;
    if (time_axis && !time_on_end(projection)) {
        const glm::dvec2 foot = axis_corner(s, projection.right);
        for (const double t : ticks(s.t0, s.t1, s.time_step)) {
            const auto anchor = projection.project(space.point(foot.x, foot.y, t));
            if (!anchor) continue;
            label.text = tick_text(t, s.time_step) + " s";
            label.anchor = *anchor;
            label.directions = {{-1, 0}};
            label.distance = 0.7f * size;
            out.push_back(label);
        }
    }
    if (!floor) return out;
    // Figures that touch read as one.
    label.room = 0.5f * size;
    struct Side {
        Edge edge;
        glm::vec2 direction;
        std::vector<double> values;  ///< that are seen
    };
    std::vector<Side> sides;
    double shown = s.step;
    for (const Edge& edge : edges(s)) {
        const bool along_x = edge.from.y == edge.to.y;
        const glm::dvec2 middle = 0.5 * (edge.from + edge.to);
        const glm::vec3 here = space.point(middle.x, middle.y, s.t0);
        const glm::vec3 outward(static_cast<float>(edge.outward.x), static_cast<float>(edge.outward.y), 0);
        // Only edges that face the viewer, and that have some length in the picture. From above, those below and to the
        // left.
        const bool faces = time_on_end(projection) ? glm::dot(outward, projection.right + projection.up) < -0.3f
                                                   : glm::dot(outward, projection.back) > 0.05f;
        std::vector<double> values = ticks(along_x ? s.x0 : s.y0, along_x ? s.x1 : s.y1, s.step);
        const auto seen_at = [&](double v) {
            return projection.project(space.point(along_x ? v : edge.from.x, along_x ? edge.from.y : v, s.t0));
        };
        std::erase_if(values, [&](double v) { return !seen_at(v); });
        if (!faces || values.size() < 2) continue;
        const glm::vec2 run = *seen_at(values.back()) - *seen_at(values.front());
        if (glm::length(run) < 4 * size) continue;
        const auto foot = projection.project(here);
        const auto beyond = projection.project(here + outward * (0.05f * static_cast<float>(s.step)));
        const glm::vec2 away = foot && beyond ? *beyond - *foot : glm::vec2(0);
        const glm::vec2 direction =
            floor_on_edge(projection) || glm::length(away) < 1e-3f ? glm::vec2(0, 1) : glm::normalize(away);
        // One step for both ways, or the floor would seem to have two scales.
        shown = std::max(shown, label_step(values, s.step, glm::abs(run), size));
        sides.push_back({edge, direction, std::move(values)});
    }
    for (auto& [edge, direction, values] : sides) {
        const bool along_x = edge.from.y == edge.to.y;
        std::erase_if(values, [&](double v) { return std::abs(std::remainder(v, shown)) > 0.01 * s.step; });
        for (const double v : values) {
            // One label tells which way it is; the others are bare.
            const bool last = v == values.back();
            label.text = last ? std::string(along_x ? "x " : "y ") + tick_text(v, shown) + " m" : tick_text(v, shown);
            // Boxes may reach below a floor that is seen edge-on; its labels stand below them.
            const double height = floor_on_edge(projection) ? s.lowest : s.t0;
            const auto anchor =
                projection.project(space.point(along_x ? v : edge.from.x, along_x ? edge.from.y : v, height));
            if (!anchor) continue;
            label.anchor = *anchor;
            label.directions = {direction};
            label.distance = 0.6f * size;
            // Those that tell the way come before their bare neighbours at a corner.
            out.insert(last ? out.begin() : out.end(), label);
        }
    }
    return out;
}

FloorExtent floor_stage(glm::dvec2 area, double begin, double end) {
    const glm::dvec2 half = 0.5 * area;
    FloorExtent floor_extent = floor_extent_of({-half.x, -half.y, begin}, {half.x, half.y, end});
    // The floor ends at its walls, wherever the grid has a line.
    floor_extent.x0 = -half.x;
    floor_extent.x1 = half.x;
    floor_extent.y0 = -half.y;
    floor_extent.y1 = half.y;
    return floor_extent;
}

void add_walls(DrawList& list, glm::dvec2 area, double bottom, double top, float scale) {
    const glm::dvec2 half = 0.5 * area;
    const glm::dvec2 corners[4] = {{-half.x, -half.y}, {half.x, -half.y}, {half.x, half.y}, {-half.x, half.y}};
    const Rgba color = list.palette.axis;
    const auto add_line = [&](glm::vec3 from, glm::vec3 to, float width, int i) {
        LineInstance line;
        line.from = from;
        line.to = to;
        line.color = color;
        line.width = width * scale;
        line.cap = 0.4f * width * scale;
        line.order = {0, 3, i};
        list.lines.push_back(line);
    };
    for (int i = 0; i < 4; ++i) {
        const glm::dvec2 a = corners[i];
        const glm::dvec2 b = corners[(i + 1) % 4];
        const glm::vec3 a0 = list.space.point(a.x, a.y, bottom);
        const glm::vec3 b0 = list.space.point(b.x, b.y, bottom);
        add_line(a0, b0, 2, 2 * i);
        if (top <= bottom) continue;
        const glm::vec3 a1 = list.space.point(a.x, a.y, top);
        const glm::vec3 b1 = list.space.point(b.x, b.y, top);
        add_line(a1, b1, 1, 2 * i + 1);
        add_line(a0, a1, 1, 8 + i);
        BoxInstance pane;
        pane.center = 0.25f * (a0 + b0 + a1 + b1);
        pane.extents = {0.5f * (b0 - a0), 0.5f * (a1 - a0), glm::vec3(0)};
        pane.state = BoxState::annotation;
        pane.fill = with_alpha(color, kGlass);
        pane.edge = Rgba(0);
        pane.pickable = false;
        pane.order = {0, 3, i};
        list.boxes.push_back(pane);
    }
}

}  // namespace mobbscope
