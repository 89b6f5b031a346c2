// Reasons, costs, focus, zoom and steps of a query in the window: by clicks, keys, the wheel and commands.
#include <app/panels/recursion_picture.h>
#include <app/script/script.h>
#include <app/window/headless_window.h>
#include <explain/query_progress.h>
#include <explain/reasons.h>
#include <render/gl/gl_context.h>

#include "app/folder_window.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <numeric>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace mobbscope::app {
namespace {

/// A window over a query of A against C, who pass close by each other for two seconds.
struct PassingWorld : FolderWindow<CrossingFolder> {
    explicit PassingWorld(PictureSize size = {1280, 2800}) : FolderWindow(size) {
        folder.write("scene.json", R"({
            "clips": {"walk": {"source": "walk.csv"}},
            "agents": [{"name": "A", "clip": "walk"},
                       {"name": "B", "clip": "walk", "translate": [2, 0.82], "rotate_deg": 180},
                       {"name": "C", "clip": "walk", "translate": [1, -1], "rotate_deg": 90}],
            "fit": {"leaf": 4}})");
        open(folder.scene);
        run("run query.select 0\nrun step.first\nframes 3");
    }
    void run(const std::string& script) {
        std::ostringstream out;
        Script::parse(script, "test").run(session, window, out);
    }
    const Rect& mark(const std::string& name) { return window.shell().marks().all().at(name); }
    const mobb::Trace& trace() const { return session.workspace.recorded()->trace; }
    const Recursion& recursion() const { return session.queries.findings()->recursion; }
    int step() const { return session.workspace.step(); }
    int last_of(int pair) const { return recursion().pairs[static_cast<std::size_t>(pair)].last; }
    std::vector<int> reasons() const {
        std::vector<int> out;
        const PlaceReasons found = session.queries.reasons().value();
        for (const int pair : found.pairs) out.push_back(last_of(pair));
        return out;
    }
    static std::string at(double x, double y) { return std::to_string(x) + ' ' + std::to_string(y); }
};

TEST(ReasonsWindow, AMomentListsTheTestsThatDecidedAboutIt) {
    PassingWorld w;
    ASSERT_GT(w.trace().size(), 30) << "a query with something to look for";
    w.run("run reasons.at 0.9");
    EXPECT_EQ(w.session.workspace.view().time, 0.9);
    const std::vector<int> chain = w.reasons();
    ASSERT_GT(chain.size(), 2u);
    for (std::size_t i = 0; i < std::min<std::size_t>(chain.size(), 9); ++i) {
        w.run("click reason." + std::to_string(i));
        EXPECT_EQ(w.step(), chain[i]);
    }
    // The clearance and the timeline ask the same.
    w.run("run reasons.none\nclick query.clearance");
    EXPECT_EQ(w.session.queries.reasons()->pairs.empty(), false);
    EXPECT_NEAR(*w.session.workspace.view().time, 1.0, 0.1);
    w.run("run reasons.none");
    EXPECT_FALSE(w.session.queries.reasons());
    w.run("click timeline.time");
    EXPECT_EQ(w.reasons().front(), chain.front());
}

TEST(ReasonsWindow, WhatIsClickedStaysWhereItIs) {
    PassingWorld w({1280, 900});
    w.run("move query.answer\nscroll query.answer -300\nframes 3");
    const Rect square = w.mark("query.square");
    ASSERT_TRUE(square.min.y > 40 && square.max.y < 860) << square.min.y;
    std::size_t rows = 0;
    for (const double share : {0.85, 0.15, 0.5}) {
        w.run("click " + w.at(square.min.x + 0.75 * square.size().x, square.min.y + share * square.size().y) +
              "\nframes 2");
        EXPECT_EQ(w.mark("query.square").min.y, square.min.y) << "although the lists above grow and shrink";
        rows = std::max(rows, w.reasons().size());
    }
    EXPECT_GT(rows, 1u);
}

