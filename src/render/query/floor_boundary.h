/// The line on the floor within which B's path may not begin, or the two of a query collide.
#pragma once

#include <explain/placement_map.h>
#include <render/drawlist/draw_list.h>
#include <scene/drawn_agent.h>

#include <glm/vec2.hpp>

#include <span>
#include <utility>
#include <vector>

namespace mobbscope {

/// Pieces of a line on the floor, world metres.
using FloorLines = std::vector<std::pair<glm::dvec2, glm::dvec2>>;

/// Of B as it is turned and timed, wherever it stands.
FloorLines floor_boundary(const FittedScene& fitted, const SceneQuery& query);

/// How it looks, in the scene and in the legend.
LineStyle boundary_style(const Palette& palette, float scale);

/// With a ring where B's path begins. `height`: of the floor in drawn space.
void add_floor_boundary(DrawList& list, const FloorLines& lines, const DrawnAgent& b, float height, float scale);

}  // namespace mobbscope
