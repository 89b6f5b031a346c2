// What a tree costs: as it is expected, as blocks are counted, and in a scene's queries.
#include <explain/expected_cost.h>
#include <explain/tree_cost.h>
#include <scene/fitted_scene.h>
#include <support/folders.h>

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

FittedScene crossing_with(mobb::TreeKind kind) {
    mobb::FitOptions fit;
    fit.tree = kind;
    return {load_scene(kCrossing), fit};
}

TEST(TreeCost, IsWhatIsExpected) {
    const auto tree = crossing_with(mobb::TreeKind::hybrid1).shared_tree(1);
    const TreeCost cost = standard_cost(tree);
    const ExpectedCost expected = expected_cost(*tree, *tree).value();
    EXPECT_EQ(cost.tree, tree);
    EXPECT_EQ(cost.workload, QueryWorkload::Kind::placements);
    EXPECT_EQ(cost.queries, 0u);
    EXPECT_EQ(cost.area, expected.placements.area());
    EXPECT_EQ(cost.offset, expected.placements.offset);
    EXPECT_EQ(cost.tests.by_kind, expected.tests.by_kind);
    EXPECT_EQ(cost.bound.value().by_kind, expected.bound.by_kind);
    EXPECT_EQ(cost.shares, expected.node_shares());
    ASSERT_EQ(cost.levels.size(), expected.levels.size());
    double parts = 0;
    for (const MeanTests& level : cost.levels) parts += cost.part(level);
    EXPECT_NEAR(parts, 1, 1e-12);
    EXPECT_NEAR(cost.part(cost.levels[0]), cost_of(cost.levels[0]) / cost_of(cost.tests), 1e-12);
}

TEST(TreeCost, BlocksAreCounted) {
    const auto tree = crossing_with(mobb::TreeKind::blocks).shared_tree(0);
    const TreeCost cost = standard_cost(tree);
    const std::array clips{tree->shared_clip()};
    const QueryWorkload workload = standard_workload(clips, kCountedPlacements, kCountedSeed);
    EXPECT_EQ(cost.queries, workload.queries.size());
    EXPECT_EQ(cost.area, workload.area);
    EXPECT_EQ(cost.tests.by_kind, mean_tests(count_tests(workload, std::span(&tree, 1))).by_kind);
    EXPECT_TRUE(cost.levels.empty());
    EXPECT_TRUE(cost.shares.empty());
    EXPECT_EQ(cost.ns(cost.tests), cost_of(cost.tests, kBlockTestPrices)) << "blocks have prices of their own";
    MeanTests half = cost.tests;
    for (double& tests : half.by_kind) tests /= 2;
    EXPECT_NEAR(cost.part(half), 0.5, 1e-12);
}

TEST(TreeCost, OfASceneIsTheMeanOfItsQueries) {
    for (const mobb::TreeKind kind : {mobb::TreeKind::mobb, mobb::TreeKind::umobb, mobb::TreeKind::blocks}) {
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