TEST(ReasonsWindow, APointOfTheMapAndASampleDoSoToo) {
    PassingWorld w;
    Rect square = w.mark("query.square");
    w.run("click " + w.at(square.min.x + 0.75 * square.size().x, square.min.y + 0.85 * square.size().y));
    ASSERT_TRUE(w.session.workspace.look.point);
    EXPECT_NEAR(w.session.workspace.look.point->time_a, 1.5, 0.05);
    EXPECT_NEAR(w.session.workspace.look.point->time_b, 0.3, 0.05);
    EXPECT_EQ(w.step(), w.reasons().back()) << "the smallest pair there";
    square = w.mark("query.square");  // the list of reasons above it has grown
    w.run("click " + w.at(square.min.x + 0.25 * square.size().x, square.min.y + 0.75 * square.size().y));
    EXPECT_FALSE(w.session.workspace.look.point) << "on the diagonal it is one moment";
    EXPECT_NEAR(w.session.workspace.view().time.value_or(0), 0.5, 0.02);

    w.run("run reasons.of_sample b 31");
    ASSERT_TRUE(w.session.workspace.look.sample);
    for (const int event : w.reasons()) {
        const mobb::Node& node = w.session.queries.findings()->sides[1].placed.node(w.trace()[event].b);
        EXPECT_TRUE(node.first <= 31 && 31 < node.end());
    }
    const std::vector<int> of_31 = w.reasons();
    w.run("run reasons.none\nrun go.sample B 31\nrun reasons.of_selection");
    EXPECT_EQ(w.reasons(), of_31) << "as the menu of a disk does";
    w.run("run time.at 0.2");
    EXPECT_FALSE(w.session.workspace.look.sample) << "a moment was asked last";

    // A sample of the list of measured pairs.
    const auto& events = w.trace();
    int measured = 0;
    while (measured < events.size() && events[measured].pairs.empty()) ++measured;
    ASSERT_LT(measured, events.size());
    w.run("run step.to " + std::to_string(measured));
    const int sample = w.trace()[w.step()].pairs.front().i;
    w.run("click sample.a." + std::to_string(sample));
    ASSERT_TRUE(w.session.workspace.look.sample);
    EXPECT_EQ(w.session.workspace.look.sample->index, sample);
    EXPECT_TRUE(std::ranges::count(w.reasons(), w.step()) > 0);
}

TEST(ReasonsWindow, CostliestBranchesAreGoneToAndFocusedOn) {
    PassingWorld w;
    const std::vector<BranchCost> branches = w.session.queries.branches();
    ASSERT_GT(branches.size(), 2u);
    w.run("click branch.1");
    EXPECT_EQ(w.step(), w.last_of(branches[1].pair));
    w.run("run focus.branch");
    const RecursionPair& focused = w.recursion().pairs[static_cast<std::size_t>(branches[1].pair)];
    EXPECT_EQ(w.session.workspace.look.focus.branch, branches[1].pair);
    EXPECT_EQ(w.session.workspace.look.zoom, (EventRange{focused.first, focused.end}));
    mobb::Trace part;
    for (int event = focused.first; event < focused.end; ++event) {
        mobb::Trace::Event kept = w.trace()[event];
        kept.parent = -1;
        part.push(kept);
    }
    EXPECT_EQ(w.session.queries.counts_in_all().tests, part.counts()) << "counters restrict to it";
    for (const BranchCost& branch : w.session.queries.branches()) {
        const RecursionPair& pair = w.recursion().pairs[static_cast<std::size_t>(branch.pair)];
        EXPECT_TRUE(pair.first > focused.first && pair.end <= focused.end);
    }
    std::vector<int> inside(static_cast<std::size_t>(focused.end - focused.first));
    std::iota(inside.begin(), inside.end(), focused.first);
    EXPECT_EQ(*w.session.queries.listed_events(), inside) << "the list of events, too";
    w.run("run focus.none\nrun focus.time 0.5:0.7\nexpect /look/focus/time [0.5, 0.7]");
    EXPECT_LT(w.session.queries.counts_in_all().tests.all(), w.trace().counts().all());
    w.run("click query.none");
    EXPECT_TRUE(w.session.workspace.look.focus.is_all()) << "another query begins anew";
}

