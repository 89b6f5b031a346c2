/// The walls around the floor of a crowd.
#pragma once

#include <render/draw_list.h>
#include <render/surroundings.h>

#include <glm/vec2.hpp>

namespace mobbscope {

/// Metres, of the walls in the picture of a moment.
inline constexpr double kWallHeight = 0.5;

/// The stage of a run: its floor between two times, seconds.
Stage floor_stage(glm::dvec2 area, double begin, double end);

/// Low walls of glass around the floor that a run takes place on. `bottom`, `top`: in the drawn space's third
/// coordinate; equal ones make a line on the floor.
void add_walls(DrawList& list, glm::dvec2 area, double bottom, double top, float scale);

}  // namespace mobbscope
