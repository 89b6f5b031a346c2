/// Random queries with their traces.
#pragma once

#include <mobb/trace.h>

#include "mobb/random_motion.h"

namespace mobbscope {
inline namespace testing {

struct RandomQuery {
    mobb::Tree tree_a, tree_b;
    mobb::Placement place_a, place_b;
    mobb::Trace trace;

    mobb::PlacedTree a() const { return {tree_a, place_a}; }
    mobb::PlacedTree b() const { return {tree_b, place_b}; }
};

inline RandomQuery random_query(mobb::test::Random& random, int most_samples = 400) {
    const mobb::ClipPtr clip_a = mobb::test::random_clip(random, most_samples);
    const mobb::ClipPtr clip_b = mobb::test::random_partner(random, *clip_a, most_samples);
    const mobb::FitOptions fit = mobb::test::random_fit(random);
    RandomQuery out{mobb::Tree(clip_a, fit), mobb::Tree(clip_b, fit), {}, {}, {}};
    mobb::test::random_placements(random, *clip_a, *clip_b, out.place_a, out.place_b);
    mobb::TraceRecorder recorder;
    static_cast<void>(mobb::query(out.a(), out.b(), recorder));
    out.trace = recorder.take();
    return out;
}

}  // namespace testing
}  // namespace mobbscope
