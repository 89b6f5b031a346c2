/// A crowd in parts that are searched apart from each other, on several machines say.
#pragma once

#include <mobb_tracks/path_sweep.h>

#include <span>

namespace mobb {

/// One of so many regions that share nothing and cover all, 0 <= part < parts: slices of time, and of these slices
/// along x, each with about as much of the crowd. They depend on the crowd alone.
Region region_of_part(std::span<const PlacedClip> crowd, int part, int parts);

}  // namespace mobb
