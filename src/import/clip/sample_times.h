/// Times of samples that doubles hold badly: what is refused, and what is said of the rest.
#pragma once

#include <import/clip/imported_clip.h>
#include <mobb/clip.h>

#include <string>
#include <vector>

namespace mobbscope {

/// Why the times of what is there every `dt` seconds, from `start` on for `duration` seconds, are not to be trusted, as
/// a sentence without its end; empty where less than a thousandth of each sample is not sure (mobb::unsure_time).
std::string coarse_times(double dt, double start, double duration);
inline std::string coarse_times(const mobb::Clip& clip, double start) {
    return coarse_times(clip.dt(), start, clip.duration());
}

/// Adds that as a warning, unless there is one of its kind already.
void warn_of_coarse_times(const mobb::Clip& clip, double start, std::vector<ImportWarning>& warnings);

/// Throws std::invalid_argument if what a file has every `dt` seconds is not told apart at its latest time, in seconds.
void check_file_times(double dt, double latest);

/// Behind a message that two rows have one time: " (doubles tell such times apart by 0.00012 s)" where that may be why;
/// else empty.
std::string rounded_time_hint(double time);

}  // namespace mobbscope
