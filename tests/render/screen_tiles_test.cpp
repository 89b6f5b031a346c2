#include <render/drawlist/shown_points.h>
#include <render/gl/tiles.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <random>
#include <vector>

namespace mobbscope {
namespace {

constexpr PictureSize kOddSize{333, 217};

ViewProjection projection(bool perspective) {
    Camera camera;
    camera.preset = CameraPreset::free;
    camera.perspective = perspective;
    const std::vector<glm::vec3> points{{-3, -2, 0}, {3, 2, 5}};
    return make_projection(camera, ShownPoints(points), nullptr, kOddSize);
}

BoxInstance box(glm::vec3 center, float half) {
    BoxInstance out;
    out.center = center;
    out.extents = {glm::vec3(half, half, 0), glm::vec3(-half, half, 0), glm::vec3(0, 0, half)};
    return out;
}

TEST(ScreenTiles, NoBoxesNeedNone) { EXPECT_TRUE(covering_tiles({}, projection(true)).empty()); }

TEST(ScreenTiles, TheyCoverTheBoxesOnceAndLieInThePicture) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> at(-4, 4);
    std::uniform_real_distribution<float> unit(-1, 1);
    for (const bool perspective : {true, false}) {
        const ViewProjection seen = projection(perspective);
        std::vector<BoxInstance> boxes;
        for (int i = 0; i < 6; ++i) boxes.push_back(box({at(random), at(random), at(random)}, 0.3f));
        const std::vector<Rect> tiles = covering_tiles(boxes, seen);
        const Rect picture{{0, 0}, {kOddSize.width, kOddSize.height}};
        double area = 0;
        for (std::size_t i = 0; i < tiles.size(); ++i) {
            EXPECT_TRUE(picture.contains(tiles[i]));
            area += static_cast<double>(tiles[i].size().x * tiles[i].size().y);
            for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(tiles[i].overlaps(tiles[j]));
        }
        EXPECT_LT(area, 0.8 * kOddSize.width * kOddSize.height) << "most of the picture is not covered";
        for (const BoxInstance& each : boxes) {
            for (int n = 0; n < 200; ++n) {
                const glm::vec3 p = each.center + unit(random) * each.extents[0] + unit(random) * each.extents[1] +
                                    unit(random) * each.extents[2];
                const auto pixel = seen.project(p);
                if (!pixel || !picture.contains({*pixel, *pixel})) continue;
                const auto holds = [&](const Rect& tile) { return tile.contains({*pixel, *pixel}); };
                EXPECT_TRUE(std::any_of(tiles.begin(), tiles.end(), holds)) << pixel->x << ' ' << pixel->y;
            }
        }
    }
}

TEST(ScreenTiles, ABoxAroundTheEyeCoversAll) {
    const ViewProjection seen = projection(true);
    const std::vector<BoxInstance> boxes{box(seen.eye, 1)};
    double area = 0;
    for (const Rect& tile : covering_tiles(boxes, seen)) area += static_cast<double>(tile.size().x * tile.size().y);
    EXPECT_EQ(area, kOddSize.width * kOddSize.height);
}

TEST(ScreenTiles, WhatIsBesideThePictureNeedsNone) {
    const ViewProjection seen = projection(false);
    const std::vector<BoxInstance> boxes{box(seen.right * 100.0f, 0.5f), box(seen.up * -100.0f, 0.5f)};
    EXPECT_TRUE(covering_tiles(boxes, seen).empty());
}

}  // namespace
}  // namespace mobbscope