TEST(ReasonsWindow, AllQueriesAreCountedAndTheWorstShown) {
    PassingWorld w;
    w.run("click queries.tests");
    ASSERT_TRUE(w.session.costs.costs());
    const SceneCosts& costs = *w.session.costs.costs();
    EXPECT_EQ(w.session.costs.listed(), costs.by_tests);
    w.run("run query.none\nrun query.worst");
    EXPECT_EQ(w.session.workspace.view().query, costs.by_tests.front());
    w.run("run query.none\nclick query." + std::to_string(costs.by_tests[1]));
    EXPECT_EQ(w.session.workspace.view().query, costs.by_tests[1]) << "rows keep their names";
    w.run("run branches.of scene");
    w.run("click cost.0");
    ASSERT_TRUE(w.session.costs.sandwich());
    EXPECT_EQ(w.session.costs.sandwich()->of, costs.nodes.front().at);
    w.run("run branches.of_node walk 1.0");
    EXPECT_FALSE(w.session.costs.sandwich()->above.empty());
    EXPECT_TRUE(w.has("above.0"));
    EXPECT_FALSE(w.has("query.stopped.all_queries"));
    auto in_part = std::make_shared<SceneCosts>(*w.session.workspace.derived().costs);
    in_part->in_part = 2;
    w.session.workspace.derived().costs = in_part;
    w.run("frames 2");
    EXPECT_TRUE(w.has("query.stopped.all_queries")) << "sums are of what was recorded";
    w.run("run tree.leaf 8");
    EXPECT_FALSE(w.session.costs.costs()) << "other trees cost something else";
}

/// A session whose jobs are not waited for, over three agents of one clip; no job is under way.
struct CountingWorld {
    CrossingFolder folder;
    Session session{true};

    CountingWorld() {
        session.options.patience = {};
        folder.write("scene.json", R"({
            "clips": {"walk": {"source": "walk.csv"}},
            "agents": [{"name": "A", "clip": "walk"},
                       {"name": "B", "clip": "walk", "translate": [2, 0.82], "rotate_deg": 180},
                       {"name": "C", "clip": "walk", "translate": [1, -1], "rotate_deg": 90}],
            "fit": {"leaf": 4}})");
        session.files.open({folder.scene});
        wait();
    }
    void wait() {
        while (session.jobs.job()) session.poll();
    }
};

TEST(ReasonsWindow, ACountOutlivesABookmarkAndStartsAnewForOtherTrees) {
    CountingWorld w;
    CostInspector& costs = w.session.costs;
    int shown = 0;
    costs.count([&] { ++shown; });
    costs.count();
    EXPECT_EQ(w.session.jobs.count(), 1u) << "it is counted once";
    w.session.workspace.edit_debug("bookmark", [](DebugState& debug) {
        debug.bookmarks.push_back({"here", 0, 0, ""});
    });
    const auto told = w.session.counts.arrivals;
    w.wait();
    ASSERT_TRUE(costs.costs()) << "a bookmark costs nothing";
    EXPECT_EQ(shown, 1);
    EXPECT_EQ(w.session.counts.arrivals, told + 1);

    const auto with_leaf = [&](int leaf) {
        w.session.workspace.edit({"leaf", ""}, [&](Scene& scene) { scene.fit.leaf = leaf; });
    };
    with_leaf(8);
    EXPECT_FALSE(costs.costs());
    costs.branches_of = CostInspector::Of::scene;
    costs.count();
    with_leaf(16);
    w.wait();
    ASSERT_TRUE(costs.costs()) << "it is wanted still";
    EXPECT_EQ(costs.costs()->tests, scene_costs(w.session.workspace.fitted()).tests);
    with_leaf(4);
    costs.count();
    costs.branches_of = CostInspector::Of::query;
    with_leaf(8);
    w.wait();
    EXPECT_FALSE(costs.costs()) << "nobody looks at it any more";
}

