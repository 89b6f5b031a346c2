// Named views: saved, gone to, renamed and removed, with a small picture of each.
#include <app/window/headless_window.h>
#include <render/gl/gl_context.h>

#include "app/crossing_window.h"

#include <gtest/gtest.h>

#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace mobbscope::app {
namespace {

struct ViewsWindow : CrossingWindow {
    const ViewState& view() const { return session.workspace.view(); }
    std::string names() const {
        std::string out;
        for (const NamedView& named : session.workspace.scene().debug.views)
            out.append(out.empty() ? "" : ", ").append(named.name);
        return out;
    }
    /// How many colours the window has where a widget stands.
    std::size_t colors_at(const std::string& mark) {
        const Rect rect = window.shell().marks().all().at(mark);
        const Image image = window.shell().read_back();
        std::set<int> out;
        for (int y = static_cast<int>(rect.min.y); y < static_cast<int>(rect.max.y); ++y) {
            for (int x = static_cast<int>(rect.min.x); x < static_cast<int>(rect.max.x); ++x) {
                const auto at = 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                                     static_cast<std::size_t>(x));
                out.insert((image.rgba[at] << 16) | (image.rgba[at + 1] << 8) | image.rgba[at + 2]);
            }
        }
        return out.size();
    }
};

TEST(NamedViews, AreSavedAndGoneToByTheirPictures) {
    ViewsWindow w;
    EXPECT_FALSE(w.has("section.views")) << "there is none";
    w.run("run view.level 2\nrun view.save_as boxes");
    EXPECT_TRUE(w.has("section.views"));
    ASSERT_TRUE(w.has("named_view.0"));
    EXPECT_GT(w.colors_at("named_view.0"), 100u) << "its picture is drawn";
    const Camera seen = w.view().camera;
    ASSERT_TRUE(seen.target);
    w.run("run view.top\nrun view.leaves\nrun agents.hide A\nrun view.save_as from above");
    EXPECT_EQ(w.names(), "boxes, from above");
    w.run("click named_view.0");
    EXPECT_EQ(w.view().levels, (LevelRange{2, 2, false}));
    EXPECT_EQ(w.view().camera, seen);
    EXPECT_TRUE(w.view().hidden.empty());
    w.run("run view.previous");
    EXPECT_EQ(w.view().hidden, std::vector<std::string>{"A"}) << "going there is looking around";
    // The window's colours stay, and a view that names what is not there is cut to what is.
    w.run("run view.theme light\nrun view.go from above");
    EXPECT_EQ(w.view().theme, Theme::light);
    w.run("run query.select 2\nrun view.save_as query\nrun query.none\nrun go.agent C\nrun agent.remove");
    EXPECT_EQ(w.session.workspace.scene().debug.views.at(2).view.query, std::nullopt) << "B against C is gone";
}

TEST(NamedViews, AreEditsOfTheScene) {
    ViewsWindow w;
    w.run("run view.save_as one");
    EXPECT_TRUE(w.session.workspace.modified());
    EXPECT_EQ(w.session.workspace.history.undo_title(), "saving the view one");
    w.run("run view.rename  the first ");
    EXPECT_EQ(w.names(), "the first");
    w.run("run view.level 1\nrun view.save_as the first");
    EXPECT_EQ(w.names(), "the first") << "one of that name becomes this one";
    EXPECT_EQ(w.session.workspace.scene().debug.views[0].view.levels, (LevelRange{1, 1, false}));
    w.run("run view.save_as two");
    EXPECT_THROW(run_command(w.session, "view.rename", "the first"), std::invalid_argument);
    EXPECT_THROW(run_command(w.session, "view.save_as", "  "), std::invalid_argument);
    EXPECT_THROW(run_command(w.session, "view.save_as", "top"), std::invalid_argument) << "render --view would not";
    EXPECT_THROW(run_command(w.session, "view.rename", "iso"), std::invalid_argument);
    EXPECT_THROW(run_command(w.session, "view.go", "three"), std::invalid_argument);
    w.run("run view.remove two");
    EXPECT_THROW(run_command(w.session, "view.rename", "x"), std::invalid_argument) << "the one gone to last is gone";
    w.run("run edit.undo");
    EXPECT_EQ(w.names(), "the first, two");
    w.run("run file.save");
    const std::vector<NamedView> saved = w.session.workspace.scene().debug.views;
    w.run("run file.reload");
    EXPECT_EQ(w.session.workspace.scene().debug.views, saved);
}

