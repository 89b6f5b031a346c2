/// The recursion of random queries: every event in one pair, children inside their parents, counts that add up.
#include <explain/recursion.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <set>
#include <tuple>
#include <vector>

#include "explain/random_query.h"

namespace mobbscope {
namespace {

using mobb::Trace;
using mobb::test::Random;

bool inside(const mobb::Interval& inner, const mobb::Interval& outer) {
    return outer.t0 <= inner.t0 && inner.t1 <= outer.t1;
}

TEST(Recursion, HoldsEveryEventOnceAndChildrenInsideParents) {
    Random random(5);
    int hits = 0;
    int deep = 0;
    for (int round = 0; round < 300; ++round) {
        const RandomQuery asked = random_query(random);
        const Recursion found = recursion_of(asked.trace, asked.a(), asked.b());
        ASSERT_EQ(found.pair_of.size(), static_cast<std::size_t>(asked.trace.size()));
        int events = 0;
        std::set<std::tuple<int, int>> nodes;
        for (std::size_t k = 0; k < found.pairs.size(); ++k) {
            const RecursionPair& pair = found.pairs[k];
            EXPECT_TRUE(nodes.insert({pair.a, pair.b}).second) << "a pair of nodes is visited once";
            events += pair.last - pair.first + 1;
            for (int e = pair.first; e <= pair.last; ++e) {
                EXPECT_EQ(found.pair_of[static_cast<std::size_t>(e)], static_cast<int>(k));
                EXPECT_EQ(asked.trace[e].a, pair.a);
                EXPECT_EQ(asked.trace[e].b, pair.b);
                EXPECT_EQ(asked.trace[e].depth, pair.depth);
            }
            EXPECT_EQ(pair.outcome, asked.trace[pair.last].outcome);
            EXPECT_GE(pair.end, pair.last + 1);
            EXPECT_LT(pair.depth, found.depth);
            if (pair.parent < 0) {
                EXPECT_EQ(k, 0u);
                EXPECT_EQ(pair.end, asked.trace.size());
                continue;
            }
            const RecursionPair& above = found.pairs[static_cast<std::size_t>(pair.parent)];
            EXPECT_EQ(above.depth + 1, pair.depth);
            EXPECT_GT(pair.first, above.last);
            EXPECT_LE(pair.end, above.end);
            EXPECT_TRUE(inside(pair.time_a, above.time_a));
            EXPECT_TRUE(inside(pair.time_b, above.time_b));
            deep += pair.depth > 3;
        }
        EXPECT_EQ(events, asked.trace.size());
        hits += !found.pairs.empty() && found.pairs[0].hit;
    }
    EXPECT_GT(hits, 50);
    EXPECT_GT(deep, 100);
}

TEST(Recursion, CountsWhatHadBeenCountedAtEachStep) {
    Random random(6);
    int avoidable = 0;
    for (int round = 0; round < 60; ++round) {
        const RandomQuery asked = random_query(random);
        if (asked.trace.size() > 400) continue;
        const Recursion found = recursion_of(asked.trace, asked.a(), asked.b());
        Trace part;
        for (int step = 0; step < asked.trace.size(); ++step) {
            part.push(asked.trace[step]);
            ASSERT_EQ(asked.trace.counts(step + 1), part.counts()) << round << ' ' << step;
        }
        for (const RecursionPair& pair : found.pairs) {
            std::int64_t in_pair = found.avoidable.before(pair.last + 1) - found.avoidable.before(pair.first);
            EXPECT_EQ(pair.avoidable, in_pair > 0);
            EXPECT_FALSE(pair.avoidable && pair.hit) << "no line parts what collides";
            avoidable += pair.avoidable;
        }
    }
    EXPECT_GT(avoidable, 5);
}

TEST(Recursion, AnEventTakesUnderTwoHundredBytes) {
    // Beside each other: boxes overlap down to a few samples, disks never do.
    std::vector<mobb::Disk> walk;
    for (int i = 0; i < 4000; ++i) walk.push_back({0.001 * i + 0.2 * std::sin(0.7 * i), 0.3 * std::sin(0.37 * i), 0.2});
    const auto clip = std::make_shared<const mobb::Clip>(1 / 30.0, walk);
    const mobb::Tree tree(clip, {.tree = mobb::TreeKind::umobb, .leaf = 1});
    const mobb::PlacedTree a(tree, {}), b(tree, {.translate = {0, 0.52}, .start = 0.013});
    mobb::TraceRecorder recorder;
    static_cast<void>(mobb::query(a, b, recorder));
    const Trace trace = recorder.take();
    const Recursion found = recursion_of(trace, a, b, kAnyVisits);
    EXPECT_TRUE(found.avoidable.all_judged());
    EXPECT_GT(found.avoidable.events.size(), 100u);
    ASSERT_GT(trace.size(), 10'000);
    EXPECT_LT(trace.bytes() + found.bytes(), 200 * static_cast<std::size_t>(trace.size()));
}

TEST(Recursion, OfAnEmptyTraceIsEmpty) {
    Random random(7);
    const RandomQuery asked = random_query(random);
    const Recursion found = recursion_of(Trace(), asked.a(), asked.b());
    EXPECT_TRUE(found.pairs.empty());
    EXPECT_EQ(found.depth, 0);
    EXPECT_EQ(found.avoidable.overlaps, 0);
}

}  // namespace
}  // namespace mobbscope