TEST(ReasonsWindow, TheSandwichThatWasAskedForLastIsShown) {
    CountingWorld w;
    w.session.costs.show_sandwich({0, 0});
    w.session.costs.show_sandwich({0, 1});
    EXPECT_EQ(w.session.jobs.count(), 1u);
    w.wait();
    ASSERT_TRUE(w.session.costs.sandwich());
    EXPECT_EQ(w.session.costs.sandwich()->of, (TreeNode{0, 1}));
    w.session.costs.show_sandwich({0, 0});
    w.session.costs.show_sandwich({0, 1});
    EXPECT_EQ(w.session.jobs.count(), 0u) << "it is known";
}

TEST(ReasonsWindow, StripAndIcicleZoomByTheWheelAroundTheMouse) {
    PassingWorld w;
    const Rect strip = w.mark("query.strip");
    const int events = w.trace().size();
    const double share = 0.75;
    const std::string place = w.at(strip.min.x + share * strip.size().x, strip.center().y);
    w.run("scroll " + place + " 4");
    ASSERT_TRUE(w.session.workspace.look.zoom);
    const EventRange zoomed = *w.session.workspace.look.zoom;
    EXPECT_LT(zoomed.size(), events / 2);
    EXPECT_NEAR(zoomed.first + share * zoomed.size(), share * events, 2) << "what is under the mouse stays";
    // A drag of the icicle shifts it, and is no click.
    const int step = w.step();
    const Rect icicle = w.mark("query.icicle");
    w.run("drag query.icicle " + w.at(0.25 * icicle.size().x, 0));
    EXPECT_NEAR(w.session.workspace.look.zoom->first, zoomed.first - 0.25 * zoomed.size(), 2);
    EXPECT_EQ(w.session.workspace.look.zoom->size(), zoomed.size());
    EXPECT_EQ(w.step(), step);
    // A step outside is brought in.
    w.run("run step.last");
    EXPECT_EQ(w.session.workspace.look.zoom->end, events);
    w.run("key Shift+Home");
    EXPECT_FALSE(w.session.workspace.look.zoom);
    w.run("run recursion.zoom 3:20\nexpect /look/zoom [3, 20]\nscroll query.icicle -30");
    EXPECT_FALSE(w.session.workspace.look.zoom) << "out to the whole";
}

TEST(ReasonsWindow, ASpanIsItsPairAndBelowItsTests) {
    PassingWorld w;
    w.session.settings.bottom_height = 300;
    w.run("run recursion.zoom 0:15\nframes 2");
    const Rect icicle = w.mark("query.icicle");
    const double each = icicle.size().x / 16.0;
    const int row = icicle_row(icicle.size().y, w.recursion().depth, 1, static_cast<float>(each));
    int tried = 0;
    for (const RecursionPair& pair : w.recursion().pairs) {
        if (pair.end > 16) continue;
        const double top = double{icicle.min.y} + pair.depth * row;
        if (top + row > icicle.max.y) continue;
        const double left = icicle.min.x + pair.first * each;
        w.run("click " + w.at(left + 0.5 * each, top + 0.3 * row));
        EXPECT_EQ(w.step(), pair.last) << "the pair, by its last test";
        w.run("expect /look/hovered_event " + std::to_string(pair.last));
        if (pair.last == pair.first) continue;
        w.run("click " + w.at(left + 0.5 * each, top + row - 3));
        EXPECT_EQ(w.step(), pair.first) << "its first test";
        w.run("expect /look/hovered_event " + std::to_string(pair.first));
        ++tried;
    }
    EXPECT_GT(tried, 2);
}

