/// What is under a pixel, computed exactly and without OpenGL.
#pragma once

#include <render/drawlist/draw_list.h>

#include <optional>
#include <vector>

namespace mobbscope {

struct Pick {
    ObjectId id;
    glm::dvec3 place{0};  ///< where the line of sight meets it first: x, y in world metres, t in global seconds
    float depth = 0;      ///< of that place, metres along the line of sight
};

/// The disks and nodes' boxes that the line of sight through a pixel (from the upper left corner, fractional: the
/// middle of pixel (x, y) is (x + 0.5, y + 0.5)) meets, nearest first and as they are drawn: a box lies a hair in front
/// of the disks that it touches, and one that the eye is inside of counts where the line of sight leaves it.
std::vector<Pick> pick(const DrawList& list, glm::vec2 pixel);

/// Where the line of sight through a pixel meets the level plane of a global time: (x, y) in world metres. None if it
/// is parallel to the plane, or meets it behind the eye.
std::optional<glm::dvec2> floor_at(const DrawList& list, glm::vec2 pixel, double time);

}  // namespace mobbscope
