/// Who comes near whom: a broad phase in space-time over the paths of a crowd.
#pragma once

#include <mobb/placed_tree.h>

#include <span>
#include <utility>
#include <vector>

namespace mobbscope {

/// Pairs (a, b) of indices into the crowd, a < b, of those whose disks may meet; it leaves out no pair that collides
/// (mobb/predicate.h). In order, each once. Time and memory grow with the number of samples and with how many are near
/// each other, not with the square of the crowd.
std::vector<std::pair<int, int>> near_pairs(std::span<const mobb::PlacedTree> crowd);

}  // namespace mobbscope
