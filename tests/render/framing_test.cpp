// The camera that frames what is shown of a scene, beside the words, and one that may be turned.
#include "render/pictures.h"
#include "scenes.h"

#include <render/drawlist/camera.h>
#include <render/drawlist/cut.h>
#include <render/drawlist/draw_list.h>
#include <render/layout/framing.h>
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

/// Disks, and boxes too, seen in the picture: the rectangle around them; `covered`: some of them is in a panel.
struct Seen {
    Rect around{glm::vec2(1e6f), glm::vec2(-1e6f)};
    bool covered = false;
};

Seen seen_in(const DrawList& list) {
    Seen out;
    const auto see = [&](glm::vec3 point) {
        const glm::vec2 pixel = list.projection.project(point).value_or(glm::vec2(-1e6f));
        out.around = {glm::min(out.around.min, pixel), glm::max(out.around.max, pixel)};
        for (const Overlay& overlay : list.overlays) {
            out.covered = out.covered || overlay.rect.overlaps(Rect{pixel, pixel}.grown(0.01f));
        }
    };
    for (const DiskInstance& disk : list.disks) {
        for (const glm::vec3& way : rim_directions()) {
            see(disk.base + disk.radius * way);
            see(disk.top + disk.top_radius * way);
        }
    }
    for (const BoxInstance& box : list.boxes) {
        if (box.pickable && is_seen(list.slab, box)) std::ranges::for_each(box_corners(box), see);
    }
    return out;
}

