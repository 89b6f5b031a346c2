#include <base/text.h>
#include <mobb/traversal.h>
#include <render/drawlist/pen.h>
#include <render/parts/floor_and_axes.h>

#include <glm/common.hpp>
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

    bool along_x() const { return from.y == to.y; }
    std::vector<double> ticks_on(const FloorExtent& s) const {
        return along_x() ? ticks(s.x0, s.x1, s.step) : ticks(s.y0, s.y1, s.step);
    }
    /// Where x or y is `v`.
    glm::dvec2 at(double v) const { return along_x() ? glm::dvec2(v, from.y) : glm::dvec2(from.x, v); }
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
    // Five times 5, or 0.5, is no number to count by.
    const bool by_fives = std::abs(step / std::pow(10, std::floor(std::log10(step) + 1e-9)) - 5) < 0.5;
    for (const double multiple : {1.0, 2.0, by_fives ? 4.0 : 5.0, 10.0}) {
        const glm::vec2 between = run / spaces * static_cast<float>(multiple);
        if (between.x >= wide || between.y >= high) return multiple * step;
    }
    return 20 * step;
}

/// For lines of the surroundings that lie above all those so far of their level.
Pen surroundings_pen(DrawList& list, int level) {
    return {list, {DrawLayer::surroundings, level, static_cast<std::int64_t>(list.lines.size())}};
}

constexpr float kGlass = 0.1f;  // opacity

constexpr float kMapSide = 128;  // pixels at scale 1, of the longer side

}  // namespace

FloorExtent floor_extent_of(glm::dvec3 min, glm::dvec3 max) {
    const double step = nice_step(std::max({max.x - min.x, max.y - min.y, 1e-6}), kCells);
    const double time_step = nice_step(std::max(max.z - min.z, 1e-6), kTicks);
    const auto below = [&](double v) { return std::floor(v / step - 1e-6) * step; };
    const auto above = [&](double v) { return std::ceil(v / step + 1e-6) * step; };
    return {below(min.x), above(max.x), below(min.y), above(max.y), step, min.z, max.z, min.z, time_step};
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
    Pen pen = surroundings_pen(list, 0);
    const LineStyle style{list.palette.grid, scale};
    for (const double x : ticks(s.x0, s.x1, s.step)) {
        pen.line(space.point(x, s.y0, s.t0), space.point(x, s.y1, s.t0), style);
    }
    for (const double y : ticks(s.y0, s.y1, s.step)) {
        pen.line(space.point(s.x0, y, s.t0), space.point(s.x1, y, s.t0), style);
    }
}

void add_time_axis(DrawList& list, const FloorExtent& s, float scale) {
    if (time_on_end(list.projection)) return;
    const DrawnSpace& space = list.space;
    const glm::dvec2 foot = axis_corner(s, list.projection.right);
    const auto at = [&](double t) { return space.point(foot.x, foot.y, t); };
    Pen grid_pen = surroundings_pen(list, 0), axis_pen = surroundings_pen(list, 1);
    const LineStyle grid{list.palette.grid, scale}, axis{list.palette.axis, 1.2f * scale};
    // Seen edge-on there is no grid behind the scene, so its ticks run all the way across.
    const bool across = floor_on_edge(list.projection);
    const bool along_x = std::abs(list.projection.right.x) > std::abs(list.projection.right.y);
    const glm::dvec2 opposite =
        along_x ? glm::dvec2(foot.x == s.x0 ? s.x1 : s.x0, foot.y) : glm::dvec2(foot.x, foot.y == s.y0 ? s.y1 : s.y0);
    for (const double t : ticks(s.t0, s.t1, s.time_step)) {
        if (across) grid_pen.line(at(t), space.point(opposite.x, opposite.y, t), grid);
        const float pixels = list.projection.pixels_per_metre(at(t));
        if (pixels <= 0) continue;
        const float half = kTick * scale / pixels;
        axis_pen.line(at(t) - list.projection.right * half, at(t) + list.projection.right * half, axis);
    }
    if (across) {
        for (const double v : ticks(along_x ? s.x0 : s.y0, along_x ? s.x1 : s.y1, s.step)) {
            const glm::dvec2 p = along_x ? glm::dvec2(v, foot.y) : glm::dvec2(foot.x, v);
            grid_pen.line(space.point(p.x, p.y, s.t0), space.point(p.x, p.y, s.t1), grid);
        }
    }
    axis_pen.line(at(s.t0), at(s.t1), axis);
}

