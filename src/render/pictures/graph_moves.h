/// What the picture of a motion graph knows of its moves.
#pragma once

#include <render/drawlist/draw_list.h>
#include <render/drawlist/picture_options.h>
#include <scene/motion_graph.h>
#include <scene/scene.h>

#include <cstddef>
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

/// What is drawn with: palette and sizes, and colours of speeds from 0 to `fastest` m/s.
struct GraphStyle {
    const Palette& palette;
    Metrics metrics;
    double fastest = 1;

    Rgba color_of(double speed) const { return quantity_color(static_cast<float>(speed / fastest), palette); }
};

/// What the widths of arrows say.
struct ArrowScale {
    std::size_t most = 1;  ///< moves that one arrow stands for
    float unit = 1;        ///< pixels

    /// Of an arrow that stands for so many moves.
    float width(std::size_t count) const;
};

/// Adds hubs and arrows within the area.
ArrowScale add_graph_arrows(DrawList& list, const MotionGraph& graph, const std::vector<FloorPath>& paths,
                            const GraphStyle& style, const Rect& area);

/// The one scale of all floor paths.
struct FanScale {
    double pixels_per_metre = 1;
    double ring_step = 1;  ///< metres from ring to ring
};

/// Adds a card with the floor paths of each hub in which moves begin, within the area; of many hubs those with the most
/// moves.
FanScale add_graph_fans(DrawList& list, const MotionGraph& graph, const std::vector<FloorPath>& paths,
                        const GraphStyle& style, const Rect& area);

}  // namespace mobbscope
