#include <base/text.h>
#include <render/drawlist/picture_options.h>
#include <render/pictures/graph_moves.h>
#include <render/pictures/graph_picture.h>
#include <render/text/labels.h>
#include <scene/motion_graph.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

namespace mobbscope {

namespace {

constexpr int kColorSteps = 48;    // of the bar of speeds
constexpr float kBarLength = 132;  // pixels at scale 1: the length of the bars

std::string bound_text(const char* what, double bound, const char* unit) {
    return std::isfinite(bound) ? std::string(what) + " up to " + brief(bound) + ' ' + unit
                                : std::string("any ") + what;
}

std::string duration_text(double seconds) {
    if (seconds < 100) return brief(std::round(seconds * 10) / 10) + " s";
    return brief(std::round(seconds / 6) / 10) + " min";
}

/// The sentence at the top and what stands below it.
std::pair<std::string, std::string> titles(const MotionGraph& graph, const std::vector<FloorPath>& paths) {
    double seconds = 0;
    for (const FloorPath& path : paths) seconds += path.seconds;
    return {"Motion graph: " + counted(graph.hubs.size(), "hub", "hubs") + ", " +
                counted(paths.size(), "move", "moves") + ", " + duration_text(seconds) + " of motion",
            "where moves join: " + bound_text("pose distance", graph.bounds.pose_distance, "m") + ", " +
                bound_text("change of velocity", graph.bounds.root_speed, "m/s")};
}

class GraphLegend {
  public:
    /// In so many pixels' width: its parts are beside each other if they have room, else one below the other.
    GraphLegend(const GraphCanvas& canvas, float width) : canvas_(canvas), in_a_row_(width >= 3 * part().x) {}

    float height() const { return (in_a_row_ ? 1.0F : 3.0F) * part().y; }

    /// With its upper left corner at a point.
    void add(glm::vec2 corner, const ArrowScale& arrows, const FanScale& fans) {
        const glm::vec2 next = in_a_row_ ? glm::vec2(part().x, 0) : glm::vec2(0, part().y);
        add_speeds(corner);
        add_widths(corner + next, arrows);
        add_metres(corner + 2.0F * next, fans);
    }

  private:
    glm::vec2 part() const {
        const float scale = canvas_.metrics.scale;
        return {(kBarLength + 26) * scale, 2 * line() + 24 * scale};
    }
    float line() const { return line_height(FontFace::text, canvas_.metrics.small); }
    float bar() const { return kBarLength * canvas_.metrics.scale; }

    void write(const std::string& text, glm::vec2 corner, float share, Rgba color) {
        const float width = Font::of(FontFace::text).width(text, canvas_.metrics.small);
        canvas_.write(TextRole::legend, text, canvas_.metrics.small, color,
                      {std::round(corner.x - share * width), corner.y});
    }

    void add_speeds(glm::vec2 corner) {
        write("mean speed, m/s", corner, 0, canvas_.palette().quiet_text);
        const glm::vec2 at = corner + glm::vec2(0, line() + 4 * canvas_.metrics.scale);
        const float height = 9 * canvas_.metrics.scale;
        for (int i = 0; i < kColorSteps; ++i) {
            const float a = bar() * static_cast<float>(i) / kColorSteps;
            const float b = bar() * static_cast<float>(i + 1) / kColorSteps;
            const double speed = canvas_.fastest * (i + 0.5) / kColorSteps;
            const glm::vec2 middle = at + glm::vec2(0, 0.5F * height);
            canvas_.line(middle + glm::vec2(a, 0), middle + glm::vec2(b, 0), canvas_.color_of(speed), height);
        }
        const double step = nice_step(canvas_.fastest, 2);
        for (const double speed : ticks(0, canvas_.fastest, step)) {
            const auto share = static_cast<float>(speed / canvas_.fastest);
            write(tick_text(speed, step), at + glm::vec2(share * bar(), height + 2 * canvas_.metrics.scale), share,
                  canvas_.palette().text);
        }
    }

