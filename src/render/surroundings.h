/// The floor and the time axis: what the scene is measured against.
#pragma once

#include <render/draw_list.h>
#include <render/label_layout.h>

#include <string>
#include <vector>

namespace mobbscope {

/// What the floor covers, world metres and global seconds.
struct Stage {
    double x0 = 0, x1 = 1, y0 = 0, y1 = 1;
    double step = 1;        ///< metres between the lines of the grid
    double t0 = 0, t1 = 1;  ///< of the paths; the floor lies at t0
    double lowest = 0;      ///< boxes may begin before, at this time
    double time_step = 1;   ///< seconds between the ticks
};

/// A floor of whole grid cells around [min, max] (x, y, t).
Stage make_stage(glm::dvec3 min, glm::dvec3 max);

/// The corners of the floor, and those above them at the end of time.
std::vector<glm::vec3> stage_corners(const Stage& stage, const DrawnSpace& space);

/// Which corner of the floor the time axis stands on: the one farthest to the left. `right`: of the picture, in drawn
/// space.
glm::dvec2 axis_corner(const Stage& stage, glm::vec3 right);

void add_floor_grid(DrawList& list, const Stage& stage, float scale);
void add_time_axis(DrawList& list, const Stage& stage, float scale);
/// The outline of the floor raised to a time, and a faint sheet in it.
void add_time_cursor(DrawList& list, const Stage& stage, double time, float scale);

/// Distances along the two edges of the floor that face the viewer, and seconds along the axis.
std::vector<LabelRequest> stage_labels(const DrawList& list, const Stage& stage, bool floor, bool time_axis,
                                       float size);

/// The widest label of the time axis.
std::string longest_tick(const Stage& stage);

/// The widest label of the floor.
std::string longest_distance(const Stage& stage);

/// True if the camera looks along the floor (its grid is a line) or along the axis of time (it is a point).
bool floor_on_edge(const Lens& lens);
bool time_on_end(const Lens& lens);

}  // namespace mobbscope
