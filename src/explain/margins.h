/// How far a miss that a certificate proves may be pushed before its lines stop proving it.
#pragma once

#include <explain/certificate.h>

#include <glm/vec2.hpp>

#include <optional>
#include <vector>

namespace mobbscope {

inline constexpr double kFarthestShift = 100;  ///< metres along x and y: a free region is drawn no farther

/// What may change with no collision. Each margin is of a change of its own, with all else as it is.
struct Margins {
    double growth = 0;  ///< metres by which both radii may grow: half the least gap, rounded down; >= 0
    /// Shifts d of B with u_m . d > -gap_m for every tile m: a convex polygon around the origin, counter-clockwise,
    /// metres, cut to the square of +-kFarthestShift. Empty where the two touch.
    std::vector<glm::dvec2> free_region;
    bool bounded = true;  ///< false: the region reaches the square
    /// Seconds: B may start up to so much earlier or later, and every line still holds over the time that the two then
    /// share. Infinite: no shift changes it.
    double shift_in_time = 0;
};

/// Requires a certificate of a miss (no contact) with at least one tile; none otherwise.
std::optional<Margins> margins_of(const mobb::PlacedClip& a, const mobb::PlacedClip& b, const Certificate& certificate);

/// Metres that a shift of B leaves to the edge of the free region; 0 or less outside.
double room_left(const Certificate& certificate, glm::dvec2 shift);

/// The part of a convex polygon where dot(u, p) <= most, metres.
std::vector<glm::dvec2> cut_off(const std::vector<glm::dvec2>& polygon, glm::dvec2 u, double most);

}  // namespace mobbscope
