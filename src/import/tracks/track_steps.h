/// How far the points of tracks are apart in time. Times in files are rounded: 0.033, 0.067 and 0.1 are in step.
#pragma once

#include <import/tracks/tracks.h>

#include <optional>
#include <span>

namespace mobbscope {

/// The most frequent step from point to point, in frames; the shorter of equally frequent ones. Steps that rounded
/// times make of one count as one: their mean. None: no track has two points. `rounding`: TrackFile::rounding.
std::optional<double> most_frequent_step(std::span<const Track> tracks, double rounding = 0);
std::optional<double> most_frequent_step(std::span<const TrackPoint> points, double rounding = 0);

/// When the samples of a track are: at its first point, and whole steps after it.
struct TrackGrid {
    double steps = 0;       ///< from the first point to the last
    double step = 1;        ///< frames
    bool in_step = true;    ///< the points are whole steps apart, to time_tolerance; else steps and step say nothing
    bool has_gaps = false;  ///< some points are more than one step apart
};

/// The grid of a track in a file whose usual step is `usual`. Points that are all equally far apart are one step apart,
/// whatever the file's step; other tracks have the file's step if it suits them, else their own most frequent one.
TrackGrid grid_of(std::span<const TrackPoint> points, double usual, double rounding = 0);

/// Likewise where what is not evenly spaced as a whole is out of step.
TrackGrid grid_of_all(std::span<const TrackPoint> points, double usual, double rounding = 0);

/// From one point to the next: at least one step.
double steps_between(const TrackPoint& a, const TrackPoint& b, double step);

}  // namespace mobbscope
