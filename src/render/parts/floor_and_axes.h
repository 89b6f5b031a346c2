/// The floor and the time axis: what the scene is measured against.
#pragma once

#include <render/drawlist/draw_list.h>
#include <render/text/labels.h>
#include <scene/drawn_agent.h>

#include <glm/vec2.hpp>

#include <span>
#include <vector>

namespace mobbscope {

/// What the floor covers, world metres and global seconds.
struct FloorExtent {
    double x0 = 0, x1 = 1, y0 = 0, y1 = 1;
    double step = 1;        ///< metres between the lines of the grid
    double t0 = 0, t1 = 1;  ///< of the paths; the floor lies at t0
    double lowest = 0;      ///< boxes may begin before, at this time
    double time_step = 1;   ///< seconds between the ticks
};

/// A floor of whole grid cells around [min, max] (x, y, t).
FloorExtent floor_extent_of(glm::dvec3 min, glm::dvec3 max);

/// The corners of the floor, and those above them at the end of time.
std::vector<glm::vec3> floor_corners(const FloorExtent& floor_extent, const DrawnSpace& space);

/// Which corner of the floor the time axis stands on: the one farthest to the left. `right`: of the picture, in drawn
/// space.
glm::dvec2 axis_corner(const FloorExtent& floor_extent, glm::vec3 right);

void add_floor_grid(DrawList& list, const FloorExtent& floor_extent, float scale);
void add_time_axis(DrawList& list, const FloorExtent& floor_extent, float scale);
/// The outline of the floor raised to a time, and a faint sheet in it.
void add_time_cursor(DrawList& list, const FloorExtent& floor_extent, double time, float scale);

/// Distances along the two edges of the floor that face the viewer, and seconds along the axis.
std::vector<LabelRequest> floor_and_axis_labels(const DrawList& list, const FloorExtent& floor_extent, bool floor,
                                                bool time_axis, float size);

/// What says which way time goes, where it may stand, best first: at the axis, as far up as that is in the picture,
/// else at the picture's sides. Every picture in space-time has room for one of them.
std::vector<LabelRequest> time_titles(const DrawList& list, const FloorExtent& floor_extent, float size);

/// True if the camera looks along the floor (its grid is a line) or along the axis of time (it is a point).
bool floor_on_edge(const ViewProjection& projection);
bool time_on_end(const ViewProjection& projection);

/// Metres, of the walls in the picture of a moment.
inline constexpr double kWallHeight = 0.5;

/// Of a run: its floor between two times, seconds.
FloorExtent floor_stage(glm::dvec2 area, double begin, double end);

/// Low walls of glass around the floor that a run takes place on. `bottom`, `top`: in the drawn space's third
/// coordinate; equal ones make a line on the floor.
void add_walls(DrawList& list, glm::dvec2 area, double bottom, double top, float scale);

/// The size in pixels of a small map: where everybody is on the floor at one time.
glm::vec2 map_size(const FloorExtent& floor_extent, float scale);

/// Adds the map within a rectangle of that size.
void add_floor_map(DrawList& list, std::span<const DrawnAgent> agents, const FloorExtent& floor_extent, double time,
                   const Rect& within, float scale);

}  // namespace mobbscope
