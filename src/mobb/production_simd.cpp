// The queries of production.h for each set of vector instructions, by Highway.
#include <mobb/block_queries.h>
#include <mobb/predicate.h>
#include <mobb/separation.h>
#include <mobb/traversal.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "mobb/production_simd.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace mobb::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
}
#undef MOBB_LANES
#undef MOBB_INLINE
#define MOBB_LANES HWY_NAMESPACE
#define MOBB_INLINE HWY_INLINE
#include <mobb/block_query-inl.h>
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mobb {

std::vector<InstructionSet> vector_instruction_sets() {
    [[maybe_unused]] const std::int64_t supported = hwy::SupportedTargets();
    std::vector<InstructionSet> out;
#if HWY_TARGETS & HWY_AVX3
    if (supported & HWY_AVX3) out.push_back({"avx512", N_AVX3::queries()});
#endif
#if HWY_TARGETS & HWY_AVX2
    if (supported & HWY_AVX2) out.push_back({"avx2", N_AVX2::queries()});
#endif
#if HWY_TARGETS & HWY_SSE4
    if (supported & HWY_SSE4) out.push_back({"sse4", N_SSE4::queries()});
#endif
#if HWY_TARGETS & HWY_NEON
    if (supported & HWY_NEON) out.push_back({"neon", N_NEON::queries()});
#endif
    return out;
}

}  // namespace mobb
#endif
