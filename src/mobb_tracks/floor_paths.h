/// Where the paths of two cross on the floor, whatever the time.
#pragma once

#include <mobb/clip.h>

#include <cstdint>
#include <optional>
#include <span>

namespace mobb {

/// Two samples whose disks are in one place at some times of theirs, as near in time as any two are.
struct FloorMeeting {
    int a_sample = 0;
    int b_sample = 0;
    /// Seconds from when the earlier leaves to when the later comes: the least between two such times. Of disks that
    /// stay, from the end of one to the beginning of the other, < 0 if they share time.
    double gap = 0;
    bool a_first = false;  ///< the earlier one is A's
};

struct FloorPaths {
    bool known = false;  ///< false: too many samples lie too near each other to tell in the time of a frame
    std::optional<FloorMeeting> meeting;  ///< if the paths overlap on the floor
    double apart = 0;                     ///< metres between them if not, where that is asked; else 0
};

/// What a pair of samples of which one runs takes of the visits of floor_paths: to be measured, and to be seen to be no
/// nearer in time than another.
inline constexpr std::int64_t kRunningPair = 250, kLookedAtPair = 8;

/// Makes at most so many visits of a few nanoseconds each, one for two samples that stay or two ranges of samples.
FloorPaths floor_paths(const PlacedClip& a, const PlacedClip& b, std::int64_t most_visits = 1'000'000);

/// The least FloorMeeting::gap of any of A's paths and any of B's, or one that is at most 0: seconds; infinity if no
/// two of them overlap on the floor. None: of two paths too many samples lie too near each other to tell. At most so
/// many visits are made for two paths.
std::optional<double> least_floor_gap(std::span<const PlacedClip> a, std::span<const PlacedClip> b,
                                      std::int64_t most_visits = 1'000'000);

}  // namespace mobb