/// How much of the picture is left, at least, between the disks and its edges: of its width and of its height; below 0:
/// something is cut off. `boxes`: also around these, and what a plan shows of them; `free_top`: pixels at the top that
/// are no part of the picture.
glm::vec2 room_around(const DrawList& list, bool boxes = false, int free_top = 0) {
    const glm::vec2 first(0, free_top), size = glm::vec2(list.size.width, list.size.height) - first;
    glm::vec2 room(1e6f);
    const auto see = [&](glm::vec3 point) {
        const glm::vec2 pixel = list.projection.project(point).value_or(glm::vec2(-1e6f)) - first;
        room = glm::min(room, glm::min(pixel, size - pixel) / size);
    };
    for (const DiskInstance& disk : list.disks) {
        for (const glm::vec3& way : rim_directions()) {
            see(disk.base + disk.radius * way);
            see(disk.top + disk.top_radius * way);
        }
    }
    for (const BoxInstance& box : list.boxes) {
        if (boxes && box.pickable && is_seen(list.slab, box)) std::ranges::for_each(box_corners(box), see);
    }
    for (const LineInstance& line : list.lines) {
        if (!boxes || !list.moment || line.order.layer != DrawLayer::findings) continue;
        see(line.from);
        see(line.to);
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
                    view.boxes = view.labels = false;
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

TEST(Framing, CaptionAndLegendCoverNothing) {
    const FittedScene pair = testing::hit_scene(mobb::TreeKind::umobb);
    const FittedScene many(testing::scene_of({{}, {{3, 1}, 70, 0}, {{-4, 2}, 10, 1}, {{1, -5}, 200, 0}}), {});
    std::vector<ViewState> views(6);
    views[0].levels = {0, 0, false};
    views[1].color_by = ColorBy::waste;
    views[2].query = 0;
    views[2].step = {Step::Unit::event, 3};
    views[2].past = Past::all;
    views[3].time = 0.7;
    views[4].show = Show::moment;
    views[5].show = Show::plan;
    int beside = 0;
    for (const PictureSize size : {PictureSize{1280, 720}, {640, 360}, {400, 900}, {1600, 400}, {300, 1200}}) {
        for (const CameraPreset preset : {CameraPreset::iso, CameraPreset::top, CameraPreset::front}) {
            for (std::size_t i = 0; i < views.size(); ++i) {
                ViewState view = views[i];
                view.camera.preset = preset;
                const DrawList list = build_draw_list(view.query ? pair : many, view, size);
                SCOPED_TRACE(std::to_string(size.width) + ", preset " + std::to_string(static_cast<int>(preset)) +
                             ", view " + std::to_string(i));
                const Seen seen = seen_in(list);
                EXPECT_FALSE(seen.covered);
                EXPECT_TRUE(Rect({glm::vec2(0), glm::vec2(size.width, size.height)}).contains(seen.around));
                view.labels = false;
                const DrawList alone = build_draw_list(view.query ? pair : many, view, size);
                EXPECT_LE(list.camera.distance, 2 * alone.camera.distance) << "it is not made tiny";
                if (list.camera.shift == glm::dvec2(0)) {
                    EXPECT_EQ(list.camera.distance, alone.camera.distance) << "all of the picture is filled";
                }
                beside += list.camera.shift == glm::dvec2(0) ? 0 : 1;
            }
        }
    }
    EXPECT_GT(beside, 20);
}

TEST(Framing, ATinyPictureIsFilled) {
    const FittedScene fitted = testing::hit_scene();
    ViewState view;
    view.whole_legend = true;
    const DrawList list = build_draw_list(fitted, view, PictureSize{80, 64});
    ASSERT_FALSE(list.overlays.empty());
    view.labels = false;
    EXPECT_LE(list.camera.distance, 2 * build_draw_list(fitted, view, PictureSize{80, 64}).camera.distance);
}

/// Whatever the caption of each says, and however large its boxes are.
TEST(Framing, PicturesSideBySideAreSeenFromOnePlace) {
    const Scene scene = testing::scene_of({{}, {{3, 1}, 70, 0}});
    std::vector<PictureBeside> pictures;
    for (const mobb::TreeKind kind : {mobb::TreeKind::aabb, mobb::TreeKind::mobb, mobb::TreeKind::umobb}) {
        mobb::FitOptions options;
        options.tree = kind;
        pictures.push_back({std::make_shared<const FittedScene>(scene, options), {}});
        pictures.back().view.levels = {static_cast<int>(pictures.size()) - 1, static_cast<int>(pictures.size()), false};
    }
    pictures[1].view.legend = false;
    pictures.push_back(pictures.back());
    pictures.back().view.camera.preset = CameraPreset::top;
    const PictureOptions options{.size = {480, 360}};
    const std::vector<DrawList> lists = build_draw_lists(pictures, options);
    ASSERT_EQ(lists.size(), 4u);
    EXPECT_EQ(lists[1].camera, lists[0].camera);
    EXPECT_EQ(lists[2].camera, lists[0].camera);
    EXPECT_NE(lists[3].camera, lists[0].camera);
    EXPECT_EQ(lists[3].camera, build_draw_list(*pictures[3].fitted, pictures[3].view, options).camera);
    for (const DrawList& list : lists) {
        EXPECT_FALSE(seen_in(list).covered);
        EXPECT_TRUE(Rect({glm::vec2(0), glm::vec2(480, 360)}).contains(seen_in(list).around));
    }
}

TEST(Framing, FreePartsAreTheLargestThatNoPanelCovers) {
    const std::vector<Rect> panels{{{10, 10}, {500, 60}}, {{850, 10}, {990, 150}}, {{10, 400}, {150, 590}}};
    const std::vector<Rect> parts = free_parts({1000, 600}, panels);
    float largest = 0;
    for (const Rect& part : parts) {
        for (const Rect& panel : panels) EXPECT_FALSE(part.overlaps(panel));
        largest = std::max(largest, part.size().x * part.size().y);
        for (const Rect& other : parts) EXPECT_TRUE(&other == &part || !other.contains(part));
    }
    EXPECT_GE(largest, 700 * 540);
    ASSERT_EQ(free_parts({1000, 600}, {}).size(), 1u);
    EXPECT_EQ(united(std::vector<Rect>{{{0, 0}, {4, 4}}, {{6, 6}, {9, 9}}, {{3, 3}, {7, 7}}}).size(), 1u);
}

TEST(Framing, NothingButSceneQueryAndSizeMovesTheCamera) {
    const FittedScene mobb = testing::hit_scene();
    const FittedScene umobb = testing::hit_scene(mobb::TreeKind::umobb);
    for (const std::optional<int> query : {std::optional<int>(), std::optional<int>(0)}) {
        ViewState plain;
        plain.query = query;
        plain.labels = plain.frame_boxes = false;
        const PictureFrame first = picture_frame(mobb, plain, kGoldenSize);
        std::vector<ViewState> views(8, plain);
        views[0].step = {Step::Unit::event, 0};
        views[1].step = {Step::Unit::event, 3};
        views[2].levels = {0, 0, false};
        views[3].levels.leaves = true;
        views[4].time = 0.7;
        views[5].ancestors = true;
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
        view.boxes = view.labels = false;
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
    one.boxes = one.labels = false;
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
            view.boxes = false;
            view.camera = film_camera(paths, view, kGoldenSize, Played::turn);
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

/// A box far down in a tree may reach out of the root's.
TEST(Framing, AFilmsCameraHoldsTheBoxesOfAllItsPictures) {
    mobb::FitOptions options;
    options.leaf = 4;
    options.time_scale = 0.2;
    for (const mobb::TreeKind kind : {mobb::TreeKind::moving, mobb::TreeKind::hybrid1}) {
        options.tree = kind;
        const FittedScene fitted(testing::scene_of({{}, {{1, -1}, 90, 0}}), options);
        KeptPaths paths(std::make_shared<const FittedScene>(fitted));
        // A caption as wide as the picture.
        for (const int free_top : {0, 150}) {
            SCOPED_TRACE(free_top);
            const Rect caption{glm::vec2(0), glm::vec2(kGoldenSize.width, free_top)};
            const std::vector<Rect> panels(free_top > 0 ? 1 : 0, caption);
            const auto closest = [&](const ViewState& seen, Played played, int pictures, const auto& picture) {
                ViewState view = seen;
                view.camera = film_camera(paths, view, kGoldenSize, played, panels);
                glm::vec2 room(1);
                for (int i = 0; i < pictures; ++i) {
                    picture(view, i);
                    room = glm::min(room, room_around(build_draw_list(fitted, view, kGoldenSize), true, free_top));
                }
                return std::min(room.x, room.y);
            };
            ViewState view;
            view.time_height = 3;
            view.levels = {1, 4, false};
            EXPECT_NEAR(closest(view, Played::motion, 3, [](ViewState& of, int i) { of.time = 0.5 * i; }), 0.05 / 1.1,
                        2e-3);
            EXPECT_GT(closest(view, Played::turn, 12, [](ViewState& of, int) { of.camera.yaw_deg += 30; }), 0.04);
            view.query = 0;
            const int steps = paths.recorded(view).trace.size();
            const auto go_to = [](ViewState& of, int i) { of.step = {Step::Unit::event, static_cast<double>(i)}; };
            go_to(view, 0);
            EXPECT_NEAR(closest(view, Played::steps, steps, go_to), 0.05 / 1.1, 2e-3);
            view.slab = ValueRange{50, 60};
            view.labels = false;
            EXPECT_EQ(film_camera(paths, view, kGoldenSize, Played::steps),
                      picture_frame(fitted, view, kGoldenSize).camera)
                << "no box is in the slab";
        }
    }
}

/// The box around a bend reaches out of the floor.
TEST(Framing, AFilmOfAPlanHoldsTheSectionsOfAllItsPictures) {
    std::vector<mobb::Disk> disks;
    for (int i = 0; i < 20; ++i) disks.push_back({0.1 * i, 0, 0.2});
    for (int i = 0; i <= 20; ++i) disks.push_back({2 + 0.05 * i, 0.0866 * i, 0.2});
    Scene scene = testing::scene_of({{}});
    scene.clips.front().clip = std::make_shared<const mobb::Clip>(1 / 10.0, std::move(disks));
    mobb::FitOptions options;
    options.tree = mobb::TreeKind::umobb;
    const FittedScene fitted(std::move(scene), options);
    KeptPaths paths(std::make_shared<const FittedScene>(fitted));
    ViewState seen;
    seen.show = Show::plan;
    seen.levels = {0, 0, false};
    seen.time = 0;
    for (const Played played : {Played::motion, Played::turn}) {
        ViewState view = seen;
        view.camera = film_camera(paths, view, kGoldenSize, played);
        for (int i = 0; i < 12; ++i) {
            if (played == Played::turn) view.camera.yaw_deg += 30;
            if (played == Played::motion) view.time = 0.3 * i;
            const glm::vec2 room = room_around(build_draw_list(fitted, view, kGoldenSize), true);
            EXPECT_GT(std::min(room.x, room.y), 0.04) << i;
        }
    }
}

}  // namespace
}  // namespace mobbscope
