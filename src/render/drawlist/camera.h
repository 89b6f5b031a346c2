/// Moving the camera. All take and return explicit cameras (see framed_camera): with a target in world metres with
/// time drawn as height. Distances stay within kNearest..kFarthest.
#pragma once

#include <render/drawlist/draw_list.h>
#include <render/image/image.h>
#include <scene/view_state.h>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace mobbscope {

/// Metres from the target to the eye.
inline constexpr double kNearest = 1e-3;
inline constexpr double kFarthest = 1e7;

/// Turned about its target as if the scene had been dragged by `pixels` (right, down): half a turn for the height of
/// the picture. The pitch stops at -90 and 90 degrees.
Camera orbited(Camera camera, glm::vec2 pixels, PictureSize size);

/// Moved so that what is as deep as the target moves by `pixels` (right, down).
Camera panned(Camera camera, glm::vec2 pixels, PictureSize size);

/// Nearer by `factor` (> 0; below 1 farther). What is under the cursor, as deep as the target, stays there.
Camera zoomed(Camera camera, double factor, glm::vec2 cursor_pixel, PictureSize size);

/// Seen from the same direction: the box from `min` to `max` with a margin around it, its middle in the picture's.
Camera framing(const Camera& camera, glm::dvec3 min, glm::dvec3 max, PictureSize size);

/// Looks the way that `camera` does, from where `other` stands: with its target, distance and shift.
Camera standing_as(Camera camera, const Camera& other);

/// The camera that frames the scene by itself, from the same direction.
Camera without_target(const Camera& camera);

/// On the way from one camera (t <= 0) to another (t >= 1): turned the shorter way, the distance in equal ratios.
/// Perspective comes or goes half-way.
Camera between(const Camera& from, const Camera& to, double t);

/// For a picture of another height: what a metre is wide at the target, in pixels, stays.
Camera resized(Camera camera, PictureSize from, PictureSize to);

}  // namespace mobbscope
