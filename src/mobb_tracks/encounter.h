/// What traffic engineers ask of two who come near each other, and who is connected with whom by contacts.
#pragma once

#include <mobb_tracks/conflict.h>

#include <cstddef>
#include <limits>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace mobb {

/// Seconds >= 0, or not a number, and why.
struct MaybeSeconds {
    double seconds = std::numeric_limits<double>::quiet_NaN();
    std::string_view undefined = "";  ///< the reason; "" where it is defined
};

/// The least time to collision over the intervals of a conflict: how long it would take, from any moment of these,
/// until the two collide if both went on as they do at that moment, radii included; 0 if they collide. Undefined of
/// held clips, which have no speed, and where the two are never on such a course.
MaybeSeconds time_to_collision(const PlacedClip& a, const PlacedClip& b, const Conflict& conflict, double within);

/// The post-encroachment time: the least time from when one leaves a place on the floor until the other comes there,
/// over all that both walk (floor_paths); 0 if they collide. Undefined where their paths share no place, and where too
/// many of their samples lie too near each other to tell.
MaybeSeconds post_encroachment_time(const PlacedClip& a, const PlacedClip& b, const Conflict& conflict);

/// Groups of people who are connected by contacts, each in order, the largest first and of equals the one with the
/// least person. Who has no contact is in none. `contacts`: pairs of indices < people.
std::vector<std::vector<int>> contact_chains(std::size_t people, std::span<const std::pair<int, int>> contacts);

}  // namespace mobb
