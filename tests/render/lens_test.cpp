#include <render/drawlist/shown_points.h>
#include <render/drawlist/view_projection.h>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <vector>

namespace mobbscope {
namespace {

std::vector<glm::vec3> block(glm::vec3 half) {
    std::vector<glm::vec3> points;
    for (unsigned i = 0; i < 8; ++i) {
        points.push_back({i & 1u ? half.x : -half.x, i & 2u ? half.y : -half.y, i & 4u ? half.z : -half.z});
    }
    return points;
}

TEST(ViewProjection, EverythingFitsIntoThePicture) {
    for (const PictureSize size :
         {PictureSize{640, 360}, PictureSize{360, 640}, PictureSize{1000, 100}, PictureSize{64, 64}}) {
        const glm::vec2 picture(size.width, size.height);
        for (const CameraPreset preset :
             {CameraPreset::iso, CameraPreset::top, CameraPreset::front, CameraPreset::side, CameraPreset::free}) {
            for (const glm::vec3 half : {glm::vec3(1, 1, 1), glm::vec3(20, 0.1f, 3), glm::vec3(0.01f, 5, 5)}) {
                Camera camera;
                camera.preset = preset;
                camera.pitch_deg = -35;
                const std::vector<glm::vec3> points = block(half);
                const ViewProjection projection = make_projection(camera, ShownPoints(points), nullptr, size);
                float tightest = 1e9f;
                for (const glm::vec3& point : points) {
                    const glm::vec2 at = projection.project(point).value();
                    const float room = std::min({at.x, at.y, picture.x - at.x, picture.y - at.y});
                    EXPECT_GE(room, -0.1f);
                    tightest = std::min(tightest, room);
                    const glm::vec4 clip = projection.clip_from_world * glm::vec4(point, 1);
                    EXPECT_LE(std::abs(clip.z), clip.w);
                }
                EXPECT_LT(tightest, 1) << "the scene could be larger";
            }
        }
    }
}

TEST(ViewProjection, PresetsLookTheRightWay) {
    const std::vector<glm::vec3> points = block(glm::vec3(1));
    const auto at = [&](CameraPreset preset, glm::vec3 p) {
        Camera camera;
        camera.preset = preset;
        return make_projection(camera, ShownPoints(points), nullptr, {200, 200}).project(p).value();
    };
    EXPECT_NEAR(at(CameraPreset::top, {1, 1, 0}).x, 200, 0.1);
    EXPECT_NEAR(at(CameraPreset::top, {1, 1, 0}).y, 0, 0.1);
    EXPECT_NEAR(at(CameraPreset::front, {1, 0, 1}).x, 200, 0.1);
    EXPECT_NEAR(at(CameraPreset::front, {1, 0, 1}).y, 0, 0.1);
    EXPECT_NEAR(at(CameraPreset::side, {0, 1, 1}).x, 200, 0.1);
    EXPECT_NEAR(at(CameraPreset::side, {0, 1, 1}).y, 0, 0.1);
}

TEST(ViewProjection, ATargetGoesToTheMiddle) {
    Camera camera;
    camera.preset = CameraPreset::free;
    camera.distance = 7;
    const glm::vec3 target(0.3f, 0.2f, 0.5f);
    const ViewProjection projection = make_projection(camera, ShownPoints(block(glm::vec3(1))), &target, {300, 200});
    EXPECT_NEAR(projection.project(target)->x, 150, 0.01);
    EXPECT_NEAR(projection.project(target)->y, 100, 0.01);
    EXPECT_NEAR(projection.depth(target), 7, 1e-4);
}

/// Divided by its negative depth it would be seen, upside down, in the middle of the picture.
TEST(ViewProjection, WhatIsBehindTheEyeIsNotSeen) {
    Camera camera;
    camera.preset = CameraPreset::free;
    camera.yaw_deg = 0;
    camera.pitch_deg = 0;
    camera.distance = 2;
    const glm::vec3 target(0);
    const ViewProjection projection = make_projection(camera, ShownPoints(block(glm::vec3(5))), &target, {300, 200});
    EXPECT_TRUE(projection.project({1, 0, 0}).has_value());
    EXPECT_FALSE(projection.project({2, 0, 0}).has_value());
    EXPECT_FALSE(projection.project({4, 0.1f, 0.1f}).has_value());
    EXPECT_EQ(projection.pixels_per_metre({4, 0, 0}), 0);
}

TEST(ViewProjection, APointHasNoExtentAndStillIsSeen) {
    const std::vector<glm::vec3> point{glm::vec3(0)};
    const ViewProjection projection = make_projection({}, ShownPoints(point), nullptr, {100, 100});
    EXPECT_NEAR(projection.project(point[0])->x, 50, 0.5);
    EXPECT_NEAR(projection.project(point[0])->y, 50, 0.5);
}

}  // namespace
}  // namespace mobbscope
