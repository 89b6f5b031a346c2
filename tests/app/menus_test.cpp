// Right-click menus, what a toolbar has no room for, folded sections, the status bar, the list of the history.
#include <app/commands/command.h>
#include <app/panels/recursion_picture.h>
#include <app/script/script.h>
#include <app/window/headless_window.h>
#include <render/drawlist/pick.h>
#include <render/gl/gl_context.h>

#include "app/folder_window.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace mobbscope::app {
namespace {

struct MenuWindow : FolderWindow<CrossingFolder> {
    explicit MenuWindow(PictureSize size = {1280, 900}, double scale = 1, bool attended = false)
        : FolderWindow(size, scale, attended) {
        session.files.open({folder.scene});
        while (session.jobs.job()) session.poll();
        window.settle();
    }
    void run(const std::string& script) {
        std::ostringstream out;
        Script::parse(script, "test").run(session, window, out);
    }
    const std::map<std::string, Rect>& marks() { return window.shell().marks().all(); }
    bool has(const std::string& mark) { return marks().contains(mark); }
    bool has_menu() {
        return std::ranges::any_of(marks(), [](const auto& mark) { return mark.first.starts_with("context."); });
    }
    /// Where the first thing that holds for a box of the picture stands in the window.
    std::string place_of_box() {
        const DrawList& list = *window.shell().shown();
        const glm::vec2 corner = marks().at("viewport").min;
        const glm::vec2 at = corner + list.projection.project(list.boxes.front().center).value();
        return std::to_string(at.x) + ' ' + std::to_string(at.y);
    }
};

TEST(Menus, ARightClickSelectsWhatIsThereAndSaysWhatCanBeDoneWithIt) {
    MenuWindow w;
    w.run("click " + w.place_of_box() + " right");
    ASSERT_EQ(w.session.workspace.selection.kind, Selection::Kind::node);
    for (const char* id : {"view.frame", "go.parent", "step.next_of_node", "view.level", "agent.remove", "go.agent"}) {
        EXPECT_TRUE(w.has(std::string("context.") + id)) << id;
    }
    const Selection selected = w.session.workspace.selection;
    w.run("click context.edit.copy_figures");
    EXPECT_FALSE(w.has_menu());
    EXPECT_NE(w.desktop.text.find("samples\t"), std::string::npos) << w.desktop.text;
    EXPECT_EQ(w.session.workspace.selection, selected);
    w.run("click " + w.place_of_box() + " right\nclick context.go.agent");
    EXPECT_EQ(w.session.workspace.selection.kind, Selection::Kind::path);
}

TEST(Menus, WhatIsSelectedBehindSomethingStaysSelected) {
    MenuWindow w;
    const std::string there = w.place_of_box();
    w.run("click " + there + "\nwait 1\nclick " + there);
    const Selection behind = w.session.workspace.selection;
    w.run("key Escape\nclick " + there);
    ASSERT_NE(w.session.workspace.selection, behind);
    w.session.workspace.select(behind);
    w.run("click " + there + " right");
    EXPECT_EQ(w.session.workspace.selection, behind);
}

TEST(Menus, WhatCannotBeDoneDoesNothing) {
    MenuWindow w;
    w.run("click " + w.place_of_box() + " right\nclick context.step.next_of_node");
    EXPECT_FALSE(w.session.workspace.view().query);
    EXPECT_TRUE(w.has("context.step.next_of_node")) << "the menu stays";
    w.run("key Escape");
    EXPECT_FALSE(w.has_menu());
    EXPECT_EQ(w.session.workspace.selection.kind, Selection::Kind::node) << "Escape closed the menu alone";
}

TEST(Menus, ARightDragShiftsAndOpensNothing) {
    MenuWindow w;
    const Camera before = w.session.workspace.view().camera;
    w.run("drag viewport 60 20 right");
    EXPECT_FALSE(w.has_menu());
    EXPECT_NE(w.session.workspace.view().camera, before);
    EXPECT_EQ(w.session.workspace.selection, Selection{});
}

TEST(Menus, NothingUnderTheMouseHasThePicturesMenu) {
    MenuWindow w;
    const Rect rect = w.marks().at("viewport");
    const std::string corner = std::to_string(rect.max.x - 12) + ' ' + std::to_string(rect.min.y + 40);
    w.run("run go.agent A\nclick " + corner + " right");
    EXPECT_EQ(w.session.workspace.selection.kind, Selection::Kind::path) << "it is not about what is selected";
    w.run("click context.view.boxes");
    EXPECT_FALSE(w.session.workspace.view().boxes);
    EXPECT_FALSE(w.has_menu());
}

TEST(Menus, RowsTestsAndTimesHaveMenus) {
    MenuWindow w;
    w.run("click clip.1 right\nclick context.agent.add");
    EXPECT_EQ(w.session.workspace.scene().agents.back().name, "stand");
    w.run("click query.1 right\nclick context.query.select\nexpect /view/query 1");
    w.run("click query.0 right\nclick context.query.copy_answer\nexpect /view/query 0");
    EXPECT_NE(w.desktop.text, "");
    w.run("run step.first\nclick query.icicle right");
    EXPECT_EQ(w.session.workspace.step(), 0) << "a right click goes nowhere by itself";
    w.run("click context.step.to");
    EXPECT_GT(w.session.workspace.step(), 0);
    w.run("click query.icicle right\nclick context.go.node.2");
    EXPECT_EQ(w.session.workspace.selection.kind, Selection::Kind::node);
    EXPECT_EQ(w.session.workspace.selection.path.agent, 1) << "the node of B";
    const mobb::Interval span = time_span(w.session.workspace);
    w.run("click timeline.time right");
    EXPECT_FALSE(w.session.workspace.view().time);
    w.run("click context.time.at");
    EXPECT_NEAR(w.session.workspace.view().time.value_or(-1), 0.5 * (span.t0 + span.t1), 0.02);
}

TEST(Menus, AClickOnTheRecursionGoesToTheTestThatItsTooltipTells) {
    MenuWindow w;
    w.run("run query.select 0\nrun step.first");
    const Recursion& recursion = w.session.queries.findings()->recursion;
    const Rect icicle = w.marks().at("query.icicle");
    const ShownEvents all{{0, w.session.workspace.recorded()->trace.size()}};
    const int row = icicle_row(icicle.size().y, recursion.depth, 1, 0);
    int inner = 0;
    for (const PairCell& cell : icicle_cells(recursion, all, static_cast<int>(icicle.size().x), row)) {
        const RecursionPair& pair = recursion.pairs[static_cast<std::size_t>(cell.pair)];
        const glm::vec2 at = icicle.min + 0.5f * glm::vec2(cell.x0 + cell.x1, cell.y0 + cell.y1);
        if (at.y >= icicle.max.y) continue;
        w.run("click " + std::to_string(at.x) + ' ' + std::to_string(at.y));
        EXPECT_EQ(w.session.workspace.step(), pair.last);
        inner += pair.last > pair.first;
    }
    EXPECT_GT(inner, 0) << "else first and last test are one";
}

TEST(Menus, EveryLevelOfADeepTreeHasAButton) {
    for (const double width : {120.0, 256.0, 420.0}) {
        MenuWindow w;
        std::string samples = "t,x,y,r\n";
        for (int i = 0; i < 5000; ++i) {
            samples += std::to_string(i) + ',' + std::to_string(0.5 * i) + ',' + std::to_string(i % 7) + ",0.3\n";
        }
        w.folder.write("long.csv", samples);
        w.session.settings.left_width = width;
        w.session.files.open({w.folder.file("long.csv")});
        while (w.session.jobs.job()) w.session.poll();
        w.run("run tree.leaf 1");
        while (w.session.jobs.job()) w.session.poll();
        w.window.settle();
        const int depth = w.session.workspace.fitted().tree(0).depth();
        ASSERT_EQ(depth, 14);
        for (int level = 0; level < depth; ++level) {
            const std::string button = "view.level." + std::to_string(level);
            ASSERT_TRUE(w.has(button)) << button << " at " << width;
            EXPECT_GE(w.marks().at(button).size().x, 12) << button << " at " << width;
            w.run("click " + button);
            EXPECT_EQ(w.session.workspace.view().levels, (LevelRange{level, level, false})) << width;
        }
    }
}

TEST(Menus, AnExcerptSaysWhatOneGoesBackTo) {
    MenuWindow w;
    w.run("run query.capture 0");
    ASSERT_TRUE(w.session.workspace.in_excerpt());
    EXPECT_EQ(w.session.workspace.title(), "A and B of scene.json");
    EXPECT_EQ(command_named("crowd.back").title, "Back to the whole scene");
    w.run("click crowd.back");
    EXPECT_EQ(w.session.workspace.title(), "scene.json");
}

TEST(Menus, KeysOpenTheMenuOfWhatHasTheFocusOrIsSelected) {
    MenuWindow w;
    w.run("key Tab\nkey Down\nexpect /focus \"agent.1\"\nkey Shift+F10");
    EXPECT_TRUE(w.has("context.agents.hide"));
    EXPECT_EQ(w.session.workspace.selection.path.agent, 1) << "as a right click does";
    EXPECT_EQ(w.session.keys.focus, "context.view.frame") << "the keys go through it";
    const glm::vec2 row = w.marks().at("agent.1").center();
    const glm::vec2 menu = w.marks().at("context.view.frame").min;
    EXPECT_LT(glm::length(menu - row), 160) << "at the row";
    w.run("key Escape");
    EXPECT_FALSE(w.has_menu());
    EXPECT_EQ(w.session.keys.focus, "agent.1");
    w.run("key Menu\nkey H\nkey Enter\nexpect /view/hidden/0 \"B\"");
    w.run("key V\nkey Escape\nkey Escape\nexpect /focus null\nexpect /selection/kind \"none\"\nkey Shift+F10");
    EXPECT_TRUE(w.has("context.view.iso")) << "nothing is selected: the picture's";
    w.run("key Escape\nrun go.node A 1\nkey Shift+F10");
    EXPECT_TRUE(w.has("context.go.parent"));
    const DrawList& list = *w.window.shell().shown();
    const auto box = std::ranges::find_if(list.boxes, [](const BoxInstance& b) {
        return b.id == ObjectId{0, ObjectId::Kind::box, 1};
    });
    ASSERT_NE(box, list.boxes.end());
    const glm::vec2 at = w.marks().at("viewport").min + list.projection.project(box->center).value();
    // A long menu reaches upwards too.
    const glm::vec2 top = w.marks().at("context.view.frame").min, end = w.marks().at("context.agent.remove").max;
    EXPECT_LT(std::abs(top.x - at.x), 60) << "at the box";
    EXPECT_LT(top.y - 60, at.y);
    EXPECT_GT(end.y + 60, at.y);
    w.run("key Down\nkey Enter\nexpect /selection/index 0");
    EXPECT_EQ(w.session.keys.focus, "");
}

TEST(Menus, TheChoiceOfPastTestsIsPlain) {
    MenuWindow w;
    w.run("run query.select 0\nkey Alt+V\nkey P\nkey A\nkey S");
    EXPECT_EQ(w.session.keys.focus, "menu.view.past") << "two menus deep, not three";
    w.run("key Enter");
    EXPECT_EQ(w.session.keys.focus, "menu.view.past.ancestors") << "what is chosen";
    w.run("key O\nkey Enter\nexpect /view/past \"pair\"");
    w.run("key Ctrl+P\ntype only the pair\nkey Enter");
    EXPECT_EQ(w.session.workspace.view().past, Past::pair);
}

TEST(Menus, TheMoreMenuHoldsWhatHasNoRoom) {
    for (const PictureSize size : {PictureSize{800, 600}, {1024, 700}, {1280, 800}, {1600, 900}}) {
        for (const double scale : {1.0, 1.5, 2.0}) {
            SCOPED_TRACE(std::to_string(size.width) + " at " + std::to_string(scale));
            MenuWindow w(size, scale);
            std::set<std::string> all;
            const auto take = [&] {
                for (const auto& [name, rect] : w.marks()) {
                    if (name.starts_with("toolbar.")) all.insert(name);
                }
            };
            take();
            const float right = w.marks().at("viewport").max.x;
            for (const std::string& name : all) EXPECT_LE(w.marks().at(name).max.x, right) << name;
            if (all.erase("toolbar.more") > 0) {
                w.run("click toolbar.more");
                take();
                all.erase("toolbar.more");
            }
            EXPECT_EQ(all.size(), 13u);
            w.run("click toolbar.view.moment\nexpect /view/show \"moment\"");
        }
    }
    EXPECT_FALSE(MenuWindow({1280, 800}, 1).has("toolbar.more")) << "the usual window has room for all";
}

TEST(Menus, PanelsKeepToTheirWidthInSmallWindows) {
    for (const PictureSize size : {PictureSize{640, 400}, {800, 600}, {1024, 768}, {1280, 800}, {1440, 900}}) {
        for (const double scale : {1.0, 1.5, 2.0}) {
            SCOPED_TRACE(std::to_string(size.width) + " at scale " + std::to_string(scale));
            MenuWindow w(size, scale);
            const auto right_of = [&](const char* name) { return w.marks().at(name).max.x; };
            const auto expect_half = [&] {
                EXPECT_GE(w.marks().at("viewport").size().x, 0.49f * static_cast<float>(size.width));
            };
            expect_half();
            w.run("run query.select 0");
            const bool folds = w.has("fold.left");
            EXPECT_EQ(folds, static_cast<float>(size.width) < 740 * scale);
            if (w.has("agent.0")) w.run("click agent.0");
            for (const char* name : {"agent.0", "clip.0", "query.0", "tree.kind", "agent.name", "agent.x"}) {
                if (!w.has(name)) continue;
                EXPECT_LE(right_of(name), w.marks().at("splitter.left").min.x) << name;
            }
            const float middle = w.marks().at(folds ? "fold.right" : "splitter.right").min.x;
            for (const char* name : {"timeline.clear", "timeline.time", "query.strip"}) {
                ASSERT_TRUE(w.has(name)) << name;
                EXPECT_LE(right_of(name), middle) << name;
            }
            if (!folds) continue;
            // One of them is there at a time.
            w.run("click fold.right");
            EXPECT_FALSE(w.has("agent.0"));
            EXPECT_TRUE(w.has("query.answer"));
            expect_half();
            w.run("click fold.right");
            EXPECT_FALSE(w.has("query.answer"));
            EXPECT_GT(w.marks().at("viewport").size().x, 0.8f * static_cast<float>(size.width));
            w.run("click fold.left");
            EXPECT_TRUE(w.has("agent.0"));
        }
    }
}

TEST(Menus, WidthsOfPanelsHoldInLargerWindows) {
    Settings settings;
    settings.left_width = 400;
    settings.right_width = 500;
    const auto widths = [&](PictureSize size) {
        MenuWindow w(size, 1);
        w.session.settings = settings;
        w.window.settle();
        return std::pair(w.marks().at("splitter.left").min.x,
                         static_cast<float>(size.width) - w.marks().at("splitter.right").max.x);
    };
    EXPECT_EQ(widths({1920, 1080}), std::pair(400.0f, 500.0f));
    EXPECT_EQ(widths({1500, 900}), std::pair(400.0f, 500.0f));
    const auto [left, right] = widths({1024, 768});
    EXPECT_LE(left + right, 512);
    EXPECT_LT(left, right) << "each keeps its share";
}

TEST(Menus, ASectionFoldsAndStaysSo) {
    MenuWindow w;
    w.run("click section.clips");
    EXPECT_FALSE(w.has("clip.0"));
    EXPECT_TRUE(w.session.settings.folded.at("clips"));
    const float below = w.marks().at("section.queries").min.y;
    w.run("click section.clips");
    EXPECT_TRUE(w.has("clip.0"));
    EXPECT_GT(w.marks().at("section.queries").min.y, below);
    EXPECT_FALSE(w.session.settings.folded.at("clips"));
}

TEST(Menus, NoListJumpsWhenSomebodyIsSelected) {
    MenuWindow w;
    const std::map<std::string, Rect> before = w.marks();
    w.run("click agent.1");
    ASSERT_TRUE(w.has("agent.x"));
    for (const auto& [name, rect] : before) {
        if (!name.starts_with("agent.") && !name.starts_with("clip.") && !name.starts_with("query.")) continue;
        ASSERT_TRUE(w.has(name)) << name;
        EXPECT_EQ(w.marks().at(name).min.y, rect.min.y) << name;
    }
}

TEST(Menus, AQueryOpensWhereItWasLeft) {
    MenuWindow w;
    w.run("run query.select 0\nrun step.to 2\nclick query.1\nexpect /query/index 1");
    const int end = w.session.workspace.recorded()->trace.size() - 1;
    EXPECT_EQ(w.session.workspace.step(), end) << "its first opening shows the answer";
    w.run("key Q\nclick query.0\nexpect /query/step 2\nkey PageDown\nkey PageUp\nexpect /query/step 2");
    // The previous view is where one was, and what it left is still known.
    w.run("run step.to 1\nkey Q\nkey Ctrl+[\nexpect /query/step 1\nkey Ctrl+[\nexpect /query/step 2");
    // The queries before it may go.
    w.run("run query.select 2\nrun step.to 0\nrun query.select 0\nrun query.remove\nrun query.select 1");
    EXPECT_EQ(w.session.workspace.step(), 0);
    // Of a shorter trace the end is what is nearest.
    w.run("run query.select 0\nrun step.last\nrun query.none\nrun tree.levels 1\nrun query.select 0");
    EXPECT_EQ(w.session.workspace.step(), w.session.workspace.recorded()->trace.size() - 1);
}

TEST(Menus, TheHistoryIsAListToGoTo) {
    MenuWindow w;
    w.run("run go.agent A\nrun agent.move 1 1\nrun agent.turn 20\nrun agent.start 2\nrun edit.history");
    ASSERT_EQ(w.session.workspace.history.count(), 4u);
    ASSERT_TRUE(w.has("history.3"));
    w.run("click history.1");
    EXPECT_EQ(w.session.workspace.scene().agents[0].placement.translate, glm::dvec2(1, 1));
    EXPECT_EQ(w.session.workspace.scene().agents[0].placement.rotate_deg, 0);
    EXPECT_EQ(w.session.workspace.history.place(), 1u) << "two back at once";
    EXPECT_EQ(w.session.dialogs.now, Dialog::history) << "to be looked at";
    w.run("key Down\nexpect /scene/agents/0/rotate_deg 20\nkey Down\nexpect /scene/agents/0/start 2");
    w.run("key Up\nkey Up\nkey Up\nkey Up\nkey Enter\nexpect /dialog \"none\"\nexpect /modified false");
    EXPECT_EQ(w.session.workspace.history.redo_title(), "moving A: x 1.00 m, y 1.00 m");
}

TEST(Menus, ClipsAreNoAgentsUntilTheyAreMadeSome) {
    MenuWindow w;
    w.session.files.open({w.folder.file("walk.csv"), w.folder.file("stand.csv")});
    w.window.settle();
    for (const char* row : {"agent.0", "clip.0"}) {
        w.run(std::string("click ") + row + " right");
        EXPECT_TRUE(w.has("context.agent.make")) << row;
        for (const char* id : {"query.add", "agent.add", "agent.rename", "agent.duplicate", "agent.remove"}) {
            EXPECT_FALSE(w.has(std::string("context.") + id)) << row << ' ' << id;
        }
        w.run("key Escape");
    }
    EXPECT_FALSE(w.has("scene.add_agent"));
    EXPECT_THROW(run_command(w.session, "agent.add", "walk"), std::invalid_argument)
        << "two clips would be three agents";
    w.run("click scene.make_agents\nexpect /scene/agents/1/name \"stand\"\nexpect /scene/agents/2 null");
    EXPECT_FALSE(w.has("scene.make_agents"));
    w.run("click agent.0 right");
    EXPECT_TRUE(w.has("context.agent.rename"));
    EXPECT_FALSE(w.has("context.agent.make"));
    w.run("key Escape\nkey Ctrl+Z\nexpect /scene/agents null\nexpect /undo null");
}

TEST(Menus, NothingButWhatIsUnderTheMouseIsOutlined) {
    MenuWindow w;
    w.run("run query.select 0\nrun step.to 6");
    const DrawList& list = *w.window.shell().shown();
    const glm::vec2 corner = w.marks().at("viewport").min;
    const auto has_faces = [&](const Pick& hit) {
        return std::ranges::any_of(list.boxes,
                                   [&](const BoxInstance& b) { return b.pickable && b.id == hit.id && b.fill.a > 0; });
    };
    // Within nodes tested before, where nothing else is.
    int empty = 0;
    int lit = 0;
    for (int y = 20; y < list.size.height; y += 30) {
        for (int x = 20; x < list.size.width; x += 30) {
            const glm::vec2 at(x, y);
            const std::vector<Pick> hits = pick(list, at);
            const auto outlined = [&](const Pick& hit) {
                return hit.id.kind == ObjectId::Kind::box && !has_faces(hit);
            };
            if (hits.empty() || !std::ranges::all_of(hits, outlined)) continue;
            w.run("move " + std::to_string(corner.x + at.x) + ' ' + std::to_string(corner.y + at.y));
            ++(w.session.workspace.hovered == Selection{} ? empty : lit);
        }
    }
    EXPECT_GT(empty, 10);
    EXPECT_LT(lit, empty) << "only at the edges";
}

TEST(Menus, TheStatusBarCountsAndSaysWhatIsUnderTheMouse) {
    MenuWindow w;
    const Rect bar = w.marks().at("status.counts");
    EXPECT_LT(bar.max.y - bar.min.y, 20);
    EXPECT_FALSE(w.has("status.hover"));
    EXPECT_FALSE(w.has("status.frame")) << "a picture is the same every time";
    w.run("move agent.0");
    EXPECT_TRUE(w.has("status.hover"));
    w.run("move " + w.place_of_box());
    EXPECT_EQ(w.session.workspace.hovered.kind, Selection::Kind::node);
    w.run("move clip.0");
    EXPECT_EQ(w.session.workspace.hovered, (Selection{Selection::Kind::clip, {}, 0}));
    w.run("move menu.search");
    EXPECT_EQ(w.session.workspace.hovered, Selection{}) << "what the mouse has left is not under it";
    EXPECT_FALSE(w.has("status.hover"));
    MenuWindow attended({1280, 800}, 1, true);
    attended.window.shell().read_back();
    attended.window.settle();
    EXPECT_TRUE(attended.has("status.frame"));
}

}  // namespace
}  // namespace mobbscope::app
