// Pictures side by side.
#include <render/pictures/sheet.h>

#include "render/backends.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace mobbscope {
namespace {

const Palette& kPalette = palette(Theme::light);
const Metrics kMetrics = metrics_of({1280, 720});

/// Of the pixels that have this value in every channel.
struct Found {
    int left = 1 << 20, top = 1 << 20, right = -1, bottom = -1, count = 0;
};

Found find(const Image& image, std::uint8_t value) {
    Found found;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const std::uint8_t* pixel = image.at(x, y);
            if (!std::all_of(pixel, pixel + 4, [&](std::uint8_t channel) { return channel == value; })) continue;
            found = {std::min(found.left, x), std::min(found.top, y), std::max(found.right, x),
                     std::max(found.bottom, y), found.count + 1};
        }
    }
    return found;
}

/// With this value in every channel.
Image uniform(int width, int height, std::uint8_t value) {
    Image image(width, height);
    std::fill(image.rgba.begin(), image.rgba.end(), value);
    return image;
}

using SheetTest = testing::OnEachBackend;

TEST_P(SheetTest, FillsWhatItIsGivenWithEvenGaps) {
    const PictureSize size{700, 300};
    const PictureSize cell = cell_size(size, 3, 3, true, kMetrics);
    std::vector<SheetCell> cells;
    for (const auto value : std::to_array<std::uint8_t>({11, 22, 33})) {
        cells.push_back({"(a) title", uniform(cell.width, cell.height, value)});
    }
    const Image sheet = make_sheet(cells, 3, kPalette, kPalette.background, kMetrics, renderer(), size);
    EXPECT_EQ(sheet.width, 700);
    EXPECT_EQ(sheet.height, 300);
    const Found first = find(sheet, 11), second = find(sheet, 22), third = find(sheet, 33);
    for (const Found& found : {first, second, third}) EXPECT_EQ(found.count, cell.width * cell.height);
    const int gap = second.left - first.right;
    EXPECT_NEAR(third.left - second.right, gap, 1);
    EXPECT_NEAR(first.left, gap - 1, 1);
    EXPECT_NEAR(sheet.width - third.right, gap, 2);
    EXPECT_GT(first.top, gap + 10) << "room for the title";
}

TEST_P(SheetTest, WithoutASizeItIsAsLargeAsItNeedsToBe) {
    const std::vector<SheetCell> cells{
        {"", uniform(100, 80, 11)}, {"", uniform(90, 70, 22)}, {"", uniform(80, 60, 33)}};
    const Image sheet = make_sheet(cells, 2, kPalette, kPalette.background, kMetrics, renderer());
    const int gap = static_cast<int>(kMetrics.pad);
    EXPECT_EQ(sheet.width, 2 * 100 + 3 * gap);
    EXPECT_EQ(sheet.height, 80 + 60 + 3 * gap) << "each row as high as it needs to be";
    const Found small = find(sheet, 22);
    EXPECT_EQ(small.left, 100 + 2 * gap + 5) << "in the middle of its cell";
    EXPECT_EQ(small.top, gap);
    EXPECT_EQ(find(sheet, 33).top, 80 + 2 * gap);
}

TEST_P(SheetTest, TheGroundIsOneColour) {
    const std::vector<SheetCell> cells{{"title", uniform(100, 80, 11)}};
    const Image sheet = make_sheet(cells, 1, kPalette, kPalette.background, kMetrics, renderer());
    const int gap = static_cast<int>(kMetrics.pad);
    // The corner of the sheet, and that of the title's row.
    EXPECT_TRUE(std::equal(sheet.at(0, 0), sheet.at(0, 0) + 4, sheet.at(gap, gap)));
}

TEST_P(SheetTest, TitlesStandOnAnyGround) {
    for (const Theme theme : {Theme::dark, Theme::light}) {
        for (const Rgba& background : {Rgba(0), Rgba(1, 1, 1, 0.5f), Rgba(0, 0, 0, 0.5f)}) {
            const Palette& colors = palette(theme);
            const std::vector<SheetCell> cells{{"(a) title", uniform(200, 100, 9)}};
            const Image sheet = make_sheet(cells, 1, colors, background, kMetrics, renderer());
            int solid = 0;
            for (int y = 0; y < sheet.height - 100 - 14; ++y) {
                for (int x = 0; x < sheet.width; ++x) solid += sheet.at(x, y)[3] > 230 ? 1 : 0;
            }
            EXPECT_GT(solid, 20) << name(theme) << " on " << background.r << ", " << background.a;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Backends, SheetTest, ::testing::Values(Backend::osmesa, Backend::egl), testing::backend_name);

TEST(CellSize, RefusesCellsThatAreTooSmall) {
    EXPECT_THROW(cell_size({300, 300}, 5, 5, false, kMetrics), std::invalid_argument);
    EXPECT_NO_THROW(cell_size({300, 300}, 2, 2, false, kMetrics));
}

}  // namespace
}  // namespace mobbscope
