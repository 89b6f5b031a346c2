#include <mobb/body.h>

#include <gtest/gtest.h>

#include <cmath>
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
