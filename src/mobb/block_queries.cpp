#include <mobb/block_queries.h>
#include <mobb/predicate.h>
#include <mobb/separation.h>
#include <mobb/traversal.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <type_traits>

// The operations of Highway that block_bounds-inl.h and unequal_dt_scan-inl.h use, on one float at a time: for builds
// without Highway, and for tests of the others. Names and meanings are Highway's.
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

#define MOBB_LANES scalar
#define MOBB_INLINE inline
#include <mobb/block_query-inl.h>

namespace mobb {

namespace {

const std::vector<InstructionSet>& all_instruction_sets() {
    static const std::vector<InstructionSet> all = [] {
#ifdef MOBB_HIGHWAY
        std::vector<InstructionSet> sets = vector_instruction_sets();
#else
        std::vector<InstructionSet> sets;
#endif
        sets.push_back({"scalar", scalar::queries()});
        return sets;
    }();
    return all;
}

std::atomic<const BlockQueries*> in_use{nullptr};

const BlockQueries& chosen_queries() {
    const BlockQueries* now = in_use.load(std::memory_order_relaxed);
    if (now == nullptr) [[unlikely]] {
        now = all_instruction_sets().front().queries;
        in_use.store(now, std::memory_order_relaxed);
    }
    return *now;
}

}  // namespace

namespace detail {

std::optional<SamplePair> first_hit(const PlacedBlocks& a, const PlacedBlocks& b, const RootsApart& roots) {
    SamplePair pair;
    return chosen_queries().first_hit(a, b, roots, pair) ? std::optional(pair) : std::nullopt;
}

bool intersects(const PlacedBlocks& a, const PlacedBlocks& b, const RootsApart& roots) {
    return chosen_queries().intersects(a, b, roots);
}

bool for_each_hit(const PlacedBlocks& a, const PlacedBlocks& b, const RootsApart& roots, HitSink sink,
                  BlockObserver* observer) {
    return (observer || roots.meet) && chosen_queries().for_each_hit(a, b, roots, sink, observer);
}

}  // namespace detail

void intersects_each(std::span<const BlocksPair> pairs, std::span<bool> answers) {
    if (pairs.size() != answers.size()) throw std::invalid_argument("intersects_each needs as many answers as pairs");
    chosen_queries().intersects_each(pairs.data(), pairs.size(), answers.data());
}

std::vector<std::string_view> instruction_sets() {
    std::vector<std::string_view> names;
    for (const InstructionSet& set : all_instruction_sets()) names.push_back(set.name);
    return names;
}

bool use_instruction_set(std::string_view name) {
    const std::vector<InstructionSet>& all = all_instruction_sets();
    const auto found =
        std::find_if(all.begin(), all.end(), [name](const InstructionSet& set) { return set.name == name; });
    if (found == all.end()) return false;
    in_use.store(found->queries, std::memory_order_relaxed);
    return true;
}

}  // namespace mobb
