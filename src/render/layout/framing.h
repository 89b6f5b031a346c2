/// Where the scene goes in the picture: how time becomes height, and what the projection must show.
#pragma once

#include <render/drawlist/draw_list.h>
#include <render/drawlist/picture_options.h>
#include <render/drawlist/shown_points.h>
#include <render/layout/block_layout.h>
#include <render/parts/floor_and_axes.h>
#include <render/query/query_boxes.h>
#include <scene/drawn_agent.h>

#include <functional>
#include <limits>
#include <span>
#include <vector>

namespace mobbscope {

/// In (x, y, t).
struct Bounds {
    glm::dvec3 min{std::numeric_limits<double>::max()};
    glm::dvec3 max{std::numeric_limits<double>::lowest()};
    void add(glm::dvec3 p);
    glm::dvec3 middle() const { return 0.5 * (min + max); }
};

/// Adds the disks of some of a clip's samples.
void add_samples(Bounds& bounds, const mobb::PlacedClip& clip, mobb::SampleRange range);

/// Of the paths' disks.
Bounds bounds_of(std::span<const DrawnAgent> agents);

/// `bounds` with the boxes that are shown.
Bounds with_boxes(Bounds bounds, const DrawList& list);

/// About as tall as wide, unless the view says how tall.
DrawnSpace space_for(const Bounds& bounds, const ViewState& view);

/// Adds floor and axis to what must be inside the picture.
void add_floor_points(ShownPoints& points, const DrawnSpace& space, const FloorExtent& floor_extent,
                      const ViewState& view, bool has_cursor);

/// The picture without its margin, what is above `top`, and room for the labels along the scene's outline.
Frame free_frame(PictureSize size, float top, const FloorExtent& floor_extent, const ViewState& view,
                 const Metrics& metrics);

/// A projection that shows the points in a frame, or what the view's camera aims at.
ViewProjection projection_for(const DrawList& list, const ViewState& view, const ShownPoints& points,
                              const Frame& frame);

/// Sets the list's projection and frame, so that all `points` (drawn space) fit into what caption, labels and blocks
/// leave; returns the places of legend and map. `top`: where the caption ends, pixels. `map`: its size, 0 for none.
/// `busy`: what blocks had better not cover, asked for once a projection is set.
Blocks aim(DrawList& list, const ShownPoints& points, const FloorExtent& floor_extent, const ViewState& view,
           const Metrics& metrics, float top, glm::vec2 map, const std::function<std::vector<Rect>()>& busy);

}  // namespace mobbscope
