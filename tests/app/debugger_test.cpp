// The query debugger in the window, by keys and clicks: list of events, filters, breakpoints, bookmarks, the way back.
#include <app/window/headless_window.h>
#include <render/gl/gl_context.h>

#include "app/folder_window.h"
#include "mobb/random_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

namespace mobbscope::app {
namespace {

/// A and B go beside each other, so near that most boxes of theirs overlap; C is elsewhere.
constexpr const char* kNearlyTouching = R"({
    "clips": {"walk": {"source": "walk.csv"}},
    "agents": [{"name": "A", "clip": "walk"}, {"name": "B", "clip": "walk", "translate": [0, 0.805]},
               {"name": "C", "clip": "walk", "translate": [0, 9], "start": 0.5}],
    "fit": {"leaf": 2}})";

struct DebuggerWindow : FolderWindow<CrossingFolder> {
    std::filesystem::path scene = folder.write("near.json", kNearlyTouching);

    DebuggerWindow() : FolderWindow({1440, 3400}) {
        session.files.open({scene});
        run_command(session, "query.select", "0");
        run_command(session, "step.first");
        window.settle();
    }

    Rect at(const std::string& mark) {
        const auto found = window.shell().marks().all().find(mark);
        if (found != window.shell().marks().all().end()) return found->second;
        ADD_FAILURE() << mark << " is not there";
        return {};
    }
    void click(const std::string& mark, int button = 0) {
        window.shell().feed(MouseMove{at(mark).center()});
        window.shell().feed(MouseButton{button, true});
        window.shell().feed(MouseButton{button, false});
        window.settle();
    }

    int step() { return session.workspace.step(); }
    std::string filter() {
        const auto& filter = session.workspace.events.filter;
        return filter ? filter->text() : "";
    }
    const std::vector<int>& rows() { return *session.queries.listed_events(); }
    std::vector<int> passing(const std::string& text) {
        return steps_that_pass(session.queries.events(), EventFilter(text));
    }
    const DebugState& debug() { return session.workspace.scene().debug; }
};

TEST(Debugger, AFilterIsTypedCompletedAndApplied) {
    DebuggerWindow w;
    w.key("Ctrl+F");
    ASSERT_TRUE(w.has("events.filter"));
    w.type("ga");
    EXPECT_TRUE(w.has("events.filter.candidate"));
    w.key("Tab");
    w.type("> 0 a");
    EXPECT_TRUE(w.has("events.filter.caret")) << "'a' is not finished";
    EXPECT_FALSE(w.has("events.filter.hits"));
    w.key("Tab");
    w.type("lev");
    w.key("Down");
    w.key("Tab");
    w.type(">= 2");
    EXPECT_TRUE(w.has("events.filter.words"));
    EXPECT_TRUE(w.has("events.filter.hits")) << "before it is applied";
    EXPECT_EQ(w.filter(), "");
    w.key("Enter");
    EXPECT_EQ(w.filter(), "gap > 0 and level(b) >= 2");
    EXPECT_EQ(w.rows(), w.passing("gap > 0 and level(b) >= 2"));
    ASSERT_FALSE(w.rows().empty());
    EXPECT_EQ(all_messages(w.session), "");
    w.key("Ctrl+F");
    w.type("outcome = hit");
    w.key("Escape");
    EXPECT_EQ(w.filter(), "gap > 0 and level(b) >= 2") << "taken back";
    w.click("events.all");
    EXPECT_EQ(static_cast<int>(w.rows().size()), w.session.queries.events().size());
}

TEST(Debugger, AWrongFilterPointsWithACaret) {
    DebuggerWindow w;
    w.key("Ctrl+F");
    w.type("gpa < 1");
    const float first = w.at("events.filter.caret").min.x;
    EXPECT_NEAR(first, w.at("events.filter").min.x, 12) << "below the first letter";
    w.key("Enter");
    EXPECT_EQ(w.filter(), "");
    EXPECT_TRUE(w.has("events.filter.caret")) << "it is mended where it stands";
    w.key("Escape");
    w.key("Ctrl+F");
    w.type("gap < 0.05 and levle(a) > 2");
    EXPECT_GT(w.at("events.filter.caret").min.x, first + 80);
}

