#include <gtest/gtest.h>
#include <mobb/level_figures.h>
#include <mobb/random_motion.h>
#include <mobb/tree.h>

#include <algorithm>
#include <numbers>
#include <stdexcept>

namespace mobb {
namespace {

using test::Random;

TEST(Tree, SplitsAtTheMiddleSample) {
    Random random(4);
    for (int round = 0; round < 300; ++round) {
        const ClipPtr clip = test::random_clip(random, 400);
        const FitOptions options = test::random_fit(random);
        const Tree tree(clip, options);
        ASSERT_FALSE(tree.nodes().empty());
        EXPECT_EQ(tree.nodes()[0].parent, -1);
        EXPECT_EQ(tree.nodes()[0].count, clip->count());
        int depth = 0;
        for (int i = 0; i < static_cast<int>(tree.nodes().size()); ++i) {
            const Node& node = tree.nodes()[static_cast<std::size_t>(i)];
            depth = std::max(depth, node.level + 1);
            const bool last_level = options.levels > 0 && node.level == options.levels - 1;
            EXPECT_EQ(node.is_leaf(), node.count <= options.leaf || last_level);
            if (node.is_leaf()) continue;
            const Node& first = tree.nodes()[static_cast<std::size_t>(node.children[0])];
            const Node& second = tree.nodes()[static_cast<std::size_t>(node.children[1])];
            EXPECT_EQ(first.first, node.first);
            EXPECT_EQ(first.count, (node.count + 1) / 2);
            EXPECT_EQ(second.first, first.end());
            EXPECT_EQ(second.end(), node.end());
            for (const Node* child : {&first, &second}) {
                EXPECT_EQ(child->parent, i);
                EXPECT_EQ(child->level, node.level + 1);
            }
        }
        EXPECT_EQ(depth, tree.depth());
        if (options.levels > 0) {
            EXPECT_LE(tree.depth(), options.levels);
        }
    }
}

TEST(Tree, OfBlocksHasTheirNumbersAndParents) {
    Random random(6);
    for (int round = 0; round < 200; ++round) {
        const ClipPtr clip = test::random_clip(random);
        const Tree tree(clip, {.tree = TreeKind::production});
        ASSERT_NE(tree.blocks(), nullptr);
        ASSERT_EQ(static_cast<int>(tree.nodes().size()), tree.blocks()->node_count());
        for (int i = 0; i < tree.blocks()->node_count(); ++i) {
            const Node& node = tree.nodes()[static_cast<std::size_t>(i)];
            EXPECT_EQ(node.box.kind, BoxKind::block);
            EXPECT_EQ(node.is_leaf(), node.level == tree.depth() - 1);
            if (node.is_leaf()) continue;
            int next = node.first;
            for (int child = node.children[0]; child <= node.children[1]; ++child) {
                const Node& below = tree.nodes()[static_cast<std::size_t>(child)];
                EXPECT_EQ(below.parent, i);
                EXPECT_EQ(below.first, next);
                EXPECT_EQ(tree.child_with(node, below.first), child);
                EXPECT_EQ(tree.child_with(node, below.end() - 1), child);
                next = below.end();
            }
            EXPECT_EQ(next, node.end());
        }
    }
}

TEST(Tree, PlacesInALevelCountThroughTime) {
    Random random(5);
    for (int round = 0; round < 50; ++round) {
        const Tree tree(test::random_clip(random, 400), test::random_any_fit(random));
        const auto nodes = tree.nodes();
        for (int i = 0; i < static_cast<int>(nodes.size()); ++i) {
            const Node& node = nodes[static_cast<std::size_t>(i)];
            EXPECT_EQ(tree.place_in_level(i), std::count_if(nodes.begin(), nodes.end(), [&](const Node& other) {
                          return other.level == node.level && other.first < node.first;
                      }));
        }
    }
}

TEST(Tree, KindsSayWhichBoxesStandWhere) {
    std::vector<Disk> walk;
    for (int i = 0; i < 64; ++i) walk.push_back({0.1 * i, 0.01 * i * i, 0.4});
    const auto clip = std::make_shared<const Clip>(0.1, walk);
    for (const TreeKind kind :
         {TreeKind::mobb, TreeKind::umobb, TreeKind::hybrid1, TreeKind::hybrid2, TreeKind::moving, TreeKind::aabb}) {
        const Tree tree(clip, {.tree = kind});
        for (const Node& node : tree.nodes()) {
            const bool root = node.level == 0;
            const bool free =
                kind == TreeKind::umobb || (kind == TreeKind::hybrid1 && !root) || (kind == TreeKind::hybrid2 && root);
            const BoxKind expected = kind == TreeKind::moving ? BoxKind::moving
                                     : kind == TreeKind::aabb ? BoxKind::aabb
                                     : free                   ? BoxKind::obb3d
                                                              : BoxKind::obb2d;
            EXPECT_EQ(node.box.kind, expected) << name(kind);
        }
    }
}

TEST(Tree, RefusesOptionsOutOfRange) {
    const auto clip = std::make_shared<const Clip>(1, std::vector<Disk>{{0, 0, 1}});
    EXPECT_THROW(Tree(nullptr, {}), std::invalid_argument);
    EXPECT_THROW(Tree(clip, {.tree = static_cast<TreeKind>(9)}), std::invalid_argument);
    EXPECT_THROW(Tree(clip, {.axes = static_cast<Axes>(9)}), std::invalid_argument);
    EXPECT_THROW(Tree(clip, {.leaf = 0}), std::invalid_argument);
    EXPECT_THROW(Tree(clip, {.levels = -1}), std::invalid_argument);
    EXPECT_THROW(Tree(clip, {.time_scale = 0}), std::invalid_argument);
    EXPECT_THROW(Tree(clip, {.time_scale = std::nan("")}), std::invalid_argument);
}

TEST(Tree, LevelFiguresCoverTheWholeClip) {
    // 11 samples, leaf 5: 6 + 5; then 3 + 3 below the first only.
    std::vector<Disk> walk;
    for (int i = 0; i < 11; ++i) walk.push_back({double(i), 0, 0.5});
    const auto clip = std::make_shared<const Clip>(0.1, walk);
    const Tree tree(clip, {.leaf = 5});
    const std::vector<LevelFigures> levels = level_figures(tree);
    ASSERT_EQ(levels.size(), 3u);
    EXPECT_EQ(levels[0].nodes, 1);
    EXPECT_EQ(levels[1].nodes, 2);
    EXPECT_EQ(levels[2].nodes, 3);
    EXPECT_NEAR(levels[0].volume, 11 * 1 * 1.1, 1e-12);
    EXPECT_NEAR(levels[1].volume, 6 * 1 * 0.6 + 5 * 1 * 0.5, 1e-12);
    EXPECT_NEAR(levels[2].volume, 2 * 3 * 1 * 0.3 + 5 * 1 * 0.5, 1e-12);
    EXPECT_NEAR(*levels[0].tightness, 11 * std::numbers::pi * 0.25 * 0.1 / 12.1, 1e-12);
}

TEST(Tree, TightnessIsAbsentWhereBoxesHaveNoVolume) {
    const auto clip = std::make_shared<const Clip>(0.1, std::vector<Disk>{{0, 0, 0}, {1, 0, 0}});
    EXPECT_FALSE(level_figures(Tree(clip, {}))[0].tightness.has_value());
}

TEST(Tree, VolumeOfFreeBoxesIsInSquareMetreSeconds) {
    const auto clip = std::make_shared<const Clip>(0.1, std::vector<Disk>{{3, 4, 0.5}});
    for (const double w : {0.5, 1.0, 4.0}) {
        const Tree tree(clip, {.tree = TreeKind::umobb, .time_scale = w});
        EXPECT_NEAR(level_figures(tree)[0].volume, 0.1, 1e-15);
    }
}

TEST(Names, RoundTrip) {
    for (const std::string_view n : tree_kind_names()) EXPECT_EQ(name(*tree_kind_from_name(n)), n);
    for (const std::string_view n : axes_names()) EXPECT_EQ(name(*axes_from_name(n)), n);
    EXPECT_FALSE(tree_kind_from_name("MOBB").has_value());
}

}  // namespace
}  // namespace mobb
