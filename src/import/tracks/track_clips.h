/// Tracks to clips: one a track, with the time at which it starts on the crowd's common clock.
#pragma once

#include <import/clip/imported_clip.h>
#include <import/tracks/tracks.h>

#include <filesystem>
#include <vector>

namespace mobbscope {

/// Metres: the radius of people whose file has none, about half a shoulder width.
inline constexpr double kDefaultTrackRadius = 0.2;

/// The clips of a file's tracks, or of the one that options.id names. Stored points are the samples; options.fps
/// resamples them. Missing frames of a track are interpolated, tracks out of step are resampled (30 fps), both with a
/// warning. options.dt is the time from one frame number to the next; options.trim counts from the file's first frame,
/// and who is not there then is left out. Throws InputError.
std::vector<ImportedClip> track_clips(const TrackFile& tracks, const std::filesystem::path& file,
                                      const ImportOptions& options);

}  // namespace mobbscope