TEST(Debugger, TheListIsSortedByItsHeadings) {
    DebuggerWindow w;
    w.key("R");
    run_command(w.session, "events.filter", "outcome = separated");
    w.window.settle();
    w.click("events.sort.gap");
    const std::vector<int> ascending = w.rows();
    const mobb::Trace& trace = w.session.workspace.recorded()->trace;
    EXPECT_TRUE(std::ranges::is_sorted(ascending, {}, [&](int step) { return trace[step].gap; }));
    w.click("events.sort.gap");
    EXPECT_TRUE(w.session.workspace.events.descending);
    EXPECT_EQ(trace[w.rows().front()].gap, trace[ascending.back()].gap);
    // Rows are gone through in their order, both ways.
    w.click("events.row." + std::to_string(w.rows()[0]));
    EXPECT_EQ(w.step(), w.rows()[0]);
    for (std::size_t row = 1; row < 4; ++row) {
        w.key("F3");
        EXPECT_EQ(w.step(), w.rows()[row]);
    }
    w.key("Shift+F3");
    EXPECT_EQ(w.step(), w.rows()[2]);
    w.click("events.row." + std::to_string(w.rows()[0]));
    w.key("Shift+F3");
    EXPECT_EQ(w.step(), w.rows()[0]);
    EXPECT_EQ(all_messages(w.session), "The list of events begins here\n");
}

TEST(Debugger, ARowUnderTheMouseIsItsEventEverywhere) {
    DebuggerWindow w;
    w.key("R");
    w.window.shell().feed(MouseMove{w.at("events.row.2").center()});
    w.window.settle();
    EXPECT_EQ(w.session.workspace.hovered_event, 2);
    // A breakpoint changes no event: the focus stays.
    run_command(w.session, "focus.branch", "0");
    run_command(w.session, "breakpoint.add", "outcome = overlap");
    EXPECT_EQ(w.session.workspace.look.focus.branch, 0);
}

TEST(Debugger, TheListOpensAtThePresentStep) {
    DebuggerWindow w;
    w.key("Shift+Right");
    w.key("R");
    const int last = w.session.queries.events().size() - 1;
    EXPECT_TRUE(w.has("events.row." + std::to_string(last)));
}

TEST(Debugger, TheRowOfThePresentStepIsSeen) {
    DebuggerWindow w;
    w.key("R");
    const int last = w.session.queries.events().size() - 1;
    EXPECT_FALSE(w.has("events.row." + std::to_string(last)));
    w.key("Shift+Right");
    EXPECT_TRUE(w.has("events.row." + std::to_string(last)));
    w.key("Shift+Left");
    EXPECT_TRUE(w.has("events.row.0"));
    w.click("timeline.recursion");
    EXPECT_FALSE(w.has("events.row.0"));
    EXPECT_TRUE(w.has("query.icicle"));
}

TEST(Debugger, FiltersAreSavedWithTheScene) {
    DebuggerWindow w;
    run_command(w.session, "events.filter", "gap < 0.2");
    run_command(w.session, "events.save", "tight");
    EXPECT_EQ(refusal(w.session, "events.save", " "), "a filter needs a name");
    run_command(w.session, "events.filter", "outcome = hit");
    run_command(w.session, "events.save", "hits");
    EXPECT_EQ(refusal(w.session, "events.rename_saved", "tight"), "another filter is named 'tight'");
    run_command(w.session, "events.rename_saved", "the hit");
    w.window.settle();
    w.click("events.more");
    w.click("context.events.saved");
    w.click("context.events.saved.tight");
    EXPECT_EQ(w.filter(), "gap < 0.2");
    run_command(w.session, "breakpoint.add", "outcome = overlap");
    run_command(w.session, "breakpoint.switch", "outcome = overlap");
    run_command(w.session, "bookmark.add", "here");
    run_command(w.session, "bookmark.note", "loose");
    run_command(w.session, "file.save");
    const DebugState kept = w.debug();
    EXPECT_EQ(kept.filters, (std::vector<NamedFilter>{{"tight", "gap < 0.2"}, {"the hit", "outcome = hit"}}));
    EXPECT_EQ(load_scene(w.scene).debug, kept);
    for (int i = 0; i < 3; ++i) w.key("Ctrl+Z");
    EXPECT_EQ(w.debug().bookmarks.size(), 0u);
    EXPECT_TRUE(w.debug().breakpoints.at(0).on);
    for (int i = 0; i < 4; ++i) w.key("Ctrl+Z");
    EXPECT_EQ(w.debug(), DebugState());
    EXPECT_EQ(w.filter(), "gap < 0.2") << "looking stays";
}

