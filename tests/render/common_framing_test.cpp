// One camera for a sequence of pictures.
#include "render/pictures.h"
#include "scenes.h"

#include <render/drawlist/camera.h>
#include <render/drawlist/draw_list.h>
#include <render/layout/common_framing.h>
#include <render/pictures/build_draw_list.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace mobbscope {
namespace {

using testing::kGoldenSize;

/// How much of the picture is left, at least, between what is drawn and its edges; below 0: something is cut off.
float room_around(const DrawList& list) {
    float room = 1e6f;
    const auto see = [&](glm::vec3 point) {
        const auto pixel = list.projection.project(point);
        ASSERT_TRUE(pixel);
        room = std::min({room, pixel->x, pixel->y, static_cast<float>(kGoldenSize.width) - pixel->x,
                         static_cast<float>(kGoldenSize.height) - pixel->y});
    };
    for (const BoxInstance& box : list.boxes) {
        for (const glm::vec3& corner : box_corners(box)) see(corner);
    }
    for (const DiskInstance& disk : list.disks) see(disk.base);
    for (const LineInstance& line : list.lines) see(line.from), see(line.to);
    return room;
}

Camera turned(Camera camera, double degrees) {
    camera.yaw_deg += degrees;
    return camera;
}

/// Pixels between the first disk and the last one.
float length_of_path(const DrawList& list) {
    return glm::distance(*list.projection.project(list.disks.front().base),
                         *list.projection.project(list.disks.back().base));
}

TEST(CommonFraming, OneViewIsAsLargeAsByItself) {
    const FittedScene fitted = testing::hit_scene();
    for (const bool perspective : {true, false}) {
        ViewState view;
        view.time = 1;
        view.camera.perspective = perspective;
        const DrawList list = build_draw_list(fitted, view, kGoldenSize);
        CommonFraming framing;
        framing.add(list);
        view.camera = framing.still(view.camera);
        view.time_height = list.space.time_height;
        const DrawList again = build_draw_list(fitted, view, kGoldenSize);
        EXPECT_NEAR(length_of_path(again) / length_of_path(list), 1, 0.1);
        EXPECT_GT(room_around(again), 4);
    }
}

TEST(CommonFraming, AStillCameraShowsAllSteps) {
    const FittedScene fitted = testing::hit_scene();
    ViewState view;
    view.query = 0;
    CommonFraming framing;
    std::vector<ViewState> views;
    const int steps = static_cast<int>(record(fitted, fitted.queries()[0]).trace.size());
    for (int i = 0; i < steps; ++i) {
        view.step = {Step::Unit::event, static_cast<double>(i)};
        views.push_back(view);
        framing.add(build_draw_list(fitted, view, kGoldenSize));
    }
    const Camera camera = framing.still(view.camera);
    float closest = 1e6f;
    for (ViewState& seen : views) {
        seen.camera = camera;
        closest = std::min(closest, room_around(build_draw_list(fitted, seen, kGoldenSize)));
    }
    EXPECT_GT(closest, 4);
    EXPECT_LT(closest, 60) << "as large as can be";
}

TEST(CommonFraming, ATurningCameraShowsAllFromEverySide) {
    const FittedScene fitted = testing::hit_scene();
    for (const bool perspective : {true, false}) {
        for (const double pitch : {-40.0, 0.0, 24.0, 60.0, 90.0}) {
            ViewState view;
            view.camera.preset = CameraPreset::free;
            view.camera.pitch_deg = pitch;
            view.camera.perspective = perspective;
            CommonFraming framing;
            for (int i = 0; i < 12; ++i) {
                ViewState seen = view;
                seen.camera.yaw_deg += 30 * i;
                framing.add(build_draw_list(fitted, seen, kGoldenSize));
            }
            const Camera camera = framing.turning(view.camera);
            float closest = 1e6f;
            for (int i = 0; i < 36; ++i) {
                ViewState seen = view;
                seen.camera = turned(camera, 10 * i);
                closest = std::min(closest, room_around(build_draw_list(fitted, seen, kGoldenSize)));
            }
            EXPECT_GT(closest, 2) << pitch << (perspective ? " in perspective" : "");
            EXPECT_LT(closest, 60) << pitch << (perspective ? " in perspective" : "");
        }
    }
}

}  // namespace
}  // namespace mobbscope
