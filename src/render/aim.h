/// Where the scene goes in the picture once it is known what must be seen and what is written around it.
#pragma once

#include <render/block_layout.h>
#include <render/draw_list.h>
#include <render/metrics.h>
#include <render/surroundings.h>

#include <functional>
#include <span>
#include <vector>

namespace mobbscope {

/// Sets the list's lens and frame, so that all `points` (drawn space) fit into what caption, labels and blocks leave;
/// returns the places of legend and map. `top`: where the caption ends, pixels. `map`: its size, 0 for none. `busy`:
/// what blocks had better not cover, asked for once a lens is set.
Blocks aim(DrawList& list, std::span<const glm::vec3> points, const Stage& stage, const ViewState& view,
           const Metrics& metrics, float top, glm::vec2 map, const std::function<std::vector<Rect>()>& busy);

}  // namespace mobbscope
