#include <render/pictures/graph_moves.h>
#include <render/text/labels.h>
#include <scene/motion_graph.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

namespace mobbscope {

namespace {

// Lengths in pitches: the distance from a hub to its neighbour on their circle.
constexpr double kNode = 0.17;         // a hub's radius
constexpr double kLoop = 0.17;         // radius of the arrow from a hub to itself
constexpr double kCircleMargin = 0.6;  // from a circle of hubs to the edge of its square: a hub and its loop
constexpr float kMostPitch = 210;      // pixels at scale 1
constexpr float kRoomyPitch = 130;     // pixels at scale 1
constexpr float kBend = 0.17F;         // of an arrow's length, sideways
constexpr int kPoints = 40;            // of a curve

/// All moves from one hub to another.
struct Arrow {
    int from = 0;
    int to = 0;
    std::size_t count = 0;
    double seconds = 0;
    double length = 0;
};

std::vector<Arrow> arrows_of(const std::vector<FloorPath>& paths) {
    std::map<std::pair<int, int>, Arrow> by_hubs;
    for (const FloorPath& path : paths) {
        Arrow& arrow = by_hubs[{path.from, path.to}];
        arrow.from = path.from;
        arrow.to = path.to;
        arrow.count += 1;
        arrow.seconds += path.seconds;
        arrow.length += path.length;
    }
    std::vector<Arrow> out;
    for (const auto& [unused, arrow] : by_hubs) out.push_back(arrow);
    // Thin ones over broad ones.
    std::stable_sort(out.begin(), out.end(), [](const Arrow& a, const Arrow& b) { return a.count > b.count; });
    return out;
}

/// Hubs that lead to each other stand on a circle.
struct Ring {
    std::vector<int> hubs;
    glm::dvec2 center{0};  ///< pitches

    double radius() const {
        const auto n = static_cast<double>(hubs.size());
        return n < 2 ? 0 : 0.5 / std::sin(std::numbers::pi / n);
    }
    double side() const { return 2 * (radius() + kCircleMargin); }
};

std::vector<Ring> rings_of(const MotionGraph& graph) {
    const std::vector<int> component = hub_components(graph);
    std::vector<Ring> rings;
    for (std::size_t h = 0; h < component.size(); ++h) {
        rings.resize(std::max(rings.size(), static_cast<std::size_t>(component[h]) + 1));
        rings[static_cast<std::size_t>(component[h])].hubs.push_back(static_cast<int>(h));
    }
    std::stable_sort(rings.begin(), rings.end(),
                     [](const Ring& a, const Ring& b) { return a.hubs.size() > b.hubs.size(); });
    return rings;
}

/// Puts the rings in rows of at most `width`, from the origin down, each row in the middle; gives the height. Pitches.
double put_in_rows(std::vector<Ring>& rings, double width) {
    double top = 0;
    for (std::size_t begin = 0; begin < rings.size();) {
        std::size_t end = begin;
        double used = 0;
        while (end < rings.size() && (end == begin || used + rings[end].side() <= width)) used += rings[end++].side();
        const double height = rings[begin].side();  // the largest: they are sorted
        double x = 0.5 * (width - used);
        for (std::size_t i = begin; i < end; ++i) {
            rings[i].center = {x + 0.5 * rings[i].side(), top + 0.5 * height};
            x += rings[i].side();
        }
        top += height;
        begin = end;
    }
    return top;
}

/// The largest pitch in pixels at which the rings fit the area, which they are then put in.
float fit_rings(std::vector<Ring>& rings, const Rect& area, float most) {
    const double widest = rings.front().side();
    float pitch = most;
    while (pitch > 4) {
        const double width = area.size().x / pitch;
        if (width >= widest && put_in_rows(rings, width) * pitch <= area.size().y) break;
        pitch *= 0.97F;
    }
    return pitch;
}

class ArrowPicture {
  public:
    ArrowPicture(const GraphCanvas& canvas, const MotionGraph& graph, const Rect& area)
        : canvas_(canvas), graph_(graph), places_(graph.hubs.size()), outward_(graph.hubs.size()) {
        std::vector<Ring> rings = rings_of(graph);
        pitch_ = fit_rings(rings, area, kMostPitch * canvas.metrics.scale);
        const double height = put_in_rows(rings, area.size().x / pitch_);
        const glm::vec2 corner(area.min.x, area.min.y + 0.5F * (area.size().y - static_cast<float>(height) * pitch_));
        for (const Ring& ring : rings) {
            for (std::size_t i = 0; i < ring.hubs.size(); ++i) {
                // The first at the top, then clockwise.
                const double turn =
                    2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(ring.hubs.size());
                const glm::dvec2 out(std::sin(turn), -std::cos(turn));
                const auto hub = static_cast<std::size_t>(ring.hubs[i]);
                outward_[hub] = glm::vec2(out);
                places_[hub] = corner + pitch_ * glm::vec2(ring.center + ring.radius() * out);
            }
        }
    }

    /// Of line widths, pixels: crowded arrows are thinner.
    float unit() const {
        return canvas_.metrics.scale * std::clamp(pitch_ / (kRoomyPitch * canvas_.metrics.scale), 0.4F, 1.0F);
    }

