/// Where the scene goes in the picture: how time becomes height, and the camera that shows it all.
#pragma once

#include <render/drawlist/draw_list.h>
#include <render/drawlist/shown_points.h>
#include <render/parts/floor_and_axes.h>
#include <scene/drawn_agent.h>

#include <limits>
#include <span>
#include <vector>

namespace mobbscope {

/// In (x, y, t).
struct Bounds {
    glm::dvec3 min{std::numeric_limits<double>::max()};
    glm::dvec3 max{std::numeric_limits<double>::lowest()};
    void add(glm::dvec3 p);
    glm::dvec3 middle() const { return 0.5 * (min + max); }
};

/// Adds the disks of some of a clip's samples.
void add_samples(Bounds& bounds, const mobb::PlacedClip& clip, mobb::SampleRange range);

/// Of the paths' disks.
Bounds bounds_of(std::span<const DrawnAgent> agents);

/// About as tall as wide, unless the view says how tall.
DrawnSpace space_for(const Bounds& bounds, const ViewState& view);

/// Adds floor and axis to what is near and far.
void add_floor_points(ShownPoints& points, const DrawnSpace& space, const FloorExtent& floor_extent,
                      const ViewState& view, bool has_cursor);

/// How much wider and higher than what it frames a picture is.
inline constexpr double kFrameMargin = 0.1;

/// The parts of a picture, upright and in whole pixels, that no panel covers and that no larger one contains.
std::vector<Rect> free_parts(PictureSize size, std::span<const Rect> panels);

/// Those that overlap as one.
std::vector<Rect> united(std::span<const Rect> panels);

/// The explicit camera (preset free, with a target) that looks from where `camera` does and has all `points` (drawn
/// space) in the picture, with a margin, as large as they fit. `panels` (pixels) cover none of them: if they do so in
/// the whole picture, the points fill the free part where they are largest. Where they would be less than half as large
/// there, they fill the whole picture. The target is seen in the middle of that part, as deep as the middle of the
/// points; it is in world metres with time drawn `space.time_height` high, which the view has to keep. A camera that
/// has a target keeps it.
Camera framed_camera(const Camera& camera, const ShownPoints& points, const DrawnSpace& space, PictureSize size,
                     std::span<const Rect> panels = {}, double margin = kFrameMargin);

/// Likewise, but it may be turned about its target: all points are in the picture from every side.
Camera turning_camera(const Camera& camera, const ShownPoints& points, const DrawnSpace& space, PictureSize size,
                      std::span<const Rect> panels = {});

/// Sets what is seen through the frame's camera. `points`: what is near and far.
void project(PictureFrame& frame, const ShownPoints& points);

}  // namespace mobbscope
