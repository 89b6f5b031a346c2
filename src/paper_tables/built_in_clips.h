/// Made-up clips for those who have no motion capture at hand.
#pragma once

#include <mobb/clip.h>

#include <cstdint>
#include <vector>

namespace mobbscope {

/// Walks about as fast, as wide and as winding as people's: `count` of them at 30 samples a second that last
/// `mean_seconds` on average, each within a third of it more or less. They stay within about 3 m of the middle of a
/// capture volume.
std::vector<mobb::ClipPtr> walks_in_a_volume(int count, double mean_seconds, std::uint64_t seed);

/// Likewise short clips: straight and curved walks, runs, quarter turns, steps to the side and back, as sets for motion
/// graphs have them.
std::vector<mobb::ClipPtr> short_moves(int count, double mean_seconds, std::uint64_t seed);

}  // namespace mobbscope
