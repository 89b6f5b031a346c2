/// What the picture of a motion graph knows of its moves.
#pragma once

#include <render/drawlist/draw_list.h>
#include <render/drawlist/picture_options.h>
#include <render/text/labels.h>
#include <scene/motion_graph.h>
#include <scene/scene.h>

#include <cstddef>
#include <string>
#include <vector>

namespace mobbscope {

/// A move on the floor: metres, from its entry; x to the left of the hub's heading, y along it.
struct FloorPath {
    int from = 0;  ///< hubs
    int to = 0;
    double seconds = 0;
    double length = 0;  ///< metres
    std::vector<glm::dvec2> points;

    double speed() const { return length / seconds; }
};

std::vector<FloorPath> floor_paths_of(const Scene& scene);

/// What the parts of the picture are drawn on and with; colours of speeds go from 0 to `fastest` m/s.
struct GraphCanvas {
    DrawList& list;
    Metrics metrics;
    double fastest = 1;

    const Palette& palette() const { return list.palette; }
    Rgba color_of(double speed) const { return quantity_color(static_cast<float>(speed / fastest), palette()); }

    void line(glm::vec2 from, glm::vec2 to, Rgba color, float width) const {
        list.overlay_lines.push_back({from, to, color, width, kSolid});
    }
    void dot(glm::vec2 middle, float radius, Rgba fill, Rgba border = Rgba(0), float border_width = 0) const {
        list.marks.push_back({{middle - radius, middle + radius}, radius, fill, border, border_width});
    }
    /// A line of text with its upper left corner at a point.
    void write(TextRole role, const std::string& text, float size, Rgba color, glm::vec2 corner) const {
        list.texts.push_back(text_at(role, text, FontFace::text, size, color, corner));
    }
};

/// What the widths of arrows say.
struct ArrowScale {
    std::size_t most = 1;  ///< moves that one arrow stands for
    float unit = 1;        ///< pixels

    /// Of an arrow that stands for so many moves.
    float width(std::size_t count) const;
};

/// Adds hubs and arrows within the area.
ArrowScale add_graph_arrows(const GraphCanvas& canvas, const MotionGraph& graph, const std::vector<FloorPath>& paths,
                            const Rect& area);

/// The one scale of all floor paths.
struct FanScale {
    double pixels_per_metre = 1;
    double ring_step = 1;  ///< metres from ring to ring
};

/// Adds a card with the floor paths of each hub in which moves begin, within the area; of many hubs those with the most
/// moves.
FanScale add_graph_fans(const GraphCanvas& canvas, const MotionGraph& graph, const std::vector<FloorPath>& paths,
                        const Rect& area);

}  // namespace mobbscope
