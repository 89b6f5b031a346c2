#include "render/pictures.h"

#include <render/image/image_diff.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>

namespace mobbscope {
namespace {

/// No pixel may differ.
constexpr DiffOptions kNone{3, 0, 0, 0};

Image grey(int width, int height) { return filled(width, height, 100); }

void paint(Image& image, PixelRect where, std::uint8_t level) {
    for (int y = where.y; y < where.y + where.height; ++y) {
        for (int x = where.x; x < where.x + where.width; ++x) std::fill_n(image.at(x, y), 3, level);
    }
}

TEST(ImageDiff, EqualPicturesAreTheSame) {
    const ImageDiff result = diff(grey(20, 10), grey(20, 10), {0, 0});
    EXPECT_TRUE(result.same);
    EXPECT_TRUE(result.same_size);
    EXPECT_EQ(result.pixels, 200);
    EXPECT_EQ(result.largest, 0);
    EXPECT_EQ(result.mean, 0);
    EXPECT_EQ(result.bounds, std::nullopt);
    EXPECT_EQ(result.histogram[0], 200);
    EXPECT_EQ(result.fraction(), 0);
}

TEST(ImageDiff, SmallDifferencesCountAsEqual) {
    const Image reference = grey(100, 100);
    Image actual = reference;
    for (std::size_t i = 0; i < actual.rgba.size(); ++i) {
        if (i % 4 != 3) actual.rgba[i] = i % 8 < 4 ? 103 : 97;
    }
    const ImageDiff result = diff(actual, reference);
    EXPECT_TRUE(result.passes);
    EXPECT_EQ(result.differing, 0);
    EXPECT_EQ(result.largest, 3);
    EXPECT_FALSE(diff(actual, reference, {2.9, 0.001}).passes);
    EXPECT_EQ(diff(actual, reference, {2.9, 0.001}).differing, 10000);
}

TEST(ImageDiff, EachChannelCounts) {
    for (int channel = 0; channel < 4; ++channel) {
        for (const int by : {4, -4}) {
            const Image reference = filled(3, 1, 100, 200);
            Image actual = filled(3, 1, 100, 200);
            std::uint8_t& value = actual.at(1, 0)[channel];
            value = static_cast<std::uint8_t>(value + 2 * by);
            EXPECT_EQ(diff(actual, reference, {3, 0}).differing, 1) << channel;
            EXPECT_EQ(diff(reference, actual, {3, 0}).differing, 1) << channel;
        }
    }
}

TEST(ImageDiff, FourPixelsOrTwentyOfAMillionMayDiffer) {
    const Image reference = grey(100, 100);
    Image actual = reference;
    for (int i = 0; i < 4; ++i) actual.at(i, 0)[1] = 0;
    const ImageDiff enough = diff(actual, reference);
    EXPECT_TRUE(enough.passes);
    EXPECT_FALSE(enough.same) << "some bytes differ";
    actual.at(4, 0)[1] = 0;
    const ImageDiff result = diff(actual, reference);
    EXPECT_FALSE(result.passes);
    EXPECT_EQ(result.differing, 5);
    EXPECT_EQ(result.largest, 100);
    EXPECT_DOUBLE_EQ(result.fraction(), 0.0005);
    EXPECT_EQ(DiffOptions{}.allowed(640 * 360), 4);
    EXPECT_EQ(DiffOptions{}.allowed(1920 * 1080), 41);
    EXPECT_EQ(DiffOptions{}.allowed(64 * 64), 4);
    EXPECT_EQ(DiffOptions{}.allowed(32 * 32), 1) << "a thousandth of a small picture";
    EXPECT_FALSE(diff(grey(2, 2), filled(2, 2, 0)).passes) << "all of it differs";
}

TEST(ImageDiff, TheAllowedShareIsExact) {
    for (int side = 1; side < 200; ++side) EXPECT_EQ((DiffOptions{3, 0.001, 0, 0}.allowed(1000LL * side)), side);
}

TEST(ImageDiff, AnAllowanceIsANumberOfPixelsOrAShare) {
    const auto allowed = [](const std::string& text, std::int64_t pixels) {
        DiffOptions options;
        set_allowance(options, text);
        return options.allowed(pixels);
    };
    EXPECT_EQ(allowed("12px", 100), 12);
    EXPECT_EQ(allowed("0px", 1'000'000), 0);
    EXPECT_EQ(allowed("50ppm", 1'000'000), 50);
    EXPECT_EQ(allowed("0.1%", 5000), 5);
    EXPECT_EQ(allowed("0.001", 5000), 5);
    for (const char* bad : {"", "1", "12", "1.5px", "-1px", "px", "nanpx", "101%", "-1ppm", "1e9ppm"}) {
        EXPECT_THROW(allowed(bad, 1), std::invalid_argument) << bad;
    }
}

TEST(ImageDiff, SameIsOnlyWhatNoByteDiffersIn) {
    const Image reference = filled(10, 10, 100, 0);
    Image actual = reference;
    actual.at(3, 4)[0] = 7;  // nobody sees it
    const ImageDiff hidden = diff(actual, reference);
    EXPECT_TRUE(hidden.passes);
    EXPECT_FALSE(hidden.same);
    EXPECT_EQ(hidden.unequal, 0);
    EXPECT_EQ(diff_sentence(hidden),
              "passes: none of 100 pixels looks different; colours under transparent ones differ");
    Image noisy = grey(10, 10);
    noisy.at(3, 4)[0] = 102;
    noisy.at(5, 4)[0] = 101;
    const ImageDiff noise = diff(noisy, grey(10, 10));
    EXPECT_EQ(noise.unequal, 2);
    EXPECT_EQ(noise.unequal_bounds, (PixelRect{3, 4, 3, 1}));
    EXPECT_EQ(diff_sentence(noise),
              "passes: none of 100 pixels differs by more than 3/255; 2 differ by up to 2/255, within 3x1 at (3, 4)");
}

/// Levels from 30 to 229, with faint lines a level or two lighter.
Image shaded(int width, int height, bool with_grid = true) {
    Image out(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const int level = 30 + (x + 2 * y) % 200 + (with_grid && (x % 16 == 0 || y % 16 == 0) ? 3 : 0);
            std::fill_n(out.at(x, y), 3, static_cast<std::uint8_t>(level));
            out.at(x, y)[3] = 255;
        }
    }
    return out;
}

template <class Change>
Image levels_changed(Image image, const Change& change) {
    for (std::size_t i = 0; i < image.rgba.size(); ++i) {
        if (i % 4 != 3) image.rgba[i] = static_cast<std::uint8_t>(std::clamp(change(image.rgba[i]), 0, 255));
    }
    return image;
}

TEST(TileMeans, FindWhatLeansToOneSide) {
    const Image reference = shaded(640, 360);
    const std::pair<const char*, Image> changes[] = {
        {"3 brighter", levels_changed(reference, [](int level) { return level + 3; })},
        {"gamma 1.02",
         levels_changed(reference,
                        [](int level) { return static_cast<int>(std::lround(255 * std::pow(level / 255.0, 1.02))); })},
        {"6 bits a channel", levels_changed(reference, [](int level) { return level / 4 * 255 / 63; })},
        {"without the faint grid", shaded(640, 360, false)}};
    for (const auto& [name, actual] : changes) {
        const ImageDiff result = diff(actual, reference);
        EXPECT_EQ(result.differing, 0) << name;
        EXPECT_FALSE(result.passes) << name;
        EXPECT_EQ(result.bounds, result.tile) << name;
        EXPECT_NE(diff_sentence(result).find("; the mean within 32x3"), std::string::npos) << diff_sentence(result);
        const auto glows = [&](std::size_t i) { return result.heat.rgba[4 * i] > 200; };
        EXPECT_TRUE(glows(0) || glows(640 * 100 + 100)) << name;
    }
}

TEST(TileMeans, ForgiveNoise) {
    const Image reference = shaded(1920, 1080);
    for (unsigned seed = 1; seed < 6; ++seed) {
        std::minstd_rand random(seed);
        const ImageDiff result =
            diff(levels_changed(reference, [&](int level) { return level + static_cast<int>(random() / 16 % 5) - 2; }),
                 reference, {}, nullptr, HeatMap::left_out);
        EXPECT_EQ(result.largest, 2);
        EXPECT_TRUE(result.passes) << diff_sentence(result);
        EXPECT_GT(result.tile_mean, 0.05) << "it is noise";
    }
}

TEST(TileMeans, TilesFillThePicture) {
    const Image reference = grey(100, 70);
    Image actual = reference;
    paint(actual, {66, 35, 34, 35}, 102);
    const ImageDiff result = diff(actual, reference);
    EXPECT_EQ(result.tile, (PixelRect{66, 35, 34, 35})) << "the last of 3 x 2";
    EXPECT_EQ(result.tile_mean, 2);
    EXPECT_EQ(diff_sentence(result),
              "different: none of 7000 pixels differs by more than 3/255; 1190 differ by up to 2/255, within 34x35 at "
              "(66, 35); the mean within 34x35 at (66, 35) differs by 2/255, allowed: 0.3/255");
    Image mask = filled(100, 70, 255);
    paint(mask, {66, 35, 34, 20}, 0);
    EXPECT_TRUE(diff(actual, reference, {}, &mask).passes) << "15 rows of 34 pixels are too few";
    EXPECT_TRUE(diff(filled(16, 16, 101), filled(16, 16, 100)).passes) << "and so is a small picture";
    EXPECT_FALSE(diff(filled(16, 32, 101), filled(16, 32, 100)).passes);
}

TEST(TileMeans, LeaveOutWhatIsCounted) {
    const Image reference = grey(100, 100);
    Image actual = reference;
    paint(actual, {10, 10, 2, 2}, 255);
    EXPECT_TRUE(diff(actual, reference).passes) << "four pixels may differ by any amount";
    EXPECT_EQ(diff(actual, reference).tile, std::nullopt);
}

TEST(TileMeans, AThresholdThatIsGivenIsAllowedEverywhere) {
    const Image reference = grey(100, 100), actual = filled(100, 100, 103);
    EXPECT_FALSE(diff(actual, reference).passes);
    DiffOptions options;
    set_threshold(options, "3");
    EXPECT_TRUE(diff(actual, reference, options).passes);
}

TEST(ImageDiff, TellsHowMuchAndWhere) {
    const Image reference = grey(10, 10);
    Image actual = reference;
    paint(actual, {2, 3, 1, 1}, 110);
    paint(actual, {7, 5, 1, 2}, 60);
    paint(actual, {0, 9, 1, 1}, 102);  // within the tolerance
    const ImageDiff result = diff(actual, reference);
    EXPECT_EQ(result.differing, 3);
    EXPECT_EQ(result.largest, 40);
    EXPECT_DOUBLE_EQ(result.mean, (10 + 40 + 40 + 2) / 100.0);
    EXPECT_EQ(result.bounds, (PixelRect{2, 3, 6, 4}));
    EXPECT_EQ(result.histogram[0], 96);
    EXPECT_EQ(result.histogram[2], 1);
    EXPECT_EQ(result.histogram[10], 1);
    EXPECT_EQ(result.histogram[40], 2);
    EXPECT_EQ(std::accumulate(result.histogram.begin(), result.histogram.end(), std::int64_t{0}), result.pixels);
}

TEST(ImageDiff, PicturesOfDifferentSizesDiffer) {
    const ImageDiff result = diff(grey(10, 10), grey(10, 11));
    EXPECT_FALSE(result.same_size);
    EXPECT_FALSE(result.same);
    EXPECT_EQ(result.pixels, 0);
    EXPECT_EQ(result.heat.width, 0);
    EXPECT_EQ(result.actual_size, (PictureSize{10, 10}));
    EXPECT_EQ(result.reference_size, (PictureSize{10, 11}));
    EXPECT_FALSE(diff(grey(11, 10), grey(10, 11), {255, 1, 1}).passes);
}

TEST(ImageDiff, ColourThatNobodySeesIsNoDifference) {
    EXPECT_EQ(diff(filled(4, 4, 0, 0), filled(4, 4, 255, 0)).largest, 0);
    EXPECT_EQ(diff(filled(4, 4, 0, 1), filled(4, 4, 255, 1)).largest, 1);
    EXPECT_EQ(diff(filled(4, 4, 0, 128), filled(4, 4, 255, 128)).largest, 128);
    EXPECT_EQ(diff(filled(4, 4, 0, 0), filled(4, 4, 0, 255)).largest, 255);
}

/// A line, an edge and a dot: one pixel aside they are forgiven, two pixels aside or missing they are not.
TEST(ImageDiff, AShiftOfOnePixelIsForgivenInAnyDirection) {
    const std::pair<PixelRect, const char*> shapes[] = {
        {{0, 10, 40, 1}, "line"}, {{10, 10, 20, 20}, "block"}, {{20, 20, 1, 1}, "dot"}};
    for (const auto& [shape, name] : shapes) {
        Image reference = grey(40, 40);
        paint(reference, shape, 255);
        for (int dy = -2; dy <= 2; ++dy) {
            for (int dx = -2; dx <= 2; ++dx) {
                if (shape.width == 40 && dx != 0) continue;
                PixelRect moved = shape;
                moved.x += dx;
                moved.y += dy;
                Image actual = grey(40, 40);
                paint(actual, moved, 255);
                const bool near = std::max(std::abs(dx), std::abs(dy)) <= 1;
                EXPECT_EQ(diff(actual, reference, {3, 0, 1, 0}).passes, near) << name << ' ' << dx << ' ' << dy;
                EXPECT_EQ(diff(actual, reference, {3, 0, 0, 0}).passes, dx == 0 && dy == 0) << name;
            }
        }
    }
}

TEST(ImageDiff, AShiftForgivesNothingThatIsMissing) {
    const Image empty = grey(40, 40);
    Image line = empty;
    paint(line, {0, 0, 1, 40}, 255);
    const ImageDiff missing = diff(empty, line, {3, 0, 1});
    EXPECT_EQ(missing.bounds, (PixelRect{0, 0, 1, 40}));
    EXPECT_EQ(diff(line, empty, {3, 0, 1}).bounds, (PixelRect{0, 0, 1, 40}));
    EXPECT_EQ(missing.histogram[155], 40);
}

TEST(ImageDiff, OnlyTheMaskIsCompared) {
    const Image reference = grey(10, 10);
    Image actual = reference;
    paint(actual, {0, 0, 5, 10}, 200);
    actual.at(9, 9)[0] = 255;
    Image mask = filled(10, 10, 255);
    paint(mask, {0, 0, 5, 10}, 0);
    const ImageDiff result = diff(actual, reference, kNone, &mask);
    EXPECT_EQ(result.pixels, 50);
    EXPECT_EQ(result.differing, 1);
    EXPECT_EQ(result.bounds, (PixelRect{9, 9, 1, 1}));
    EXPECT_DOUBLE_EQ(result.mean, 155 / 50.0);
    EXPECT_FALSE(result.passes);
    mask.at(9, 9)[3] = 0;
    EXPECT_TRUE(diff(actual, reference, kNone, &mask).same) << "transparent";
    mask.at(9, 9)[3] = 1;
    std::fill_n(mask.at(9, 9), 2, std::uint8_t{0});
    EXPECT_FALSE(diff(actual, reference, kNone, &mask).passes) << "neither black nor transparent";
    const Image other = grey(10, 11);
    EXPECT_THROW(diff(actual, reference, {}, &other), std::invalid_argument);
}

}  // namespace
}  // namespace mobbscope
