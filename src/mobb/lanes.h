/// Two doubles at once, on every processor that has such registers. Internal to this folder.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace mobb {

/// Operators work on each of the two, with the results that they have on single doubles.
using TwoDoubles [[gnu::vector_size(16)]] = double;
using TwoMasks [[gnu::vector_size(16)]] = std::int64_t;  ///< of a comparison: -1 where it holds, else 0

inline double magnitude(double v) { return std::abs(v); }
inline TwoDoubles magnitude(TwoDoubles v) { return std::bit_cast<TwoDoubles>(std::bit_cast<TwoMasks>(v) & INT64_MAX); }

}  // namespace mobb
