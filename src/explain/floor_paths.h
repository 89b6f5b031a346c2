/// How the paths of two placed clips lie on the floor, whatever the time: whether they would meet if both were there at
/// once, and by how little they miss each other.
#pragma once

#include <mobb/clip.h>

#include <cstdint>
#include <optional>

namespace mobbscope {

/// Two samples whose disks overlap on the floor, and are the nearest in time of all that do.
struct FloorMeeting {
    int a_sample = 0;
    int b_sample = 0;
    double gap = 0;  ///< seconds from the end of the earlier to the beginning of the later; < 0 if they share time
    bool a_first = false;  ///< the earlier one is A's
};

struct FloorPaths {
    bool known = false;  ///< false: too many samples lie too near each other to tell in the time of a frame
    std::optional<FloorMeeting> meeting;  ///< if the paths overlap on the floor
    double apart = 0;                     ///< metres between them if not; else 0
};

/// Visits at most so many pairs of samples or ranges of samples, a few nanoseconds each.
FloorPaths floor_paths(const mobb::PlacedClip& a, const mobb::PlacedClip& b, std::int64_t most_visits = 1'000'000);

}  // namespace mobbscope