void add_time_cursor(DrawList& list, const FloorExtent& s, double time, float scale) {
    const DrawnSpace& space = list.space;
    const glm::vec3 corners[4] = {space.point(s.x0, s.y0, time), space.point(s.x1, s.y0, time),
                                  space.point(s.x1, s.y1, time), space.point(s.x0, s.y1, time)};
    const LineStyle style{.color = list.palette.accent, .width = 1.3f * scale, .hidden = 0.3f};
    Pen(list, {DrawLayer::time_cursor})
        .path(
            4, [&](int i) { return corners[i % 4]; }, style);
    list.boxes.push_back(annotation_sheet(0.5f * (corners[0] + corners[2]), 0.5f * (corners[1] - corners[0]),
                                          0.5f * (corners[3] - corners[0]), with_alpha(list.palette.accent, 0.035f),
                                          {DrawLayer::time_cursor}));
}

std::vector<LabelRequest> floor_and_axis_labels(const DrawList& list, const FloorExtent& s, bool floor, bool time_axis,
                                                float size) {
    std::vector<LabelRequest> out;
    const DrawnSpace& space = list.space;
    const ViewProjection& projection = list.projection;
    LabelRequest label;
    label.role = TextRole::tick;
    label.face = FontFace::mono;
    label.size = size;
    label.color = list.palette.quiet_text;
    if (time_axis && !time_on_end(projection)) {
        const glm::dvec2 foot = axis_corner(s, projection.right);
        const auto seen_at = [&](double t) { return projection.project(space.point(foot.x, foot.y, t)); };
        std::vector<double> times = ticks(s.t0, s.t1, s.time_step);
        std::erase_if(times, [&](double t) { return !seen_at(t); });
        const double shown =
            times.size() < 2
                ? s.time_step
                : label_step(times, s.time_step, glm::abs(*seen_at(times.back()) - *seen_at(times.front())), size);
        for (const double t : times) {
            if (std::abs(std::remainder(t, shown)) > 0.01 * s.time_step) continue;
            const auto anchor = seen_at(t);
            label.text = tick_text(t, shown) + " s";
            label.anchor = *anchor;
            label.directions = {{-1, 0}};
            label.distance = 0.7f * size;
            out.push_back(label);
        }
    }
    if (!floor) return out;
    struct Side {
        Edge edge;
        glm::vec2 direction;
        std::vector<double> values;  ///< that are seen
    };
    std::vector<Side> sides;
    double shown = s.step;
    for (const Edge& edge : edges(s)) {
        const glm::dvec2 middle = 0.5 * (edge.from + edge.to);
        const glm::vec3 here = space.point(middle.x, middle.y, s.t0);
        const glm::vec3 outward(static_cast<float>(edge.outward.x), static_cast<float>(edge.outward.y), 0);
        // Only edges that face the viewer, and that have some length in the picture. From above, those below and to the
        // left.
        const bool faces = time_on_end(projection) ? glm::dot(outward, projection.right + projection.up) < -0.3f
                                                   : glm::dot(outward, projection.back) > 0.05f;
        std::vector<double> values = edge.ticks_on(s);
        const auto seen_at = [&](double v) {
            return projection.project(space.point(edge.at(v).x, edge.at(v).y, s.t0));
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
        std::erase_if(values, [&](double v) { return std::abs(std::remainder(v, shown)) > 0.01 * s.step; });
        for (const double v : values) {
            // One label tells which way it is; the others are bare.
            const bool last = v == values.back();
            label.text =
                last ? std::string(edge.along_x() ? "x " : "y ") + tick_text(v, shown) + " m" : tick_text(v, shown);
            // Boxes may reach below a floor that is seen edge-on; its labels stand below them.
            const double height = floor_on_edge(projection) ? s.lowest : s.t0;
            const auto anchor = projection.project(space.point(edge.at(v).x, edge.at(v).y, height));
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

std::vector<LabelRequest> time_titles(const DrawList& list, const FloorExtent& s, float size) {
    constexpr int kTitlePlaces = 24;  // along the axis, and along a side
    const ViewProjection& projection = list.projection;
    const glm::dvec2 foot = axis_corner(s, projection.right);
    const glm::vec2 picture(projection.size.width, projection.size.height);
    const char* const words = !time_on_end(projection) ? "time, s"
                              : projection.back.z > 0  ? "time, s: towards you"
                                                       : "time, s: away from you";
    std::vector<LabelRequest> out;
    const auto add = [&](const std::string& text, glm::vec2 anchor, std::vector<glm::vec2> directions) {
        LabelRequest label;
        label.text = text;
        label.size = size;
        label.color = list.palette.text;
        label.anchor = anchor;
        label.directions = std::move(directions);
        label.distance = 0.6f * size;
        out.push_back(label);
    };
    for (int i = 0; i < kTitlePlaces; ++i) {
        const double t = s.t1 - (s.t1 - s.t0) * i / kTitlePlaces;
        const auto at = projection.project(list.space.point(foot.x, foot.y, t));
        if (!at || !Rect{glm::vec2(0), picture}.contains({*at, *at})) continue;
        // Beside the ticks, which stand to the left, once there is no room above.
        add(words, *at, {{0, -1}, {0.7f, -1}, {1, 0}, {-1, -1}});
    }
    const std::string away = time_on_end(projection) ? words : "time, s: upwards";
    for (const float x : {0.0f, picture.x}) {
        for (int i = 1; i < kTitlePlaces; ++i) {
            const float y = picture.y * (0.5f + 0.5f * static_cast<float>(i % 2 ? i : -i) / kTitlePlaces);
            add(away, {x, y}, {{x > 0 ? -1 : 1, 0}});
        }
    }
    return out;
}

FloorExtent floor_stage(glm::dvec2 area, double begin, double end) {
    const glm::dvec2 half = 0.5 * area;
    const FloorExtent grid = floor_extent_of({-half.x, -half.y, begin}, {half.x, half.y, end});
    // The floor ends at its walls, wherever the grid has a line.
    return {-half.x, half.x, -half.y, half.y, grid.step, grid.t0, grid.t1, grid.lowest, grid.time_step};
}

void add_walls(DrawList& list, glm::dvec2 area, double bottom, double top, float scale) {
    const glm::dvec2 half = 0.5 * area;
    const glm::dvec2 corners[4] = {{-half.x, -half.y}, {half.x, -half.y}, {half.x, half.y}, {-half.x, half.y}};
    const Rgba color = list.palette.axis;
    const auto order = [](int i) { return DrawOrder{DrawLayer::surroundings, 3, i}; };
    const auto add_line = [&](glm::vec3 from, glm::vec3 to, float width, int i) {
        const LineStyle style{.color = color, .width = width * scale, .cap = 0.4f * width * scale};
        list.lines.push_back({style, from, to, order(i)});
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
        list.boxes.push_back(annotation_sheet(0.25f * (a0 + b0 + a1 + b1), 0.5f * (b0 - a0), 0.5f * (a1 - a0),
                                              with_alpha(color, kGlass), order(i)));
    }
}

glm::vec2 map_size(const FloorExtent& s, float scale) {
    const double longest = std::max(s.x1 - s.x0, s.y1 - s.y0);
    return glm::ceil(glm::vec2(glm::dvec2(s.x1 - s.x0, s.y1 - s.y0) / longest) * kMapSide * scale);
}

void add_floor_map(DrawList& list, std::span<const DrawnAgent> agents, const FloorExtent& s, double time,
                   const Rect& within, float scale) {
    const glm::vec2 map = within.size();
    const auto at = [&](double x, double y) {
        const glm::dvec2 unit((x - s.x0) / (s.x1 - s.x0), (s.y1 - y) / (s.y1 - s.y0));
        return within.min + glm::vec2(unit) * map;
    };
    for (const double x : ticks(s.x0, s.x1, s.step)) {
        list.overlay_lines.push_back({at(x, s.y0), at(x, s.y1), list.palette.grid, 1, kSolid});
    }
    for (const double y : ticks(s.y0, s.y1, s.step)) {
        list.overlay_lines.push_back({at(s.x0, y), at(s.x1, y), list.palette.grid, 1, kSolid});
    }
    for (const DrawnAgent& agent : agents) {
        if (agent.hidden) continue;
        const mobb::PlacedClip& clip = agent.clip();
        glm::vec2 from = at(clip.disk(0).x, clip.disk(0).y);
        for (int i = 1; i < clip.count(); ++i) {
            const glm::vec2 to = at(clip.disk(i).x, clip.disk(i).y);
            if (i + 1 < clip.count() && std::hypot(to.x - from.x, to.y - from.y) < 1.5f) continue;
            list.overlay_lines.push_back({from, to, with_alpha(agent.color, 0.7f), scale, kSolid});
            from = to;
        }
    }
    const float pixels = map.x / static_cast<float>(s.x1 - s.x0);
    for (const DrawnAgent& agent : agents) {
        const std::optional<int> sample = sample_at(agent, time);
        if (!sample || agent.hidden) continue;
        for (const mobb::PlacedClip& path : agent.paths()) {
            const mobb::Disk disk = mobb::swept(path, *sample).at(time);
            const glm::vec2 middle = at(disk.x, disk.y);
            const float r = std::max(static_cast<float>(disk.r) * pixels, 2.5f * scale);
            list.marks.push_back(
                {{middle - r, middle + r}, r, with_alpha(agent.color, 0.9f), list.palette.text, scale});
        }
    }
}

}  // namespace mobbscope
