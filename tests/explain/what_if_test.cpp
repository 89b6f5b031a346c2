// A node that is other, measured: against trees that were fitted with other options as a whole.
#include <explain/what_if.h>
#include <mobb/query.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "mobb/random_motion.h"

namespace mobbscope {
namespace {

using mobb::TreeKind;
using TreePtr = std::shared_ptr<const mobb::Tree>;

/// Around a corner: its boxes have waste.
mobb::ClipPtr walk_around_a_corner(int count) {
    std::vector<mobb::Disk> samples;
    for (int i = 0; i < count; ++i) {
        const double way = 6.0 * i / count;
        samples.push_back({std::min(way, 4.5), std::max(0.0, way - 4.5), 0.3 + 0.05 * std::sin(0.4 * i)});
    }
    return std::make_shared<const mobb::Clip>(1.0 / 30, std::move(samples));
}

QueryWorkload placements(const mobb::ClipPtr& clip, std::size_t count) {
    return standard_workload(std::array{clip}, count, 7);
}

const NodeVariant* find(const WhatIf& found, const std::string& words) {
    for (const NodeVariant& variant : found.variants) {
        if (change_words(*found.variants.front().tree, variant.change) == words) return &variant;
    }
    ADD_FAILURE() << "there is no " << words;
    return nullptr;
}

/// The variant of the root makes the tree of other options as a whole.
void expect_rebuild(const mobb::FitOptions& options, const std::string& words, const mobb::FitOptions& rebuilt) {
    const mobb::ClipPtr clip = walk_around_a_corner(120);
    const QueryWorkload workload = placements(clip, 4000);
    const std::array<TreePtr, 1> present{std::make_shared<const mobb::Tree>(clip, options)};
    const std::array<TreePtr, 1> other{std::make_shared<const mobb::Tree>(clip, rebuilt)};
    const WhatIf found = what_if(workload, present, 0, 0);
    const NodeVariant* variant = find(found, words);
    if (!variant) return;
    const std::vector<mobb::TestCounts> before = count_tests(workload, present), after = count_tests(workload, other);
    EXPECT_EQ(variant->tests.by_kind, mean_tests(after).by_kind) << words;
    EXPECT_EQ(found.variants.front().tests.by_kind, mean_tests(before).by_kind) << words;
    std::vector<double> differences;
    for (std::size_t i = 0; i < before.size(); ++i) differences.push_back(cost_of(after[i]) - cost_of(before[i]));
    EXPECT_EQ(variant->difference.mean, spread_of(differences).mean) << words;
    EXPECT_EQ(variant->difference.standard_error, spread_of(differences).standard_error) << words;
    EXPECT_NE(variant->difference.mean, 0) << words;
}

TEST(WhatIf, EqualsAFullRebuild) {
    expect_rebuild({.tree = TreeKind::mobb}, "3D box", {.tree = TreeKind::hybrid2});
    expect_rebuild({.tree = TreeKind::umobb}, "2D box", {.tree = TreeKind::hybrid1});
    expect_rebuild({.tree = TreeKind::hybrid1}, "3D box", {.tree = TreeKind::umobb});
    for (const TreeKind kind : {TreeKind::mobb, TreeKind::umobb, TreeKind::moving}) {
        const mobb::FitOptions leaf{.tree = kind, .leaf = 200};
        for (const mobb::Axes axes : {mobb::Axes::covariance, mobb::Axes::minarea}) {
            expect_rebuild(leaf, "axes " + std::string(name(axes)), {.tree = kind, .leaf = 200, .axes = axes});
        }
        expect_rebuild(leaf, "split 60 + 60", {.tree = kind, .leaf = 60});
        expect_rebuild({.tree = kind, .leaf = 60}, "a leaf", {.tree = kind, .leaf = 200});
    }
}

TEST(WhatIf, MeasuresEveryVariantOfEveryNode) {
    const mobb::ClipPtr clip = walk_around_a_corner(100);
    const QueryWorkload workload = placements(clip, 300);
    for (const mobb::TreeKind kind : mobb::kTreeKinds) {
        const std::array<TreePtr, 1> trees{std::make_shared<const mobb::Tree>(clip, mobb::FitOptions{.tree = kind})};
        const auto nodes = static_cast<int>(trees[0]->nodes().size());
        if (trees[0]->blocks()) {
            EXPECT_TRUE(node_changes(*trees[0], 0).empty());
            EXPECT_THROW(what_if(workload, trees, 0, 0), std::invalid_argument);
            continue;
        }
        for (const int node : {0, 1, nodes / 2, nodes - 1}) {
            std::size_t told = 0;
            const WhatIf found = what_if(workload, trees, 0, node, [&](std::size_t done, std::size_t all) {
                EXPECT_LE(done, all);
                told = all;
            });
            EXPECT_EQ(found.variants.size(), 1 + node_changes(*trees[0], node).size());
            EXPECT_EQ(told, workload.queries.size() * found.variants.size());
            EXPECT_EQ(found.variants.front().difference.mean, 0);
            EXPECT_EQ(found.variants.front().difference.standard_error, 0);
            for (const NodeVariant& variant : found.variants) {
                EXPECT_NEAR(variant.cost, found.variants.front().cost + variant.difference.mean, 1e-9 * variant.cost);
                EXPECT_GT(variant.volume, 0);
                EXPECT_EQ(variant.children > 0, !variant.tree->is_leaf(node));
                // Answers are those of the tree as it is, bit for bit.
                for (std::size_t i = 0; i < workload.queries.size(); ++i) {
                    const ClipQuery& asked = workload.queries[i];
                    const mobb::PlacedTree a(*trees[0], asked.place_a), b(*trees[0], asked.place_b);
                    const mobb::PlacedTree other_a(*variant.tree, asked.place_a), other_b(*variant.tree, asked.place_b);
                    ASSERT_EQ(mobb::query(a, b), mobb::query(other_a, other_b));
                }
            }
        }
        EXPECT_THROW(what_if(workload, trees, 0, nodes), std::invalid_argument);
        EXPECT_THROW(what_if(workload, trees, 0, -1), std::invalid_argument);
    }
}

TEST(WhatIf, ATighterSplitThanTheMiddleCostsLess) {
    // 90 samples go straight on, then 30 to the side.
    const mobb::ClipPtr clip = walk_around_a_corner(120);
    const std::array<TreePtr, 1> trees{std::make_shared<const mobb::Tree>(clip, mobb::FitOptions{.leaf = 60})};
    const WhatIf found = what_if(placements(clip, kWhatIfQueries), trees, 0, 0);
    const NodeVariant& present = found.variants.front();
    const NodeVariant* tightest = nullptr;
    for (const NodeVariant& variant : found.variants) {
        if (variant.change.split.value_or(0) > 0 && (!tightest || variant.children < tightest->children))
            tightest = &variant;
    }
    ASSERT_TRUE(tightest);
    EXPECT_GT(*tightest->change.split, 60);
    EXPECT_LT(*tightest->change.split, 90);
    EXPECT_LT(tightest->children, 0.9 * present.children);
    EXPECT_LT(tightest->difference.mean, -3 * tightest->difference.standard_error);
    EXPECT_LE(found.best().cost, tightest->cost);
    EXPECT_NE(&found.best(), &present);
}

TEST(WhatIf, KeepsTheNodeWhereNothingIsBetter) {
    const auto clip = std::make_shared<const mobb::Clip>(0.1, std::vector<mobb::Disk>(50, {0, 0, 0.3}));
    const std::array<TreePtr, 1> trees{std::make_shared<const mobb::Tree>(clip, mobb::FitOptions{.leaf = 50})};
    const WhatIf found = what_if(placements(clip, 2000), trees, 0, 0);
    EXPECT_EQ(&found.best(), &found.variants.front());
    EXPECT_EQ(change_words(*trees[0], found.best().change), "as it is");
}

TEST(WhatIf, SaysWhatIsTried) {
    const mobb::ClipPtr clip = walk_around_a_corner(40);
    const auto words_of = [&](const mobb::FitOptions& options, int node) {
        const mobb::Tree tree(clip, options);
        std::vector<std::string> out;
        for (const mobb::NodeChange& change : node_changes(tree, node)) out.push_back(change_words(tree, change));
        return out;
    };
    using Words = std::vector<std::string>;
    EXPECT_EQ(words_of({.leaf = 20}, 1), (Words{"axes covariance", "axes minarea", "3D box", "split 10 + 10"}));
    EXPECT_EQ(words_of({.tree = TreeKind::aabb, .leaf = 20, .levels = 2}, 1), Words{});
    EXPECT_EQ(words_of({.tree = TreeKind::moving, .leaf = 20, .levels = 2, .axes = mobb::Axes::minarea}, 1),
              (Words{"axes endpoints", "axes covariance"}));
    const Words root = words_of({.leaf = 20}, 0);
    EXPECT_EQ(root.back(), "a leaf");
    EXPECT_NE(std::ranges::find(root, "split 10 + 30"), root.end());
    EXPECT_NE(std::ranges::find(root, "split 30 + 10"), root.end());
}

}  // namespace
}  // namespace mobbscope
