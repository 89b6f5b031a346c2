// The query in view beside itself in the window: under another fit, and as its stored trace.
#include <app/script/script.h>
#include <app/window/headless_window.h>
#include <render/gl/gl_context.h>
#include <scene/scene_json.h>

#include "app/folder_window.h"

#include <gtest/gtest.h>

#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace mobbscope::app {
namespace {

struct CompareWorld : FolderWindow<CrossingFolder> {
    CompareWorld() : FolderWindow({1280, 2800}) {
        open(R"({"clips": {"walk": {"source": "walk.csv"}},
            "agents": [{"name": "A", "clip": "walk"},
                       {"name": "B", "clip": "walk", "translate": [2, 0.82], "rotate_deg": 180}],
            "fit": {"leaf": 4}})");
        run("run query.select 0\nrun step.first\nframes 3");
    }
    void open(const std::string& scene) {
        session.files.open({folder.write("compared.json", scene)});
        window.settle();
    }
    void run(const std::string& script) {
        std::ostringstream out;
        Script::parse(script, "test").run(session, window, out);
    }
    const Rect& mark(const std::string& name) { return window.shell().marks().all().at(name); }
    const FitComparison& other() const { return *session.queries.comparison(); }
};

TEST(CompareWindow, AClickOnTheStripsGoesToTheDecisionOfThatMoment) {
    CompareWorld w;
    EXPECT_FALSE(w.has("compare.strips"));
    w.run("click compare.with\nframes 2\nclick compare.with.umobb\nframes 3");
    ASSERT_TRUE(w.session.workspace.compare_with);
    ASSERT_TRUE(w.has("compare.strips"));
    EXPECT_EQ(w.other().names, (std::array<std::string, 2>{"MOBB", "UMOBB"}));
    for (const double share : {0.2, 0.5, 0.8}) {
        const Rect strips = w.mark("compare.strips");
        w.run("click " + std::to_string(strips.min.x + share * strips.size().x) + ' ' +
              std::to_string(strips.center().y) + "\nframes 3");
        const TraversalComparison& both = w.other().traversals;
        const double t0 = both.times.front().t0, t1 = both.times.back().t1;
        ASSERT_TRUE(w.session.workspace.view().time);
        const double time = *w.session.workspace.view().time;
        EXPECT_NEAR(time, t0 + share * (t1 - t0), 0.01 * (t1 - t0));
        EXPECT_EQ(w.session.workspace.step(), both.decision(*both.at(time), 0).step);
        EXPECT_TRUE(w.has("compare.now"));
    }
    w.run("run compare.leaf 2\nframes 3");
    EXPECT_EQ(w.other().names, (std::array<std::string, 2>{"MOBB, leaf 4", "UMOBB, leaf 2"}));
    w.run("run compare.none\nframes 3");
    EXPECT_FALSE(w.has("compare.strips"));
    EXPECT_TRUE(w.has("section.compare"));
}

TEST(CompareWindow, TheComparisonFollowsTheFitInView) {
    CompareWorld w;
    w.run("run compare.with umobb\nframes 3");
    const std::size_t before = w.other().traversals.times.size();
    w.run("run tree.kind umobb\nframes 3");
    EXPECT_EQ(w.other().names[1], "UMOBB (2)");
    for (const ComparedTime& time : w.other().traversals.times) EXPECT_EQ(time.earlier, 0);
    w.run("run tree.kind mobb\nframes 3");
    EXPECT_EQ(w.other().traversals.times.size(), before);
}

