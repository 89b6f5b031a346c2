// Slabs of time and the floor plan in the window, by mouse and keys.
#include <app/document/agents.h>
#include <app/script/script.h>
#include <app/window/headless_window.h>
#include <render/gl/gl_context.h>
#include <render/parts/highlights.h>

#include "app/folder_window.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <string>

namespace mobbscope::app {
namespace {

struct SlabWindow : FolderWindow<CrossingFolder> {
    SlabWindow() : FolderWindow({1280, 800}) {
        session.files.open({folder.scene});
        while (session.jobs.job()) session.poll();
        window.settle();
    }
    void run(const std::string& script) {
        std::ostringstream out;
        Script::parse(script, "test").run(session, window, out);
    }
    const ViewState& view() const { return session.workspace.view(); }
    Rect bars() { return window.shell().marks().all().at("timeline.time"); }
    /// Where a time stands on the bars, so far down.
    glm::vec2 at(double time, float down) {
        const mobb::Interval span = time_span(session.workspace);
        const Rect rect = bars();
        const double share = (time - span.t0) / (span.t1 - span.t0);
        return {rect.min.x + static_cast<float>(share) * rect.size().x, rect.min.y + down * rect.size().y};
    }
    void drag(glm::vec2 from, glm::vec2 to, bool shift) {
        Shell& shell = window.shell();
        const auto feed = [&](const InputEvent& event) {
            shell.feed(event);
            window.settle();
        };
        feed(MouseMove{from});
        if (shift) feed(KeyPress{Key::shift, true});
        feed(MouseButton{0, true});
        for (int i = 1; i <= 5 && from != to; ++i) feed(MouseMove{from + (to - from) * (0.2f * static_cast<float>(i))});
        feed(MouseButton{0, false});
        if (shift) feed(KeyPress{Key::shift, false});
    }
};

TEST(SlabInTheWindow, IsDraggedOverTheTimeline) {
    SlabWindow w;
    w.drag(w.at(1.5, 0.2f), w.at(0.5, 0.2f), true);
    ASSERT_TRUE(w.view().slab);
    EXPECT_NEAR(w.view().slab->least, 0.5, 0.01);
    EXPECT_NEAR(w.view().slab->most, 1.5, 0.01);
    EXPECT_FALSE(w.view().time) << "the time cursor is another drag";
    ASSERT_TRUE(w.window.shell().shown()->slab);

    w.drag(w.at(1.5, 0.5f), w.at(1.9, 0.5f), false);
    EXPECT_NEAR(w.view().slab->least, 0.5, 0.01);
    EXPECT_NEAR(w.view().slab->most, 1.9, 0.01) << "its handle";
    w.drag(w.at(0.5, 0.5f), w.at(2.2, 0.5f), false);
    EXPECT_NEAR(w.view().slab->least, 1.9, 0.01) << "past the other end they change places";
    EXPECT_NEAR(w.view().slab->most, 2.2, 0.01);

    w.drag(w.at(0.7, 0.5f), w.at(0.9, 0.5f), false);
    EXPECT_NEAR(w.view().time.value_or(-1), 0.9, 0.01) << "beside the handles the time cursor is dragged";
    EXPECT_NEAR(w.view().slab->least, 1.9, 0.01);

    w.drag(w.at(1, 0.2f), w.at(1, 0.2f), true);
    EXPECT_FALSE(w.view().slab) << "a click with Shift";
    EXPECT_NEAR(w.view().time.value_or(-1), 0.9, 0.01);
    w.run("run view.previous");
    ASSERT_TRUE(w.view().slab);
    EXPECT_NEAR(w.view().slab->least, 1.9, 0.01);
    w.drag(w.at(1, 0.2f), w.at(1.2, 0.2f), true);
    EXPECT_NEAR(w.view().slab->least, 1, 0.01);
}

TEST(SlabInTheWindow, IsFramedByHome) {
    SlabWindow w;
    w.run("run view.frame_boxes\nkey Home");
    const double all = w.window.shell().shown()->camera.distance;
    w.run("run view.slab 0.5:0.7\nkey Home");
    const DrawList& list = *w.window.shell().shown();
    EXPECT_LT(list.camera.distance, all);
    const glm::dvec3 target = list.space.place(list.space.from_target(*list.camera.target));
    EXPECT_NEAR(target.z, 0.6, 0.05);
    w.run("run view.no_slab\nkey Home");
    EXPECT_NEAR(w.window.shell().shown()->camera.distance, all, 1e-6 * all);
}

TEST(SlabInTheWindow, WhatItCutsAwayIsNotPointedOut) {
    SlabWindow w;
    w.run("run view.level 2\nrun view.slab 0.5:0.7\nrun go.node A 0.0");
    ASSERT_EQ(w.session.workspace.selection.kind, Selection::Kind::node);
    EXPECT_FALSE(w.window.shell().shown()->highlights.empty());
    w.run("run view.slab 50:60");
    EXPECT_TRUE(w.window.shell().shown()->highlights.empty());
}

TEST(FloorPlan, HasACameraOfItsOwn) {
    SlabWindow w;
    w.run("run time.at 0.7\nrun view.zoom 2\nrun view.orbit 20 5");
    const Camera before = w.view().camera;
    w.run("key Shift+G");
    EXPECT_EQ(w.view().show, Show::plan);
    const auto list = [&]() -> const DrawList& { return *w.window.shell().shown(); };
    ASSERT_TRUE(list().moment);
    EXPECT_NEAR(list().projection.back.z, 1, 1e-6);
    EXPECT_NEAR(list().projection.up.y, 1, 1e-6) << "y is up";
    EXPECT_FALSE(list().projection.perspective);
    w.run("run view.orbit 90 30");
    EXPECT_NEAR(list().projection.back.z, 1, 1e-6) << "it only turns about the upright axis";
    EXPECT_NEAR(std::abs(list().projection.up.x), 1, 1e-4);
    w.run("key M");
    EXPECT_EQ(w.view().show, Show::moment);
    w.run("key Shift+G\nkey Shift+G");
    EXPECT_EQ(w.view().show, Show::space_time);
    EXPECT_EQ(w.view().camera, before);
    w.run("run view.plan");
    EXPECT_EQ(w.view().show, Show::plan);
}

}  // namespace
}  // namespace mobbscope::app
