// From node to node of a tree by keys and links, a node alone, and the boxes above it.
#include <app/window/headless_window.h>
#include <render/gl/gl_context.h>
#include <render/parts/node_boxes.h>

#include "app/crossing_window.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

namespace mobbscope::app {
namespace {

struct TreeWindow : CrossingWindow {
    const DrawList& shown() { return *window.shell().shown(); }
    const mobb::Tree& tree() const { return session.workspace.fitted().tree(0); }
    /// "1.1"
    std::string selected() const {
        const Selection& now = session.workspace.selection;
        if (now.kind != Selection::Kind::node) return "";
        return std::to_string(tree().level(now.index)) + '.' + std::to_string(tree().place_in_level(now.index));
    }
    std::string press(const std::string& keys) {
        for (std::istringstream in(keys); in >> std::ws && !in.eof();) {
            std::string chord;
            in >> chord;
            run("key " + chord);
        }
        return selected();
    }
    std::string last_message() const {
        return session.notifications.all().empty() ? "" : session.notifications.all().back().text;
    }
    std::set<int> boxes_of(int agent) {
        std::set<int> out;
        for (const BoxInstance& box : shown().boxes)
            if (box.id.agent == agent) out.insert(box.id.index);
        return out;
    }
    long ghosts() {
        return std::ranges::count(shown().highlights, HighlightLine::Role::ancestor, &HighlightLine::role);
    }
};

TEST(TreeWindow, KeysWalkTheTreeAndSayWhereItEnds) {
    TreeWindow w;
    const LevelRange before = w.session.workspace.view().levels;
    w.run("run go.node A 0.0");
    EXPECT_EQ(w.press("Ctrl+Up"), "0.0");
    EXPECT_EQ(w.last_message(), "Parent node: this is the root of its tree");
    EXPECT_EQ(w.press("Ctrl+Down"), "1.0");
    EXPECT_EQ(w.session.workspace.view().levels, (LevelRange{1, 1, false})) << "the level follows";
    EXPECT_EQ(w.press("Ctrl+Left"), "1.0");
    EXPECT_EQ(w.last_message(), "Previous node: this is the first node of its level");
    EXPECT_EQ(w.press("Ctrl+Shift+Down"), "2.1");
    EXPECT_EQ(w.press("Ctrl+Right"), "2.2");
    EXPECT_EQ(w.press("Ctrl+Right Ctrl+Right"), "2.3");
    EXPECT_EQ(w.last_message(), "Next node: this is the last node of its level");
    EXPECT_EQ(w.press("Ctrl+Up"), "1.1");
    EXPECT_EQ(w.press("Ctrl+Down Ctrl+Down Ctrl+Down"), "4.8");
    w.press("Ctrl+Down");
    EXPECT_EQ(w.last_message(), "First child node: this is a leaf");
    w.run("run view.previous");
    EXPECT_EQ(w.session.workspace.view().levels, before) << "levels one after the other are taken back at once";
}

TEST(TreeWindow, LinksLeadAboveBesideAndBelow) {
    TreeWindow w;
    w.run("run go.node B 2.1");
    const auto link = [&](int level, int place) {
        for (int i = 0; i < static_cast<int>(w.tree().nodes().size()); ++i)
            if (w.tree().level(i) == level && w.tree().place_in_level(i) == place) return "node." + std::to_string(i);
        return std::string();
    };
    for (const auto& [level, place] : {std::pair(0, 0), std::pair(1, 0), std::pair(2, 1), std::pair(2, 0),
                                       std::pair(2, 2), std::pair(3, 2), std::pair(3, 3)})
        EXPECT_TRUE(w.has(link(level, place))) << level << '.' << place;
    EXPECT_FALSE(w.has(link(2, 3)));
    w.run("move " + link(3, 3));
    EXPECT_EQ(w.session.workspace.hovered.kind, Selection::Kind::node) << "the picture outlines what a link leads to";
    w.run("click " + link(3, 3));
    EXPECT_EQ(w.selected(), "3.3");
    EXPECT_EQ(w.session.workspace.selection.path.agent, 1);
    w.run("click " + link(1, 0));
    EXPECT_EQ(w.selected(), "1.0");
    w.run("click " + link(1, 1));
    EXPECT_EQ(w.selected(), "1.1");
    // A sample has the way to its leaf.
    w.run("run go.sample B 0");
    EXPECT_TRUE(w.has(link(4, 0)));
    w.run("click " + link(1, 0));
    EXPECT_EQ(w.selected(), "1.0");
}

TEST(TreeWindow, ANodeIsShownAloneAndThePartGoesAlong) {
    TreeWindow w;
    w.run("run go.node A 1.1");
    const int top = w.session.workspace.selection.index;
    const std::set<int> all = w.boxes_of(0), others = w.boxes_of(1);
    EXPECT_FALSE(w.has("toolbar.node.show_all"));
    w.run("run view.level 3\nkey Shift+I");
    EXPECT_EQ(w.session.workspace.view().subtree, (DrawnNode{0, top}));
    EXPECT_EQ(w.boxes_of(0).size(), 5u) << "the node, and four on level 3";
    EXPECT_EQ(w.boxes_of(1).size(), 8u);
    EXPECT_TRUE(w.shown().headline.empty() || w.has("toolbar.node.show_all"));
    EXPECT_TRUE(w.has("toolbar.node.show_all")) << "it is said above the picture, with the way to end it";
    // Below it the part stays; outside it goes along.
    w.run("run go.node A 3.5");
    EXPECT_EQ(w.session.workspace.view().subtree, (DrawnNode{0, top}));
    w.run("run go.node A 1.0");
    EXPECT_EQ(w.session.workspace.view().subtree, (DrawnNode{0, w.session.workspace.selection.index}));
    w.run("run go.node B 1.1");
    EXPECT_EQ(w.session.workspace.view().subtree->agent, 0) << "another agent has all its boxes";
    w.run("click toolbar.node.show_all");
    EXPECT_EQ(w.session.workspace.view().subtree, std::nullopt);
    EXPECT_FALSE(w.has("toolbar.node.show_all"));
    w.run("run view.previous");
    EXPECT_TRUE(w.session.workspace.view().subtree) << "it is a change of the view";
    // Once more ends it; a node of a tree that was fitted anew is another one.
    w.run("run go.node A 1.0\nkey Shift+I");
    EXPECT_EQ(w.session.workspace.view().subtree, std::nullopt);
    w.run("run node.isolate\nrun tree.kind umobb");
    EXPECT_TRUE(w.session.workspace.view().subtree) << "it has the same samples";
    w.run("run tree.levels 1");
    EXPECT_EQ(w.session.workspace.view().subtree, std::nullopt);
    w.run("run edit.undo");
    EXPECT_TRUE(w.session.workspace.view().subtree);
    EXPECT_EQ(all, (std::set<int>{1, top}));
    EXPECT_EQ(others, all);
}

TEST(TreeWindow, GhostsOfASelectionLeaveTheWorldAsItIs) {
    TreeWindow w;
    w.run("run go.node A 3.2\nrun view.level 3");
    EXPECT_EQ(w.ghosts(), 0);
    w.run("click node.ancestors");
    EXPECT_EQ(w.ghosts(), 36);
    const Revision drawn = w.shown().revision;
    w.run("run go.node A 3.3");
    EXPECT_EQ(w.ghosts(), 36);
    w.run("run go.none");
    EXPECT_EQ(w.ghosts(), 0);
    EXPECT_TRUE(w.shown().revision == drawn) << "the list is not built anew";
    w.run("run go.node B 3.0\nrun node.isolate\nrun go.none");
    EXPECT_EQ(w.ghosts(), 36) << "of the part that is alone";
    w.run("run view.moment");
    EXPECT_EQ(w.ghosts(), 0);
}

}  // namespace
}  // namespace mobbscope::app
