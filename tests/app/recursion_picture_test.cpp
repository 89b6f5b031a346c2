/// Traces in pixels: nothing is lost by merging what is small.
#include <app/panels/recursion_picture.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "explain/random_query.h"

namespace mobbscope::app {
namespace {

using mobb::test::Random;

TEST(RecursionPicture, AStripHoldsEveryEventOnce) {
    Random random(11);
    int merged = 0, avoidable_in_all = 0;
    for (int round = 0; round < 200; ++round) {
        const RandomQuery asked = random_query(random);
        const Recursion recursion = recursion_of(asked.trace, asked.a(), asked.b());
        const int width = random.integer(1, random.chance(0.5) ? 12 : 300);
        const auto cells = strip_cells(asked.trace, recursion, {{0, asked.trace.size()}}, width);
        MarkCounts counts{};
        int next = 0;
        float x = 0;
        for (const StripCell& cell : cells) {
            EXPECT_EQ(cell.first, next);
            EXPECT_FLOAT_EQ(cell.x0, x);
            EXPECT_GE(cell.x1 - cell.x0, 0.999f);
            EXPECT_EQ(std::accumulate(cell.marks.begin(), cell.marks.end(), 0), cell.end - cell.first);
            for (std::size_t m = 0; m < kEventMarks; ++m) counts[m] += cell.marks[m];
            merged += cell.end - cell.first > 1;
            next = cell.end;
            x = cell.x1;
        }
        EXPECT_EQ(next, asked.trace.size());
        EXPECT_FLOAT_EQ(x, static_cast<float>(width));
        MarkCounts expected{};
        for (int e = 0; e < asked.trace.size(); ++e) {
            const bool avoidable = avoidable_overlap(asked.a(), asked.b(), asked.trace[e]).has_value();
            ++expected[static_cast<std::size_t>(avoidable ? EventMark::avoidable
                                                          : mark_of(asked.trace[e].test, asked.trace[e].outcome))];
        }
        EXPECT_EQ(counts, expected);
        avoidable_in_all += counts[static_cast<std::size_t>(EventMark::avoidable)];
    }
    EXPECT_GT(merged, 100);
    EXPECT_GT(avoidable_in_all, 20);
}

int pixel(double t, const mobb::Interval& whole, int size) {
    return static_cast<int>(std::lround((t - whole.t0) / (whole.t1 - whole.t0) * size));
}

TEST(RecursionPicture, ASquareShowsEveryPairThatWasDecided) {
    Random random(12);
    int merged = 0;
    for (int round = 0; round < 200; ++round) {
        const RandomQuery asked = random_query(random);
        const Recursion recursion = recursion_of(asked.trace, asked.a(), asked.b());
        const int size = random.integer(1, random.chance(0.5) ? 8 : 200);
        const auto& root = recursion.pairs.front();
        const auto cells = square_cells(recursion, root.time_a, root.time_b, size, size);
        int decided = 0;
        for (const PairCell& cell : cells) {
            EXPECT_GE(cell.x0, 0);
            EXPECT_GE(cell.y0, 0);
            EXPECT_LE(cell.x1, size);
            EXPECT_LE(cell.y1, size);
            EXPECT_LT(cell.x0, cell.x1);
            EXPECT_LT(cell.y0, cell.y1);
            merged += cell.merged - 1;
            if (!recursion.pairs[static_cast<std::size_t>(cell.pair)].has_children()) decided += cell.merged;
        }
        EXPECT_EQ(decided, std::ranges::count_if(recursion.pairs, [](const auto& p) { return !p.has_children(); }));
        for (const RecursionPair& pair : recursion.pairs) {
            if (pair.has_children()) continue;
            const int x = std::min(pixel(pair.time_a.t0, root.time_a, size), size - 1);
            const int y = std::min(size - pixel(pair.time_b.t1, root.time_b, size), size - 1);
            const bool shown = std::ranges::any_of(cells, [&](const PairCell& cell) {
                const RecursionPair& of = recursion.pairs[static_cast<std::size_t>(cell.pair)];
                return !of.has_children() && cell.x0 <= x && x < cell.x1 && cell.y0 <= y && y < cell.y1 &&
                       mark_of(of) >= mark_of(pair);
            });
            EXPECT_TRUE(shown) << round;
        }
    }
    EXPECT_GT(merged, 100);
}

TEST(RecursionPicture, AnIcicleHoldsEveryPairOnceAndLosesNoHit) {
    Random random(13);
    int merged = 0;
    int hits = 0;
    for (int round = 0; round < 200; ++round) {
        const RandomQuery asked = random_query(random);
        const Recursion recursion = recursion_of(asked.trace, asked.a(), asked.b());
        const int width = random.integer(1, random.chance(0.5) ? 12 : 300);
        const auto cells = icicle_cells(recursion, {{0, asked.trace.size()}}, width, 10);
        std::size_t pairs = 0;
        bool hit = false;
        for (const PairCell& cell : cells) {
            const RecursionPair& pair = recursion.pairs[static_cast<std::size_t>(cell.pair)];
            EXPECT_GE(cell.x0, 0);
            EXPECT_LE(cell.x1, width);
            EXPECT_LT(cell.x0, cell.x1);
            EXPECT_EQ(cell.y0, pair.depth * 10);
            pairs += static_cast<std::size_t>(cell.merged);
            merged += cell.merged - 1;
            hit = hit || pair.outcome == mobb::Outcome::hit;
        }
        EXPECT_EQ(pairs, recursion.pairs.size());
        EXPECT_EQ(hit, recursion.pairs.front().hit);
        hits += hit;
    }
    EXPECT_GT(merged, 100);
    EXPECT_GT(hits, 20);
}

TEST(RecursionPicture, AZoomShowsItsEventsAloneAndAFocusItsOwn) {
    Random random(14);
    int left_out = 0;
    for (int round = 0; round < 200; ++round) {
        const RandomQuery asked = random_query(random);
        const Recursion recursion = recursion_of(asked.trace, asked.a(), asked.b());
        const int first = random.integer(0, asked.trace.size() - 1);
        const EventRange range{first, random.integer(first + 1, asked.trace.size())};
        FocusWindow focus;
        if (random.chance(0.5)) focus.branch = random.integer(0, static_cast<int>(recursion.pairs.size()) - 1);
        const InFocus inside = events_in(recursion, focus);
        const ShownEvents shown{range, &inside};
        const int width = random.integer(1, 300);
        int events = 0;
        int next = range.first;
        for (const StripCell& cell : strip_cells(asked.trace, recursion, shown, width)) {
            EXPECT_EQ(cell.first, next);
            next = cell.end;
            events += std::accumulate(cell.marks.begin(), cell.marks.end(), 0);
        }
        EXPECT_EQ(next, range.end);
        int expected = 0;
        for (int event = range.first; event < range.end; ++event) expected += shown.has(event);
        EXPECT_EQ(events, expected);
        int pairs = 0;
        for (const PairCell& cell : icicle_cells(recursion, shown, width, 10)) {
            EXPECT_GE(cell.x0, 0);
            EXPECT_LE(cell.x1, width);
            pairs += cell.merged;
        }
        int seen = 0;
        for (const RecursionPair& pair : recursion.pairs) {
            seen += pair.first < range.end && pair.end > range.first && shown.has(pair.last);
        }
        EXPECT_EQ(pairs, seen);
        left_out += static_cast<int>(recursion.pairs.size()) - seen;
    }
    EXPECT_GT(left_out, 100);
}

}  // namespace
}  // namespace mobbscope::app