TEST(ReasonsWindow, WhatIsHoveredLightsUpTheSameEvent) {
    PassingWorld w;
    w.run("run step.last");
    const auto highlights = [&] { return w.window.shell().shown()->highlights.size(); };
    const std::size_t before = highlights();
    w.run("run reasons.at 0.9\nmove reason.1\nframes 2");
    EXPECT_EQ(w.session.workspace.hovered_event, w.reasons()[1]);
    EXPECT_GT(highlights(), before) << "both boxes in the picture";
    w.run("move branch.0\nframes 2");
    EXPECT_EQ(w.session.workspace.hovered_event, w.last_of(w.session.queries.branches()[0].pair));
    w.run("move query.strip\nframes 2");
    EXPECT_GE(w.session.workspace.hovered_event, 0);
    w.run("move crumb.0\nframes 2");
    EXPECT_EQ(w.session.workspace.hovered_event, w.recursion().pairs[0].last);
    w.run("click crumb.0");
    EXPECT_EQ(w.step(), w.recursion().pairs[0].last);
    w.run("move query.answer\nframes 2");
    EXPECT_EQ(w.session.workspace.hovered_event, -1);
}

TEST(ReasonsWindow, StepsGoBothWays) {
    PassingWorld w;
    const auto& query = w.session.workspace.fitted().queries()[0];
    const mobb::Tree& a = w.session.workspace.fitted().tree(query.a.clip);
    const mobb::Tree& b = w.session.workspace.fitted().tree(query.b.clip);
    const std::map<std::string, Step> kinds{{"separated", {Step::Unit::separated, 1}},
                                            {"overlap", {Step::Unit::overlap, 1}},
                                            {"leaf", {Step::Unit::leaf, 1}},
                                            {"depth 3", {Step::Unit::depth, 3}}};
    for (const auto& [name, of] : kinds) {
        std::vector<int> expected;
        for (int event = 0; event < w.trace().size(); ++event) {
            if (is_counted(of, w.trace(), event, a, b)) expected.push_back(event);
        }
        ASSERT_GT(expected.size(), 3u) << name;
        w.run("run step.first");
        if (expected.front() == 0) expected.erase(expected.begin());
        std::vector<int> forth;
        for (std::size_t i = 0; i < expected.size(); ++i) {
            w.run("run step.next_" + name);
            forth.push_back(w.step());
        }
        EXPECT_EQ(forth, expected) << name;
        std::vector<int> back{w.step()};
        for (std::size_t i = 1; i < expected.size(); ++i) {
            w.run("run step.previous_" + name);
            back.push_back(w.step());
        }
        std::ranges::reverse(back);
        EXPECT_EQ(back, expected) << name << ", backwards";
    }
    // Into, and out again; over, and back.
    w.run("run step.first\nkey F11");
    EXPECT_EQ(w.trace()[w.step()].depth, 1);
    w.run("key F11\nkey Shift+F11");
    EXPECT_EQ(w.trace()[w.step()].depth, 1) << "the test that led there";
    const int from = w.step();
    w.run("key Down\nkey Shift+Down");
    EXPECT_EQ(w.step(), from);
    w.run("key Ctrl+G\ntype 7\nkey Enter");
    EXPECT_EQ(w.step(), 7);
}

TEST(ReasonsWindow, APairSaysHowItEndedAfterItsLastChild) {
    PassingWorld w;
    for (const RecursionPair& pair : w.recursion().pairs) {
        if (!pair.has_children()) continue;
        w.run("run step.to " + std::to_string(pair.end - 1));
        w.run("expect /look/ended != []");
        w.run("run step.to " + std::to_string(pair.last) + "\nexpect /look/ended []");
    }
}

}  // namespace
}  // namespace mobbscope::app
