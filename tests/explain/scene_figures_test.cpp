// The figures of a scene's nodes: what is kept of them, and which fit's counts they have.
#include <explain/scene_figures.h>
#include <support/folders.h>

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

std::shared_ptr<const FittedScene> crossing_fitted(mobb::TreeKind kind, int leaf) {
    mobb::FitOptions fit;
    fit.tree = kind;
    fit.leaf = leaf;
    return std::make_shared<const FittedScene>(load_scene(kCrossing), fit);
}

double tests_of(const SceneCosts& costs, TreeNode node) {
    for (const NodeCost& cost : costs.nodes) {
        if (cost.at == node) return static_cast<double>(cost.boxes);
    }
    return 0;
}

TEST(SceneFigures, TreesThatNobodyHasAreForgotten) {
    SceneFigures figures;
    std::vector<std::weak_ptr<const mobb::Tree>> old;
    for (const int leaf : {4, 5, 6}) {
        const auto fitted = crossing_fitted(mobb::TreeKind::mobb, leaf);
        for (const auto& tree : old) EXPECT_FALSE(tree.expired()) << "until something else is kept";
        const auto clips = static_cast<int>(fitted->scene().clips.size());
        for (int clip = 0; clip < clips; ++clip) figures.of(fitted, clip, NodeField::volume);
        for (const auto& tree : old) EXPECT_TRUE(tree.expired()) << leaf;
        old.clear();
        for (int clip = 0; clip < clips; ++clip) old.push_back(fitted->shared_tree(clip));
    }
}

TEST(SceneFigures, AColumnStaysWhileSomebodyHasTheTree) {
    SceneFigures figures;
    const auto fitted = crossing_fitted(mobb::TreeKind::umobb, 4);
    const std::span<const double> volumes = figures.of(fitted, 0, NodeField::volume).column(NodeField::volume);
    const std::vector<double> before(volumes.begin(), volumes.end());
    for (int leaf = 5; leaf < 25; ++leaf) figures.of(crossing_fitted(mobb::TreeKind::umobb, leaf), 0, NodeField::share);
    EXPECT_EQ(figures.of(fitted, 0, NodeField::volume).column(NodeField::volume).data(), volumes.data());
    EXPECT_EQ(std::vector<double>(volumes.begin(), volumes.end()), before);
}

/// Two fits of a scene, each of which is seen through copies of its own.
struct BothFits {
    FittedScene all = crossing_fitted(mobb::TreeKind::mobb, 4)->with_fit("umobb", {.tree = mobb::TreeKind::umobb});
    std::array<SceneCosts, 2> costs{scene_costs(all.using_fit(0)), scene_costs(all.using_fit(1))};
    SceneFigures figures{SceneFigures::Counting::elsewhere};

    std::shared_ptr<const FittedScene> seen(std::size_t fit) const {
        return std::make_shared<const FittedScene>(all.using_fit(fit));
    }
    void take(std::size_t fit) {
        figures.take(seen(fit), std::make_shared<const SceneCosts>(costs[fit]),
                     std::make_shared<const BlameInScene>(blame_in(*seen(fit))));
    }
    void expect_tests(std::size_t fit) {
        const TreeNode node = costs[fit].nodes.front().at;
        const NodeValues& values = figures.of(seen(fit), node.clip, NodeField::tests);
        EXPECT_EQ(values.value(NodeField::tests, node.node), tests_of(costs[fit], node)) << fit;
        EXPECT_GT(values.value(NodeField::tests, node.node), 0);
        EXPECT_TRUE(figures.of(seen(fit), node.clip, NodeField::avoidable).has(NodeField::avoidable)) << fit;
        EXPECT_EQ(figures.heat_of(seen(fit)), NodeField::tests) << fit;
    }
};

TEST(SceneFigures, EachFitHasItsOwnCounts) {
    for (const std::size_t first : {0u, 1u}) {
        SCOPED_TRACE(first);
        const std::size_t second = 1 - first;
        BothFits both;
        both.take(first);
        both.expect_tests(first);
        EXPECT_EQ(both.figures.heat_of(both.seen(second)), NodeField::share) << "not counted yet";
        EXPECT_FALSE(both.figures.of(both.seen(second), 0, NodeField::tests).has(NodeField::tests));
        both.expect_tests(first);
        both.take(second);
        for (const std::size_t fit : {first, second, first}) both.expect_tests(fit);
        both.figures.take(both.seen(first), nullptr, nullptr);
        EXPECT_FALSE(both.figures.of(both.seen(first), 0, NodeField::tests).has(NodeField::tests));
        both.expect_tests(second);
    }
}

TEST(SceneFigures, WhatIsCountedAnewHasAnotherRevision) {
    BothFits both;
    const std::int64_t before = both.figures.revision();
    both.figures.take(both.seen(0), nullptr, nullptr);
    EXPECT_EQ(both.figures.revision(), before) << "nothing was known, and nothing is";
    const auto costs = std::make_shared<const SceneCosts>(both.costs[0]);
    both.figures.take(both.seen(0), costs, nullptr);
    const std::int64_t counted = both.figures.revision();
    EXPECT_NE(counted, before);
    both.figures.take(both.seen(0), costs, nullptr);
    EXPECT_EQ(both.figures.revision(), counted);
}

}  // namespace
}  // namespace mobbscope