TEST(Debugger, BreakpointsStopBothWays) {
    DebuggerWindow w;
    w.key("F4");
    EXPECT_EQ(all_messages(w.session), "Run to the next breakpoint: no breakpoint is on\n");
    w.session.notifications.clear();
    w.click("break.filter");
    w.type("outcome = separated");
    EXPECT_TRUE(w.has("break.filter.hits"));
    EXPECT_TRUE(w.debug().breakpoints.empty());
    w.key("Enter");
    ASSERT_EQ(w.debug().breakpoints, (std::vector<Breakpoint>{{"outcome = separated", true}}));
    const std::vector<int> hits = w.passing("outcome = separated");
    ASSERT_GT(hits.size(), 2u);
    EXPECT_EQ(w.session.queries.break_steps(), hits);
    std::vector<int> stops;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        w.key("F4");
        stops.push_back(w.step());
    }
    EXPECT_EQ(stops, hits);
    w.key("F4");
    EXPECT_EQ(w.step(), hits.back());
    EXPECT_EQ(all_messages(w.session), "No later breakpoint\n");
    for (std::size_t i = hits.size() - 1; i > 0; --i) {
        w.key("Shift+F4");
        EXPECT_EQ(w.step(), hits[i - 1]);
    }
    // One that is off stops nobody, and undo brings it back.
    w.click("break.0.on");
    EXPECT_TRUE(w.session.queries.break_steps().empty());
    EXPECT_FALSE(find_command("breakpoint.next")->enabled(w.session));
    w.key("Ctrl+Z");
    EXPECT_EQ(w.session.queries.break_steps(), hits);
    w.click("break.0.remove");
    EXPECT_TRUE(w.debug().breakpoints.empty());
}

TEST(Debugger, WhatIsSeenBreaksByItsMenuAndF9) {
    DebuggerWindow w;
    w.key("R");
    run_command(w.session, "events.filter", "outcome = separated");
    w.window.settle();
    const int step = w.rows()[1];
    w.click("events.row." + std::to_string(step), 1);
    w.click("context.breakpoint.add.4");
    ASSERT_EQ(w.debug().breakpoints.size(), 1u);
    EXPECT_EQ(w.debug().breakpoints[0].where, "outcome = separated");
    EXPECT_TRUE(w.has("events.break." + std::to_string(step)));
    w.click("events.row." + std::to_string(step));
    w.key("F9");
    ASSERT_EQ(w.debug().breakpoints.size(), 2u);
    const std::vector<int> hits = w.passing(w.debug().breakpoints[1].where);
    EXPECT_NE(std::ranges::find(hits, step), hits.end());
    w.key("F9");
    EXPECT_EQ(w.debug().breakpoints.size(), 1u);
}

