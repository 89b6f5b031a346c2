// Structural similarity: what loses much of it and what little.
#include "render/pictures.h"

#include <render/image/ssim.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>

namespace mobbscope {
namespace {

/// Black lines on white, every tenth row.
Image ruled() {
    Image image = filled(64, 48, 255);
    for (int y = 5; y < 48; y += 10) {
        for (int x = 0; x < 64; ++x) std::fill_n(image.at(x, y), 3, std::uint8_t{0});
    }
    return image;
}

TEST(Ssim, APictureLosesNothingAgainstItself) { EXPECT_EQ(largest_ssim_loss(ruled(), ruled()), 0); }

TEST(Ssim, IsTheFormulaOfAFlatWindow) {
    // Of two flat windows only the means count.
    const double c1 = 0.01 * 255 * 0.01 * 255;
    const double expected = 1 - (2.0 * 100 * 60 + c1) / (100.0 * 100 + 60 * 60 + c1);
    EXPECT_NEAR(largest_ssim_loss(filled(20, 20, 100), filled(20, 20, 60)), expected, 1e-12);
}

TEST(Ssim, NoiseLosesLittleAndALineMuch) {
    std::mt19937 random(3);
    Image noisy = ruled();
    for (std::uint8_t& value : noisy.rgba) {
        if (value > 2 && value < 253) value = static_cast<std::uint8_t>(value + random() % 3 - 1);
    }
    EXPECT_LT(largest_ssim_loss(noisy, ruled()), 0.02);
    Image erased = ruled();
    for (int x = 20; x < 40; ++x) std::fill_n(erased.at(x, 15), 3, std::uint8_t{255});
    EXPECT_GT(largest_ssim_loss(erased, ruled()), 0.5);
}

TEST(Ssim, LooksIntoEveryCorner) {
    const Image white = filled(21, 13, 255);
    for (const int x : {0, 20}) {
        for (const int y : {0, 12}) {
            Image dot = white;
            dot.at(x, y)[1] = 0;
            EXPECT_GT(largest_ssim_loss(dot, white), 0.05) << x << ' ' << y;
        }
    }
    Image tiny = filled(3, 2, 255);
    std::fill_n(tiny.at(1, 1), 3, std::uint8_t{0});
    EXPECT_GT(largest_ssim_loss(tiny, filled(3, 2, 255)), 0.05) << "smaller than a window";
}

}  // namespace
}  // namespace mobbscope
