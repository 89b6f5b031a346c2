#include <mobb/body.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace {

using namespace mobb;

TEST(BodyTest, DisksCoverARectangleAndHardlyStandOut) {
    for (const auto& [length, width] :
         {std::pair(4.6, 1.9), std::pair(18.0, 2.5), std::pair(1.0, 1.0), std::pair(0.4, 0.6)}) {
        const std::vector<BodyDisk> body = rectangle_body(length, width);
        for (double x = -0.5; x <= 0.5; x += 0.01) {
            for (double y = -0.5; y <= 0.5; y += 0.01) {
                double gap = 1;
                for (const BodyDisk& disk : body)
                    gap = std::min(gap, std::hypot(x * length - disk.forward, y * width - disk.left) - disk.r);
                EXPECT_LE(gap, 1e-12) << length << " x " << width;
            }
        }
        EXPECT_LE(rectangle_excess(length, width), 0.05 * std::min(length, width));
        EXPECT_GE(body_reach(body), std::hypot(length, width) / 2 - 1e-12);
    }
    EXPECT_EQ(rectangle_body(0, 0), std::vector{BodyDisk{}});
    EXPECT_LE(rectangle_body(1e6, 1).size(), kMaxBodyDisks);
}

TEST(BodyTest, HeadingsAreKeptWhileStanding) {
    // East, stands, north, then noise.
    const Clip clip(0.1, {{0, 0, 1}, {0, 0, 1}, {1, 0, 1}, {1, 0, 1}, {1, 0, 1}, {1, 1, 1}, {1.01, 1, 1}});
    const std::vector<double> headings = headings_of(clip);
    const std::vector<double> right{0, 0, 0, 0, 90, 90, 90};
    ASSERT_EQ(headings.size(), right.size());
    for (std::size_t i = 0; i < right.size(); ++i) EXPECT_NEAR(headings[i], right[i], 1e-12) << i;
    EXPECT_EQ(headings_of(Clip(1, {{5, 5, 1}})), std::vector{0.0});
    // Fine steps have the direction of some together.
    const std::vector<double> fine = headings_of(Clip(0.01, {{0, 0, 1}, {0.06, 0.001, 1}, {0.12, 0, 1}, {0.18, 0, 1}}));
    EXPECT_EQ(fine, (std::vector{0.0, 0.0, 0.0, 0.0}));
}

TEST(BodyTest, WhoIsTheSameBackwardsReversesWithoutTurning) {
    // East, back west, then north-west: that is nearer to backwards than to forwards, as south-east.
    const Clip clip(1, {{0, 0, 1}, {2, 0, 1}, {0, 0, 1}, {-2, 1, 1}, {-2, 1, 1}}, Motion::linear);
    const std::vector<BodyDisk> truck = rectangle_body(12, 2.5);
    const double slope = std::atan2(1, -2) * (180 / std::numbers::pi);
    const std::vector<double> headings = headings_of(clip, truck), of_motion = headings_of(clip);
    const std::vector<double> right{0, 0, slope + 180, slope + 180, slope + 180}, turned{0, 180, slope, slope, slope};
    ASSERT_EQ(headings.size(), right.size());
    for (std::size_t i = 0; i < right.size(); ++i) {
        EXPECT_NEAR(std::remainder(headings[i] - right[i], 360), 0, 1e-12) << i;
        EXPECT_NEAR(std::remainder(of_motion[i] - turned[i], 360), 0, 1e-12) << i;
    }
    // The row stays as long as it is all the way.
    const Clip front = member_of(clip, headings, truck.back()), rear = member_of(clip, headings, truck.front());
    for (std::size_t i = 0; i < right.size(); ++i) {
        const Disk &a = front.samples()[i], &b = rear.samples()[i];
        EXPECT_NEAR(std::hypot(a.x - b.x, a.y - b.y), 2 * truck.back().forward, 1e-9);
        EXPECT_GT(a.x, b.x) << "the same end is ahead";
    }
    // One whose front is told from its back turns round.
    std::vector<BodyDisk> lorry = truck;
    lorry.back().r /= 2;
    EXPECT_EQ(headings_of(clip, lorry), of_motion);
    EXPECT_TRUE(has_direction(clip));
    EXPECT_FALSE(has_direction(Clip(1, {{0, 0, 1}, {0.05, 0, 1}, {-0.09, 0, 1}})));
}

TEST(BodyTest, MembersWalkBesideTheCentre) {
    const Clip clip(0.5, {{0, 0, 9}, {0, 2, 9}}, Motion::linear);
    const Clip member = member_of(clip, headings_of(clip), {1, 0.5, 0.25});
    ASSERT_EQ(member.count(), 2);
    EXPECT_EQ(member.motion(), Motion::linear);
    EXPECT_EQ(member.dt(), 0.5);
    EXPECT_NEAR(member.samples()[0].x, -0.5, 1e-15);
    EXPECT_NEAR(member.samples()[0].y, 1, 1e-15);
    EXPECT_NEAR(member.samples()[1].y, 3, 1e-15);
    EXPECT_EQ(member.samples()[1].r, 0.25);
    EXPECT_THROW(member_of(clip, std::vector{0.0}, {}), std::invalid_argument);
}

}  // namespace
