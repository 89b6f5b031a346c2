/// From drawn space to pixels.
#pragma once

#include <render/image.h>
#include <scene/view_state.h>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <optional>
#include <span>

namespace mobbscope {

/// The part of a picture that the scene is to fill, pixels from the upper left corner.
struct Frame {
    glm::vec2 min{0};
    glm::vec2 max{0};
};

/// A camera with all its numbers settled.
struct Lens {
    glm::mat4 clip_from_world{1};
    glm::vec3 right{1, 0, 0};  ///< unit, on the screen
    glm::vec3 up{0, 0, 1};
    glm::vec3 back{0, -1, 0};  ///< from the scene towards the eye
    glm::vec3 eye{0};          ///< where it stands; of no meaning without perspective
    bool perspective = false;
    float near_depth = 0;  ///< distance of the nearest and farthest of the scene along the line of sight
    float far_depth = 1;
    PictureSize size;

    /// The pixel (from the upper left corner, fractional) where a point is seen; none for one behind the eye, which the
    /// division would mirror, or nearer to it than anything is drawn.
    std::optional<glm::vec2> project(glm::vec3 point) const;
    /// Distance along the line of sight.
    float depth(glm::vec3 point) const;
    /// Pixels that a metre across the line of sight takes at a point; 0 where none can be seen.
    float pixels_per_metre(glm::vec3 point) const;
};

/// The yaw and pitch in degrees, and whether there is perspective, once the preset has its say.
struct Orientation {
    double yaw_deg = 0;
    double pitch_deg = 0;
    bool perspective = false;
};
Orientation orientation(const Camera& camera);

/// The unit vector that points to the right in the picture.
glm::vec3 right_of(const Camera& camera);

/// A lens for the camera. Without a target all `points` fit into `frame` as large as can be; `target` (drawn space)
/// goes to the middle of the frame otherwise. `points` also set what is near and far.
Lens make_lens(const Camera& camera, std::span<const glm::vec3> points, const glm::vec3* target, const Frame& frame,
               PictureSize size);

}  // namespace mobbscope
