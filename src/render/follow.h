/// Where the camera goes along with an agent.
#pragma once

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

/// Whether there is an agent, or a path, of that name to follow.
bool can_follow(const Scene& scene, const std::string& name);

}  // namespace mobbscope
