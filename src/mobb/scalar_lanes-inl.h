// The operations of Highway that block_bounds-inl.h and unequal_dt_scan-inl.h use, on one float at a time: for builds
// without Highway, and for tests of the others. Names and meanings are Highway's.
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace mobb::scalar::hn {

struct OneLane {};
template <class, std::size_t>
using CappedTag = OneLane;

constexpr std::size_t Lanes(OneLane) { return 1; }
constexpr std::size_t MaxLanes(OneLane) { return 1; }
inline float LoadU(OneLane, const float* from) { return *from; }
inline float Set(OneLane, float value) { return value; }
inline float Add(float a, float b) { return a + b; }
inline float Sub(float a, float b) { return a - b; }
inline float Mul(float a, float b) { return a * b; }
inline float MulAdd(float a, float b, float c) { return a * b + c; }
inline float NegMulAdd(float a, float b, float c) { return c - a * b; }
inline float Abs(float a) { return std::abs(a); }
inline float Div(float a, float b) { return a / b; }
inline float Min(float a, float b) { return a < b ? a : b; }
inline float Max(float a, float b) { return a > b ? a : b; }
struct FirstLane {};
inline FirstLane SetTableIndices(OneLane, const std::int32_t*) { return {}; }
inline float TableLookupLanes(float a, FirstLane) { return a; }
inline bool Le(float a, float b) { return a <= b; }
inline bool Lt(float a, float b) { return a < b; }
inline bool Or(bool a, bool b) { return static_cast<bool>(static_cast<unsigned>(a) | static_cast<unsigned>(b)); }
inline void StoreMaskBits(OneLane, bool mask, std::uint8_t* bits) { bits[0] = mask ? 1 : 0; }

}  // namespace mobb::scalar::hn