TEST(CompareWindow, AStoredTraceIsComparedEventByEvent) {
    CompareWorld w;
    Scene scene = w.session.workspace.scene();
    const SceneQuery asked = w.session.workspace.fitted().queries()[0];
    const mobb::Trace& now = w.session.workspace.recorded()->trace;
    mobb::Trace stored;
    int changed = -1;
    for (int step = 0; step < now.size(); ++step) {
        mobb::Trace::Event event = now[step];
        if (changed < 0 && event.outcome == mobb::Outcome::separated) {
            event.gap += 0.25;
            changed = step;
        }
        stored.push(event);
    }
    ASSERT_GE(changed, 0);
    scene.queries = {{asked.a, asked.b, {}, std::make_shared<const mobb::Trace>(now)},
                     {asked.a, asked.b, {}, std::make_shared<const mobb::Trace>(stored)}};
    w.open(to_json(scene));
    w.run("run query.select 0\nrun compare.with stored\nframes 3\nexpect /query/compare/agrees true");
    EXPECT_FALSE(w.has("query.difference")) << "there is none to go to";
    w.run("run query.select 1\nframes 3\nexpect /query/compare/agrees false");
    w.run("expect /query/compare/difference " + std::to_string(changed));
    w.run("run step.last\nframes 2\nclick query.difference\nframes 2");
    EXPECT_EQ(w.session.workspace.step(), changed);
}

TEST(CompareWindow, AStoredTraceIsCheckedWhenItsFileIsOpened) {
    CompareWorld w;
    Scene scene = w.session.workspace.scene();
    const SceneQuery asked = w.session.workspace.fitted().queries()[0];
    const RecordedQuery now = *w.session.workspace.recorded();
    mobb::Trace stored;
    std::vector<mobb::MeasuredPair> pairs;
    int changed = -1;
    for (int step = 0; step < now.trace.size(); ++step) {
        mobb::Trace::Event event = now.trace[step];
        if (changed < 0 && !event.pairs.empty()) {
            pairs.assign(event.pairs.begin(), event.pairs.end());
            pairs.back().distance += 1e-6;
            event.pairs = pairs;
            changed = step;
        }
        stored.push(event);
    }
    ASSERT_GE(changed, 0);
    const Expectation expect{now.contact.has_value(), now.contact};
    scene.queries = {{asked.a, asked.b, expect, std::make_shared<const mobb::Trace>(now.trace)}};
    w.session.notifications.clear();
    w.open(to_json(scene));
    EXPECT_TRUE(w.session.notifications.all().empty()) << "it is as the file says";
    w.run("run query.select 0\nframes 3");
    EXPECT_FALSE(w.has("query.disagrees"));
    scene.queries.push_back({asked.a, asked.b, expect, std::make_shared<const mobb::Trace>(stored)});
    w.open(to_json(scene));
    const std::string at_step = "the traces differ at step " + std::to_string(changed) + " in pairs";
    ASSERT_EQ(w.session.notifications.all().size(), 1u);
    const std::string said = w.session.notifications.all().back().text;
    EXPECT_TRUE(said.starts_with("query 1: " + at_step)) << said;
    EXPECT_EQ(w.session.workspace.stored_difference(0), nullptr);
    ASSERT_TRUE(w.session.workspace.stored_difference(1));
    w.run("run query.select 1\nrun step.last\nframes 3");
    EXPECT_TRUE(w.has("query.disagrees")) << "the answer is as expected, the trace is not";
    w.run("click query.difference\nframes 3");
    EXPECT_EQ(w.session.workspace.step(), changed);
    EXPECT_TRUE(w.has("compare.now")) << "both sides of the step";
}

TEST(CompareWindow, AClipThatWasAlteredIsNamedWhenItsFileIsOpened) {
    CompareWorld w;
    w.run("run query.capture 0\nframes 3");
    const std::string text = to_json(w.session.workspace.scene());
    ASSERT_NE(text.find("\"digest\": \""), std::string::npos);
    CompareWorld same, other;
    same.open(text);
    EXPECT_TRUE(same.session.notifications.all().empty());
    const std::size_t dt = text.find("\"dt\": ") + 6;
    other.open(text.substr(0, dt) + " 0.25" + text.substr(text.find(',', dt)));
    ASSERT_FALSE(other.session.notifications.all().empty());
    EXPECT_NE(other.session.notifications.all().front().text.find("are not those that were captured"),
              std::string::npos);
}

}  // namespace
}  // namespace mobbscope::app
