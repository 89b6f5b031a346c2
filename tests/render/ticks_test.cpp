#include <render/text/labels.h>

#include <gtest/gtest.h>

#include <string>
#include <vector>

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

/// Letters of a width, and a gap behind them.
float width_of(const std::string& label) { return 8 * static_cast<float>(label.size()) + 10; }

TEST(Ticks, ARulersLabelsAreEvenAndHaveRoom) {
    for (const double from : {-3.7, 0.0, 0.013, 512.0, 1e5}) {
        for (const double span : {0.031, 0.9, 5.87, 29.9, 240.0, 86400.0}) {
            for (const float length : {60.0f, 233.0f, 500.0f, 1900.0f}) {
                SCOPED_TRACE(std::to_string(from) + " + " + std::to_string(span) + " on " + std::to_string(length));
                const double step = ruler_step(from, from + span, length, width_of);
                const std::vector<double> values = ticks(from, from + span, step);
                std::size_t decimals = std::string::npos;
                for (std::size_t i = 0; i < values.size(); ++i) {
                    const std::string label = tick_text(values[i], step);
                    EXPECT_NEAR(std::stod(label), values[i], 1e-6 * step) << "it says where it stands";
                    const std::size_t point = label.find('.');
                    const std::size_t here = point == std::string::npos ? 0 : label.size() - point;
                    if (i > 0) {
                        EXPECT_EQ(here, decimals);
                    }
                    decimals = here;
                    if (i > 0) {
                        EXPECT_LE(width_of(label), 1.001 * step / span * length);
                    }
                }
                if (length > 400 && from < 1000) {
                    EXPECT_GE(values.size(), 3u);
                }
            }
        }
    }
}

}  // namespace
}  // namespace mobbscope
