/// Fitting one box around consecutive samples of a clip (paper, Sections 3.1 and 4).
#pragma once

#include <mobb/box.h>
#include <mobb/clip.h>

#include <cstdint>

namespace mobb {

/// How the directions of a box are chosen.
enum class Axes : std::uint8_t {
    endpoints,   ///< from the first centre to the last: the paper's
    covariance,  ///< principal axes of the centres (for 3D boxes, of (x, y, w*t))
    minarea,  ///< smallest rectangle over 1,800 angles; 3D: the smallest volume found. Never larger than the other two
};

/// Consecutive samples [first, first + count) of a clip; count >= 1.
struct SampleRange {
    int first = 0;
    int count = 0;
    int end() const { return first + count; }
};

/// First and last centre nearer than this (metres) give no direction of travel.
inline constexpr double kStandingStill = 1e-6;

/// The tight oriented rectangle around the disks, extruded over their time. The time axis is scaled by w (m/s).
Box fit_obb2d(const Clip& clip, SampleRange range, Axes axes, double time_scale);

/// The tight free box around the cylinders. Where its first axis would be along time (one sample, or first and last
/// centre within kStandingStill) the result is an obb2d: this is where the 2D tests in the paper's UMOBB rows come
/// from.
Box fit_obb3d(const Clip& clip, SampleRange range, Axes axes, double time_scale);

}  // namespace mobb
