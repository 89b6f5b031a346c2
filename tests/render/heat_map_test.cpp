#include "render/pictures.h"

#include <render/image/image.h>
#include <render/image/image_diff.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace mobbscope {
namespace {

int red_over_blue(const std::uint8_t* pixel) { return pixel[0] - pixel[2]; }

TEST(HeatMap, AGhostOfTheReferenceStays) {
    Image reference = filled(10, 10, 40);
    std::fill_n(reference.at(3, 3), 3, std::uint8_t{250});
    const Image heat = heat_map(reference, std::vector<std::int16_t>(100, 3), 3);
    const std::uint8_t* dark = heat.at(0, 0);
    const std::uint8_t* light = heat.at(3, 3);
    EXPECT_GT(light[0], dark[0] + 30);
    EXPECT_LT(light[0], 100) << "faint";
    EXPECT_EQ(light[0], light[2]);
    EXPECT_EQ(light[3], 255);
}

TEST(HeatMap, LargerDifferencesAreBrighter) {
    std::vector<std::int16_t> differences(256);
    for (std::size_t i = 0; i < 256; ++i) differences[i] = static_cast<std::int16_t>(i);
    const Image heat = heat_map(filled(256, 1, 100), differences, 3);
    const auto brightness = [&](int x) { return heat.at(x, 0)[0] + heat.at(x, 0)[1] + heat.at(x, 0)[2]; };
    EXPECT_GT(brightness(4), brightness(3) + 150) << "what differs at all stands out";
    for (int x = 5; x < 256; ++x) EXPECT_GE(brightness(x), brightness(x - 1));
    EXPECT_EQ(brightness(255), 3 * 255);
}

/// The halo makes one pixel some that are seen, in a small picture as in a large one, and reaches not far.
TEST(HeatMap, ASinglePixelIsSeen) {
    for (const int side : {100, 2400}) {
        const auto area = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
        std::vector<std::int16_t> differences(area, 0);
        differences[area / 2 + static_cast<std::size_t>(side) / 2] = 4;
        const Image heat = heat_map(filled(side, side, 200), differences, 3);
        int glowing = 0;
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) glowing += red_over_blue(heat.at(x, y)) > 20 ? 1 : 0;
        }
        EXPECT_GT(glowing, side / 12);
        EXPECT_LT(glowing, 40 + side * side / 2000);
        EXPECT_GT(red_over_blue(heat.at(side / 2 + 1, side / 2)), 60);
        EXPECT_GT(red_over_blue(heat.at(side / 2 - 1, side / 2 - 1)), 60);
        EXPECT_EQ(red_over_blue(heat.at(0, 0)), 0);
    }
}

TEST(HeatMap, WhatIsNotComparedIsBlue) {
    const Image heat = heat_map(filled(2, 1, 100), std::vector<std::int16_t>{kNotCompared, 0}, 3);
    EXPECT_LT(red_over_blue(heat.at(0, 0)), -30);
    EXPECT_EQ(red_over_blue(heat.at(1, 0)), 0);
}

TEST(HeatMap, IsPartOfTheComparison) {
    const Image reference = filled(30, 30, 100);
    Image actual = reference;
    actual.at(4, 7)[0] = 255;
    Image mask = filled(30, 30, 255);
    std::fill_n(mask.at(29, 29), 3, std::uint8_t{0});
    const Image heat = diff(actual, reference, {}, &mask).heat;
    EXPECT_EQ(heat.at(4, 7)[0], 255);
    EXPECT_LT(heat.at(15, 7)[0], 60);
    EXPECT_LT(red_over_blue(heat.at(29, 29)), -30);
}

TEST(Strip, StandsPicturesSideBySide) {
    const Image a = filled(10, 20, 10);
    const Image b = filled(5, 8, 200);
    const Image strip = make_strip(std::vector<const Image*>{&a, &b, &a});
    ASSERT_EQ(strip.width, 10 + 4 + 5 + 4 + 10);
    ASSERT_EQ(strip.height, 20);
    EXPECT_EQ(*strip.at(9, 19), 10);
    EXPECT_EQ(*strip.at(10, 0), 128);
    EXPECT_EQ(*strip.at(13, 19), 128);
    EXPECT_EQ(*strip.at(14, 0), 200);
    EXPECT_EQ(*strip.at(18, 7), 200);
    EXPECT_EQ(*strip.at(18, 8), 128) << "below a shorter one";
    EXPECT_EQ(strip.at(18, 8)[3], 255);
    EXPECT_EQ(*strip.at(32, 19), 10);
    EXPECT_EQ(make_strip(std::vector<const Image*>{&b}).rgba, b.rgba);
}

TEST(Strip, AnAbsurdOneIsRefused) {
    const Image wide = filled(100000, 1, 0);
    const Image tall = filled(1, 100000, 0);
    EXPECT_THROW(make_strip(std::vector<const Image*>{&wide, &tall}), std::invalid_argument);
}

}  // namespace
}  // namespace mobbscope
