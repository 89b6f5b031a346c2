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

/// The tight oriented rectangle around the disks, extruded over their time. The range must lie in the clip and hold a
/// sample; the time axis is scaled by w > 0 (m/s).
Box fit_obb2d(const Clip& clip, SampleRange range, Axes axes, double time_scale);

/// The tight free box around the cylinders, under the same conditions. Where its first axis would be along time (one
/// sample, or first and last centre within kStandingStill) the result is an obb2d: this is where the 2D tests in the
/// paper's UMOBB rows come from.
Box fit_obb3d(const Clip& clip, SampleRange range, Axes axes, double time_scale);

/// The tight moving rectangle, under the same conditions. Its centre moves at (last centre - first)/((count - 1)*dt), 0
/// for one sample, and it holds each disk at both ends of the disk's hold interval. `axes` are those of the disks as
/// they drift in the moving frame; endpoints keep the direction of travel. `time_scale` scales the time axis only.
Box fit_moving(const Clip& clip, SampleRange range, Axes axes, double time_scale);

/// The tight rectangle along the clip's x and y, extruded over its time, under the same conditions.
Box fit_aabb(const Clip& clip, SampleRange range, double time_scale);

/// The box of that kind; an aabb has no axes to choose.
Box fit(BoxKind kind, const Clip& clip, SampleRange range, Axes axes, double time_scale);

}  // namespace mobb
