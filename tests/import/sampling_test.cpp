#include <import/clip/sampling.h>

#include <gtest/gtest.h>

#include <cmath>

namespace mobbscope {
namespace {

std::vector<TimedDisk> frames(std::initializer_list<double> times) {
    std::vector<TimedDisk> out;
    for (const double t : times) out.push_back({t, {10 * t, -t, 0.3 + t}});
    return out;
}

TEST(Sampling, RoundedTimesAreUniformAndLateOnesAreNot) {
    EXPECT_TRUE(is_uniform(frames({0, 0.033333, 0.066667, 0.1})));
    EXPECT_TRUE(is_uniform(frames({0, 1.019, 2})));
    EXPECT_FALSE(is_uniform(frames({0, 1.021, 2})));
    EXPECT_FALSE(is_uniform(frames({0, 0.017, 0.033, 0.05})));
    EXPECT_TRUE(is_uniform(frames({0, 0.017, 0.033, 0.05}), kMillisecond));
    EXPECT_FALSE(is_uniform(frames({0, 0.021, 0.04}), kMillisecond)) << "no rounding of 0.02";
    EXPECT_FALSE(is_uniform(frames({0, 0.0035, 0.006}), kMillisecond)) << "a millisecond is much of a frame";
    EXPECT_TRUE(is_in_milliseconds(1.7e9 + 0.017));
    EXPECT_FALSE(is_in_milliseconds(1.7e9 + 0.0167));
}

TEST(Sampling, TheLastKeyIsSampledThoughTimesAreRounded) {
    EXPECT_EQ(sample_count(0, 0.1, 1.0 / 30), 4);
    // 516 frames of 0.00833333 s are 4.3 s less a rounding: still 130 samples at 30 Hz.
    EXPECT_EQ(sample_count(0, 516 * 0.00833333, 1.0 / 30), 130);
    EXPECT_EQ(sample_count(0, 0.095, 1.0 / 30), 3);
    EXPECT_EQ(sample_count(0, 0, 1.0 / 30), 1);
}

TEST(Sampling, BetweenFramesIsLinearAndNearOneIsThatFrame) {
    const auto rows = frames({0, 1, 3});
    const auto disks = sample(rows, {0.5, 1.5, 2});
    EXPECT_DOUBLE_EQ(disks[0].x, 5);
    EXPECT_DOUBLE_EQ(disks[0].r, 0.8);
    EXPECT_DOUBLE_EQ(disks[1].y, -2);
    EXPECT_EQ(sample(rows, {1.019, 1, 1})[0].x, sample(rows, {1, 1, 1})[0].x);
    EXPECT_NE(sample(rows, {1.05, 1, 1})[0].x, rows[1].disk.x);
}

TEST(Sampling, NearAFrameIsMeasuredInFramesNotInTheGap) {
    const auto rows = frames({0, 10, 10.1});
    // 9.9 s is 3 samples before the frame at 10 s, though only a hundredth of the gap.
    EXPECT_DOUBLE_EQ(sample(rows, {9.9, 1.0 / 30, 1})[0].x, 99);
    EXPECT_DOUBLE_EQ(sample(rows, {0.1, 1.0 / 30, 1})[0].x, 1);
    EXPECT_EQ(sample(rows, {9.9995, 1.0 / 30, 1})[0].x, rows[1].disk.x);
    // With long steps the stored gap is the frame.
    EXPECT_DOUBLE_EQ(sample(rows, {10.01, 5, 1})[0].x, 100.1);
}

TEST(Sampling, BeyondTheFramesTheEndsStay) {
    const auto rows = frames({0, 1});
    const auto disks = sample(rows, {-1, 3, 2});
    EXPECT_EQ(disks[0].x, 0);
    EXPECT_EQ(disks[1].x, 10);
}

TEST(Sampling, OriginMovesAndTurnsThePath) {
    const std::vector<mobb::Disk> path{{5, 5, 0.4}, {5, 5.05, 0.4}, {5, 6, 0.4}};
    auto moved = path;
    put_at_origin(moved, Origin::start);
    EXPECT_EQ(moved[0].x, 0);
    EXPECT_DOUBLE_EQ(moved[2].y, 1);
    auto turned = path;
    put_at_origin(turned, Origin::start_heading);
    EXPECT_DOUBLE_EQ(turned[2].x, 1);
    EXPECT_NEAR(turned[2].y, 0, 1e-15);
    auto kept = path;
    put_at_origin(kept, Origin::keep);
    EXPECT_EQ(kept[2].y, 6);
}

TEST(Sampling, HeadingIsTakenFromTheFirstSampleATenthOfAMetreAway) {
    // A shuffle to the left, then the walk ahead along +y.
    std::vector<mobb::Disk> path{{0, 0, 0.4}, {-0.09, 0, 0.4}, {0, 0.2, 0.4}};
    put_at_origin(path, Origin::start_heading);
    EXPECT_NEAR(path[2].x, 0.2, 1e-15);
    std::vector<mobb::Disk> standing{{0, 0, 0.4}, {0.05, 0.05, 0.4}};
    put_at_origin(standing, Origin::start_heading);
    EXPECT_EQ(standing[1].x, 0.05);
}

}  // namespace
}  // namespace mobbscope
