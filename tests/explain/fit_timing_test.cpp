// Measured times of fits: what is decided on planted machines, and that a real one is asked as documents say.
#include <explain/fit_timing.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "mobb/random_motion.h"

namespace mobbscope {
namespace {

using mobb::test::Random;

std::vector<mobb::ClipPtr> two_clips() {
    Random random(5);
    std::vector<mobb::ClipPtr> out;
    for (const int count : {40, 90}) {
        std::vector<mobb::Disk> samples;
        for (int i = 0; i < count; ++i) samples.push_back({0.03 * i, random.real(-0.1, 0.1), 0.3});
        out.push_back(std::make_shared<const mobb::Clip>(1.0 / 30, std::move(samples)));
    }
    return out;
}

FitTrees trees_of_fit(const std::vector<mobb::ClipPtr>& clips, const mobb::FitOptions& fit) {
    FitTrees out;
    for (const mobb::ClipPtr& clip : clips) out.push_back(std::make_shared<const mobb::Tree>(clip, fit));
    return out;
}

std::vector<double> same_times(std::span<const ClipQuery> queries, std::size_t stretch) {
    return std::vector<double>((queries.size() + stretch - 1) / stretch, 100.0);
}

/// Two fits on a loaded machine: how long each takes, of which stretch of queries more than the other, and noise.
struct PlantedPair {
    double first, second;
    std::uint64_t seed;

