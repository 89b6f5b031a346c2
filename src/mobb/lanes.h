/// Two doubles at once, in a register where the processor has one for both.
#pragma once

#include <glm/vec2.hpp>

#include <bit>
#include <cstdint>
#include <limits>

namespace mobb {

/// Operators work on each of the two, with the results that they have on single doubles.
using TwoDoubles [[gnu::vector_size(16)]] = double;
using TwoMasks [[gnu::vector_size(16)]] = std::int64_t;  ///< of a comparison: -1 where it holds, else 0

inline TwoDoubles lanes(glm::dvec2 v) { return std::bit_cast<TwoDoubles>(v); }
inline TwoDoubles both(double v) { return TwoDoubles{v, v}; }
inline TwoDoubles swapped(TwoDoubles v) { return TwoDoubles{v[1], v[0]}; }
inline TwoDoubles magnitude(TwoDoubles v) {
    return std::bit_cast<TwoDoubles>(std::bit_cast<TwoMasks>(v) & std::numeric_limits<std::int64_t>::max());
}
/// The second where neither is less (greater), as std::min and std::max do of numbers in that order.
inline TwoDoubles least(TwoDoubles v, TwoDoubles w) { return v < w ? v : w; }
inline TwoDoubles greatest(TwoDoubles v, TwoDoubles w) { return v > w ? v : w; }
inline bool any(TwoMasks mask) { return (mask[0] | mask[1]) != 0; }

}  // namespace mobb
