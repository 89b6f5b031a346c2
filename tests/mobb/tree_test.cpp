#include <gtest/gtest.h>
#include <mobb/level_figures.h>
#include <mobb/random_motion.h>
#include <mobb/tree.h>

#include <algorithm>
#include <cmath>
#include <cstring>
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
        EXPECT_EQ(tree.parent(0), -1);
        EXPECT_EQ(tree.nodes()[0].count, clip->count());
        int depth = 0;
        for (int i = 0; i < static_cast<int>(tree.nodes().size()); ++i) {
            const Node& node = tree.nodes()[static_cast<std::size_t>(i)];
            depth = std::max(depth, tree.level(i) + 1);
            const bool last_level = options.levels > 0 && tree.level(i) == options.levels - 1;
            EXPECT_EQ(node.is_leaf(), node.count <= options.leaf || last_level);
            if (node.is_leaf()) continue;
            const Node& first = tree.node(tree.children(i)[0]);
            const Node& second = tree.node(tree.children(i)[1]);
            EXPECT_EQ(first.first, node.first);
            EXPECT_EQ(first.count, (node.count + 1) / 2);
            EXPECT_EQ(second.first, first.end());
            EXPECT_EQ(second.end(), node.end());
            for (const int child : tree.children(i)) {
                EXPECT_EQ(tree.parent(child), i);
                EXPECT_EQ(tree.level(child), tree.level(i) + 1);
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
        const Tree tree(clip, {.tree = TreeKind::blocks});
        ASSERT_NE(tree.blocks(), nullptr);
        ASSERT_EQ(static_cast<int>(tree.nodes().size()), tree.blocks()->node_count());
        for (int i = 0; i < tree.blocks()->node_count(); ++i) {
            const Node& node = tree.node(i);
            EXPECT_EQ(tree.box(i).kind, BoxKind::block);
            EXPECT_EQ(tree.is_leaf(i), tree.level(i) == tree.depth() - 1);
            const auto [first, last] = tree.children(i);
            if (tree.is_leaf(i)) {
                EXPECT_EQ(first, -1);
                continue;
            }
            int next = node.first;
            for (int child = first; child <= last; ++child) {
                const Node& below = tree.node(child);
                EXPECT_EQ(tree.parent(child), i);
                EXPECT_EQ(below.first, next);
                EXPECT_EQ(tree.child_with(i, below.first), child);
                EXPECT_EQ(tree.child_with(i, below.end() - 1), child);
                next = below.end();
            }
            EXPECT_EQ(next, node.end());
        }
    }
}

TEST(Tree, CountsAllOfItsMemory) {
    Random random(8);
    const ClipPtr clip = test::random_clip(random, 2000);
    for (const std::string_view name : tree_kind_names()) {
        const Tree tree(clip, {.tree = *tree_kind_from_name(name)});
        const auto nodes = tree.nodes().size();
        // Where each node stands, and the boxes that are not upright, come on top.
        std::size_t bytes = nodes * (sizeof(Node) + 3 * sizeof(int)), boxes = 0;
        for (std::size_t i = 0; i < nodes; ++i) {
            if (!is_upright(tree.nodes()[i].kind)) boxes = i + 1;
        }
        bytes += boxes * sizeof(Box);
        if (tree.blocks()) {
            // Of a sample at least its centre and two radii, in single precision.
            EXPECT_GE(tree.blocks()->bytes(), static_cast<std::size_t>(clip->count()) * 4 * sizeof(float));
            bytes += tree.blocks()->bytes();
        }
        EXPECT_GE(tree.bytes(), bytes) << name;
        EXPECT_LE(tree.bytes(), bytes + (nodes - boxes) * sizeof(Box)) << name;
    }
}

