// Curves of paths: a circle turns evenly, who stands does not turn, and no extreme is lost in columns of pixels.
#include <explain/path_curves.h>

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

namespace mobbscope {
namespace {

using mobb::Clip;
using mobb::Disk;
using mobb::Motion;
using mobb::PlacedClip;

constexpr double kDt = 0.05;

/// Counter-clockwise at `speed` m/s.
Clip walked_circle(double radius, double speed, int count, Motion motion = Motion::held) {
    std::vector<Disk> disks;
    for (int i = 0; i < count; ++i) {
        const double angle = speed / radius * kDt * i;
        disks.push_back({radius * std::cos(angle), radius * std::sin(angle), 0.3 + 0.01 * i});
    }
    return {kDt, disks, motion};
}

Clip standing_clip(int count) { return {kDt, std::vector<Disk>(static_cast<std::size_t>(count), Disk{1, 2, 0.3})}; }

TEST(PathCurves, ACircleHasItsSpeedAndTurnsEvenly) {
    for (const Motion motion : {Motion::held, Motion::linear}) {
        const Clip clip = walked_circle(2, 1.5, 41, motion);
        const PathCurve speed = speed_curve(clip), turn = turn_curve(clip);
        // The chord of a step, not the arc.
        const double step = 1.5 / 2 * kDt;
        const double chord = 2 * 2 * std::sin(step / 2) / kDt;
        const double rate = 1.5 / 2 * 180 / std::numbers::pi;
        for (int i = 0; i < 40; ++i) EXPECT_NEAR(speed.values[static_cast<std::size_t>(i)], chord, 1e-9) << i;
        for (int i = 1; i < 40; ++i) EXPECT_NEAR(turn.values[static_cast<std::size_t>(i)], rate, 1e-9) << i;
        EXPECT_FALSE(speed.has(40));
        EXPECT_FALSE(turn.has(0));
        EXPECT_FALSE(turn.has(40));
    }
}

TEST(PathCurves, ToTheRightIsBelowZero) {
    std::vector<Disk> disks;
    for (int i = 0; i <= 5; ++i) disks.push_back({0.1 * i, 0, 0.3});
    for (int i = 1; i <= 5; ++i) disks.push_back({0.5, -0.1 * i, 0.3});
    const PathCurve turn = turn_curve(Clip(kDt, disks));
    EXPECT_NEAR(turn.values[5], -90 / kTurnWindow, 1e-9) << "a right angle over the window";
    EXPECT_NEAR(turn.values[1], 0, 1e-9);
    EXPECT_NEAR(turn.values[9], 0, 1e-9);
}

TEST(PathCurves, WhoStandsHasASpeedOfZeroAndDoesNotTurn) {
    const Clip clip = standing_clip(20);
    const PathCurve speed = speed_curve(clip), turn = turn_curve(clip);
    for (int i = 0; i < 19; ++i) EXPECT_EQ(speed.values[static_cast<std::size_t>(i)], 0);
    for (int i = 0; i < 20; ++i) EXPECT_FALSE(turn.has(i));
    const PlacedClip placed(clip, {});
    EXPECT_FALSE(value_at(turn, placed, 0.5));
    for (const ValueColumn& column : columns_of(turn, placed, 0, 1, 7)) EXPECT_FALSE(column.any);
    // Swaying is no turning: 1 mm to and fro.
    std::vector<Disk> sways;
    for (int i = 0; i < 40; ++i) sways.push_back({i % 2 == 0 ? 0 : 0.001, i % 3 == 0 ? 0 : 0.001, 0.3});
    const PathCurve swaying = turn_curve(Clip(kDt, sways));
    for (int i = 5; i < 35; ++i) EXPECT_FALSE(swaying.has(i)) << i;
}

TEST(PathCurves, OneSampleHasARadiusAlone) {
    const Clip clip = standing_clip(1);
    EXPECT_EQ(radius_curve(clip).values, std::vector<double>{0.3});
    EXPECT_FALSE(speed_curve(clip).has(0));
    EXPECT_FALSE(turn_curve(clip).has(0));
    const PlacedClip placed(clip, {.start = 3});
    EXPECT_EQ(value_at(radius_curve(clip), placed, 3.02).value().second, 0.3);
    EXPECT_FALSE(value_at(radius_curve(clip), placed, 2.9));
}

TEST(PathCurves, RadiiRunWhereTheClipRuns) {
    const Clip held = walked_circle(2, 1.5, 11), linear = walked_circle(2, 1.5, 11, Motion::linear);
    const PlacedClip a(held, {.start = 1}), b(linear, {.start = 1});
    const double middle = 1 + 2.5 * kDt;
    EXPECT_EQ(value_at(radius_curve(held), a, middle).value(), std::pair(2, 0.32));
    EXPECT_EQ(value_at(radius_curve(linear), b, middle).value().first, 2);
    EXPECT_NEAR(value_at(radius_curve(linear), b, middle).value().second, 0.325, 1e-12);
    // Speed holds for the whole step in both.
    EXPECT_EQ(value_at(speed_curve(linear), b, middle).value().second, speed_curve(linear).values[2]);
    EXPECT_FALSE(value_at(radius_curve(linear), b, 1 + 10.5 * kDt)) << "a linear clip ends at its last sample";
    EXPECT_TRUE(value_at(radius_curve(held), a, 1 + 10.5 * kDt));
}

TEST(PathCurves, NoExtremeIsLostInColumns) {
    std::vector<Disk> disks(100'000, Disk{0, 0, 0.3});
    disks[31'416].r = 0.9;
    disks[77'777].r = 0.1;
    const Clip clip(0.01, disks);
    const auto columns = columns_of(radius_curve(clip), PlacedClip(clip, {}), 0, 1000, 100);
    ASSERT_EQ(columns.size(), 100u);
    for (std::size_t i = 0; i < 100; ++i) {
        EXPECT_EQ(columns[i].most, i == 31 ? 0.9 : 0.3) << i;
        EXPECT_EQ(columns[i].least, i == 77 ? 0.1 : 0.3) << i;
    }
    // Beyond the clip there is nothing.
    const auto wide = columns_of(radius_curve(clip), PlacedClip(clip, {}), 0, 2000, 10);
    EXPECT_TRUE(wide[4].any);
    EXPECT_FALSE(wide[5].any);
}

TEST(PathCurves, CostIsThatOfTheNodeForEachOfItsSeconds) {
    const auto clip = std::make_shared<const Clip>(walked_circle(2, 1.5, 40));
    const mobb::Tree tree(clip, {.leaf = 10});
    ASSERT_EQ(tree.nodes().size(), 7u);
    std::vector<double> shares(7);
    for (std::size_t i = 0; i < 7; ++i) shares[i] = 0.1 + 0.01 * static_cast<double>(i);
    const PathCurve root = cost_curve(tree, shares, {0, 0});
    EXPECT_NEAR(root.values[0], 10 / (40 * kDt), 1e-9);
    EXPECT_EQ(root.values[0], root.values[39]);
    const PathCurve leaves = cost_curve(tree, shares, {0, 0, true});
    for (int sample = 0; sample < 40; ++sample) {
        int node = 0;
        while (!tree.is_leaf(node)) node = tree.child_with(node, sample);
        EXPECT_NEAR(leaves.values[static_cast<std::size_t>(sample)],
                    100 * shares[static_cast<std::size_t>(node)] / (10 * kDt), 1e-9);
    }
    EXPECT_EQ(cost_curve(tree, shares, {1, 9}).values, leaves.values) << "deeper levels have the leaves above them";
    EXPECT_FALSE(cost_curve(tree, {}, {0, 0}).has(0));
}

TEST(PathCurves, EachIsDescribed) {
    for (std::size_t i = 0; i < kCurveCount; ++i) {
        EXPECT_EQ(static_cast<std::size_t>(curve_infos()[i].kind), i);
        EXPECT_FALSE(curve_infos()[i].unit.empty());
        EXPECT_FALSE(curve_infos()[i].doc.empty());
    }
}

}  // namespace
}  // namespace mobbscope
