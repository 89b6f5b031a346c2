/// Where the camera goes along with an agent.
#pragma once

#include <render/drawlist/draw_list.h>
#include <scene/fitted_scene.h>
#include <scene/view_state.h>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <optional>

namespace mobbscope {

/// Where the agent that the view follows is about a time: the mean of its way over a second, so that the camera glides
/// where the body sways. None if nobody is followed. Throws std::invalid_argument if there is no such agent.
std::optional<glm::dvec2> followed_place(const FittedScene& fitted, const ViewState& view, double time);

/// What the view's camera counts its target from, in (x, y, t): the followed agent at `time`, and of a run, in
/// space-time, that time; else the origin.
glm::dvec3 camera_anchor(const FittedScene& fitted, const ViewState& view, double time);

/// Metres around a followed agent that are in the picture where nobody says how near the camera is.
inline constexpr double kAroundFollowed = 5;

inline constexpr double kStanding = 1.8;  ///< metres: people's height

/// Where the followed agent stands at the view's time, as a camera's target, which counts from it. `picture`: of the
/// view.
glm::dvec3 target_of_followed(const FittedScene& fitted, const ViewState& view, const PictureFrame& picture);

/// The explicit camera (see framed_camera) that has so many metres around the followed agent in the picture, as seen
/// from where the view's camera looks. `picture`: of the view.
Camera framing_followed(const FittedScene& fitted, const ViewState& view, const PictureFrame& picture,
                        double metres = kAroundFollowed);

/// Whether there is an agent, or a path, of that name to follow.
bool can_follow(const Scene& scene, const std::string& name);

}  // namespace mobbscope
