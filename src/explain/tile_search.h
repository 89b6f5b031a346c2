/// The fewest lines that keep two paths apart for a time.
#pragma once

#include <explain/separating_line.h>

#include <functional>
#include <optional>
#include <vector>

namespace mobbscope {

/// A line that is known to keep A and B apart, fixed or at some speed, until a time.
struct KnownLine {
    glm::dvec2 direction{1, 0};  ///< unit, either way round
    double until = 0;            ///< global seconds
};
/// The one at a time, if there is one.
using KnownLines = std::function<std::optional<KnownLine>(double time)>;

/// Tiles over all pairs that share time before `end`, in order of time: from each end point on the longest of all
/// directions and speeds, and none shorter than a known line or one pair of samples. Fixed lines are taken where they
/// need no more tiles than moving ones. Of as few tiles the least gap is about as wide as it can be.
std::vector<Tile> fewest_tiles(const mobb::PlacedClip& a, const mobb::PlacedClip& b, double end,
                               const KnownLines& known);

}  // namespace mobbscope
