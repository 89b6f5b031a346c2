/// What room a track takes: disks of the sizes that the file or its class says.
#pragma once

#include <import/tracks/tracks.h>
#include <mobb/body.h>

#include <span>
#include <string>
#include <vector>

namespace mobbscope {

struct TrackBody {
    double r = kDefaultTrackRadius;       ///< metres: around the track's points
    std::vector<mobb::BodyDisk> disks{};  ///< empty: it is that disk
};

/// The body of a track of a file without radii: of its lengths and widths the medians. `metres`: per file unit.
TrackBody body_of(const TrackFile& file, const Track& track, double metres);

/// What body_of takes, for a warning.
std::string body_remark(const TrackFile& file, double metres);

/// All of a track's points as the samples of a clip.
mobb::Clip whole_path(const Track& track, double metres);

/// At points of a track, at least one, those of the headings of all its points: degrees, without jumps from a whole
/// turn to none.
std::vector<double> headings_in_part(const Track& track, std::span<const double> headings,
                                     std::span<const TrackPoint> points);

/// Those of the file likewise; of points without one that of the point before, else of the next. Empty: no point has
/// one.
std::vector<double> headings_at(const TrackFile& file, std::span<const TrackPoint> points);

}  // namespace mobbscope
