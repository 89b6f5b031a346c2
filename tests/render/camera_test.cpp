// Explicit cameras: settled from one that frames the scene, and moved.
#include <render/drawlist/camera.h>
#include <render/drawlist/draw_list.h>
#include <render/drawlist/shown_points.h>
#include <render/layout/framing.h>
#include <render/pictures/build_draw_list.h>

#include "render/pictures.h"
#include "render/scenes.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace mobbscope {
namespace {

std::vector<glm::vec3> points_of(const DrawList& list) {
    std::vector<glm::vec3> out;
    for (const DiskInstance& disk : list.disks) out.push_back(disk.base);
    for (const BoxInstance& box : list.boxes) {
        for (const glm::vec3& corner : box_corners(box)) out.push_back(corner);
    }
    return out;
}

/// The largest difference in pixels between where two lenses see the points.
float pixel_difference(const ViewProjection& a, const ViewProjection& b, const std::vector<glm::vec3>& points) {
    float most = 0;
    for (const glm::vec3& point : points) {
        most = std::max(most, glm::length(a.project(point).value() - b.project(point).value()));
    }
    return most;
}

TEST(Settled, ShowsWhatTheFramedPictureShows) {
    for (const bool far : {false, true}) {
        const glm::dvec2 there = far ? glm::dvec2(-10'000, 10'000) : glm::dvec2(0);
        const double then = far ? 1e5 : 0;
        const FittedScene fitted(testing::scene_of({{there, 0, then}, {there + glm::dvec2(1, -1), 90, then}}), {});
        for (const CameraPreset preset :
             {CameraPreset::iso, CameraPreset::top, CameraPreset::front, CameraPreset::side, CameraPreset::free}) {
            for (const bool perspective : {true, false}) {
                for (const double fov : {0.5, 12.0, 90.0}) {
                    for (const bool query : {true, false}) {
                        ViewState view;
                        view.camera.preset = preset;
                        view.camera.pitch_deg = -35;
                        view.camera.perspective = perspective;
                        view.camera.fov_deg = fov;
                        if (query) view.query = 0;
                        const DrawList framed = build_draw_list(fitted, view, kGoldenSize);
                        view.camera = framed.camera;
                        ASSERT_TRUE(view.camera.target);
                        EXPECT_EQ(view.camera.preset, CameraPreset::free);
                        const DrawList aimed = build_draw_list(fitted, view, kGoldenSize);
                        EXPECT_LT(pixel_difference(framed.projection, aimed.projection, points_of(framed)), 0.05f)
                            << name(preset) << (perspective ? "" : " ortho") << (far ? " far" : "") << " fov " << fov;
                        EXPECT_EQ(aimed.camera, view.camera) << "settled already";
                    }
                }
            }
        }
    }
}

TEST(Settled, TheTargetIsInTheMiddleOfTheScene) {
    const FittedScene fitted(testing::scene_of({{{500, 500}, 0, 40}}), {});
    ViewState view;
    view.time_height = 3;
    const DrawList list = build_draw_list(fitted, view, kGoldenSize);
    const Camera camera = list.camera;
    EXPECT_NEAR(camera.target->x, 501, 0.5);
    EXPECT_NEAR(camera.target->y, 500, 0.5);
    EXPECT_NEAR(camera.target->z, 3 * 41, 1.5);
}

/// The picture with an explicit camera stands still, however many lines the caption has.
TEST(Settled, SteppingDoesNotMoveThePicture) {
    const FittedScene fitted = testing::hit_scene();
    ViewState view;
    view.query = 0;
    const PictureSize narrow{320, 360};
    DrawList first = build_draw_list(fitted, view, narrow);
    view.camera = first.camera;
    const glm::vec3 point(0.1f, 0.2f, 0.3f);
    const glm::vec2 at = first.projection.project(point).value();
    bool captions_differ = false;
    for (int step = 0; step < 12; ++step) {
        view.step = {Step::Unit::event, static_cast<double>(step)};
        const DrawList list = build_draw_list(fitted, view, narrow);
        captions_differ = captions_differ || list.texts.size() != first.texts.size();
        EXPECT_LT(glm::length(list.projection.project(point).value() - at), 0.05f) << step;
    }
    EXPECT_TRUE(captions_differ) << "nothing to disturb the picture";
}

/// A projection for an explicit camera where drawn space is the world.
ViewProjection camera_lens(const Camera& camera, PictureSize size = kGoldenSize) {
    const glm::vec3 target(*camera.target);
    const std::vector<glm::vec3> points{target - 5.0f, target + 5.0f};
    return make_projection(camera, ShownPoints(points), &target, size);
}

Camera explicit_camera(bool perspective) {
    Camera camera;
    camera.preset = CameraPreset::free;
    camera.yaw_deg = 30;
    camera.pitch_deg = 20;
    camera.perspective = perspective;
    camera.fov_deg = 40;
    camera.target = glm::dvec3(1, 2, 3);
    camera.distance = 20;
    camera.shift = {0.1, -0.2};
    return camera;
}

TEST(Navigate, TheShiftIsInWidthsAndHeights) {
    for (const bool perspective : {true, false}) {
        const Camera camera = explicit_camera(perspective);
        const glm::vec2 at = camera_lens(camera).project(glm::vec3(*camera.target)).value();
        EXPECT_NEAR(at.x, 640 * 0.6, 0.01);
        EXPECT_NEAR(at.y, 360 * 0.7, 0.01);
    }
}

TEST(Navigate, OrbitingTurnsAroundTheTarget) {
    for (const bool perspective : {true, false}) {
        const Camera camera = explicit_camera(perspective);
        const Camera turned = orbited(camera, {90, 36}, kGoldenSize);
        EXPECT_NEAR(turned.yaw_deg, -15, 1e-9);
        EXPECT_NEAR(turned.pitch_deg, 38, 1e-9);
        const glm::vec3 target(*camera.target);
        EXPECT_LT(glm::length(*camera_lens(turned).project(target) - *camera_lens(camera).project(target)), 0.01f);
        // What is between the eye and the target goes where the mouse goes.
        const ViewProjection before = camera_lens(camera);
        const glm::vec3 front = target + before.back;
        EXPECT_GT(camera_lens(orbited(camera, {9, 0}, kGoldenSize)).project(front)->x, before.project(front)->x);
        EXPECT_GT(camera_lens(orbited(camera, {0, 9}, kGoldenSize)).project(front)->y, before.project(front)->y);

        EXPECT_EQ(orbited(camera, {0, 1e6f}, kGoldenSize).pitch_deg, 90);
        EXPECT_EQ(orbited(camera, {0, -1e6f}, kGoldenSize).pitch_deg, -90);
        EXPECT_LE(std::abs(orbited(camera, {1e5f, 0}, kGoldenSize).yaw_deg), 180);
    }
}

TEST(Navigate, WhatIsPannedFollowsTheMouse) {
    for (const bool perspective : {true, false}) {
        const Camera camera = explicit_camera(perspective);
        const ViewProjection before = camera_lens(camera);
        const glm::vec3 beside = glm::vec3(*camera.target) + before.right * 1.5f + before.up * 0.5f;
        const glm::vec2 way(37, -21);
        const glm::vec2 moved =
            *camera_lens(panned(camera, way, kGoldenSize)).project(beside) - *before.project(beside);
        EXPECT_NEAR(moved.x, way.x, 0.02);
        EXPECT_NEAR(moved.y, way.y, 0.02);
    }
}

TEST(Navigate, ZoomingKeepsWhatIsUnderTheCursor) {
    for (const bool perspective : {true, false}) {
        const Camera camera = explicit_camera(perspective);
        const ViewProjection before = camera_lens(camera);
        const glm::vec3 beside = glm::vec3(*camera.target) + before.right * 3.0f + before.up * -1.0f;
        const glm::vec2 cursor = before.project(beside).value();
        for (const double factor : {0.5, 1.0, 1.2, 3.0}) {
            const Camera nearer = zoomed(camera, factor, cursor, kGoldenSize);
            const ViewProjection after = camera_lens(nearer);
            EXPECT_LT(glm::length(after.project(beside).value() - cursor), 0.05f) << factor;
            EXPECT_NEAR(after.pixels_per_metre(beside) / before.pixels_per_metre(beside), factor, 1e-3);
        }
        EXPECT_EQ(zoomed(camera, 1e9, cursor, kGoldenSize).distance, kNearest);
        EXPECT_EQ(zoomed(camera, 1e-9, cursor, kGoldenSize).distance, kFarthest);
    }
}

TEST(Navigate, FramingShowsTheWholeBoxAndNotMuchElse) {
    for (const bool perspective : {true, false}) {
        for (const PictureSize size : {kGoldenSize, PictureSize{200, 600}}) {
            for (const double pitch : {-90.0, -20.0, 0.0, 45.0}) {
                Camera camera = explicit_camera(perspective);
                camera.pitch_deg = pitch;
                const glm::dvec3 min(100, 200, 300);
                const glm::dvec3 max(104, 201, 302);
                const Camera framed = framing(camera, min, max, size);
                EXPECT_EQ(framed.yaw_deg, camera.yaw_deg);
                EXPECT_EQ(framed.pitch_deg, camera.pitch_deg);
                const ViewProjection projection = camera_lens(framed, size);
                float room = 1;
                for (unsigned i = 0; i < 8; ++i) {
                    const glm::vec3 corner(i & 1u ? max.x : min.x, i & 2u ? max.y : min.y, i & 4u ? max.z : min.z);
                    const glm::vec2 at = projection.project(corner).value() / glm::vec2(size.width, size.height);
                    room = std::min({room, at.x, at.y, 1 - at.x, 1 - at.y});
                }
                EXPECT_NEAR(room, 0.1, 0.002) << pitch;
            }
        }
    }
    const Camera point = framing(explicit_camera(true), glm::dvec3(1), glm::dvec3(1), kGoldenSize);
    EXPECT_EQ(point.distance, kNearest);
}

TEST(Navigate, FlightsGoTheShorterWay) {
    Camera from = explicit_camera(true);
    from.yaw_deg = 170;
    Camera to = explicit_camera(false);
    to.yaw_deg = -160;
    to.pitch_deg = 60;
    to.target = glm::dvec3(5, 2, 3);
    to.distance = 2000;
    to.shift = {0, 0};
    EXPECT_EQ(between(from, to, 0), from);
    EXPECT_EQ(between(from, to, 1), to);
    EXPECT_EQ(between(from, to, 7), to);
    const Camera half = between(from, to, 0.5);
    EXPECT_NEAR(std::remainder(half.yaw_deg - 185, 360), 0, 1e-9);
    EXPECT_NEAR(half.pitch_deg, 40, 1e-9);
    EXPECT_NEAR(half.distance, 200, 1e-9);
    EXPECT_NEAR(half.target->x, 3, 1e-9);
    EXPECT_NEAR(half.shift.x, 0.05, 1e-9);
    EXPECT_NEAR(between(from, to, 0.01).distance, 20 * std::pow(100, 0.01), 1e-9);
}

/// What moves the camera needs no draw list: the frame is that of the list, whatever is shown.
TEST(Camera, TheFrameIsThatOfThePicture) {
    const FittedScene fitted = testing::hit_scene();
    for (const Show show : {Show::space_time, Show::moment}) {
        for (const bool with_query : {false, true}) {
            for (const std::optional<double> time : {std::optional<double>(), std::optional<double>(0.8)}) {
                ViewState view;
                view.show = show;
                view.time = time;
                if (with_query) view.query = 0;
                const DrawList list = build_draw_list(fitted, view, kGoldenSize);
                const PictureFrame frame = picture_frame(fitted, view, kGoldenSize);
                EXPECT_EQ(frame.projection.clip_from_world, list.projection.clip_from_world);
                EXPECT_EQ(frame.size, list.size);
                EXPECT_EQ(frame.space.time_height, list.space.time_height);
                EXPECT_EQ(frame.moment, list.moment);
                EXPECT_EQ(frame.camera, list.camera);
                view.camera = frame.camera;
                EXPECT_EQ(picture_frame(fitted, view, kGoldenSize).projection.clip_from_world,
                          build_draw_list(fitted, view, kGoldenSize).projection.clip_from_world);
            }
        }
    }
}

}  // namespace
}  // namespace mobbscope
