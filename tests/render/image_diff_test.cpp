#include <render/image_diff.h>

#include <gtest/gtest.h>

namespace mobbscope {
namespace {

Image grey(int width, int height) {
    Image image(width, height);
    std::fill(image.rgba.begin(), image.rgba.end(), std::uint8_t{100});
    return image;
}

TEST(ImageDiff, SmallDifferencesCountAsEqual) {
    const Image reference = grey(100, 100);
    Image actual = reference;
    for (std::uint8_t& channel : actual.rgba) channel += 3;
    const ImageDiff result = diff(actual, reference);
    EXPECT_TRUE(result.same);
    EXPECT_EQ(result.differing, 0);
    EXPECT_EQ(result.largest, 3);
}

TEST(ImageDiff, AThousandthOfThePixelsMayDiffer) {
    const Image reference = grey(100, 100);
    Image actual = reference;
    for (int i = 0; i < 10; ++i) actual.at(i, 0)[1] = 0;
    EXPECT_TRUE(diff(actual, reference).same);
    actual.at(10, 0)[1] = 0;
    const ImageDiff result = diff(actual, reference);
    EXPECT_FALSE(result.same);
    EXPECT_EQ(result.differing, 11);
    EXPECT_EQ(result.largest, 100);
}

TEST(ImageDiff, TheHeatMapShowsWhere) {
    const Image reference = grey(10, 10);
    Image actual = reference;
    actual.at(4, 7)[0] = 255;
    const Image heat = diff(actual, reference).heat;
    EXPECT_EQ(heat.at(4, 7)[0], 255);
    EXPECT_LT(heat.at(3, 7)[0], 60);
}

TEST(ImageDiff, PicturesOfDifferentSizesDiffer) {
    const ImageDiff result = diff(grey(10, 10), grey(10, 11));
    EXPECT_FALSE(result.same_size);
    EXPECT_FALSE(result.same);
}

}  // namespace
}  // namespace mobbscope
