// What a tree costs: counted in standard placements and divided as expected, and in a scene's queries.
#include <explain/expected_cost.h>
#include <explain/tree_cost.h>
#include <scene/fitted_scene.h>
#include <support/folders.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <numeric>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mobb/random_motion.h"

namespace mobbscope {
namespace {

FittedScene crossing_with(mobb::TreeKind kind) {
    mobb::FitOptions fit;
    fit.tree = kind;
    return {load_scene(kCrossing), fit};
}

/// The same placements, each of them asked.
std::vector<mobb::TestCounts> asked_again(const std::shared_ptr<const mobb::Tree>& tree, std::size_t count,
                                          std::uint64_t seed = kCountedSeed) {
    return count_tests(standard_workload(std::array{tree->shared_clip()}, count, seed), std::span(&tree, 1));
}

/// Also of those placements that are far apart, which are not asked.
TEST(TreeCost, IsTheMeanOfStandardPlacements) {
    mobb::test::Random random(53);
    for (const mobb::TreeKind kind : mobb::kTreeKinds) {
        if (mobb::info(kind).has_blocks()) continue;
        for (int round = 0; round < 3; ++round) {
            const mobb::FitOptions fit{.tree = kind, .leaf = random.integer(1, 20)};
            const auto clip = mobb::test::random_motion(random, mobb::test::random_clip(random, 200));
            const auto tree = std::make_shared<const mobb::Tree>(clip, fit);
            const auto cost = standard_cost(tree, 10'000);
            ASSERT_TRUE(cost);
            EXPECT_EQ(cost->tree, tree);
            EXPECT_EQ(cost->workload, QueryWorkload::Kind::placements);
            const std::vector<mobb::TestCounts> tests = asked_again(tree, cost->queries);
            const MeanTests mean = mean_tests(tests);
            for (const mobb::TestKind test : mobb::kTestKinds)
                EXPECT_DOUBLE_EQ(cost->tests[test], mean[test]) << mobb::name(kind) << ' ' << round;
            std::vector<double> boxes, pairs;
            for (const mobb::TestCounts& each : tests) {
                boxes.push_back(static_cast<double>(each.boxes()));
                pairs.push_back(static_cast<double>(each[mobb::TestKind::samples]));
            }
            double error = 0;
            for (const Spread& spread : {spread_of(boxes), spread_of(pairs)})
                if (spread.mean > 0) error = std::max(error, spread.standard_error / spread.mean);
            EXPECT_NEAR(cost->count.standard_error(), error, 1e-9 + 1e-6 * error) << mobb::name(kind);
        }
    }
}

/// There the slack of box tests is wider than the room between roots.
TEST(TreeCost, IsOfEachPlacementWhereSlackIsWide) {
    std::vector<mobb::Disk> walk, point;
    for (int i = 0; i < 60; ++i) walk.push_back({5e5 + 0.05 * i, 5.9e6, 0.3});
    point.assign(60, {1, 2, 0});
    for (const std::vector<mobb::Disk>& disks : {walk, point}) {
        const auto clip = std::make_shared<const mobb::Clip>(0.1, disks, mobb::Motion::linear);
        for (const mobb::TreeKind kind : mobb::kTreeKinds) {
            if (mobb::info(kind).has_blocks()) continue;
            const auto tree = std::make_shared<const mobb::Tree>(clip, mobb::FitOptions{.tree = kind});
            const auto cost = standard_cost(tree, 5000);
            ASSERT_TRUE(cost);
            const MeanTests mean = mean_tests(asked_again(tree, cost->queries));
            for (const mobb::TestKind test : mobb::kTestKinds)
                EXPECT_DOUBLE_EQ(cost->tests[test], mean[test]) << mobb::name(kind);
        }
    }
}

TEST(TreeCost, IsCountedUntilItsErrorsAreSmall) {
    const auto tree = crossing_with(mobb::TreeKind::mobb).shared_tree(1);
    const auto cost = standard_cost(tree);
    ASSERT_TRUE(cost);
    EXPECT_LT(cost->count.standard_error(), 0.005);
    EXPECT_GT(cost->queries, 100'000u);
    EXPECT_EQ(standard_cost(tree, 50'000)->queries, 50'000u) << "but no more than that";
}

TEST(TreeCost, IsCountedOn) {
    const auto tree = crossing_with(mobb::TreeKind::umobb).shared_tree(0);
    const auto first = counted_on(tree, nullptr, 10'000);
    ASSERT_TRUE(first);
    EXPECT_EQ(first->queries, kFirstCounted);
    std::size_t told = 0;
    const auto second = counted_on(tree, first.get(), 10'000, [&](std::size_t done, std::size_t all) {
        told = done;
        EXPECT_LE(done, all);
    });
    EXPECT_EQ(second->queries, 2 * kFirstCounted);
    EXPECT_EQ(told, kFirstCounted);
    const auto whole = standard_cost(tree, 10'000);
    EXPECT_EQ(whole->queries, 10'000u);
    EXPECT_EQ(counted_on(tree, second.get(), 10'000)->tests.by_kind, whole->tests.by_kind);
}

TEST(TreeCost, IsDividedAsExpected) {
    const auto tree = crossing_with(mobb::TreeKind::hybrid1).shared_tree(1);
    const auto cost = standard_cost(tree, 20'000);
    const ExpectedCost expected = expected_cost(*tree, *tree).value();
    EXPECT_EQ(cost->expected->tests.by_kind, expected.tests.by_kind);
    EXPECT_EQ(cost->shares, expected.node_shares());
    ASSERT_EQ(cost->levels.size(), expected.levels.size());
    MeanTests all;
    for (std::size_t i = 0; i < cost->levels.size(); ++i) {
        all += cost->levels[i];
        for (const mobb::TestKind test : mobb::kTestKinds)
            EXPECT_NEAR(cost->levels[i][test] * expected.tests[test], expected.levels[i][test] * cost->tests[test],
                        1e-12);
    }
    for (const mobb::TestKind test : mobb::kTestKinds) EXPECT_NEAR(all[test], cost->tests[test], 1e-12);
    EXPECT_NEAR(cost->ns(all), cost->ns(), 1e-9);
    EXPECT_NEAR(cost->part(cost->levels[0]), cost_of(cost->levels[0]) / cost_of(cost->tests), 1e-12);
}

TEST(TreeCost, OfBlocksIsNotKnown) {
    const auto tree = crossing_with(mobb::TreeKind::blocks).shared_tree(0);
    EXPECT_FALSE(standard_cost(tree));
    EXPECT_NE(why_no_cost(*tree).find("Blocks are not counted"), std::string_view::npos);
    EXPECT_EQ(why_no_cost(crossing_with(mobb::TreeKind::mobb).tree(0)), "");
}

TEST(TreeCost, OfAClipThatCannotBePlacedIsNotKnown) {
    const auto tree = std::make_shared<const mobb::Tree>(
        std::make_shared<const mobb::Clip>(0.1, std::vector<mobb::Disk>{{mobb::kMaxLength, 0, 1}}), mobb::FitOptions{});
    EXPECT_FALSE(standard_cost(tree));
    EXPECT_NE(why_no_cost(*tree), "");
}

TEST(TreeCost, IsCountedOfManyClipsInSeconds) {
    EXPECT_EQ(most_counted(1), most_counted(4));
    EXPECT_LT(most_counted(100), most_counted(4));
    EXPECT_GE(most_counted(100'000), 100'000u);
}

/// What is shown is within 2 % of a million other placements.
TEST(TreeCost, OfRecordingsIsWhatAMillionPlacementsCost) {
    const std::string folder = kSharedData / "bvh/";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no recordings in " << folder;
    for (const char* file : {"long/cmu_03_03_walk-uneven-terrain_amc30hz", "short/cmu_09_01_run_120hz"}) {
        const Scene scene = load_scene(folder + file + ".bvh");
        const auto tree = std::make_shared<const mobb::Tree>(scene.clips.front().clip, mobb::FitOptions{});
        const auto cost = standard_cost(tree);
        const MeanTests mean = mean_tests(asked_again(tree, 1'000'000, 53));
        EXPECT_NEAR(cost->ns(), cost_of(mean), 0.02 * cost_of(mean)) << file;
        EXPECT_NEAR(cost->tests.boxes(), mean.boxes(), 0.02 * mean.boxes()) << file;
    }
}

TEST(TreeCost, OfASceneIsTheMeanOfItsQueries) {
    for (const mobb::TreeKind kind : {mobb::TreeKind::mobb, mobb::TreeKind::umobb, mobb::TreeKind::moving}) {
        const FittedScene fitted = crossing_with(kind);
        const SceneCosts counted = scene_costs(fitted);
        const std::array trees{fitted.shared_tree(0), fitted.shared_tree(1)};
        const MeanTests mean = mean_tests(count_tests(scene_workload(fitted.scene()), trees));
        double shares = 0;
        for (const int clip : {0, 1}) {
            const TreeCost cost = cost_in_scene(counted, clip, fitted.shared_tree(clip));
            EXPECT_EQ(cost.workload, QueryWorkload::Kind::queries);
            EXPECT_EQ(cost.queries, fitted.queries().size());
            MeanTests in_levels;
            for (const MeanTests& level : cost.levels) in_levels += level;
            for (const mobb::TestKind test : mobb::kTestKinds) {
                EXPECT_DOUBLE_EQ(cost.tests[test], mean[test]);
                EXPECT_NEAR(in_levels[test], mean[test], 1e-9);
            }
            ASSERT_EQ(cost.shares.size(), fitted.tree(clip).nodes().size());
            shares = std::accumulate(cost.shares.begin(), cost.shares.end(), shares);
        }
        EXPECT_NEAR(shares, 1, 1e-12) << "over all trees";
    }
}

}  // namespace
}  // namespace mobbscope
