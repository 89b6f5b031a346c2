#include <render/text/labels.h>

#include <gtest/gtest.h>

namespace mobbscope {
namespace {

TEST(Ticks, StepsAreOneTwoFive) {
    EXPECT_DOUBLE_EQ(nice_step(10, 5), 2);
    EXPECT_DOUBLE_EQ(nice_step(9.9, 5), 1);
    EXPECT_DOUBLE_EQ(nice_step(42, 5), 5);
    EXPECT_DOUBLE_EQ(nice_step(0.0031, 6), 0.0005);
    EXPECT_DOUBLE_EQ(nice_step(1e7, 5), 2e6);
}

TEST(Ticks, BothEndsCount) {
    EXPECT_EQ(ticks(-1, 1, 0.5), (std::vector<double>{-1, -0.5, 0, 0.5, 1}));
    EXPECT_EQ(ticks(0.1, 0.9, 0.5), (std::vector<double>{0.5}));
    EXPECT_EQ(ticks(1e5, 1e5 + 2, 1), (std::vector<double>{100000, 100001, 100002}));
    EXPECT_TRUE(ticks(0.1, 0.2, 1).empty());
}

TEST(Ticks, TextHasTheStepsDecimals) {
    EXPECT_EQ(tick_text(2, 0.5), "2.0");
    EXPECT_EQ(tick_text(2, 1), "2");
    EXPECT_EQ(tick_text(0.005, 0.005), "0.005");
    EXPECT_EQ(tick_text(-0.0, 1), "0");
    EXPECT_EQ(tick_text(100000, 20), "100000");
}

}  // namespace
}  // namespace mobbscope
