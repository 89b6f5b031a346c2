/// Where the scene goes in the picture once it is known what must be seen and what is written around it.
#pragma once

#include <render/drawlist/draw_list.h>
#include <render/drawlist/metrics.h>
#include <render/layout/block_layout.h>
#include <render/parts/floor_and_axes.h>

#include <functional>
#include <span>
#include <vector>

namespace mobbscope {

/// Sets the list's projection and frame, so that all `points` (drawn space) fit into what caption, labels and blocks
/// leave; returns the places of legend and map. `top`: where the caption ends, pixels. `map`: its size, 0 for none.
/// `busy`: what blocks had better not cover, asked for once a projection is set.
Blocks aim(DrawList& list, std::span<const glm::vec3> points, const FloorExtent& floor_extent, const ViewState& view,
           const Metrics& metrics, float top, glm::vec2 map, const std::function<std::vector<Rect>()>& busy);

}  // namespace mobbscope
