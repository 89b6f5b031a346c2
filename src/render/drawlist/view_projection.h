/// From drawn space to pixels.
#pragma once

#include <render/image/image.h>
#include <scene/view_state.h>

#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <numbers>
#include <optional>

namespace mobbscope {

inline constexpr double kDegree = std::numbers::pi / 180;  // in radians

/// What is seen in one place of the picture, drawn space.
struct Ray {
    glm::dvec3 origin{0};
    glm::dvec3 direction{0, 0, -1};  ///< unit, away from the viewer
    glm::dvec3 at(double distance) const { return origin + distance * direction; }
};

/// A camera with all its numbers settled.
struct ViewProjection {
    glm::mat4 clip_from_world{1};
    /// What clip_from_world does across the line of sight: a point x to the right of the eye and y above it goes to
    /// scale * (x, y) + middle * w, where w is its depth, or 1 without perspective.
    glm::vec2 scale{1};
    glm::vec2 middle{0};
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
    /// Whether what lies level at this height is seen from below.
    bool below(float height) const { return perspective ? eye.z < height : back.z < 0; }
    /// The line of sight through a pixel: from the eye, or without perspective from before the nearest of the scene.
    Ray ray(glm::vec2 pixel) const;
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

/// The camera's unit directions.
struct Directions {
    glm::dvec3 right, up;
    glm::dvec3 back;  ///< from the scene towards the eye
};
Directions directions(const Camera& camera);

class ShownPoints;

/// A projection for the camera. Without a target all `points` fit into the picture as large as can be. With `target`
/// (drawn space) that goes to the picture's middle, moved by the camera's shift. `points` also set what is near and
/// far.
ViewProjection make_projection(const Camera& camera, const ShownPoints& points, const glm::vec3* target,
                               PictureSize size);

/// Disks of different agents may have faces in one plane, which rounding would mix. So each agent's disks lie a hair
/// behind those of the agent before it, and those of the first are seen. Agents so far apart in the list share a depth:
/// the last of them still lies within a pixel of its place.
inline constexpr int kAgentDepths = 64;

/// That hair in clip space.
inline float agent_depth_step(const ViewProjection& projection) {
    constexpr float kShare = 4e-6f;  // of the scene's depth, at most
    return 2 * kShare * (projection.perspective ? projection.near_depth : 1);
}

/// Over the viewer's left shoulder, so that shapes read the same from every side. Unit length.
inline glm::vec3 towards_light(const ViewProjection& projection) {
    return glm::normalize(projection.back - 0.9f * projection.right + 0.5f * projection.up);
}

}  // namespace mobbscope