    void add_arrow(const Arrow& arrow, const ArrowScale& scale) {
        const auto from = static_cast<std::size_t>(arrow.from);
        const auto to = static_cast<std::size_t>(arrow.to);
        const float width = scale.width(arrow.count);
        const Rgba color = canvas_.color_of(arrow.length / arrow.seconds);
        add_curve(from == to ? loop(from) : bow(places_[from], places_[to]), places_[from], places_[to], width, color);
    }

    void add_hubs() {
        const float r = node();
        for (std::size_t h = 0; h < places_.size(); ++h) {
            canvas_.dot(places_[h], r, mix_colors(canvas_.palette().background, canvas_.palette().panel_border, 0.6F),
                        canvas_.palette().text, 1.3F * canvas_.metrics.scale);
            const float size = std::round(std::min(1.1F * r, 1.4F * canvas_.metrics.text));
            const std::string name = fit_text(graph_.hubs[h].name, FontFace::text, size, 1.7F * r);
            const glm::vec2 extent(Font::of(FontFace::text).width(name, size), line_height(FontFace::text, size));
            canvas_.write(TextRole::name, name, size, canvas_.palette().text, glm::round(places_[h] - 0.5F * extent));
        }
    }

  private:
    using Curve = std::vector<glm::vec2>;

    float node() const { return std::max(static_cast<float>(kNode) * pitch_, 5 * canvas_.metrics.scale); }

    /// Bends to its left, so that the way there and the way back are two.
    static Curve bow(glm::vec2 from, glm::vec2 to) {
        const glm::vec2 way = to - from;
        const glm::vec2 middle = 0.5F * (from + to) + 2 * kBend * glm::vec2(way.y, -way.x);
        Curve out;
        for (int i = 0; i <= kPoints; ++i) {
            const float t = static_cast<float>(i) / kPoints;
            out.push_back((1 - t) * (1 - t) * from + 2 * t * (1 - t) * middle + t * t * to);
        }
        return out;
    }

    Curve loop(std::size_t hub) const {
        const float r = static_cast<float>(kLoop) * pitch_;
        const glm::vec2 center = places_[hub] + outward_[hub] * (node() + 0.55F * r);
        Curve out;
        for (int i = 0; i <= kPoints; ++i) {
            const float turn = 2 * std::numbers::pi_v<float> * (static_cast<float>(i) / kPoints);
            const glm::vec2 back = -outward_[hub];
            out.push_back(center + r * glm::vec2(std::cos(turn) * back.x - std::sin(turn) * back.y,
                                                 std::sin(turn) * back.x + std::cos(turn) * back.y));
        }
        return out;
    }

    /// The part of the curve between the hubs, its end an arrowhead.
    void add_curve(const Curve& curve, glm::vec2 from, glm::vec2 to, float width, Rgba color) {
        const float clear = node() + 2 * unit();
        const float head = 1.8F * width + 6 * unit();
        std::size_t begin = 0;
        while (begin + 2 < curve.size() && glm::distance(curve[begin], from) < clear) ++begin;
        std::size_t end = curve.size() - 1;
        while (end > begin + 1 && glm::distance(curve[end], to) < clear) --end;
        std::size_t neck = end;
        while (neck > begin + 1 && glm::distance(curve[neck], curve[end]) < head) --neck;
        for (std::size_t i = begin; i < neck; ++i) {
            // A little longer than the way, so that no notch is left at the bends.
            const glm::vec2 more = (0.5F + 0.1F * width) * glm::normalize(curve[i + 1] - curve[i]);
            canvas_.line(curve[i] - more, curve[i + 1] + more, color, width);
        }
        // A triangle of strips, each less wide than the one before.
        const glm::vec2 base = curve[neck];
        const glm::vec2 tip = curve[end];
        const int strips = std::max(static_cast<int>(glm::distance(base, tip)), 2);
        const float broad = width + 7 * unit();
        for (int i = 0; i < strips; ++i) {
            const float a = static_cast<float>(i) / static_cast<float>(strips);
            const float b = static_cast<float>(i + 1) / static_cast<float>(strips);
            canvas_.line(glm::mix(base, tip, a), glm::mix(base, tip, b), color, std::max(broad * (1 - a), 1.0F));
        }
    }

    const GraphCanvas& canvas_;
    const MotionGraph& graph_;
    float pitch_ = 0;
    std::vector<glm::vec2> places_;   ///< of the hubs, pixels
    std::vector<glm::vec2> outward_;  ///< away from the hubs that it shares a circle with
};

}  // namespace

float ArrowScale::width(std::size_t count) const {
    return unit * (1 + 5 * std::sqrt(static_cast<float>(count) / static_cast<float>(most)));
}

ArrowScale add_graph_arrows(const GraphCanvas& canvas, const MotionGraph& graph, const std::vector<FloorPath>& paths,
                            const Rect& area) {
    const std::vector<Arrow> arrows = arrows_of(paths);
    ArrowPicture picture(canvas, graph, area);
    // They are sorted: the first stands for the most moves.
    const ArrowScale scale{arrows.front().count, picture.unit()};
    for (const Arrow& arrow : arrows) picture.add_arrow(arrow, scale);
    picture.add_hubs();
    return scale;
}

}  // namespace mobbscope
