/// A small map: where everybody is on the floor at one time.
#pragma once

#include <render/draw_list.h>
#include <render/subject.h>
#include <render/surroundings.h>

#include <span>

namespace mobbscope {

/// The map's size in pixels.
glm::vec2 inset_size(const Stage& stage, float scale);

/// Adds the map with its upper left corner at a point.
void add_floor_inset(DrawList& list, std::span<const Subject> subjects, const Stage& stage, double time,
                     glm::vec2 corner, float scale);

}  // namespace mobbscope
