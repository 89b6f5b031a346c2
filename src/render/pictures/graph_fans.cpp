#include <base/text.h>
#include <render/drawlist/pen.h>
#include <render/pictures/graph_moves.h>
#include <render/text/labels.h>
#include <scene/motion_graph.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace mobbscope {

namespace {

constexpr float kLeastCard = 76;    // pixels at scale 1
constexpr float kCardGap = 8;       // between cards
constexpr double kLeastExtent = 1;  // metres: a fan of steps on the spot is drawn no larger
constexpr int kRingPoints = 72;

/// The moves that begin in a hub.
struct Fan {
    int hub = 0;
    std::vector<const FloorPath*> paths;
    glm::dvec2 least{0};  ///< of all points, metres
    glm::dvec2 most{0};

    glm::dvec2 extent() const { return glm::max(most - least, glm::dvec2(kLeastExtent)); }
};

std::vector<Fan> fans_of(const MotionGraph& graph, const std::vector<FloorPath>& paths) {
    std::vector<Fan> fans(graph.hubs.size());
    for (std::size_t h = 0; h < fans.size(); ++h) fans[h].hub = static_cast<int>(h);
    for (const FloorPath& path : paths) {
        Fan& fan = fans[static_cast<std::size_t>(path.from)];
        fan.paths.push_back(&path);
        for (const glm::dvec2 p : path.points) {
            fan.least = glm::min(fan.least, p);
            fan.most = glm::max(fan.most, p);
        }
    }
    std::erase_if(fans, [](const Fan& fan) { return fan.paths.empty(); });
    return fans;
}

/// How many columns of cards there are, and how large they are.
struct Grid {
    std::size_t columns = 1;
    glm::vec2 cell{0};
};

Grid grid_for(std::size_t cards, glm::vec2 room) {
    Grid best;
    for (std::size_t columns = 1; columns <= cards; ++columns) {
        const std::size_t rows = (cards + columns - 1) / columns;
        const glm::vec2 cell = room / glm::vec2(static_cast<float>(columns), static_cast<float>(rows));
        if (std::min(cell.x, cell.y) > std::min(best.cell.x, best.cell.y)) best = {columns, cell};
    }
    return best;
}

class FanPicture {
  public:
    FanPicture(const GraphCanvas& canvas, const MotionGraph& graph) : canvas_(canvas), graph_(graph) {}

    /// Pixels around the paths in a card: left, above, right and below.
    float title() const { return line_height(FontFace::text, canvas_.metrics.small) + 8 * canvas_.metrics.scale; }
    float margin() const { return 9 * canvas_.metrics.scale; }

    Rect room_in(const Rect& card) const {
        const glm::vec2 corner(card.min.x + margin(), card.min.y + title());
        return {corner, glm::max(card.max - margin(), corner + 1.0F)};
    }

    void add_card(const Fan& fan, const Rect& card, double pixels_per_metre, double ring_step) {
        const float scale = canvas_.metrics.scale;
        canvas_.list.panels.push_back({card, 5 * scale, canvas_.palette().panel, canvas_.palette().panel_border, 1});
        add_title(fan, card);
        const Rect room = room_in(card);
        const glm::dvec2 center = 0.5 * (fan.least + fan.most);
        const auto at = [&](glm::dvec2 p) {
            // The hub's heading goes up, its left to the left.
            const glm::dvec2 away = (p - center) * pixels_per_metre;
            return room.center() + glm::vec2(-away.x, -away.y);
        };
        add_rings(at({0, 0}), ring_step * pixels_per_metre, room.grown(0.5F * margin()));
        for (const FloorPath* path : fan.paths) add_path(*path, at);
        const float r = 2.6F * scale;
        const glm::vec2 hub = at({0, 0});
        canvas_.dot(hub, r, canvas_.palette().text);
    }