TEST(Debugger, BookmarksLeadBackWithTheirNotes) {
    DebuggerWindow w;
    run_command(w.session, "step.to", "5");
    w.key("Ctrl+B");
    ASSERT_EQ(w.debug().bookmarks.size(), 1u);
    EXPECT_EQ(w.debug().bookmarks[0].step, 5);
    w.click("bookmark.note");
    w.type("loose here");
    w.key("Enter");
    EXPECT_EQ(w.debug().bookmarks[0].note, "loose here");
    run_command(w.session, "query.select", "1");
    w.window.settle();
    w.click("bookmark.0");
    EXPECT_EQ(w.session.workspace.view().query, 0);
    EXPECT_EQ(w.step(), 5);
    // A trace may have become shorter since.
    w.session.workspace.edit_debug("far", [](DebugState& debug) { debug.bookmarks[0].step = 100'000; });
    run_command(w.session, "bookmark.go", w.debug().bookmarks[0].name);
    EXPECT_EQ(w.step(), w.session.queries.events().size() - 1);
    w.window.settle();
    w.click("bookmark.0.remove");
    EXPECT_TRUE(w.debug().bookmarks.empty());
    w.key("Ctrl+Z");
    EXPECT_EQ(w.debug().bookmarks.size(), 1u);
}

/// Whatever breakpoints are set, what was found out about the query stays.
TEST(Debugger, ItsEditsRecordNothingAnew) {
    DebuggerWindow w;
    const RecordedQuery* recorded = w.session.workspace.recorded();
    const auto findings = w.session.queries.findings();
    const auto events = recorded->trace.size();
    run_command(w.session, "breakpoint.add", "outcome = hit");
    EXPECT_EQ(w.session.queries.findings(), findings);
    EXPECT_EQ(w.session.workspace.recorded()->trace.size(), events);
}

TEST(Debugger, TabFromTheNameOfABookmarkLeadsToItsNote) {
    DebuggerWindow w;
    w.key("Ctrl+B");
    w.click("bookmark.name");
    w.key("Ctrl+A");
    w.type("here");
    w.key("Tab");
    w.type("A z x loose");
    w.key("Enter");
    const std::vector<Bookmark>& all = w.session.workspace.scene().debug.bookmarks;
    ASSERT_EQ(all.size(), 1u);
    EXPECT_EQ(all[0].name, "here");
    EXPECT_EQ(all[0].note, "A z x loose");
}

/// What a person sees of a query.
struct SeenStep {
    int query = 0, step = 0;
    ViewState view;  ///< without its step

    friend bool operator==(const SeenStep&, const SeenStep&) = default;
};

SeenStep seen_step(Session& session) {
    const Workspace& workspace = session.workspace;
    SeenStep out{*workspace.view().query, workspace.step(), workspace.view()};
    out.view.step = {};
    return out;
}

/// Walking any way, and back and forward again, shows the same at every place. A run of single steps is one place.
TEST(Debugger, TheWayBackShowsWhatWasVisited) {
    const CrossingFolder folder;
    int merged = 0;
    for (int seed = 0; seed < 30; ++seed) {
        mobb::test::Random random(static_cast<std::uint64_t>(seed));
        Session session(false);
        session.files.open({folder.scene});
        run_command(session, "query.select", "0");
        std::vector<SeenStep> visits{seen_step(session)};
        int way = 0;  // of the run of single steps that the last visit is of
        const std::vector<std::string> steps{"step.forward", "step.back",      "step.into",      "step.out",
                                             "step.over",    "step.over_back", "step.next_leaf", "step.previous_leaf",
                                             "rows.next",    "rows.previous",  "step.last",      "step.next_overlap"};
        for (int i = 0; i < 80; ++i) {
            session.workspace.close_group();
            const int choice = random.integer(0, static_cast<int>(steps.size()) + 1);
            if (choice < static_cast<int>(steps.size())) {
                const std::string& name = steps[static_cast<std::size_t>(choice)];
                if (find_command(name)->enabled(session)) run_command(session, name);
            } else if (choice == static_cast<int>(steps.size())) {
                run_command(session, "query.select", std::to_string(random.integer(0, 2)));
            } else {
                const int last = session.workspace.recorded()->trace.size() - 1;
                run_command(session, "step.to", std::to_string(random.integer(0, last)));
            }
            const SeenStep now = seen_step(session);
            if (now == visits.back()) continue;
            const int by = now.query == visits.back().query ? now.step - visits.back().step : 0;
            const bool single = std::abs(by) == 1;
            if (single && by == way) {
                visits.back() = now;
                ++merged;
            } else {
                visits.push_back(now);
            }
            way = single ? by : 0;
        }
        for (std::size_t i = visits.size() - 1; i > 0; --i) {
            run_command(session, "step.visited_back");
            ASSERT_EQ(seen_step(session), visits[i - 1]) << "seed " << seed << ", visit " << i - 1;
        }
        EXPECT_FALSE(find_command("step.visited_back")->enabled(session));
        for (std::size_t i = 1; i < visits.size(); ++i) {
            run_command(session, "step.visited_forward");
            ASSERT_EQ(seen_step(session), visits[i]) << "seed " << seed << ", visit " << i;
        }
        EXPECT_FALSE(find_command("step.visited_forward")->enabled(session));
    }
    EXPECT_GT(merged, 20);
}

TEST(Debugger, StepsOfOtherTreesAreNotVisited) {
    const CrossingFolder folder;
    Session session(false);
    session.files.open({folder.scene});
    run_command(session, "query.select", "0");
    for (const char* step : {"4", "1"}) {
        session.workspace.close_group();
        run_command(session, "step.to", step);
    }
    run_command(session, "tree.kind", "umobb");
    ASSERT_GT(session.workspace.visited.before.size(), 1u);
    const SeenStep now = seen_step(session);
    run_command(session, "step.visited_back");
    EXPECT_EQ(seen_step(session), now);
    run_command(session, "tree.kind", "mobb");
    run_command(session, "step.visited_back");
    EXPECT_EQ(session.workspace.step(), 4);
}

TEST(Debugger, AnEditOfTheDebuggingStateKeepsHowTheQueryIsSeen) {
    const CrossingFolder folder;
    Session session(false);
    session.files.open({folder.scene});
    run_command(session, "query.select", "0");
    run_command(session, "focus.branch", "0");
    run_command(session, "recursion.zoom", "1:4");
    const auto findings = session.queries.findings();
    run_command(session, "breakpoint.here");
    EXPECT_EQ(session.queries.break_steps().empty(), false);
    run_command(session, "edit.undo");
    EXPECT_TRUE(session.queries.break_steps().empty());
    EXPECT_TRUE(session.workspace.look.focus.branch && session.workspace.look.zoom);
    EXPECT_EQ(session.queries.findings(), findings) << "nothing is found out again";
    const std::size_t edits = session.workspace.history.count();
    run_command(session, "breakpoint.add", "outcome = hit");
    run_command(session, "breakpoint.add", "outcome = hit");
    EXPECT_EQ(session.workspace.history.place(), 1u) << "the same once more is not an edit";
    EXPECT_LE(session.workspace.history.count(), edits);
}

TEST(Debugger, HitsAreThoseInTheFocus) {
    const CrossingFolder folder;
    Session session(false);
    session.files.open({folder.scene});
    run_command(session, "query.select", "0");
    const EventFilter all("step >= 0"), time("test = time");
    const int events = session.workspace.recorded()->trace.size();
    EXPECT_EQ(session.queries.hits(all), events);
    EXPECT_EQ(session.queries.events_in_focus(), events);
    const int times = session.queries.hits(time);
    run_command(session, "focus.time", "0:0.05");
    EXPECT_LT(session.queries.hits(all), events);
    EXPECT_EQ(session.queries.hits(all), session.queries.events_in_focus());
    EXPECT_LT(session.queries.hits(time), times);
    run_command(session, "events.filter", "test = time");
    EXPECT_EQ(session.queries.hits(time), std::ssize(*session.queries.listed_events()));
}

TEST(Debugger, ExcerptsShareFiltersAndBreakpointsWithTheWhole) {
    const CrossingFolder folder;
    Session session(false);
    session.files.open({folder.scene});
    run_command(session, "query.select", "0");
    run_command(session, "breakpoint.add", "outcome = hit");
    run_command(session, "query.capture");
    ASSERT_TRUE(session.workspace.in_excerpt());
    EXPECT_EQ(session.workspace.scene().debug.breakpoints.size(), 1u);
    run_command(session, "breakpoint.add", "gap < 0.5");
    run_command(session, "crowd.back");
    ASSERT_FALSE(session.workspace.in_excerpt());
    ASSERT_EQ(session.workspace.scene().debug.breakpoints.size(), 2u);
    EXPECT_EQ(session.workspace.scene().debug.breakpoints[1].where, "gap < 0.5");
    run_command(session, "edit.undo");
    EXPECT_TRUE(session.workspace.in_excerpt());
}

}  // namespace
}  // namespace mobbscope::app
