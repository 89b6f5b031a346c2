// The figures of nodes: each against another way of finding it out.
#include <explain/node_values.h>
#include <mobb/level_figures.h>

#include <gtest/gtest.h>
#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>
#include <random>
#include <vector>

namespace mobbscope {
namespace {

std::shared_ptr<const mobb::Tree> tree_of(mobb::TreeKind kind) {
    std::vector<mobb::Disk> samples;
    for (int i = 0; i < 200; ++i)
        samples.push_back({2 * std::cos(0.05 * i), 3 * std::sin(0.03 * i), 0.3 + 0.1 * std::sin(i / 9.0)});
    return std::make_shared<const mobb::Tree>(std::make_shared<const mobb::Clip>(1.0 / 30, samples),
                                              mobb::FitOptions{.tree = kind});
}

/// The part of random points of a box that are outside t0..t1.
double outside_by_chance(const mobb::Box& box, double time_scale, double t0, double t1) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const std::array<glm::dvec3, 3> edges = mobb::half_edges(box);
    constexpr int kPoints = 40'000;
    int outside = 0;
    for (int i = 0; i < kPoints; ++i) {
        double t = box.center.z;
        for (const glm::dvec3& edge : edges) t += uniform(random) * edge.z;
        if (t < time_scale * t0 || t > time_scale * t1) ++outside;
    }
    return static_cast<double>(outside) / kPoints;
}

/// The area of a box's shadow from above, in cells of so many metres.
double shadow(const mobb::Box& box, double cell) {
    const std::array<glm::dvec3, 8> all = mobb::corners(box);
    glm::dvec2 least(all[0]), most(all[0]);
    for (const glm::dvec3& corner : all) {
        least = glm::min(least, glm::dvec2(corner));
        most = glm::max(most, glm::dvec2(corner));
    }
    // A point is in the shadow of a convex body unless some edge between two corners has all others on its other side.
    const auto covered = [&](glm::dvec2 at) {
        for (const glm::dvec3& a : all) {
            for (const glm::dvec3& b : all) {
                const glm::dvec2 along = glm::dvec2(b) - glm::dvec2(a);
                const auto side = [&](glm::dvec2 p) { return along.x * (p.y - a.y) - along.y * (p.x - a.x); };
                if (side(at) >= -1e-12) continue;
                if (std::ranges::all_of(all,
                                        [&](const glm::dvec3& other) { return side(glm::dvec2(other)) >= -1e-12; }))
                    return false;
            }
        }
        return true;
    };
    int count = 0;
    const int columns = static_cast<int>((most.x - least.x) / cell) + 1;
    const int rows = static_cast<int>((most.y - least.y) / cell) + 1;
    for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < columns; ++x) count += covered(least + cell * glm::dvec2(x + 0.5, y + 0.5)) ? 1 : 0;
    }
    return count * cell * cell;
}

TEST(NodeValues, OverhangIsThePartOfRandomPointsOutsideTheTime) {
    const auto tree = tree_of(mobb::TreeKind::umobb);
    const NodeValues values(tree, {});
    double most = 0;
    for (int i = 0; i < values.size(); ++i) {
        const mobb::Node& node = tree->node(i);
        const double by_chance = outside_by_chance(tree->box(i), tree->time_scale(), tree->t0(node), tree->t1(node));
        EXPECT_NEAR(values.value(NodeField::overhang, i), by_chance, 0.01) << i;
        most = std::max(most, by_chance);
    }
    EXPECT_GT(most, 0.2);  // else nothing was tried
}

TEST(NodeValues, OnlyTreesWithFreeBoxesHaveAnOverhang) {
    EXPECT_FALSE(NodeValues(tree_of(mobb::TreeKind::mobb), {}).has(NodeField::overhang));
    EXPECT_TRUE(NodeValues(tree_of(mobb::TreeKind::umobb), {}).has(NodeField::overhang));
}