TEST(NamedViews, HaveAMenu) {
    ViewsWindow w;
    w.run("run view.save_as one\nrun view.save_as two\nrun view.level 1\nclick named_view.0 right");
    for (const char* item : {"context.view.go", "context.view.save_as", "context.view.rename", "context.view.remove"})
        EXPECT_TRUE(w.has(item)) << item;
    w.run("click context.view.save_as");
    EXPECT_EQ(w.session.workspace.scene().debug.views[0].view.levels, (LevelRange{1, 1, false}));
    w.run("click named_view.0 right\nclick context.view.rename\ntype uno\nkey Enter");
    EXPECT_EQ(w.names(), "uno, two");
    w.run("click named_view.1 right\nclick context.view.remove");
    EXPECT_EQ(w.names(), "uno");
    w.run("run view.leaves\nkey Ctrl+P\ntype go to uno\nkey Enter");
    EXPECT_EQ(w.session.workspace.history.look_back_title(), "going to the view uno") << "the palette knows the name";
}

TEST(NamedViews, WhatAViewLacksInTheSceneIsLeftOut) {
    ViewsWindow w;
    w.folder.write("lacking.json",
                   R"({"clips": {"walk": {"source": "walk.csv"}}, "agents": [{"name": "A", "clip": "walk"}],
        "debug": {"views": [{"name": "lost", "view": {"query": 7, "hidden": ["Z"], "levels": 1,
                                                      "subtree": {"participant": 3, "node": 2}}}]}})");
    w.run("run file.open " + w.folder.file("lacking.json").string());
    ASSERT_EQ(w.names(), "lost");
    EXPECT_GT(w.colors_at("named_view.0"), 100u);
    w.run("click named_view.0");
    EXPECT_EQ(w.view().query, std::nullopt);
    EXPECT_EQ(w.view().subtree, std::nullopt);
    EXPECT_TRUE(w.view().hidden.empty());
    EXPECT_EQ(w.view().levels, (LevelRange{1, 1, false}));
}

/// Counts the pictures that it has somebody else draw.
struct CountingMaker : PictureMaker {
    explicit CountingMaker(PictureMaker& to_) : to(to_) {}
    Image draw(const DrawList& list, int samples) override { return to.draw(list, samples); }
    Image draw_coarse(const DrawList& list, int divisor) override {
        ++drawn;
        return to.draw_coarse(list, divisor);
    }
    PictureMaker& to;
    int drawn = 0;
};

TEST(NamedViews, OnePictureIsDrawnAFrameAndNoneAmidADrag) {
    ViewsWindow w;
    PictureMaker* const maker = w.session.picture_maker;
    CountingMaker counting(*maker);
    w.session.picture_maker = &counting;
    w.run("run view.save_as one\nrun view.save_as two\nrun view.save_as three\nrun go.agent A");
    EXPECT_EQ(counting.drawn, 3);
    w.window.shell().feed(MouseMove{{800, 300}});
    w.window.shell().feed(MouseButton{0, true});
    w.window.settle();
    run_command(w.session, "agent.nudge", "1 0");
    w.window.settle();
    EXPECT_EQ(counting.drawn, 3);
    w.window.shell().feed(MouseButton{0, false});
    for (int before = counting.drawn, frame = 0; frame < 8; before = counting.drawn, ++frame) {
        w.window.frame();
        EXPECT_LE(counting.drawn, before + 1);
    }
    EXPECT_EQ(counting.drawn, 6);
    w.session.picture_maker = maker;
}

TEST(NamedViews, PicturesDoNotCountTheQueries) {
    ViewsWindow w;
    w.run("run view.color_by tests\nrun view.save_as tests\nrun view.color_by agent");
    const std::size_t before = w.colors_at("named_view.0");
    EXPECT_GT(before, 100u) << "its picture is drawn";
    run_command(w.session, "nodes.count");
    w.window.settle();
    EXPECT_NE(w.colors_at("named_view.0"), before) << "its picture shows what is counted now";
}

}  // namespace
}  // namespace mobbscope::app
