/// Agents by the names that a view has for them, and the grid that it may lay them out in.
#pragma once

#include <scene/scene.h>

#include <glm/vec2.hpp>

#include <span>
#include <string>
#include <vector>

namespace mobbscope {

/// The cell of one agent in the grid: on the floor, in metres.
struct GridCell {
    glm::dvec2 offset{0};        ///< from where the agent is to where it is drawn
    glm::dvec2 low{0}, high{0};  ///< what its disks stay within there, in the middle of the cell
    glm::dvec2 size{0};          ///< of the cell; all of a grid are of one size
};

/// A cell for each agent, in rows from left to right and from the back to the front, about as wide as deep. They are as
/// large as the largest agent over all time.
std::vector<GridCell> grid_of(const Scene& scene, std::span<const PlacedAgent> agents);

/// Whether what a view shows of the scene is laid out in a grid.
bool is_in_grid(const Scene& scene, const ViewState& view);

/// A scene of several clips without agents is seen in a grid: each clip is where its own file has it, so that together
/// they would be a heap.
void lay_out_clips(Scene& scene);

/// The names that ViewState::hidden and its like may have: of a run its people, without agents the clips.
std::vector<std::string> names_in_view(const Scene& scene);
/// The one of an agent; of a run of who plays it.
const std::string& name_in_view(const Scene& scene, const PlacedAgent& who);

/// Whether a list of names of the view is not empty.
bool names_agents(const ViewState& view);
/// Throws ViewMismatch, with the nearest name, if such a list names nobody of the scene.
void check_names(const Scene& scene, const ViewState& view);
/// Takes such names out of the view.
void drop_unknown_names(const Scene& scene, ViewState& view);

}  // namespace mobbscope