/// The last sample of a linear clip is one moment: a leaf of its own takes no time, and its box has no volume.
TEST(NodeValues, ABoxWithoutVolumeHasNoOverhang) {
    std::vector<mobb::Disk> samples;
    for (int i = 0; i < 9; ++i) samples.push_back({0.3 * i, 0.1 * i * i, 0.4});
    const auto clip = std::make_shared<const mobb::Clip>(0.5, samples, mobb::Motion::linear);
    const auto tree =
        std::make_shared<const mobb::Tree>(clip, mobb::FitOptions{.tree = mobb::TreeKind::umobb, .leaf = 1});
    const NodeValues values(tree, {});
    int without = 0;
    for (int i = 0; i < values.size(); ++i) {
        const bool has_volume = values.value(NodeField::volume, i) > 0;
        EXPECT_EQ(has_volume, tree->t1(tree->node(i)) > tree->t0(tree->node(i))) << i;
        EXPECT_EQ(std::isnan(values.value(NodeField::overhang, i)), !has_volume) << i;
        without += has_volume ? 0 : 1;
    }
    EXPECT_EQ(without, 1);
}

TEST(NodeValues, FloorAreaIsThatOfTheShadow) {
    for (const mobb::TreeKind kind : {mobb::TreeKind::mobb, mobb::TreeKind::umobb, mobb::TreeKind::moving}) {
        const auto tree = tree_of(kind);
        for (const int node : {0, 1, static_cast<int>(tree->nodes().size()) - 1}) {
            const double counted = shadow(tree->box(node), 0.02);
            EXPECT_NEAR(floor_area(tree->box(node)), counted, 0.03 * counted) << mobb::name(kind) << ' ' << node;
        }
    }
}

TEST(NodeValues, LevelsAddUpToTheirFigures) {
    for (const mobb::TreeKind kind : {mobb::TreeKind::mobb, mobb::TreeKind::umobb, mobb::TreeKind::blocks}) {
        const auto tree = tree_of(kind);
        const NodeValues values(tree, {});
        const mobb::LevelFigures finest = mobb::level_figures(*tree).back();
        double volume = 0, filled = 0;
        for (int i = 0; i < values.size(); ++i) {
            if (!tree->is_leaf(i)) continue;
            volume += values.value(NodeField::volume, i);
            filled += values.value(NodeField::volume, i) * values.value(NodeField::fill, i);
        }
        EXPECT_NEAR(volume, finest.volume, 1e-9 * volume);
        EXPECT_NEAR(filled / volume, finest.tightness.value(), 1e-9);
    }
}

TEST(NodeValues, WasteAddsUpToTheEmptySpaceOfTheRoot) {
    for (const mobb::TreeKind kind : {mobb::TreeKind::mobb, mobb::TreeKind::umobb, mobb::TreeKind::blocks}) {
        const auto tree = tree_of(kind);
        const NodeValues values(tree, {});
        double sum = 0;
        for (const double waste : values.column(NodeField::waste)) sum += waste;
        const double empty = values.value(NodeField::volume, 0) * (1 - values.value(NodeField::fill, 0));
        EXPECT_NEAR(sum, empty, 1e-9 * values.value(NodeField::volume, 0)) << mobb::name(kind);
    }
}

/// A scale of colours would begin at what rounding leaves.
TEST(NodeValues, NothingIsWastedBetweenBoxesThatStand) {
    const auto clip =
        std::make_shared<const mobb::Clip>(1.0 / 30, std::vector<mobb::Disk>(1000, mobb::Disk{0.1, 0.7, 0.3}));
    for (const int leaf : {1, 3, 10}) {
        const auto tree = std::make_shared<const mobb::Tree>(clip, mobb::FitOptions{.leaf = leaf});
        const NodeValues values(tree, {});
        for (int i = 0; i < values.size(); ++i) {
            if (tree->is_leaf(i)) continue;
            EXPECT_EQ(values.value(NodeField::waste, i), 0) << leaf << ' ' << i;
        }
    }
}

TEST(NodeValues, TestsAndBlameAreThoseOfTheClip) {
    const auto tree = tree_of(mobb::TreeKind::mobb);
    NodeValues values(tree, std::vector<double>(tree->nodes().size(), 0.25));
    EXPECT_FALSE(values.has(NodeField::tests));
    SceneCosts costs;
    costs.nodes = {{.at = {1, 2}, .boxes = 9}, {.at = {0, 3}, .boxes = 5}};
    values.add_tests(costs, 0);
    EXPECT_EQ(values.value(NodeField::tests, 3), 5);
    EXPECT_EQ(values.value(NodeField::tests, 2), 0);
    EXPECT_EQ(values.value(NodeField::share, 2), 0.25);
}

}  // namespace
}  // namespace mobbscope