  private:
    void add_title(const Fan& fan, const Rect& card) {
        const float scale = canvas_.metrics.scale;
        const float size = canvas_.metrics.small;
        const glm::vec2 corner = card.min + glm::vec2(7, 4) * scale;
        const float room = card.size().x - 14 * scale;
        const std::string name =
            fit_text(graph_.hubs[static_cast<std::size_t>(fan.hub)].name, FontFace::text, size, room);
        canvas_.write(TextRole::name, name, size, canvas_.palette().text, corner);
        const float used = Font::of(FontFace::text).width(name, size) + 7 * scale;
        const std::string count = counted(fan.paths.size(), "move", "moves");
        if (Font::of(FontFace::text).width(count, size) > room - used) return;
        canvas_.write(TextRole::note, count, size, canvas_.palette().quiet_text, corner + glm::vec2(used, 0));
    }

    void add_rings(glm::vec2 center, double step, const Rect& room) {
        const auto inside = [&](glm::vec2 p) {
            return p.x > room.min.x && p.x < room.max.x && p.y > room.min.y && p.y < room.max.y;
        };
        const double reach = glm::length(glm::dvec2(room.size()));
        for (int ring = 1; ring * step < reach; ++ring) {
            const double r = ring * step;
            glm::vec2 from = center + glm::vec2(static_cast<float>(r), 0);
            for (int i = 1; i <= kRingPoints; ++i) {
                const glm::vec2 to = center + glm::vec2(r * on_circle<double>(i, kRingPoints));
                if (inside(from) && inside(to)) {
                    canvas_.line(from, to, canvas_.palette().grid, canvas_.metrics.scale);
                }
                from = to;
            }
        }
    }

    template <class At>
    void add_path(const FloorPath& path, const At& at) {
        const float scale = canvas_.metrics.scale;
        const Rgba color = canvas_.color_of(path.speed());
        glm::vec2 from = at(path.points.front());
        for (std::size_t i = 1; i < path.points.size(); ++i) {
            const glm::vec2 to = at(path.points[i]);
            if (i + 1 < path.points.size() && glm::distance(from, to) < 1.5F) continue;
            canvas_.line(from, to, with_alpha(color, 0.8F), 1.2F * scale);
            from = to;
        }
        const float r = 1.9F * scale;
        canvas_.dot(from, r, color);
    }

    const GraphCanvas& canvas_;
    const MotionGraph& graph_;
};

}  // namespace

FanScale add_graph_fans(const GraphCanvas& canvas, const MotionGraph& graph, const std::vector<FloorPath>& paths,
                        const Rect& area) {
    const float scale = canvas.metrics.scale;
    std::vector<Fan> fans = fans_of(graph, paths);
    const std::size_t all = fans.size();
    std::stable_sort(fans.begin(), fans.end(),
                     [](const Fan& a, const Fan& b) { return a.paths.size() > b.paths.size(); });
    Grid grid = grid_for(fans.size(), area.size());
    float below = 0;
    const float line = line_height(FontFace::text, canvas.metrics.small);
    while (fans.size() > 1 && std::min(grid.cell.x, grid.cell.y) < kLeastCard * scale) {
        fans.pop_back();
        below = 1.4F * line;
        grid = grid_for(fans.size(), area.size() - glm::vec2(0, below));
    }
    std::sort(fans.begin(), fans.end(), [](const Fan& a, const Fan& b) { return a.hub < b.hub; });
    if (fans.size() < all) {
        const std::string text = "of " + std::to_string(all) + " hubs those with the most moves";
        canvas.write(TextRole::note, text, canvas.metrics.small, canvas.palette().quiet_text,
                     {area.min.x, area.max.y - line});
    }

    FanPicture picture(canvas, graph);
    const glm::vec2 card = grid.cell - kCardGap * scale;
    const Rect room = picture.room_in({{0, 0}, card});
    double pixels = std::numeric_limits<double>::infinity();
    for (const Fan& fan : fans) {
        pixels = std::min({pixels, room.size().x / fan.extent().x, room.size().y / fan.extent().y});
    }
    const double ring_step = nice_step(std::min(room.size().x, room.size().y) / pixels, 3);
    for (std::size_t i = 0; i < fans.size(); ++i) {
        const std::size_t row = i / grid.columns;
        const glm::vec2 cell(static_cast<float>(i % grid.columns), static_cast<float>(row));
        const glm::vec2 corner = glm::round(area.min + cell * grid.cell + glm::vec2(kCardGap * scale, 0));
        picture.add_card(fans[i], {corner, corner + card}, pixels, ring_step);
    }
    return {pixels, ring_step};
}

}  // namespace mobbscope
