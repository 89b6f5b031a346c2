// Fits of a clip side by side: figures by level, which is better, and the sentence that says so.
#include <explain/compared_fits.h>
#include <explain/tree_cost.h>
#include <mobb/level_figures.h>
#include <scene/fitted_scene.h>
#include <support/folders.h>

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope {
namespace {

using Trees = std::vector<std::shared_ptr<const mobb::Tree>>;
using Costs = std::vector<std::shared_ptr<const TreeCost>>;

Trees trees_of(const std::vector<mobb::FitOptions>& fits, const std::string& scene = "crossing.json") {
    const FittedScene fitted(load_scene(kScenes / scene), fits.front());
    Trees out;
    for (const mobb::FitOptions& fit : fits)
        out.push_back(std::make_shared<const mobb::Tree>(fitted.tree(0).shared_clip(), fit));
    return out;
}

Costs standard_costs(const Trees& trees) {
    Costs out;
    for (const auto& tree : trees) out.push_back(standard_cost(tree, 20'000));
    return out;
}

/// Levels with these volumes, by fit; the last is that of the leaves.
ComparedFits made_up(std::vector<std::string> names, const std::vector<std::vector<double>>& volumes,
                     const std::vector<double>& costs) {
    ComparedFits out{std::move(names), {}, {}, {}};
    const auto figure = [](const std::vector<double>& of) {
        ComparedFigure made;
        made.values.assign(of.begin(), of.end());
        find_best(made, Better::less);
        return made;
    };
    for (const std::vector<double>& level : volumes)
        out.levels.push_back({static_cast<int>(out.levels.size()), figure(level), {}, {}});
    out.leaves.volume = out.levels.back().volume;
    out.cost = figure(costs);
    return out;
}

TEST(ComparedFits, HaveTheFiguresOfEachTree) {
    const Trees trees = trees_of({{.tree = mobb::TreeKind::mobb}, {.tree = mobb::TreeKind::umobb}});
    const Costs costs = standard_costs(trees);
    const ComparedFits both = compared(trees, costs);
    EXPECT_EQ(both.names, (std::vector<std::string>{"MOBB", "UMOBB"}));
    for (std::size_t fit = 0; fit < 2; ++fit) {
        const std::vector<mobb::LevelFigures> figures = mobb::level_figures(*trees[fit]);
        ASSERT_EQ(both.levels.size(), figures.size());
        double sum = 0;
        for (std::size_t i = 0; i < figures.size(); ++i) {
            EXPECT_EQ(both.levels[i].volume.values[fit], figures[i].volume);
            EXPECT_EQ(both.levels[i].fill.values[fit], figures[i].tightness);
            sum += both.levels[i].cost.values[fit].value();
        }
        EXPECT_EQ(both.leaves.volume.values[fit], figures.back().volume);
        EXPECT_EQ(both.cost.values[fit], costs[fit]->ns(costs[fit]->tests));
        EXPECT_NEAR(sum, *both.cost.values[fit], 1e-9 * sum) << "the levels are all of the cost";
    }
    EXPECT_FALSE(both.differ_in_depth());
    for (const ComparedLevel& level : both.levels) {
        const double mobb = *level.volume.values[0], umobb = *level.volume.values[1];
        ASSERT_GT(std::abs(mobb - umobb), 0.01 * mobb);
        EXPECT_EQ(level.volume.best, umobb < mobb ? 1 : 0) << level.level;
        EXPECT_EQ(level.fill.best, level.volume.best) << "the disks are the same";
        EXPECT_NEAR(level.volume.difference(1).value(), umobb / mobb - 1, 1e-12);
        EXPECT_EQ(level.volume.difference(0), 0.0);
    }
}

TEST(ComparedFits, OfOtherDepthsHaveARowOfLeaves) {
    const Trees trees = trees_of({{.leaf = 10}, {.leaf = 40}, {.tree = mobb::TreeKind::blocks}});
    const ComparedFits all = compared(trees, standard_costs(trees));
    EXPECT_EQ(all.names[0], "MOBB, leaf 10");
    EXPECT_EQ(all.names[1], "MOBB, leaf 40");
    ASSERT_EQ(static_cast<int>(all.levels.size()), trees[0]->depth());
    EXPECT_TRUE(all.differ_in_depth());
    const ComparedLevel& last = all.levels.back();
    EXPECT_TRUE(last.volume.values[0]);
    EXPECT_FALSE(last.volume.values[1]);
    EXPECT_EQ(all.levels[1].volume.difference(1), 0.0) << "the same boxes";
    EXPECT_EQ(all.leaves.volume.values[1], mobb::level_figures(*trees[1]).back().volume);
    EXPECT_FALSE(all.cost.values[2]) << "blocks are not counted";
    EXPECT_FALSE(all.levels[0].cost.values[2]);
}

TEST(ComparedFits, WithoutCostsSayHowTightTheyAre) {
    const Trees trees = trees_of({{.tree = mobb::TreeKind::mobb}, {.tree = mobb::TreeKind::moving}});
    const ComparedFits both = compared(trees, Costs(2));
    EXPECT_FALSE(both.cost.values[0]);
    EXPECT_EQ(both.cost.best, -1);
    EXPECT_EQ(verdict(both).find("cost"), std::string::npos) << verdict(both);
    const Costs known = standard_costs(trees);
    EXPECT_NE(verdict(compared(trees, known)).find("cost"), std::string::npos);
}

TEST(ComparedFits, TheVerdictIsHonest) {
    using Names = std::vector<std::string>;
    const Names two{"MOBB", "moving"};
    EXPECT_EQ(verdict(made_up(two, {{10, 9}, {8, 7}, {4, 3}}, {100, 70})),
              "moving is tighter on all levels (25 % less volume at the leaves) and costs 30 % less a query.");
    EXPECT_EQ(verdict(made_up(two, {{10, 9}, {8, 7}, {4, 3}}, {70, 100})),
              "moving is tighter on all levels (25 % less volume at the leaves), but MOBB costs 30 % less a query.");
    EXPECT_EQ(verdict(made_up(two, {{9, 10}, {7, 8}, {5, 6}, {4, 3}}, {100, 70})),
              "MOBB is tighter on levels 0 to 2 and moving on level 3 (moving has 25 % less volume at the leaves); "
              "moving costs 30 % less a query.");
    EXPECT_EQ(verdict(made_up(two, {{10, 10}, {8, 7}}, {5, 5})),
              "moving is tighter on level 1 (12 % less volume at the leaves); both cost about the same.");
    EXPECT_EQ(verdict(made_up(two, {{10, 10}}, {5, 5})), "Both are equally tight and cost about the same.");
    EXPECT_EQ(verdict(made_up({"MOBB", "UMOBB", "moving"}, {{3, 3, 3}}, {5, 5, 5})), "No fit is tightest or cheapest.");
    EXPECT_EQ(verdict(made_up({"MOBB", "UMOBB", "moving"}, {{3, 2, 1}, {3, 2, 1}}, {30, 20, 10})),
              "moving is tightest on all levels (50 % less volume at the leaves) and costs 50 % less a query.");
}

TEST(ComparedFits, WhatDiffersByHalfAPercentIsAlike) {
    const auto best_of = [](std::vector<std::optional<double>> values, Better better) {
        ComparedFigure figure{std::move(values)};
        find_best(figure, better);
        return figure.best;
    };
    EXPECT_EQ(best_of({1000, 995.1}, Better::less), -1);
    EXPECT_EQ(best_of({1000, 994.9}, Better::less), 1);
    EXPECT_EQ(best_of({1000, 1004.9}, Better::more), -1);
    EXPECT_EQ(best_of({1000, 1005.1}, Better::more), 1);
    EXPECT_EQ(best_of({1000, 994.9, 994.8}, Better::less), -1) << "the next one is as good";
    EXPECT_EQ(best_of({1000, std::nullopt}, Better::less), -1) << "there is nothing to compare";
}

TEST(ComparedFits, CostsThatMayDifferByChanceAreAlike) {
    const Trees trees = trees_of({{.leaf = 10}, {.leaf = 40}});
    const std::shared_ptr<const TreeCost> known = standard_cost(trees[0]);
    const auto best_of_more = [&](double part) {
        TreeCost more = *known;
        for (double& tests : more.tests.by_kind) tests *= 1 + part;
        return compared(trees, Costs{std::make_shared<const TreeCost>(more), known}).cost.best;
    };
    const double error = known->count.standard_error();
    EXPECT_EQ(best_of_more(4 * error), -1);
    EXPECT_EQ(best_of_more(5 * error), 1);
}

TEST(ComparedFits, ANodeIsFoundInAnotherTreeByItsSamples) {
    const Trees trees = trees_of({{.leaf = 10},
                                  {.tree = mobb::TreeKind::umobb, .leaf = 10},
                                  {.tree = mobb::TreeKind::moving, .leaf = 40},
                                  {.tree = mobb::TreeKind::blocks}});
    const mobb::Tree& fine = *trees[0];
    for (int node = 0; node < static_cast<int>(fine.nodes().size()); ++node) {
        EXPECT_EQ(node_over_same_samples(fine, node, *trees[1]), node) << "halved alike";
        const mobb::Node& coarse = trees[2]->node(node_over_same_samples(fine, node, *trees[2]));
        EXPECT_LE(coarse.first, fine.node(node).first);
        EXPECT_GE(coarse.end(), fine.node(node).end()) << "the leaf that holds it";
        const mobb::Node& block = trees[3]->node(node_over_same_samples(fine, node, *trees[3]));
        EXPECT_LT(std::max(block.first, fine.node(node).first), std::min(block.end(), fine.node(node).end()));
    }
    EXPECT_EQ(node_over_same_samples(*trees[2], 0, fine), 0);
}

}  // namespace
}  // namespace mobbscope