    std::vector<FitTime> measured(Protocol protocol) const {
        const std::vector<mobb::ClipPtr> clips = two_clips();
        const std::vector<FitTrees> fits{trees_of_fit(clips, {.leaf = 5}), trees_of_fit(clips, {.leaf = 20})};
        const QueryWorkload workload = standard_workload(clips, 4000, seed);
        Random noise(seed);
        double load = 1;
        const FitTimer timer = [&](Protocol, const FitTrees& trees, std::span<const ClipQuery> queries,
                                   std::size_t stretch) {
            const bool is_first = trees.front()->options().leaf == 5;
            if (noise.chance(0.1)) load = noise.chance(0.5) ? 1 : noise.real(1, 3);
            std::vector<double> out;
            for (std::size_t i = 0; i < queries.size(); i += stretch) {
                // Queries cost more or less, and some suit one of the fits.
                const std::size_t count = std::min(stretch, queries.size() - i);
                double ns = 0;
                for (const ClipQuery& asked : queries.subspan(i, count)) {
                    const double costly = 1 + std::sin(7 * asked.place_b.rotate_deg) / 2;
                    const double suits = 1 + 0.4 * std::sin(11 * asked.place_b.start);
                    ns += (is_first ? first * suits : second) * costly / static_cast<double>(count);
                }
                ns *= load * noise.real(0.8, 1.2);
                out.push_back(noise.chance(0.01) ? 30 * ns : ns);
            }
            return out;
        };
        return time_fits(fits, workload.queries, true, protocol, timer, [] {}).fits;
    }
};

TEST(FitTiming, OfFiftyPairsTwentyPerCentApartMostAreDecidedAndNoneWrongly) {
    for (const Protocol protocol : kProtocols) {
        int decided = 0, wrong = 0;
        for (std::uint64_t seed = 1; seed <= 50; ++seed) {
            const bool first_is_faster = seed % 2 == 0;
            const PlantedPair pair{first_is_faster ? 100.0 : 120.0, first_is_faster ? 120.0 : 100.0, seed};
            const std::vector<FitTime> times = pair.measured(protocol);
            if (times[0].beats(times[1]) || times[1].beats(times[0])) ++decided;
            if (first_is_faster ? times[1].beats(times[0]) : times[0].beats(times[1])) ++wrong;
        }
        EXPECT_GE(decided, 45) << name(protocol);
        EXPECT_EQ(wrong, 0) << name(protocol);
    }
}

TEST(FitTiming, FitsThatAreAlikeAreNotToldApart) {
    int decided = 0;
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
        for (const Protocol protocol : kProtocols) {
            const std::vector<FitTime> times = PlantedPair{100, 100, seed}.measured(protocol);
            if (times[0].beats(times[1]) || times[1].beats(times[0])) ++decided;
        }
    }
    EXPECT_LE(decided, 3) << "of 100";
}

TEST(FitTiming, FitsTakeTurnsInEveryOrderOverTreesThatMove) {
    const std::vector<mobb::ClipPtr> clips = two_clips();
    const std::vector<FitTrees> fits{trees_of_fit(clips, {.leaf = 2}), trees_of_fit(clips, {.leaf = 5}),
                                     trees_of_fit(clips, {.leaf = 9}),
                                     trees_of_fit(clips, {.tree = mobb::TreeKind::blocks})};
    const QueryWorkload workload = standard_workload(clips, 5000, 1);
    for (const Protocol protocol : kProtocols) {
        std::vector<const mobb::Clip*> asked;
        std::vector<int> turns;
        std::map<int, std::set<const mobb::Node*>> places;
        std::map<int, std::size_t> queries;
        const FitTimer timer = [&](Protocol of, const FitTrees& trees, std::span<const ClipQuery> some,
                                   std::size_t stretch) {
            EXPECT_EQ(of, protocol);
            const mobb::FitOptions& fit = trees.front()->options();
            const int which = fit.tree == mobb::TreeKind::blocks ? 0 : fit.leaf;
            turns.push_back(which);
            places[which].insert(trees.front()->nodes().data());
            queries[which] += some.size();
            return same_times(some, stretch);
        };
        const FitTimes times = time_fits(fits, workload.queries, true, protocol, timer, [] {});
        EXPECT_GE(times.queries, 500u);
        std::set<std::vector<int>> orders;
        for (std::size_t i = 0; i + 4 <= turns.size(); i += 4) {
            std::vector<int> turn(turns.begin() + static_cast<std::ptrdiff_t>(i),
                                  turns.begin() + static_cast<std::ptrdiff_t>(i) + 4);
            orders.insert(turn);
            std::ranges::sort(turn);
            EXPECT_EQ(turn, (std::vector<int>{0, 2, 5, 9})) << "each has its turn at each block";
        }
        EXPECT_GE(orders.size(), 8u) << "of 24";
        for (const auto& [which, count] : queries)
            EXPECT_EQ(count, (protocol == Protocol::warm ? 11 : 5) * times.queries) << "rounds";
        for (const auto& [which, nodes] : places) EXPECT_GE(nodes.size(), 2u) << which;
    }
}

TEST(FitTiming, ASlowSpellOfTheMachineCostsNoFit) {
    const std::vector<mobb::ClipPtr> clips = two_clips();
    const std::vector<FitTrees> fits{trees_of_fit(clips, {.leaf = 2}), trees_of_fit(clips, {.leaf = 9})};
    const QueryWorkload workload = standard_workload(clips, 4096, 1);
    int turn = 0;
    const FitTimer timer = [&](Protocol, const FitTrees& trees, std::span<const ClipQuery> some, std::size_t stretch) {
        std::vector<double> out = same_times(some, stretch);
        // Slower from block to block.
        for (double& ns : out) ns *= (trees.front()->options().leaf == 2 ? 1 : 1.1) * (1 + 0.1 * (turn / 2));
        ++turn;
        return out;
    };
    const std::vector<FitTime> times = time_fits(fits, workload.queries, true, Protocol::warm, timer, [] {}).fits;
    EXPECT_NEAR(times[1].ns / times[0].ns, 1.1, 1e-6);
    EXPECT_TRUE(times[0].beats(times[1]));
}

TEST(FitTiming, EveryStretchIsTimed) {
    const std::vector<mobb::ClipPtr> clips = two_clips();
    const QueryWorkload workload = standard_workload(clips, 100, 1);
    for (const mobb::TreeKind kind : {mobb::TreeKind::umobb, mobb::TreeKind::blocks}) {
        const FitTrees trees = trees_of_fit(clips, {.tree = kind});
        for (const Protocol protocol : kProtocols) {
            const std::vector<double> times = time_queries(protocol, trees, workload.queries, 30);
            ASSERT_EQ(times.size(), 4u);
            // A query that the clock sees as nothing at all is none.
            for (const double ns : times) EXPECT_GT(ns, 0) << mobb::name(kind) << ' ' << name(protocol);
        }
    }
}

}  // namespace
}  // namespace mobbscope
