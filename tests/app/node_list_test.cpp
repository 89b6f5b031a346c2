// The table of a tree's nodes below the picture: tabs, order, filter, selection both ways, counts, copies.
#include <app/script/script.h>
#include <app/window/headless_window.h>
#include <render/gl/gl_context.h>

#include "app/folder_window.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace mobbscope::app {
namespace {

struct NodeWindow : FolderWindow<CrossingFolder> {
    NodeWindow() : FolderWindow({1600, 1000}) { open(folder.scene); }
    void run(const std::string& script) {
        std::ostringstream out;
        Script::parse(script, "test").run(session, window, out);
        window.settle();
    }
    const std::vector<int>& rows() { return *session.nodes.listed(); }
    int selected() { return session.nodes.selected(); }
    static std::string row(int node) { return "nodes.row." + std::to_string(node); }
    /// All nodes are listed, by their values; those without one stand last.
    bool are_sorted(NodeField field, bool descending) {
        std::vector<int> all = rows();
        std::ranges::sort(all);
        for (int i = 0; i < session.nodes.values()->size(); ++i)
            if (i >= static_cast<int>(all.size()) || all[static_cast<std::size_t>(i)] != i) return false;
        const auto before = [&](int a, int b) {
            const double first = session.nodes.values()->value(field, a);
            const double second = session.nodes.values()->value(field, b);
            if (std::isnan(first) || std::isnan(second)) return !std::isnan(first) && std::isnan(second);
            return descending ? first > second : first < second;
        };
        return std::ranges::is_sorted(rows(), before);
    }
};

TEST(NodeList, TabsAreForQueriesAndWithout) {
    NodeWindow w;
    EXPECT_TRUE(w.has("timeline.paths"));
    EXPECT_FALSE(w.has("timeline.recursion"));
    EXPECT_FALSE(w.has("timeline.events"));
    w.run("click timeline.nodes");
    EXPECT_EQ(w.session.settings.bottom_tab, BottomTab::nodes);
    EXPECT_TRUE(w.has("nodes.filter"));
    w.run("run query.select 0");
    EXPECT_TRUE(w.has("nodes.filter")) << "it stays";
    EXPECT_TRUE(w.has("timeline.events"));
    w.run("click timeline.events");
    EXPECT_TRUE(w.has("events.filter"));
    EXPECT_FALSE(w.has("nodes.filter"));
    w.run("run query.none");
    EXPECT_EQ(w.session.settings.bottom_tab, BottomTab::events) << "it is there again with the next query";
    EXPECT_FALSE(w.has("events.filter"));
    w.run("click timeline.curves");
    EXPECT_EQ(w.session.settings.bottom_tab, BottomTab::curves);
    w.run("click timeline.paths");
    EXPECT_EQ(w.session.settings.bottom_tab, BottomTab::recursion);
    w.run("run query.select 0");
    EXPECT_TRUE(w.has("query.icicle"));
    w.run("key R");
    EXPECT_TRUE(w.has("events.filter"));
    w.run("run bottom.show nodes\nkey R");
    EXPECT_TRUE(w.has("events.filter")) << "R lists events whatever was shown";
}

TEST(NodeList, TheWorstComesFirstAndHeadingsSort) {
    NodeWindow w;
    w.run("run bottom.show nodes");
    EXPECT_TRUE(w.are_sorted(NodeField::waste, true));
    EXPECT_FALSE(w.are_sorted(NodeField::fill, true)) << "it is another order";
    w.run("click nodes.sort.fill");
    EXPECT_TRUE(w.are_sorted(NodeField::fill, false)) << "the loosest first";
    w.run("click nodes.sort.fill");
    EXPECT_TRUE(w.are_sorted(NodeField::fill, true));
    w.run("click nodes.sort.share");
    EXPECT_TRUE(w.are_sorted(NodeField::share, true));
    EXPECT_TRUE(w.session.nodes.values()->has(NodeField::share));
    EXPECT_FALSE(w.has("nodes.sort.overhang")) << "upright boxes have none";
    w.run("run tree.kind umobb");
    EXPECT_TRUE(w.has("nodes.sort.overhang"));
}

TEST(NodeList, ARowIsItsNodeEverywhere) {
    NodeWindow w;
    w.run("run bottom.show nodes");
    const int first = w.rows()[0], second = w.rows()[1];
    w.run("move " + w.row(second));
    EXPECT_EQ(w.session.nodes.hovered(), second);
    const auto lines = [&](HighlightLine::Role role) {
        return std::ranges::count(w.window.shell().shown()->highlights, role, &HighlightLine::role);
    };
    EXPECT_GT(lines(HighlightLine::Role::hover), 0);
    w.run("click " + w.row(first));
    EXPECT_EQ(w.selected(), first);
    EXPECT_GT(lines(HighlightLine::Role::selection), 0);
    // The keys go through the rows in their order, whatever has the focus.
    w.run("key F3");
    EXPECT_EQ(w.selected(), second);
    w.run("click nodes.sort.level\nkey F3");
    const std::vector<int> rows = w.rows();
    const auto at = std::ranges::find(rows, second);
    EXPECT_EQ(w.selected(), *(at + 1));
    w.run("key Shift+F3");
    EXPECT_EQ(w.selected(), second);
    while (w.selected() != rows[0]) w.run("key Shift+F3");
    for (int i = 0; i < 30 && !w.session.keys.focus.starts_with("nodes.row."); ++i) w.run("key Tab");
    EXPECT_EQ(w.session.keys.focus, w.row(rows[0])) << "Tab goes to the row that is selected";
    w.run("key Down\nkey Down");
    EXPECT_EQ(w.selected(), rows[2]) << "arrows select as they go";
    while (w.selected() != rows.back()) w.run("key F3");
    w.run("key F3");
    EXPECT_EQ(w.selected(), rows.back());
    EXPECT_EQ(all_messages(w.session), "The table of nodes ends here\n");
}

TEST(NodeList, ANodeThatIsSelectedElsewhereIsScrolledTo) {
    NodeWindow w;
    w.run("run bottom.show nodes");
    const int last = w.rows().back();
    EXPECT_FALSE(w.has(w.row(last)));
    w.run("run go.node C " + std::to_string(last));
    EXPECT_TRUE(w.has(w.row(last)));
    EXPECT_EQ(w.selected(), last);
    w.run("run go.node C 0");
    EXPECT_TRUE(w.has(w.row(0)));
    EXPECT_FALSE(w.has(w.row(last)));
}

TEST(NodeList, RowsSelectASideOfTheQueryInView) {
    NodeWindow w;
    w.run("run query.select 2\nrun bottom.show nodes\nclick " + w.row(0));
    const SceneQuery query = w.session.workspace.fitted().queries()[2];
    EXPECT_EQ(placed_agent_of(w.session.workspace.fitted(), w.session.workspace.selection.path)->name, query.a.name);
}

TEST(NodeList, AFilterIsTypedAndApplied) {
    NodeWindow w;
    w.run("key Ctrl+F");
    EXPECT_EQ(w.session.settings.bottom_tab, BottomTab::nodes) << "no query is in view";
    w.run("type fill < 70 % and lea");
    EXPECT_TRUE(w.has("nodes.filter.candidate"));
    w.run("key Tab");
    EXPECT_TRUE(w.has("nodes.filter.hits"));
    w.run("key Enter");
    EXPECT_EQ(w.session.nodes.filter->text(), "fill < 70 % and leaf");
    const NodeValues& values = *w.session.nodes.values();
    const auto is_wanted = [&](int node) {
        return values.tree().node(node).is_leaf() && values.value(NodeField::fill, node) < 0.7;
    };
    ASSERT_FALSE(w.rows().empty());
    EXPECT_TRUE(std::ranges::all_of(w.rows(), is_wanted));
    int wanted = 0;
    for (int node = 0; node < values.size(); ++node) wanted += is_wanted(node) ? 1 : 0;
    EXPECT_EQ(static_cast<int>(w.rows().size()), wanted);
    w.run("key Ctrl+F\ntype gap < 1");
    EXPECT_TRUE(w.has("nodes.filter.caret")) << "nodes have no gap";
    w.run("key Escape\nclick nodes.all");
    EXPECT_EQ(static_cast<int>(w.rows().size()), w.session.nodes.values()->size());
    w.run("run query.select 0\nrun bottom.show recursion\nkey Ctrl+F");
    EXPECT_EQ(w.session.settings.bottom_tab, BottomTab::events);
}

TEST(NodeList, TestsAreCountedOnDemand) {
    NodeWindow w;
    w.run("run bottom.show nodes");
    EXPECT_TRUE(w.session.nodes.can_count());
    w.run("click nodes.count");
    EXPECT_FALSE(w.has("nodes.count"));
    w.run("click nodes.sort.tests");
    const std::shared_ptr<const NodeValues> values = w.session.nodes.values();
    EXPECT_TRUE(w.are_sorted(NodeField::tests, true));
    EXPECT_GT(values->value(NodeField::tests, w.rows()[0]), 0);
    EXPECT_TRUE(values->has(NodeField::avoidable));
    w.run("run tree.leaf 8");
    EXPECT_TRUE(w.session.nodes.can_count()) << "other trees make other tests";
}

TEST(NodeList, RowsAreCopied) {
    NodeWindow w;
    w.run("run bottom.show nodes\nrun nodes.filter level < 1\nclick nodes.more\nclick context.nodes.copy_csv");
    EXPECT_EQ(w.desktop.text.substr(0, 34), "node,level,sample,waste,empty,fill");
    EXPECT_NE(w.desktop.text.find("\n0.0,0,0..59,"), std::string::npos) << w.desktop.text;
    w.run("run nodes.copy");
    EXPECT_NE(w.desktop.text.find("\n0.0\t0\t0..59\t"), std::string::npos) << w.desktop.text;
    EXPECT_EQ(all_messages(w.session), "Copied 1 node\n");
}

TEST(NodeList, ALowPanelHasRowsInPlaceOfTheLevels) {
    NodeWindow w;
    w.run("run bottom.show nodes");
    const auto rows = [&] {
        const auto& marks = w.window.shell().marks().all();
        return std::ranges::count_if(marks, [](const auto& mark) { return mark.first.starts_with("nodes.row."); });
    };
    EXPECT_TRUE(w.has("nodes.levels"));
    EXPECT_GE(rows(), 6);
    w.window.resize({1280, 420});
    w.window.settle();
    EXPECT_FALSE(w.has("nodes.levels"));
    EXPECT_GE(rows(), 1);
}

TEST(NodeList, ScriptsSeeTheTable) {
    NodeWindow w;
    w.run(
        "run bottom.show nodes\nrun nodes.filter leaf\nrun nodes.sort fill\n"
        "expect /nodes/filter \"leaf\"\nexpect /nodes/sort \"fill\"\nexpect /nodes/descending false\n"
        "expect /nodes/selected null\nrun rows.next\nexpect /nodes/selected != null");
}

}  // namespace
}  // namespace mobbscope::app
