/// What traffic engineers ask of two who come near each other, and who is connected with whom by contacts.
#pragma once

#include <mobb/clip.h>

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

/// Two who come near each other, each with one path, or those of all disks of a body: their steps are at one time.
struct Encounter {
    std::span<const PlacedClip> a, b;
    double within = 0;           ///< metres >= 0: how near that is
    double from = 0;             ///< global seconds: before it they are never so near
    double least_clearance = 0;  ///< metres: over all their paths; below 0 if they collide
};

/// The least time to collision over all moments at which two paths are so near: how long it would take until the two
/// collide if both went on as they do at that moment, radii included; 0 if they collide. Undefined of held clips, which
/// have no speed, and where no two paths are ever on such a course.
MaybeSeconds time_to_collision(const Encounter& of);

/// The post-encroachment time: the least time from when one leaves a place on the floor until the other comes there,
/// over all that both walk (least_floor_gap); 0 if they collide. Undefined where their paths share no place, and where
/// too many of their samples lie too near each other to tell.
MaybeSeconds post_encroachment_time(const Encounter& of);

/// Groups of people who are connected by contacts, each in order, the largest first and of equals the one with the
/// least person. Who has no contact is in none. `contacts`: pairs of indices < people.
std::vector<std::vector<int>> contact_chains(std::size_t people, std::span<const std::pair<int, int>> contacts);

}  // namespace mobb
