// The plots below the timeline: on its axis, of who is shown, and what the mouse does in them.
#include <app/window/headless_window.h>
#include <base/text.h>
#include <explain/path_curves.h>
#include <render/gl/gl_context.h>

#include "app/crossing_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace mobbscope::app {
namespace {

using testing::CrossingFolder;

struct CurvesWindow {
    CrossingFolder folder;
    testing::TestDesktop desktop;
    Session session{false};
    HeadlessWindow window;

    CurvesWindow() : window(GlContext::open(Backend::automatic), session, {1280, 1000}, 1) {
        session.desktop = &desktop;
        session.files.open({folder.scene});
        run("bottom.show", "curves");
    }
    void run(const std::string& command, const std::string& argument = "") {
        run_command(session, command, argument);
        window.settle();
    }
    bool has(const std::string& mark) { return window.shell().marks().all().contains(mark); }
    Rect rect(const std::string& mark) { return window.shell().marks().all().at(mark); }
    /// The mouse to a part of the plot's width and height, from the lower left.
    void move(const std::string& mark, double across, double up) {
        const Rect at = rect(mark);
        const glm::vec2 size = at.size();
        window.shell().feed(
            MouseMove{{at.min.x + static_cast<float>(across) * size.x, at.max.y - static_cast<float>(up) * size.y}});
        window.settle();
    }
    void press(bool down) {
        window.shell().feed(MouseButton{0, down});
        window.settle();
    }
};

TEST(Curves, StandOnTheAxisOfTheTimeline) {
    CurvesWindow w;
    for (const bool asked : {false, true}) {
        if (asked) w.run("query.select", "0");
        for (const CurveInfo& curve : curve_infos()) {
            const std::string mark = "curves." + std::string(curve.name);
            ASSERT_TRUE(w.has(mark)) << mark;
            EXPECT_EQ(w.rect(mark).min.x, w.rect("timeline.time").min.x);
            EXPECT_EQ(w.rect(mark).max.x, w.rect("timeline.time").max.x);
        }
    }
}

TEST(Curves, AClickMovesTheTimeCursorAndADragGoesOn) {
    CurvesWindow w;
    w.move("curves.speed", 0.5, 0.5);
    w.press(true);
    ASSERT_TRUE(w.session.workspace.view().time);
    // From 0 to 2.5 s.
    EXPECT_NEAR(*w.session.workspace.view().time, 1.25, 0.01);
    w.move("curves.speed", 0.75, 0.5);
    EXPECT_NEAR(*w.session.workspace.view().time, 1.875, 0.01);
    w.press(false);
    w.move("curves.speed", 0.25, 0.5);
    EXPECT_NEAR(*w.session.workspace.view().time, 1.875, 0.01);
}

TEST(Curves, TheSampleAtTheMouseLightsUpAndItsValueIsCopied) {
    CurvesWindow w;
    w.run("agents.hide", "B");
    w.run("agents.hide", "C");
    w.move("curves.speed", 0.206, 0.5);
    // 0.515 s of 2.5 s at 30 a second.
    EXPECT_EQ(w.session.workspace.hovered, (Selection{Selection::Kind::sample, {0, -1, 0}, 15}));
    w.window.shell().feed(KeyPress{Key::ctrl, true});
    w.window.settle();
    w.press(true);
    w.press(false);
    const mobb::Clip& clip = w.session.workspace.fitted().tree(0).clip();
    EXPECT_EQ(w.desktop.text, format_double(speed_curve(clip).values[15]));
    EXPECT_FALSE(w.session.workspace.view().time) << "with Ctrl a click only copies";
}

TEST(Curves, SayWhatIsLeftOut) {
    CurvesWindow w;
    EXPECT_FALSE(w.has("curves.left_out"));
    w.run("go.agent", "C");
    for (int i = 0; i < 11; ++i) w.run("agent.duplicate");
    EXPECT_TRUE(w.has("curves.left_out")) << "14 agents";
}

}  // namespace
}  // namespace mobbscope::app
