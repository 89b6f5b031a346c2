// The queries of blocks.h for each set of vector instructions, by Highway.
#include <mobb/block_queries.h>
#include <mobb/predicate.h>
#include <mobb/separation.h>
#include <mobb/traversal.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <type_traits>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "mobb/block_queries_simd.cpp"
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
    std::vector<InstructionSet> out;
#if HWY_ARCH_X86
    // Not by hwy::SupportedTargets: its library runs an instruction at the start of every program that not every
    // machine has. What Highway's targets may use beyond these, all processors that have these do have.
#define MOBB_HAS(feature) (__builtin_cpu_supports(feature) != 0)
    __builtin_cpu_init();
    [[maybe_unused]] const bool sse4 = MOBB_HAS("ssse3") && MOBB_HAS("sse4.2") && MOBB_HAS("pclmul") && MOBB_HAS("aes");
    [[maybe_unused]] const bool avx2 =
        sse4 && MOBB_HAS("avx2") && MOBB_HAS("fma") && MOBB_HAS("bmi") && MOBB_HAS("bmi2");
    [[maybe_unused]] const bool avx512 = avx2 && MOBB_HAS("avx512f") && MOBB_HAS("avx512vl") && MOBB_HAS("avx512bw") &&
                                         MOBB_HAS("avx512dq") && MOBB_HAS("avx512cd");
#undef MOBB_HAS
#endif
#if HWY_TARGETS & HWY_AVX3
    if (avx512) out.push_back({"avx512", N_AVX3::queries()});
#endif
#if HWY_TARGETS & HWY_AVX2
    if (avx2) out.push_back({"avx2", N_AVX2::queries()});
#endif
#if HWY_TARGETS & HWY_SSE4
    if (sse4) out.push_back({"sse4", N_SSE4::queries()});
#endif
#if HWY_TARGETS & HWY_NEON
    out.push_back({"neon", N_NEON::queries()});
#endif
    return out;
}

}  // namespace mobb
#endif
