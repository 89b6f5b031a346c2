/// Fitting one box around consecutive samples of a clip (paper, Sections 3.1 and 4).
#pragma once

#include <mobb/box.h>
#include <mobb/clip.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace mobb {

/// How the directions of a box are chosen.
enum class Axes : std::uint8_t {
    endpoints,   ///< from the first centre to the last: the paper's
    covariance,  ///< principal axes of the centres (for 3D boxes, of (x, y, w*t))
    minarea,  ///< smallest rectangle over 1,800 angles; 3D: the smallest volume found. Never larger than the other two
};

/// As in files and on the command line: "endpoints", "covariance", "minarea".
std::string_view name(Axes axes);
std::optional<Axes> axes_from_name(std::string_view name);
std::span<const std::string_view> axes_names();

/// Consecutive samples [first, first + count) of a clip; count >= 1.
struct SampleRange {
    int first = 0;
    int count = 0;
    int end() const { return first + count; }
};

/// First and last centre nearer than this (metres) give no direction of travel.
inline constexpr double kStandingStill = 1e-6;

/// The tight box around the cylinders of a range, which must lie in the clip and hold a sample. The time axis is scaled
/// by w > 0 (m/s). Of a linear clip the cylinders are slanted: the box also holds the disk that the range's last one
/// runs to, but the directions, the velocity and what follows from a count of 1 come from the range's own samples.
///
/// An obb2d, moving box or aabb is a rectangle extruded over the range's time. An obb3d whose first axis would be along
/// time (one sample, or first and last centre within kStandingStill) comes out as an obb2d: this is where the 2D tests
/// in the paper's UMOBB rows come from. The centre of a moving box moves at (last centre - first)/((count - 1)*dt), 0
/// for one sample, and the box holds each disk at both ends of the disk's hold interval; its axes are those of the
/// disks as they drift in the moving frame, but endpoints keep the direction of travel. An aabb has no axes to choose,
/// nor has a block (see bounding_disk).
Box fit(BoxKind kind, const Clip& clip, SampleRange range, Axes axes, double time_scale);

}  // namespace mobb
