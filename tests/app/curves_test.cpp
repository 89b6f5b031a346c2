// The plots below the timeline: on its axis, of who is shown, and what the mouse does in them.
#include <app/window/headless_window.h>
#include <base/text.h>
#include <explain/path_curves.h>
#include <render/gl/gl_context.h>

#include "app/folder_window.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace mobbscope::app {
namespace {

struct CurvesWindow : FolderWindow<CrossingFolder> {
    CurvesWindow() : FolderWindow({1280, 1000}) {
        session.files.open({folder.scene});
        run("bottom.show", "curves");
    }
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

/// A walk of its own, which ends apart from the others.
std::string own_walk(int i) { return walk_csv() + "2,2," + std::to_string(0.01 * i) + ",0.4\n"; }
std::string clip_json(const std::string& name) { return '"' + name + "\": {\"source\": \"" + name + ".csv\"}"; }
std::string agent_json(const std::string& name) { return "{\"name\": \"" + name + "\", \"clip\": \"" + name + "\"}"; }

/// A scene with so many clips, each with a tree and an agent of its own.
std::string clips_scene(const CrossingFolder& folder, int count) {
    std::string clips, agents;
    for (int i = 0; i < count; ++i) {
        const std::string name = std::to_string(i);
        const char* const comma = i > 0 ? "," : "";
        folder.write(name + ".csv", own_walk(i));
        clips.append(comma).append(clip_json(name));
        agents.append(comma).append(agent_json(name));
    }
    return "{\"clips\": {" + clips + "}, \"agents\": [" + agents + "]}";
}

TEST(Curves, CostsAreFoundOnceAndOnlyOfTheActiveView) {
    constexpr int kCount = 12;
    CurvesWindow w;
    w.run("file.open", w.folder.write("clips.json", clips_scene(w.folder, kCount)).string());
    w.run("compare.fits", "mobb umobb moving aabb");
    const Workspace& workspace = w.session.workspace;
    ASSERT_EQ(w.session.views.count(), 4u);
    std::vector<std::shared_ptr<const TreeCost>> known;
    for (int clip = 0; clip < kCount; ++clip) {
        known.push_back(workspace.cost_of(clip));
        EXPECT_TRUE(known.back()) << clip;
        EXPECT_EQ(workspace.cost_of(*w.session.views.at(1).fitted, clip) != nullptr, clip == 0) << clip;
    }
    for (int frame = 0; frame < 3; ++frame) w.window.settle();
    for (int clip = 0; clip < kCount; ++clip) EXPECT_EQ(workspace.cost_of(clip), known[static_cast<std::size_t>(clip)]);
}

TEST(Curves, NoCostIsGivenUpForThatOfAnotherClip) {
    constexpr int kCount = 4;
    const CrossingFolder folder;
    TestDesktop desktop;
    Session session{true};
    session.desktop = &desktop;
    session.options.may_write = false;
    session.files.open({folder.write("clips.json", clips_scene(folder, kCount))});
    session.options.patience = {};
    while (session.jobs.job()) session.poll();
    const auto all_known = [&] {
        // As panels ask in each frame; none is waited for.
        session.fit_costs.update(0);
        for (int clip = 1; clip < kCount; ++clip) session.fit_costs.find_when_idle(clip);
        for (int clip = 0; clip < kCount; ++clip) {
            if (!session.workspace.cost_of(clip)) return false;
        }
        return true;
    };
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (!all_known() && std::chrono::steady_clock::now() < end) std::this_thread::yield();
    EXPECT_TRUE(all_known());
    session.end_work();
}

}  // namespace
}  // namespace mobbscope::app
