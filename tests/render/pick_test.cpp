#include <mobb/traversal.h>
#include <render/drawlist/camera.h>
#include <render/drawlist/pick.h>
#include <render/drawlist/picture_options.h>
#include <render/parts/node_boxes.h>
#include <render/pictures/build_draw_list.h>
#include <scene/drawn_agent.h>
#include <support/folders.h>

#include "render/backends.h"
#include "render/scenes.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <tuple>
#include <vector>

namespace mobbscope {
namespace {

constexpr PictureSize kPickSize{960, 540};

FittedScene demo_scene(const std::string& name) {
    Scene scene = load_scene(kScenes / (name + ".json"));
    const mobb::FitOptions options = scene.fit;
    return {std::move(scene), options};
}

std::string describe(const std::optional<ObjectId>& id) {
    if (!id) return "nothing";
    return std::to_string(id->agent) + (id->kind == ObjectId::Kind::disk ? " disk " : " box ") +
           std::to_string(id->index);
}

glm::vec2 middle_of_pixel(int x, int y) { return {static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f}; }

/// Whether the picks have `drawn` first. Nested boxes share planes, where rounding decides which of them is drawn:
/// there it may come after others of the same depth.
bool agrees(const std::vector<Pick>& picks, const std::optional<ObjectId>& drawn) {
    if (!drawn || picks.empty()) return !drawn && picks.empty();
    return std::any_of(picks.begin(), picks.end(), [&](const Pick& one) {
        return one.id == *drawn && one.id.kind == picks.front().id.kind && one.depth - picks.front().depth < 1e-3f;
    });
}

/// How many of every so many pixels differ, and how many of them show something.
struct Agreement {
    int pixels = 0;
    int shown = 0;
    int differing = 0;
    std::string example;
};

Agreement compare(const DrawList& list, const IdImage& drawn) {
    Agreement out;
    for (int y = 2; y < drawn.height; y += 5) {
        for (int x = 2; x < drawn.width; x += 5) {
            const std::optional<ObjectId> expected = drawn.at(x, y);
            const std::vector<Pick> picks = pick(list, middle_of_pixel(x, y));
            ++out.pixels;
            out.shown += expected ? 1 : 0;
            // A face that is seen edge-on may run through the middles of a row: rounding takes either side of it.
            const auto agrees_near = [&](float aside) {
                return agrees(pick(list, middle_of_pixel(x, y) + glm::vec2(0, aside)), expected);
            };
            if (agrees(picks, expected) || agrees_near(-0.02f) || agrees_near(0.02f)) continue;
            ++out.differing;
            out.example = "(" + std::to_string(x) + ", " + std::to_string(y) + "): drawn " + describe(expected) +
                          ", picked " + describe(picks.empty() ? std::nullopt : std::optional(picks.front().id));
        }
    }
    return out;
}

class PickTest : public testing::OnEachBackend {};

TEST_P(PickTest, AgreesWithThePicture) {
    for (const std::string name : {"crossing", "collision", "circles", "running"}) {
        const FittedScene fitted =
            name == "running" ? FittedScene(testing::running_scene({{}, {{1, -1}, 90, 0}}), {}) : demo_scene(name);
        std::vector<ViewState> views(8, fitted.scene().view);
        views[0].levels = {0, 4, false};
        views[1].levels = {3, 3, false};
        views[1].camera = {};
        views[1].camera.preset = CameraPreset::top;
        views[2].camera.preset = CameraPreset::front;
        views[3].camera.preset = CameraPreset::side;
        views[3].boxes = false;
        views[4].levels.leaves = true;
        views[4].camera.preset = CameraPreset::free;
        views[4].camera.pitch_deg = -30;
        views[5].camera.perspective = false;
        views[5].camera.fov_deg = 60;
        if (!fitted.queries().empty()) {
            views[6].query = 0;
            views[6].step = {Step::Unit::percent, 40};
            views[7].query = 0;
            views[7].proof = false;  // else its walls stand in place of boxes
        }
        for (std::size_t i = 0; i < views.size(); ++i) {
            const DrawList list = build_draw_list(fitted, views[i], kPickSize);
            const Agreement agreement = compare(list, renderer().draw_ids(list));
            EXPECT_GT(agreement.shown, agreement.pixels / 100) << name << ", view " << i;
            EXPECT_LT(agreement.differing, 0.005 * agreement.shown)
                << name << ", view " << i << ": of " << agreement.shown << " shown, such as " << agreement.example;
        }
    }
}

TEST_P(PickTest, AgreesFromInsideABoxAmongDisks) {
    for (const bool running : {false, true}) {
        const FittedScene fitted =
            running ? FittedScene(testing::running_scene({{}, {{1, -1}, 90, 0}}, 30), {}) : demo_scene("crossing");
        ViewState view = fitted.scene().view;
        view.levels = {0, 2, false};
        DrawList list = build_draw_list(fitted, view, kPickSize);
        view.camera = list.camera;
        view.camera.fov_deg = 100;
        view.camera.distance = 0.2;
        list = build_draw_list(fitted, view, kPickSize);
        const Agreement agreement = compare(list, renderer().draw_ids(list));
        EXPECT_GT(agreement.shown, agreement.pixels / 2);
        EXPECT_LT(agreement.differing, 0.005 * agreement.shown) << agreement.example;
    }
}

/// Of two who walk together, side by side, all faces lie in the same planes.
TEST_P(PickTest, OfFacesInOnePlaneThoseOfTheFirstAgentAreSeen) {
    const FittedScene fitted(testing::scene_of({{}, {{0.2, 0.1}, 0, 0}}), {});
    ViewState view;
    view.boxes = view.labels = false;
    view.camera.preset = CameraPreset::free;
    constexpr PictureSize kSize{320, 240};
    const auto coplanar = [](const DrawList& list, glm::vec2 pixel) {
        const std::vector<Pick> picks = pick(list, pixel);
        if (picks.size() < 2 || std::abs(picks[0].depth - picks[1].depth) > 1e-4f * picks[0].depth) return false;
        return picks[0].id.agent != picks[1].id.agent && picks[0].id.index == picks[1].id.index;
    };
    for (const double pitch : {90.0, 40.0, -60.0}) {
        for (const bool perspective : {true, false}) {
            int contested = 0, lost = 0;
            for (int i = 0; i < 6; ++i) {
                view.camera.pitch_deg = pitch;
                view.camera.yaw_deg = 30 + 0.01 * i;
                view.camera.perspective = perspective;
                const DrawList list = build_draw_list(fitted, view, kSize);
                const IdImage ids = renderer().draw_ids(list);
                for (int y = 1; y < kSize.height; y += 2) {
                    for (int x = 1; x < kSize.width; x += 2) {
                        const glm::vec2 middle = middle_of_pixel(x, y);
                        // Not at their rims.
                        const std::array around{glm::vec2(-1, 0), glm::vec2(1, 0), glm::vec2(0, -1), glm::vec2(0, 1)};
                        if (!std::ranges::all_of(around, [&](glm::vec2 by) { return coplanar(list, middle + by); })) {
                            continue;
                        }
                        ++contested;
                        lost += ids.at(x, y) && ids.at(x, y)->agent == 0 ? 0 : 1;
                    }
                }
            }
            EXPECT_GT(contested, 100) << pitch;
            EXPECT_EQ(lost, 0) << pitch << (perspective ? " in perspective, of " : ", of ") << contested;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Backends, PickTest, ::testing::Values(Backend::osmesa, Backend::egl), testing::backend_name);

/// How far from a box's surface a place is, metres: 0 on it.
double off_surface(const mobb::PlacedTree& tree, int node, glm::dvec3 place) {
    const mobb::Box box = world_box(tree, node);
    glm::dvec3 from = glm::dvec3(place.x, place.y, place.z * tree.time_scale()) - box.center;
    from -= glm::dvec3(box.drift * (from.z / box.half.z), 0);
    double outside = -1e9;
    for (int i = 0; i < 3; ++i) {
        const double along = std::abs(glm::dot(from, box.axes[static_cast<std::size_t>(i)]));
        outside = std::max(outside, along - box.half[i]);
    }
    return std::abs(outside);
}

double off_surface(const mobb::PlacedClip& clip, int sample, glm::dvec3 place) {
    const mobb::Disk disk = mobb::swept(clip, sample).at(place.z);
    const double beyond_rim = std::hypot(place.x - disk.x, place.y - disk.y) - disk.r;
    const double beyond_faces = std::max(clip.time(sample) - place.z, place.z - clip.time(sample + 1));
    return std::abs(std::max(beyond_rim, beyond_faces));
}

struct PickedCase {
    mobb::TreeKind kind;
    bool running;
};

class PickedPlaces : public ::testing::TestWithParam<PickedCase> {};

TEST_P(PickedPlaces, LieOnWhatIsPicked) {
    for (const bool far : {false, true}) {
        const glm::dvec2 there = far ? glm::dvec2(10'000, -10'000) : glm::dvec2(0);
        const double then = far ? 1e5 : 0;
        mobb::FitOptions options;
        options.tree = GetParam().kind;
        options.time_scale = 2;
        const std::vector<mobb::Placement> places{{there, 0, then}, {there + glm::dvec2(1, -1), 90, then}};
        const FittedScene fitted(GetParam().running ? testing::running_scene(places) : testing::scene_of(places),
                                 options);
        for (const CameraPreset preset : {CameraPreset::iso, CameraPreset::top, CameraPreset::side}) {
            ViewState view;
            view.camera.preset = preset;
            view.levels = {0, 3, false};
            const DrawList list = build_draw_list(fitted, view, kPickSize);
            const std::vector<DrawnAgent> paths = drawn_agents(fitted, view);
            int picked = 0;
            for (int y = 5; y < kPickSize.height; y += 11) {
                for (int x = 5; x < kPickSize.width; x += 11) {
                    float depth = -1e9f;
                    for (const Pick& one : pick(list, middle_of_pixel(x, y))) {
                        ++picked;
                        const mobb::PlacedTree& tree = paths[static_cast<std::size_t>(one.id.agent)].placed;
                        const double off = one.id.kind == ObjectId::Kind::disk
                                               ? off_surface(tree.placed_clip(), one.id.index, one.place)
                                               : off_surface(tree, one.id.index, one.place);
                        ASSERT_LT(off, 1e-5) << describe(one.id);
                        // A box is drawn a hair nearer than it is.
                        ASSERT_GE(one.depth, depth - 0.01f) << "nearest first";
                        depth = std::max(depth, one.depth);
                        const glm::dvec3 p = one.place;
                        const glm::vec2 seen = list.projection.project(list.space.point(p.x, p.y, p.z)).value();
                        ASSERT_LT(glm::length(seen - middle_of_pixel(x, y)), 0.05f);
                    }
                }
            }
            EXPECT_GT(picked, 1000);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Kinds, PickedPlaces, ::testing::ValuesIn([] {
                             std::vector<PickedCase> out{{mobb::TreeKind::umobb, true}};
                             for (const mobb::TreeKind kind : mobb::kTreeKinds) out.push_back({kind, false});
                             return out;
                         }()),
                         [](const auto& test) {
                             return std::string(mobb::name(test.param.kind)) + (test.param.running ? "_running" : "");
                         });

TEST(Pick, ASampleThatRunsIsHitWhereItIsInBetween) {
    const FittedScene fitted(testing::running_scene({{{2, 1}, 30, 5}}), {});
    for (const CameraPreset preset : {CameraPreset::iso, CameraPreset::top, CameraPreset::side}) {
        ViewState view;
        view.camera.preset = preset;
        const DrawList list = build_draw_list(fitted, view, kPickSize);
        const mobb::PlacedClip clip = drawn_agents(fitted, view)[0].clip();
        for (int i = 0; i + 1 < clip.count(); ++i) {
            const double time = 0.5 * (clip.time(i) + clip.time(i + 1));
            const mobb::Disk disk = mobb::swept(clip, i).at(time);
            const glm::vec2 pixel = list.projection.project(list.space.point(disk.x, disk.y, time)).value();
            const std::vector<Pick> picks = pick(list, pixel);
            const auto it = std::ranges::find(picks, ObjectId{0, ObjectId::Kind::disk, i}, &Pick::id);
            EXPECT_TRUE(it != picks.end()) << "sample " << i;
        }
    }
}

TEST(Pick, NothingIsPickedBesideTheScene) {
    const FittedScene fitted = testing::miss_scene();
    EXPECT_TRUE(pick(build_draw_list(fitted, {}, kPickSize), {1.5f, 1.5f}).empty());
}

TEST(FloorAt, IsWhereTheFloorIsSeen) {
    const FittedScene fitted(testing::scene_of({{{500, -70}, 0, 12}}), {});
    for (const bool perspective : {true, false}) {
        ViewState view;
        view.camera.perspective = perspective;
        const DrawList list = build_draw_list(fitted, view, kPickSize);
        for (const double time : {12.0, 13.25}) {
            const glm::dvec2 place(500.3, -69.8);
            const glm::vec2 pixel = list.projection.project(list.space.point(place.x, place.y, time)).value();
            EXPECT_LT(glm::length(floor_at(list, pixel, time).value() - place), 1e-4);
        }
    }
}

TEST(FloorAt, ThereIsNoneAlongOrBehindTheView) {
    const FittedScene fitted = testing::miss_scene();
    ViewState view;
    view.camera.preset = CameraPreset::front;
    EXPECT_FALSE(floor_at(build_draw_list(fitted, view, kPickSize), {300, 200}, 0));
    view.camera.preset = CameraPreset::free;
    view.camera.pitch_deg = 5;
    view.camera.fov_deg = 60;
    const DrawList list = build_draw_list(fitted, view, kPickSize);
    EXPECT_TRUE(floor_at(list, {480, 539}, 0));
    EXPECT_FALSE(floor_at(list, {480, 1}, 0)) << "above the horizon";
}

}  // namespace
}  // namespace mobbscope