TEST(Tree, PlacesInALevelCountThroughTime) {
    Random random(5);
    for (int round = 0; round < 50; ++round) {
        const Tree tree(test::random_clip(random, 400), test::random_any_fit(random));
        const auto nodes = tree.nodes();
        for (int i = 0; i < static_cast<int>(nodes.size()); ++i) {
            const Node& node = nodes[static_cast<std::size_t>(i)];
            int before = 0;
            for (int other = 0; other < static_cast<int>(nodes.size()); ++other) {
                before += tree.level(other) == tree.level(i) && tree.node(other).first < node.first ? 1 : 0;
            }
            EXPECT_EQ(tree.place_in_level(i), before);
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
        for (int i = 0; i < static_cast<int>(tree.nodes().size()); ++i) {
            const bool root = i == 0;
            const bool free =
                kind == TreeKind::umobb || (kind == TreeKind::hybrid1 && !root) || (kind == TreeKind::hybrid2 && root);
            const BoxKind expected = kind == TreeKind::moving ? BoxKind::moving
                                     : kind == TreeKind::aabb ? BoxKind::aabb
                                     : free                   ? BoxKind::obb3d
                                                              : BoxKind::obb2d;
            EXPECT_EQ(tree.box(i).kind, expected) << name(kind);
        }
    }
}

std::vector<double> numbers_of(const Box& box) {
    std::vector<double> out{static_cast<double>(box.kind), box.drift.x, box.drift.y};
    for (const glm::dvec3& v : {box.center, box.half, box.axes[0], box.axes[1], box.axes[2]}) {
        out.insert(out.end(), {v.x, v.y, v.z});
    }
    return out;
}

/// To the last bit, also of the sign of a zero.
bool same_bits(const Box& a, const Box& b) {
    const std::vector<double> x = numbers_of(a), y = numbers_of(b);
    return std::memcmp(x.data(), y.data(), x.size() * sizeof(double)) == 0;
}

void expect_boxes_of_fit(const ClipPtr& clip, const FitOptions& options) {
    const Tree tree(clip, options);
    for (int i = 0; i < static_cast<int>(tree.nodes().size()); ++i) {
        const BoxKind kind = i == 0 ? info(options.tree).root : info(options.tree).below;
        const Node& node = tree.node(i);
        const Box expected = fit(kind, *clip, {node.first, node.count}, options.axes, options.time_scale);
        EXPECT_TRUE(same_bits(tree.box(i), expected))
            << name(options.tree) << ' ' << name(options.axes) << ", leaf " << options.leaf << ", node " << i << " of "
            << clip->count() << " samples";
    }
}

/// Zero radii, walks along an axis, coordinates from tiny to huge: what makes zeros of both signs and flat boxes.
ClipPtr odd_clip(Random& random) {
    const int n = random.integer(1, 1500);
    const double unit = std::pow(10, random.integer(-160, 8));
    const double step_x = random.integer(-1, 1) * unit, step_y = random.integer(-1, 1) * unit;
    const bool is_grid = random.chance(0.5), has_radius = random.chance(0.3);
    std::vector<Disk> samples;
    double x = random.integer(-3, 3) * step_x, y = random.integer(-3, 3) * step_y;
    for (int i = 0; i < n; ++i) {
        const double r = has_radius ? random.integer(0, 2) * unit : 0;
        samples.push_back({std::clamp(x, -1e9, 1e9), std::clamp(y, -1e9, 1e9), std::min(r, 1e9)});
        x += is_grid ? random.integer(-1, 1) * step_x : step_x;
        y += is_grid ? random.integer(-1, 1) * step_y : step_y;
    }
    const Motion motion = random.chance(0.3) ? Motion::linear : Motion::held;
    return std::make_shared<const Clip>(random.chance(0.5) ? 1.0 : 1.0 / 30, std::move(samples), motion);
}

TEST(Tree, EveryNodesBoxIsTheOneFittedToItsRange) {
    Random random(31);
    for (int round = 0; round < 1200; ++round) {
        const ClipPtr clip =
            random.chance(0.4) ? odd_clip(random) : test::random_motion(random, test::random_clip(random));
        FitOptions options = test::random_fit(random);
        // The smallest boxes are dear to find.
        if (options.axes == Axes::minarea && clip->count() > 60) options.axes = Axes::endpoints;
        expect_boxes_of_fit(clip, options);
        if (HasFailure()) FAIL() << "round " << round;
    }
}

TEST(Tree, BoxesOfLongClipsAreThoseFittedToTheirRanges) {
    Random random(32);
    std::vector<Disk> walk;
    double x = 0, y = 0, heading = 0;
    for (int i = 0; i < 30000; ++i) {
        walk.push_back({x, y, random.real(0.2, 0.5)});
        heading += random.real(-0.3, 0.3);
        x += 0.04 * std::cos(heading), y += 0.04 * std::sin(heading);
    }
    for (const Motion motion : {Motion::held, Motion::linear}) {
        const auto clip = std::make_shared<const Clip>(1.0 / 30, walk, motion);
        // The bounds of blocks are of single precision.
        for (const TreeKind kind : test::kFittedTrees) expect_boxes_of_fit(clip, {.tree = kind});
        expect_boxes_of_fit(clip, {.leaf = 1});
    }
    const std::vector<Disk> start(walk.begin(), walk.begin() + 700);
    for (const TreeKind kind : {TreeKind::mobb, TreeKind::moving}) {
        expect_boxes_of_fit(std::make_shared<const Clip>(0.1, start), {.tree = kind, .axes = Axes::minarea});
    }
}

TEST(Tree, ANodeCanBeOther) {
    Random random(33);
    for (int round = 0; round < 400; ++round) {
        const ClipPtr clip = test::random_motion(random, test::random_clip(random, 900));
        const FitOptions options = test::random_fit(random);
        const Tree plain(clip, options);
        const NodeChange change = test::random_change(random, plain);
        const Tree tree(clip, options, change);
        EXPECT_EQ(tree.options(), options);
        for (int i = 0; i < static_cast<int>(tree.nodes().size()); ++i) {
            const Node& node = tree.node(i);
            const bool changed = i == change.node;
            const BoxKind plain_kind = i == 0 ? info(options.tree).root : info(options.tree).below;
            const BoxKind kind = changed ? change.kind.value_or(plain_kind) : plain_kind;
            const Axes axes = changed ? change.axes.value_or(options.axes) : options.axes;
            ASSERT_TRUE(same_bits(tree.box(i), fit(kind, *clip, {node.first, node.count}, axes, options.time_scale)));
            const bool splits = node.count > options.leaf && tree.level(i) + 1 != options.levels;
            int first_count = splits ? (node.count + 1) / 2 : 0;
            if (changed) first_count = change.split.value_or(first_count);
            ASSERT_EQ(node.is_leaf(), first_count == 0);
            if (first_count > 0) {
                ASSERT_EQ(tree.node(tree.children(i)[0]).count, first_count);
                ASSERT_EQ(tree.node(tree.children(i)[1]).first, node.first + first_count);
                ASSERT_EQ(tree.node(tree.children(i)[1]).end(), node.end());
            }
            if (i > change.node) continue;
            ASSERT_EQ(node.first, plain.node(i).first);
            ASSERT_EQ(node.count, plain.node(i).count);
        }
    }
}

TEST(Tree, RefusesChangesThatCannotBeMade) {
    const auto clip = std::make_shared<const Clip>(1, std::vector<Disk>(40, {0, 0, 1}));
    EXPECT_THROW(Tree(clip, {.tree = TreeKind::blocks}, {.node = 0, .axes = Axes::minarea}), std::invalid_argument);
    EXPECT_THROW(Tree(clip, {}, {.node = 7}), std::invalid_argument);
    EXPECT_THROW(Tree(clip, {}, {.node = 0, .kind = BoxKind::block}), std::invalid_argument);
    EXPECT_THROW(Tree(clip, {}, {.node = 0, .split = -1}), std::invalid_argument);
    EXPECT_THROW(Tree(clip, {}, {.node = 0, .split = 40}), std::invalid_argument);
    EXPECT_THROW(Tree(clip, {.levels = 2}, {.node = 1, .split = 5}), std::invalid_argument);
    EXPECT_NO_THROW(Tree(clip, {.levels = 2}, {.node = 1, .split = 0}));
}

TEST(Tree, RefusesOptionsOutOfRange) {
    const auto clip = std::make_shared<const Clip>(1, std::vector<Disk>{{0, 0, 1}});
    EXPECT_THROW(Tree(nullptr, {}), std::invalid_argument);
    EXPECT_THROW(Tree(clip, {.tree = static_cast<TreeKind>(kTreeKindCount)}), std::invalid_argument);
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
