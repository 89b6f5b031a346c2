// What is uploaded for a picture: nothing of the world where only the camera, the time or the step is another.
#include <render/drawlist/camera.h>
#include <render/parts/highlights.h>
#include <render/pictures/build_draw_list.h>
#include <render/pictures/kept_paths.h>
#include <scene/crowd_scene.h>

#include "crowd/walker_moves.h"
#include "render/backends.h"
#include "render/pictures.h"
#include "render/scenes.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <optional>
#include <utility>

namespace mobbscope {
namespace {

class KeptBuffersTest : public testing::OnEachBackend {
  protected:
    explicit KeptBuffersTest(Scene scene = testing::scene_of({{}, {{1, -1}, 90, 0.25}}, 300))
        : paths_(std::make_shared<const FittedScene>(std::move(scene), mobb::FitOptions{})) {}

    /// Draws the view twice, so that all that can be kept is.
    void settle(const ViewState& view, int samples) {
        for (int i = 0; i < 2; ++i) draw(view, samples);
    }
    DrawStatistics draw(const ViewState& view, int samples) {
        renderer().paint(build_draw_list(paths_, view, {.size = kSmallSize}), samples);
        return renderer().statistics();
    }

    KeptPaths paths_;
};

TEST_P(KeptBuffersTest, OrbitingUploadsNothingOfTheWorld) {
    for (const int samples : {1, 4}) {
        ViewState view;
        view.camera.preset = CameraPreset::free;
        settle(view, samples);
        for (int i = 0; i < 24; ++i) {
            view.camera.yaw_deg += 15;
            view.camera.pitch_deg = -80 + 7 * i;
            const DrawStatistics statistics = draw(view, samples);
            EXPECT_EQ(statistics.world_bytes, 0u) << i;
            EXPECT_GT(statistics.overlay_bytes, 0u);
            EXPECT_GT(statistics.triangles, 100u);
            EXPECT_LT(statistics.draw_calls, 40u);
        }
    }
}

TEST_P(KeptBuffersTest, ZoomingUploadsNothingOfTheWorld) {
    ViewState view;
    view.camera = build_draw_list(paths_, view, {.size = kSmallSize}).camera;
    settle(view, 1);
    const double distance = view.camera.distance;
    std::size_t nearest = 0;
    for (const double factor : {0.1, 0.5, 1.0, 2.0, 10.0, 100.0}) {
        view.camera.distance = factor * distance;
        const DrawStatistics statistics = draw(view, 1);
        EXPECT_EQ(statistics.world_bytes, 0u) << factor;
        if (factor == 1.0) nearest = statistics.triangles;
        if (factor > 1) {
            EXPECT_LT(statistics.triangles, nearest) << "farther away";
        }
    }
}

TEST_P(KeptBuffersTest, ScrubbingUploadsNothingOfTheDisks) {
    ViewState view;
    view.time = 1;
    settle(view, 1);
    for (int i = 0; i < 10; ++i) {
        *view.time += 0.1;
        const DrawStatistics statistics = draw(view, 1);
        EXPECT_LT(statistics.triangles, 3000u) << "disks are taken from the picture before";
        // The plane of the cursor is a box.
        EXPECT_LT(statistics.world_bytes, 2000u) << i;
        EXPECT_LT(statistics.state_bytes, 2000u) << i;
    }
}

TEST_P(KeptBuffersTest, SteppingUploadsColorsAtMost) {
    ViewState view;
    view.query = 0;
    view.boxes = false;
    for (int i = 0; i < 10; ++i) {
        view.step = {Step::Unit::percent, 10.0 * i};
        const DrawStatistics statistics = draw(view, 1);
        if (i >= 2) {
            EXPECT_LT(statistics.world_bytes, 2000u) << i;
        }
    }
}

/// Which disks are seen where is found out once: steps give them other colours.
TEST_P(KeptBuffersTest, SteppingDrawsNoDiskAnew) {
    ViewState view;
    view.query = 0;
    view.step = {Step::Unit::percent, 0};
    view.camera = build_draw_list(paths_, view, {.size = kSmallSize}).camera;
    const std::size_t all = draw(view, 4).triangles;
    for (int i = 1; i < 10; ++i) {
        view.step = {Step::Unit::percent, 10.0 * i};
        view.theme = i < 5 ? Theme::dark : Theme::light;
        const DrawList list = build_draw_list(paths_, view, {.size = kSmallSize});
        EXPECT_TRUE(renderer().has_disks(list, 4));
        const Image drawn = renderer().draw(list);
        EXPECT_LT(renderer().statistics().triangles, all / 10) << i;
        EXPECT_EQ(drawn.rgba, Renderer(GetParam()).draw(list).rgba) << i;
    }
    view.camera.pitch_deg = 90;
    EXPECT_FALSE(renderer().has_disks(build_draw_list(paths_, view, {.size = kSmallSize}), 4));
    EXPECT_FALSE(renderer().has_disks(build_draw_list(paths_, {}, {.size = {200, 120}}), 4));
}

TEST_P(KeptBuffersTest, OtherLevelsDrawNoDiskAnew) {
    ViewState view;
    view.camera = build_draw_list(paths_, view, {.size = kSmallSize}).camera;
    settle(view, 4);
    for (int level = 0; level < 5; ++level) {
        view.levels = {level, level, false};
        EXPECT_TRUE(renderer().has_disks(build_draw_list(paths_, view, {.size = kSmallSize}), 4)) << level;
    }
}

/// What is kept shows what a renderer without a past would.
TEST_P(KeptBuffersTest, WhatIsKeptIsWhatIsShown) {
    ViewState view;
    for (int i = 0; i < 6; ++i) {
        // Steps of one query differ in colours alone, and once in the height of time.
        if (i >= 2) view.query = 0;
        view.step = {Step::Unit::percent, 20.0 * i};
        view.time_height = i < 4 ? 0 : 2;
        view.time = 0.3 * i;
        view.theme = i < 3 ? Theme::dark : Theme::light;
        const DrawList kept = build_draw_list(paths_, view, {.size = kSmallSize});
        const DrawList fresh = build_draw_list(*paths_.fitted(), view, {.size = kSmallSize});
        Renderer anew(GetParam());
        const Image first = anew.draw(fresh);
        for (int again = 0; again < 3; ++again) EXPECT_EQ(renderer().draw(kept).rgba, first.rgba) << i;
        for (int again = 0; again < 3; ++again) {
            EXPECT_EQ(renderer().draw(kept, 1).rgba, anew.draw(fresh, 1).rgba) << i;
        }
    }
}

/// What is under the mouse changes with every move of it.
TEST_P(KeptBuffersTest, PointingOutUploadsItsLinesAlone) {
    ViewState view;
    view.levels = {0, 3, false};
    view.time = 1;
    DrawList list = build_draw_list(paths_, view, {.size = kSmallSize});
    const DrawList other = build_draw_list(paths_, {}, {.size = kSmallSize});
    const DrawnAgent agent = drawn_agents(*paths_.fitted(), view)[0];
    const std::size_t words = [&] {
        renderer().paint(list, 4);
        return renderer().statistics().overlay_bytes;
    }();
    for (int i = 0; i < 8; ++i) {
        list.highlights.clear();
        if (i != 3) add_highlight(list, agent, {AgentPart::Kind::sample, 10 * i}, HighlightLine::Role::hover, 1);
        const int samples = i == 5 ? 1 : 4;
        if (i == 4) renderer().paint(other, 4);
        renderer().paint_highlights(list, samples);
        const DrawStatistics statistics = renderer().statistics();
        if (i < 4) {
            EXPECT_EQ(statistics.world_bytes + statistics.state_bytes, 0u) << i;
            EXPECT_EQ(statistics.overlay_bytes, list.highlights.size() * 17 * sizeof(float)) << "no word either";
            EXPECT_LT(statistics.draw_calls, 6u);
        } else if (i < 7) {
            EXPECT_GE(statistics.overlay_bytes, words) << i << ": the picture before was another one";
        }
        const auto shown = testing::pixels_of(renderer().paint_highlights(list, samples), kSmallSize);
        EXPECT_EQ(shown, Renderer(GetParam()).draw(list, samples).rgba) << i;
    }
    const auto as_painted_anew = [&] {
        const auto shown = testing::pixels_of(renderer().paint_highlights(list, 4), kSmallSize);
        return shown == Renderer(GetParam()).draw(list, 4).rgba;
    };
    renderer().draw(list, 4);
    EXPECT_TRUE(as_painted_anew()) << "after it was read back";
    renderer().draw_ids(other);
    EXPECT_TRUE(as_painted_anew()) << "after the ids of another picture";
    renderer().paint(build_draw_list(paths_, view, {.size = {200, 120}}), 4);
    EXPECT_TRUE(as_painted_anew()) << "after a picture of another size";
}

/// The ghosts of a selection are part of what is pointed out.
TEST_P(KeptBuffersTest, AncestorsUploadTheirLinesAlone) {
    DrawList list = build_draw_list(paths_, {}, {.size = kSmallSize});
    const DrawnAgent agent = drawn_agents(*paths_.fitted(), {})[0];
    renderer().paint(list, 4);
    const int nodes = static_cast<int>(agent.placed.tree().nodes().size());
    for (const int node : {nodes - 1, nodes / 2, 1}) {
        add_ancestors(list, agent, node, 1);
        EXPECT_EQ(list.highlights.size(), 12u * static_cast<std::size_t>(agent.placed.tree().level(node)));
        renderer().paint_highlights(list, 4);
        const DrawStatistics statistics = renderer().statistics();
        EXPECT_EQ(statistics.world_bytes + statistics.state_bytes, 0u) << node;
        EXPECT_EQ(statistics.overlay_bytes, list.highlights.size() * 17 * sizeof(float));
    }
}

/// What a list shows is known by its revision: another one may stand where it stood.
TEST_P(KeptBuffersTest, AnotherListInTheSamePlaceIsPaintedAnew) {
    ViewState view;
    std::optional<DrawList> list = build_draw_list(paths_, view, {.size = kSmallSize});
    renderer().paint(*list, 4);
    const DrawList copy = *list;
    EXPECT_TRUE(renderer().has_scene(*list, 4));
    EXPECT_TRUE(renderer().has_scene(copy, 4));
    renderer().begin_paint(*list, 4);
    EXPECT_TRUE(renderer().is_painting(copy));
    renderer().paint(*list, 4);
    view.color_by = ColorBy::level;
    list.emplace(build_draw_list(paths_, view, {.size = kSmallSize}));
    EXPECT_FALSE(renderer().has_scene(*list, 4));
    const auto shown = testing::pixels_of(renderer().paint_highlights(*list, 4), kSmallSize);
    EXPECT_EQ(shown, Renderer(GetParam()).draw(*list, 4).rgba);
    EXPECT_NE(shown, Renderer(GetParam()).draw(copy, 4).rgba);
    EXPECT_FALSE(renderer().has_scene(copy, 4));
}

/// A run of twenty.
class RunBuffersTest : public KeptBuffersTest {
  protected:
    RunBuffersTest() : KeptBuffersTest(testing::with_run(testing::walker_scene(), 20, {13, 13})) {
        view_.time = 10;
        view_.camera.preset = CameraPreset::free;
    }
    ViewState view_;
};

TEST_P(RunBuffersTest, AnotherCameraUploadsNothingOfTheWorld) {
    for (const int samples : {1, 4}) {
        settle(view_, samples);
        for (int i = 0; i < 12; ++i) {
            view_.camera.yaw_deg += 30;
            view_.camera.pitch_deg = -80 + 13 * i;
            EXPECT_EQ(draw(view_, samples).world_bytes, 0u) << i;
        }
        ViewState near = view_;
        near.camera.pitch_deg = 20;
        near.camera.target = glm::dvec3(2, 0, 0);
        for (const double distance : {3.0, 9.0, 40.0, 900.0}) {
            near.camera.distance = distance;
            EXPECT_EQ(draw(near, samples).world_bytes, 0u) << distance;
        }
    }
}

TEST_P(RunBuffersTest, WhatLiesBesideThePictureIsNotDrawn) {
    ViewState empty = view_;
    empty.disks = false;
    for (const int samples : {1, 4}) {
        view_.camera.target = empty.camera.target = glm::dvec3(0, 300, 0);
        view_.camera.distance = empty.camera.distance = 9;
        EXPECT_EQ(draw(view_, samples).triangles, draw(empty, samples).triangles);
    }
}

/// Blocks of disks are left out; what is seen of them must not be.
TEST_P(RunBuffersTest, WhatIsSeenIsDrawn) {
    view_.floor = view_.labels = false;
    view_.camera.target = glm::dvec3(0);
    for (const bool perspective : {true, false}) {
        for (const double distance : {0.5, 3.0, 9.0, 40.0}) {
            for (const double pitch : {-30.0, 5.0, 80.0}) {
                view_.camera.perspective = perspective;
                view_.camera.distance = distance;
                view_.camera.pitch_deg = pitch;
                const DrawList list = build_draw_list(paths_, view_, {.size = kSmallSize});
                DrawList apart = list;  // each disk a block of its own
                int index = 0;
                for (DiskInstance& disk : apart.disks.edit()) disk.id.index = 2 * index++;
                // A near disk beside the picture may give all of them more sides.
                const Image drawn = renderer().draw(list);
                const Image wanted = renderer().draw(apart);
                int different = 0;
                for (std::size_t byte = 0; byte < wanted.rgba.size(); ++byte) {
                    different += std::abs(drawn.rgba[byte] - wanted.rgba[byte]) > 48;
                }
                EXPECT_LT(different, drawn.width * drawn.height / 100)
                    << perspective << " at " << distance << ", " << pitch;
            }
        }
    }
}

TEST(KeptPaths, OfARunAreThoseOfItsTimeAndWindow) {
    const auto run = std::make_shared<const FittedScene>(testing::with_run(testing::walker_scene(), 20, {13, 13}),
                                                         mobb::FitOptions{});
    KeptPaths of_run(run);
    // As the window holds it: the plays around a time, from which a view shows fewer seconds.
    ViewState view;
    view.time = 10;
    view.time_height = 1;
    const auto plays = std::make_shared<const FittedScene>(fitted_at(*run, view));
    KeptPaths of_plays(plays);
    for (const auto& [time, window] : {std::pair(10.0, 2.0), {9.0, 1.0}, {9.0, 0.5}, {10.0, 0.5}}) {
        view.time = time;
        view.time_window = window;
        EXPECT_EQ(testing::text_of(build_draw_list(of_run, view, {.size = kSmallSize})),
                  testing::text_of(build_draw_list(*run, view, kSmallSize)));
        EXPECT_EQ(testing::text_of(build_draw_list(of_plays, view, {.size = kSmallSize})),
                  testing::text_of(build_draw_list(*plays, view, kSmallSize)));
    }
    for (const Show show : {Show::moment, Show::space_time}) {
        view.show = show;
        view.theme = show == Show::moment ? Theme::light : Theme::dark;
        EXPECT_EQ(testing::text_of(build_draw_list(of_run, view, {.size = kSmallSize})),
                  testing::text_of(build_draw_list(*run, view, kSmallSize)));
    }
}

INSTANTIATE_TEST_SUITE_P(All, RunBuffersTest, ::testing::Values(Backend::osmesa, Backend::egl), testing::backend_name);
INSTANTIATE_TEST_SUITE_P(All, KeptBuffersTest, ::testing::Values(Backend::osmesa, Backend::egl), testing::backend_name);

}  // namespace
}  // namespace mobbscope
