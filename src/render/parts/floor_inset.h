/// A small map: where everybody is on the floor at one time.
#pragma once

#include <render/drawlist/draw_list.h>
#include <render/parts/floor_and_axes.h>
#include <scene/drawn_agent.h>

#include <span>

namespace mobbscope {

/// The map's size in pixels.
glm::vec2 inset_size(const FloorExtent& floor_extent, float scale);

/// Adds the map with its upper left corner at a point.
void add_floor_inset(DrawList& list, std::span<const DrawnAgent> agents, const FloorExtent& floor_extent, double time,
                     glm::vec2 corner, float scale);

}  // namespace mobbscope
