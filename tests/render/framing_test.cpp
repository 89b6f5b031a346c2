// The camera that frames a scene: the same whatever is shown of it, and one that may be turned.
#include "render/pictures.h"
#include "scenes.h"

#include <render/drawlist/camera.h>
#include <render/drawlist/draw_list.h>
#include <render/pictures/build_draw_list.h>
#include <render/pictures/kept_paths.h>
#include <scene/arrangement.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

using testing::kGoldenSize;

/// How much of the picture is left, at least, between the disks and its edges: of its width and of its height; below 0:
/// something is cut off.
glm::vec2 room_around(const DrawList& list) {
    const glm::vec2 size(list.size.width, list.size.height);
    glm::vec2 room(1e6f);
    for (const DiskInstance& disk : list.disks) {
        for (const glm::vec3& way : rim_directions()) {
            for (const glm::vec3& rim : {disk.base + disk.radius * way, disk.top + disk.top_radius * way}) {
                const auto pixel = list.projection.project(rim);
                if (!pixel) return glm::vec2(-1);
                room = glm::min(room, glm::min(*pixel, size - *pixel) / size);
            }
        }
    }
    return room;
}

TEST(Framing, ThePictureIsATenthLargerThanItsDisks) {
    const auto holds = [](const FittedScene& fitted) {
        for (const PictureSize size : {kGoldenSize, PictureSize{400, 900}, PictureSize{80, 64}}) {
            for (const CameraPreset preset : {CameraPreset::iso, CameraPreset::top, CameraPreset::front}) {
                for (const bool perspective : {true, false}) {
                    ViewState view;
                    view.camera.preset = preset;
                    view.camera.perspective = perspective;
                    const glm::vec2 room = room_around(build_draw_list(fitted, view, size));
                    // Along one side they reach as far as they may: 0.05 of 1.1.
                    EXPECT_NEAR(std::min(room.x, room.y), 0.05 / 1.1, 2e-3);
                }
            }
        }
    };
    holds(testing::hit_scene());
    holds({testing::running_scene({{}, {{1, -1}, 70, 0}}), {}});
}

TEST(Framing, NothingButSceneQueryAndSizeMovesTheCamera) {
    const FittedScene mobb = testing::hit_scene();
    const FittedScene umobb = testing::hit_scene(mobb::TreeKind::umobb);
    for (const std::optional<int> query : {std::optional<int>(), std::optional<int>(0)}) {
        ViewState plain;
        plain.query = query;
        const PictureFrame first = picture_frame(mobb, plain, kGoldenSize);
        std::vector<ViewState> views(8, plain);
        views[0].step = {Step::Unit::event, 0};
        views[1].step = {Step::Unit::event, 3};
        views[2].levels = {0, 0, false};
        views[3].levels.leaves = true;
        views[4].time = 0.7;
        views[5].labels = false;
        views[6].boxes = views[6].floor = views[6].time_axis = views[6].disks = false;
        views[7].theme = Theme::light;
        for (const ViewState& view : views) {
            for (const FittedScene* fitted : {&mobb, &umobb}) {
                for (const double scale : {0.0, 2.0}) {
                    const PictureFrame frame = picture_frame(*fitted, view, kGoldenSize, scale);
                    EXPECT_EQ(frame.camera, first.camera);
                    EXPECT_EQ(frame.space.time_height, first.space.time_height);
                }
            }
        }
    }
}

TEST(Framing, WhoIsHiddenIsNotFramed) {
    const FittedScene fitted = testing::hit_scene();
    ViewState plain;
    const PictureFrame all = picture_frame(fitted, plain, kGoldenSize);
    const std::vector<std::string> names = names_in_view(fitted.scene());
    for (const Show show : {Show::space_time, Show::moment}) {
        ViewState view;
        view.show = show;
        const Camera whole = picture_frame(fitted, view, kGoldenSize).camera;
        view.hidden = {names.front()};
        EXPECT_NE(picture_frame(fitted, view, kGoldenSize).camera, whole);
        view.hidden = names;
        EXPECT_EQ(picture_frame(fitted, view, kGoldenSize).camera, whole) << "nobody is left: all have their places";
    }
    ViewState one;
    one.hidden = {names.front()};
    EXPECT_EQ(picture_frame(fitted, one, kGoldenSize).space.time_height, all.space.time_height)
        << "a second stays as high";
    const glm::vec2 room = room_around(build_draw_list(fitted, one, kGoldenSize));
    EXPECT_NEAR(std::min(room.x, room.y), 0.05 / 1.1, 2e-3);
}

TEST(Framing, AResizedPictureKeepsItsScale) {
    const FittedScene fitted = testing::hit_scene();
    ViewState view;
    const DrawList before = build_draw_list(fitted, view, PictureSize{640, 360});
    view.camera = resized(before.camera, {640, 360}, {500, 700});
    const DrawList after = build_draw_list(fitted, view, PictureSize{500, 700});
    const glm::vec3 target = before.space.from_target(*before.camera.target);
    EXPECT_NEAR(after.projection.pixels_per_metre(target), before.projection.pixels_per_metre(target), 0.05);
    EXPECT_EQ(after.camera.target, before.camera.target);
}

TEST(Framing, ATurningCameraShowsAllFromEverySide) {
    const FittedScene fitted = testing::hit_scene();
    KeptPaths paths(std::make_shared<const FittedScene>(fitted));
    for (const bool perspective : {true, false}) {
        for (const double pitch : {-40.0, 0.0, 24.0, 60.0, 90.0}) {
            ViewState view;
            view.camera.preset = CameraPreset::free;
            view.camera.pitch_deg = pitch;
            view.camera.perspective = perspective;
            view.camera = turning_camera(paths, view, kGoldenSize);
            float closest = 1;
            for (int i = 0; i < 36; ++i) {
                view.camera.yaw_deg += 10;
                const glm::vec2 room = room_around(build_draw_list(fitted, view, kGoldenSize));
                closest = std::min({closest, room.x, room.y});
            }
            EXPECT_GT(closest, 0.04) << pitch << (perspective ? " in perspective" : "");
            EXPECT_LT(closest, 0.15) << pitch << (perspective ? " in perspective" : "");
        }
    }
}

}  // namespace
}  // namespace mobbscope