    void add_widths(glm::vec2 corner, const ArrowScale& scale_of) {
        write("moves from hub to hub", corner, 0, canvas_.palette().quiet_text);
        const auto middle_count = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(scale_of.most))));
        const std::set<std::size_t> counts{1, middle_count, scale_of.most};
        const float scale = canvas_.metrics.scale;
        const float pitch = bar() / static_cast<float>(counts.size());
        glm::vec2 at = corner + glm::vec2(0, line() + 4 * scale);
        for (const std::size_t count : counts) {
            const glm::vec2 middle = at + glm::vec2(0, 4.5F * scale);
            canvas_.line(middle, middle + glm::vec2(pitch - 12 * scale, 0), canvas_.palette().text,
                         scale_of.width(count));
            write(std::to_string(count), at + glm::vec2(0.5F * (pitch - 12 * scale), 11 * scale), 0.5F,
                  canvas_.palette().text);
            at.x += pitch;
        }
    }

    void add_metres(glm::vec2 corner, const FanScale& fans) {
        write("floor paths, hub facing up", corner, 0, canvas_.palette().quiet_text);
        const float scale = canvas_.metrics.scale;
        const auto length = static_cast<float>(fans.ring_step * fans.pixels_per_metre);
        const glm::vec2 left = corner + glm::vec2(0, line() + 8.5F * scale);
        const glm::vec2 tick(0, 4 * scale);
        const Rgba color = canvas_.palette().text;
        canvas_.line(left, left + glm::vec2(length, 0), color, 1.5F * scale);
        for (const float x : {0.0F, length}) {
            const glm::vec2 end = left + glm::vec2(x, 0);
            canvas_.line(end - tick, end + tick, color, 1.5F * scale);
        }
        write(tick_text(fans.ring_step, fans.ring_step) + " m, as from ring to ring", left + glm::vec2(0, 6.5F * scale),
              0, color);
    }

    const GraphCanvas& canvas_;
    bool in_a_row_;
};

}  // namespace

std::vector<FloorPath> floor_paths_of(const Scene& scene) {
    std::vector<FloorPath> out;
    for (const GraphMove& move : scene.graph->moves) {
        const mobb::Clip& clip = *scene.clips[static_cast<std::size_t>(move.clip)].clip;
        FloorPath path{move.from, move.to, clip.until_next(), 0, {}};
        const mobb::Rotation turn = mobb::Rotation::from_degrees(-move.entry.heading_deg);
        const auto add = [&](glm::dvec2 p) {
            const glm::dvec2 ahead = turn(p - move.entry.position);
            const glm::dvec2 point(ahead.y, ahead.x);
            if (!path.points.empty()) path.length += glm::length(point - path.points.back());
            path.points.push_back(point);
        };
        for (const mobb::Disk& disk : clip.samples()) add({disk.x, disk.y});
        add(move.exit.position);
        out.push_back(std::move(path));
    }
    return out;
}

DrawList graph_picture(const Scene& scene, PictureSize size, Theme theme, double scale) {
    check(size);
    if (!scene.graph || scene.graph->moves.empty()) throw std::invalid_argument("the scene has no graph with moves");
    const MotionGraph& graph = *scene.graph;
    const std::vector<FloorPath> paths = floor_paths_of(scene);
    DrawList list;
    list.size = size;
    list.palette = palette(theme);
    GraphCanvas canvas{list, metrics_of(size, scale), 0};
    for (const FloorPath& path : paths) canvas.fastest = std::max(canvas.fastest, path.speed());
    if (!(canvas.fastest > 1e-9)) canvas.fastest = 1;

    const Metrics& m = canvas.metrics;
    const auto [headline, below] = titles(graph, paths);
    list.headline = headline;
    glm::vec2 at(1.4F * m.pad, 1.2F * m.pad);
    const auto width = static_cast<float>(size.width);
    const auto height = static_cast<float>(size.height);
    const float headline_size = std::round(1.4F * m.text);
    const float room = width - 2.8F * m.pad;
    canvas.write(TextRole::caption, fit_text(headline, FontFace::text, headline_size, room), headline_size,
                 list.palette.text, at);
    at.y += 1.15F * line_height(FontFace::text, headline_size);
    canvas.write(TextRole::caption, fit_text(below, FontFace::text, m.text, room), m.text, list.palette.quiet_text, at);
    at.y += line_height(FontFace::text, m.text) + m.pad;

    GraphLegend legend(canvas, room);
    const float bottom = height - m.pad;
    const glm::vec2 legend_corner(at.x, bottom - legend.height());
    // Beside each other, or in a high picture one above the other; one hub needs little room for its arrow.
    const float share = graph.hubs.size() == 1 ? 0.26F : 0.48F;
    Rect arrows{at, {width - at.x, legend_corner.y - m.pad}};
    Rect fans = arrows;
    if (width >= height) {
        arrows.max.x = arrows.min.x + share * arrows.size().x;
        fans.min.x = arrows.max.x + m.pad;
    } else {
        arrows.max.y = arrows.min.y + share * arrows.size().y;
        fans.min.y = arrows.max.y + m.pad;
    }
    for (Rect* area : {&arrows, &fans}) area->max = glm::max(area->max, area->min + 1.0F);
    const ArrowScale arrow_scale = add_graph_arrows(canvas, graph, paths, arrows);
    legend.add(legend_corner, arrow_scale, add_graph_fans(canvas, graph, paths, fans));
    return list;
}

}  // namespace mobbscope
