// Pictures with backgrounds of their own, and with other numbers of samples.
#include "backends.h"
#include "render/pictures.h"
#include "scenes.h"

#include <render/image/image_diff.h>
#include <render/pictures/build_draw_list.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace mobbscope {
namespace {

/// Disks, boxes with faces, lines, panels and text.
DrawList all_pixels(Theme theme, std::optional<Rgba> background) {
    ViewState view;
    view.levels = {0, 3, false};
    view.time = 1;
    view.theme = theme;
    return build_draw_list(testing::hit_scene(), view, {.size = kSmallSize, .background = background});
}

/// The picture laid over a ground, opaque.
Image laid_over(const Image& image, Rgba ground) {
    Image out = image;
    for (std::size_t i = 0; i < out.rgba.size(); i += 4) {
        const float opacity = static_cast<float>(image.rgba[i + 3]) / 255;
        for (int c = 0; c < 3; ++c) {
            std::uint8_t& channel = out.rgba[i + static_cast<std::size_t>(c)];
            channel = static_cast<std::uint8_t>(
                std::lround(static_cast<float>(channel) * opacity + 255 * ground[c] * (1 - opacity)));
        }
        out.rgba[i + 3] = 255;
    }
    return out;
}

/// Of all channels.
int largest_difference(const Image& a, const Image& b) { return diff(a, b).largest; }

class BackgroundTest : public testing::OnEachBackend {};

TEST_P(BackgroundTest, SeenThroughPicturesAreTheOpaqueOnesOverTheThemesGround) {
    for (const Theme theme : {Theme::dark, Theme::light}) {
        const Image opaque = renderer().draw(all_pixels(theme, std::nullopt));
        const Image clear = renderer().draw(all_pixels(theme, Rgba(0)));
        EXPECT_LE(largest_difference(laid_over(clear, palette(theme).background), opaque), 2) << name(theme);
        EXPECT_EQ(clear.at(1, 238)[3], 0) << "nothing is drawn in the corner";
        const auto solid = [&](std::size_t i) { return clear.rgba[4 * i + 3] == 255; };
        std::size_t count = 0;
        for (std::size_t i = 0; i < clear.rgba.size() / 4; ++i) count += solid(i) ? 1u : 0u;
        EXPECT_GT(count, 2000u) << "disks hide what is behind them";
    }
}

TEST_P(BackgroundTest, AHalfSeenThroughGroundLiesUnderWhatIsDrawn) {
    const Rgba veil = parse_background("#FF000080");
    const Image veiled = renderer().draw(all_pixels(Theme::dark, veil));
    const std::uint8_t* corner = veiled.at(1, 238);
    // Eight bits of what lies over black give the colour back to a level.
    EXPECT_NEAR(corner[0], 255, 1);
    EXPECT_EQ(corner[1], 0);
    EXPECT_EQ(corner[3], 128);
    // Over any ground it is the clear picture over the veil over that ground.
    const Image clear = renderer().draw(all_pixels(Theme::dark, Rgba(0)));
    const Rgba ground = palette(Theme::dark).background;
    EXPECT_LE(largest_difference(laid_over(veiled, ground), laid_over(clear, mix_colors(ground, veil, veil.a))), 2);
}

TEST_P(BackgroundTest, AnOpaqueGroundIsWhatStepsBackDoesSoTowards) {
    const Rgba green(0, 0.4f, 0.1f, 1);
    const DrawList list = all_pixels(Theme::dark, green);
    EXPECT_EQ(list.palette.background, green);
    const Image image = renderer().draw(list);
    const std::uint8_t* corner = image.at(1, 238);
    EXPECT_EQ(corner[0], 0);
    EXPECT_EQ(corner[1], 102);
    EXPECT_EQ(corner[3], 255);
    const DrawList clear = all_pixels(Theme::dark, Rgba(0));
    EXPECT_EQ(clear.palette.background, palette(Theme::dark).background);
}

TEST_P(BackgroundTest, MoreSamplesThanTheContextHasAreRefused) {
    try {
        renderer().draw(all_pixels(Theme::dark, std::nullopt), 1 << 20);
        FAIL();
    } catch (const MachineError& error) {
        EXPECT_NE(std::string(error.what()).find("at most "), std::string::npos) << error.what();
    }
    EXPECT_NE(renderer().draw(all_pixels(Theme::dark, std::nullopt), 1).rgba,
              renderer().draw(all_pixels(Theme::dark, std::nullopt), 4).rgba);
}

INSTANTIATE_TEST_SUITE_P(All, BackgroundTest, ::testing::Values(Backend::osmesa, Backend::egl), testing::backend_name);

TEST(PictureOptions, BackgroundsAndSamplesAreRead) {
    EXPECT_EQ(parse_background("transparent"), Rgba(0));
    EXPECT_EQ(parse_background("#ff8000"), Rgba(255, 128, 0, 255) / 255.0f);
    EXPECT_EQ(parse_background("#FF800040"), Rgba(255, 128, 0, 64) / 255.0f);
    for (const char* bad :
         {"", "#", "red", "ff8000", "#ff800", "#ff80000", "#ff8000000", "#gg8000", "#-f8000", "#+f8000"}) {
        EXPECT_THROW(parse_background(bad), std::invalid_argument) << bad;
    }
    EXPECT_EQ(parse_samples("8"), 8);
    for (const char* bad : {"", "0", "3", "16", "-1", "4.0"}) EXPECT_THROW(parse_samples(bad), std::invalid_argument);
}

}  // namespace
}  // namespace mobbscope
