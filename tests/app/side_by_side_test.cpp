// Several views of a scene side by side: what they have in common, how they are framed, and their titles and table.
#include <app/commands/command.h>
#include <app/script/script.h>
#include <app/window/headless_window.h>
#include <explain/compared_fits.h>
#include <explain/query_progress.h>
#include <explain/trace_comparison.h>
#include <render/gl/gl_context.h>
#include <render/pictures/build_draw_list.h>

#include "app/folder_window.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::app {
namespace {

struct SideBySide : FolderWindow<CrossingFolder> {
    SideBySide() : FolderWindow({1400, 1400}) {
        session.files.open({folder.write("compared.json", R"({"clips": {"walk": {"source": "walk.csv"}},
            "agents": [{"name": "A", "clip": "walk"},
                       {"name": "B", "clip": "walk", "translate": [2, 0.82], "rotate_deg": 180}],
            "fit": {"leaf": 4}})")});
        window.settle();
    }
    void run(const std::string& script) {
        std::ostringstream out;
        Script::parse(script, "test").run(session, window, out);
        window.settle();
    }
    const ViewState& here() const { return session.workspace.view(); }
    SceneView at(std::size_t place) const { return session.views.at(place); }
};

TEST(SideBySide, EveryLinkCanBeSwitchedOffAndOn) {
    SideBySide w;
    w.run("run compare.fits mobb umobb moving,leaf=8");
    ASSERT_EQ(w.session.views.count(), 3u);
    // Whether another view is as the active one in what a link is about, after something else was done in that.
    struct Case {
        std::string link, first, second;
        std::function<bool(const ViewState&, const ViewState&)> same;
    };
    const std::vector<Case> cases{
        {"camera", "run view.top", "run view.front",
         [](const ViewState& a, const ViewState& b) { return a.camera == b.camera; }},
        {"time", "run time.at 0.2", "run time.at 0.4",
         [](const ViewState& a, const ViewState& b) { return a.time == b.time; }},
        {"level", "run view.level 1", "run view.level 3",
         [](const ViewState& a, const ViewState& b) { return a.levels == b.levels; }},
        {"query", "run query.select 0", "run query.none",
         [](const ViewState& a, const ViewState& b) { return a.query == b.query; }},
        {"time", "run view.slab 0.1:0.3", "run view.slab 0.2:0.4",
         [](const ViewState& a, const ViewState& b) { return a.slab == b.slab; }},
        {"time", "run view.cut_boxes", "run view.cut_boxes",
         [](const ViewState& a, const ViewState& b) { return a.cut_boxes == b.cut_boxes; }},
        {"time", "run view.slice", "run view.slice",
         [](const ViewState& a, const ViewState& b) { return a.slice == b.slice; }},
        {"level", "run agents.hide A", "run agents.hide B",
         [](const ViewState& a, const ViewState& b) { return a.hidden == b.hidden; }},
        {"level", "run agents.pin A", "run agents.pin B",
         [](const ViewState& a, const ViewState& b) { return a.pinned == b.pinned; }},
        {"level", "run view.heat", "run view.heat",
         [](const ViewState& a, const ViewState& b) { return a.heat == b.heat; }},
        {"level", "run view.boxes", "run view.boxes",
         [](const ViewState& a, const ViewState& b) { return a.boxes == b.boxes; }},
        {"level", "run view.ancestors", "run view.ancestors",
         [](const ViewState& a, const ViewState& b) { return a.ancestors == b.ancestors; }},
        {"camera", "run view.plan", "run view.moment",
         [](const ViewState& a, const ViewState& b) { return a.show == b.show && a.camera == b.camera; }},
    };
    for (const Case& c : cases) {
        SCOPED_TRACE(c.link);
        w.run(c.first);
        EXPECT_TRUE(c.same(w.at(1).view, w.here()) && c.same(w.at(2).view, w.here()));
        w.run("click link." + c.link);
        w.run(c.second);
        EXPECT_FALSE(c.same(w.at(1).view, w.here()) || c.same(w.at(2).view, w.here()));
        w.run("click link." + c.link);
        EXPECT_TRUE(c.same(w.at(1).view, w.here()) && c.same(w.at(2).view, w.here())) << "at once";
    }
    w.run("expect /links/camera true\nexpect /views/2/view/levels \"3\"");
}

TEST(SideBySide, ANodeIsSelectedInEveryTree) {
    SideBySide w;
    w.run("run compare.fits mobb,leaf=2 umobb,leaf=8\nrun go.node A 3.2\nframes 3");
    const mobb::Tree &fine = w.at(0).fitted->tree(0), &coarse = w.at(1).fitted->tree(0);
    const int node = w.session.workspace.selection.index;
    const int there = node_over_same_samples(fine, node, coarse);
    w.run("click view.title.1");
    ASSERT_EQ(w.session.views.active(), 1u);
    EXPECT_EQ(w.session.workspace.selection.kind, Selection::Kind::node);
    EXPECT_EQ(w.session.workspace.selection.index, there);
    w.run("run view.link_selections\nclick view.title.0");
    EXPECT_EQ(w.session.workspace.selection.kind, Selection::Kind::path) << "another tree has other nodes";
}

/// Samples of the part that a view shows alone; none: all is shown.
std::pair<int, int> samples_alone(const SceneView& seen) {
    if (!seen.view.subtree) return {-1, 0};
    const mobb::Node& node = seen.fitted->tree(0).node(seen.view.subtree->node);
    return {node.first, node.count};
}

TEST(SideBySide, APartAloneIsOfTheSameSamplesInEveryTree) {
    SideBySide w;
    // Leaves number nodes: other leaves, other numbers.
    w.run("run tree.leaf 2\nrun go.node A 2.1\nrun node.isolate\nrun view.save_as part");
    const std::pair<int, int> samples = samples_alone(w.at(0));
    const int node = w.here().subtree->node;
    ASSERT_GT(samples.second, 8);
    w.run("run compare.fits mobb,leaf=2 mobb,leaf=8\nrun view.link_selections\nrun compare.add umobb,leaf=4");
    ASSERT_EQ(w.session.views.count(), 3u);
    for (const std::size_t place : {0u, 1u, 2u}) EXPECT_EQ(samples_alone(w.at(place)), samples) << place;
    EXPECT_NE(w.at(1).view.subtree->node, node);
    w.run("run tree.leaf 6");
    for (const std::size_t place : {0u, 1u, 2u}) EXPECT_EQ(samples_alone(w.at(place)), samples) << place;
    w.run("run node.show_all\nrun view.go part");
    EXPECT_EQ(samples_alone(w.at(0)), samples) << "a view that was saved of other trees";
    w.run("run tree.levels 1");
    EXPECT_FALSE(w.here().subtree) << "no node has these samples";
    EXPECT_EQ(samples_alone(w.at(1)), samples) << "its trees are as they were";
    w.run("run view.go part");
    EXPECT_FALSE(w.here().subtree);
}

TEST(SideBySide, WhatIsSelectedStandsOutInEveryPicture) {
    SideBySide w;
    w.run("run compare.fits mobb umobb\nrun go.node A 1.1\nframes 3");
    for (const std::size_t place : {1u, 0u}) {
        w.run("run view.other");
        ASSERT_EQ(w.session.views.active(), place);
        EXPECT_GT(w.window.shell().shown()->highlights.size(), 0u);
    }
    // Beside the active one, too: its picture is another one without.
    const auto picture = [&] {
        const Image window = w.window.shell().read_back();
        const Rect at = w.window.shell().marks().all().at("viewport.1");
        std::vector<std::uint8_t> out;
        for (int y = static_cast<int>(at.min.y) + 2; y < static_cast<int>(at.max.y) - 2; ++y) {
            const auto row = window.rgba.begin() + 4 * (y * static_cast<std::ptrdiff_t>(window.width));
            out.insert(out.end(), row + 4 * (static_cast<int>(at.min.x) + 2),
                       row + 4 * (static_cast<int>(at.max.x) - 2));
        }
        return out;
    };
    const auto linked = picture();
    w.run("run view.link_selections");
    EXPECT_NE(picture(), linked);
    w.run("run view.link_selections");
    EXPECT_EQ(picture(), linked);
}

TEST(SideBySide, AStepTakesTheOtherTraversalToTheSameMoment) {
    SideBySide w;
    w.run("run compare.fits mobb,leaf=2 umobb,leaf=8\nrun query.select 0\nrun step.last");
    const SceneView &a = w.at(0), &b = w.at(1);
    const std::shared_ptr<const RecordedQuery> first = a.fitted->recorded(0), second = b.fitted->recorded(0);
    const SceneQuery query = a.fitted->queries()[0];
    const RecordedTraversal from{a.fitted->placed(query.a), a.fitted->placed(query.b), first.get()};
    const RecordedTraversal to{b.fitted->placed(query.a), b.fitted->placed(query.b), second.get()};
    const TraversalComparison both = compared(decisions_of(from.a, from.b, *first), decisions_of(to.a, to.b, *second));
    const auto step_there = [&] {
        const SceneView seen = w.at(1);
        return event_of(seen.view.step, second->trace, *seen.fitted, 0);
    };
    int different = 0;
    for (int step = 0; step < first->trace.size(); ++step) {
        w.session.workspace.go_to_event(step);
        EXPECT_EQ(step_there(), matching_step(both, from, to, step)) << step;
        different += step_there() != step ? 1 : 0;
    }
    EXPECT_GT(different, 3);
    // To become active moves nothing.
    w.session.workspace.go_to_event(3);
    const int there = step_there();
    w.run("key F6\nkey F6");
    EXPECT_EQ(w.session.workspace.step(), 3);
    EXPECT_EQ(step_there(), there);
    w.run("run view.link_queries");
    w.session.workspace.go_to_event(5);
    EXPECT_EQ(step_there(), there);
}

/// How much of the picture's shorter side is left around what is shown: below 0 it is cut off.
float margin(const DrawList& list) {
    EXPECT_FALSE(list.disks.empty());
    float out = 1e6f;
    const glm::vec2 size(list.size.width, list.size.height);
    for (const DiskInstance& disk : list.disks) {
        const auto pixel = list.projection.project(glm::vec3(disk.base));
        if (!pixel) return -1;
        out = std::min({out, pixel->x, pixel->y, size.x - pixel->x, size.y - pixel->y});
    }
    return out;
}

TEST(SideBySide, APictureHoldsTheWholeHoweverNarrowItIs) {
    SideBySide w;
    w.run("run view.frame_boxes\nrun view.front\nrun view.frame_all");
    const Camera alone = w.here().camera;
    ASSERT_GT(margin(*w.window.shell().shown()), 0);
    for (const char* more : {"run view.split", "run compare.add moving", "run compare.add aabb"}) {
        w.run(more);
        EXPECT_GT(margin(*w.window.shell().shown()), 0) << more;
        EXPECT_EQ(w.here().camera.preset, alone.preset) << "the direction stays";
        EXPECT_NE(w.here().camera.distance, alone.distance);
    }
    EXPECT_THROW(run_command(w.session, "compare.add", "hybrid1"), std::invalid_argument) << "four are enough";
    w.run("click view.close.3\nclick view.close.0");
    ASSERT_EQ(w.session.views.count(), 2u);
    EXPECT_EQ(w.session.workspace.fitted().options().tree, mobb::TreeKind::umobb) << "the neighbour is active";
    w.run("run view.split");
    const Camera again = w.here().camera;
    EXPECT_NEAR(again.distance, alone.distance, 0.01 * alone.distance) << "the former frame";
    w.run("run view.split\nkey Ctrl+Z");
    ASSERT_EQ(w.session.views.count(), 1u);
    EXPECT_EQ(w.here().camera, again) << "after undo, too";
    // Who has gone nearer stays there.
    w.run("run view.zoom 3");
    const double near = w.here().camera.distance;
    w.run("run view.split");
    EXPECT_NEAR(w.here().camera.distance, near, 0.15 * near) << "but for the title's height";
}

/// The boxes of each tree reach elsewhere.
TEST(SideBySide, ViewsThatShareTheirCameraAreFramedTogether) {
    SideBySide w;
    w.run("run compare.fits mobb umobb aabb\nrun view.level 1\nrun view.frame_all");
    for (const std::size_t place : {0u, 1u, 2u}) {
        const SceneView seen = w.at(place);
        EXPECT_EQ(seen.view.camera, w.here().camera);
        const DrawList list = build_draw_list(*seen.fitted, seen.view, w.session.views.picture->size);
        const glm::vec2 size(list.size.width, list.size.height);
        ASSERT_FALSE(list.boxes.empty());
        for (const BoxInstance& box : list.boxes) {
            for (const glm::vec3& corner : box_corners(box)) {
                const glm::vec2 at = list.projection.project(corner).value_or(glm::vec2(-1));
                EXPECT_TRUE(at.x >= 0 && at.y >= 0 && at.x <= size.x && at.y <= size.y) << place;
            }
        }
    }
    w.run("size 1200x900");
    EXPECT_EQ(w.at(2).view.camera, w.at(0).view.camera);
    EXPECT_TRUE(w.session.workspace.is_framed(w.here().camera));
}

TEST(SideBySide, ViewsOutliveExcerptsAndEndWithTheirScene) {
    SideBySide w;
    w.run("run compare.fits mobb umobb moving\nrun view.link_times\nrun view.other\nrun query.select 0");
    const auto kinds = [&] {
        std::vector<mobb::TreeKind> out;
        for (std::size_t place = 0; place < w.session.views.count(); ++place)
            out.push_back(w.at(place).fitted->options().tree);
        return out;
    };
    const auto before = kinds();
    w.run("run view.measure 0,0,0:1,1,0");
    w.session.excerpts.open(w.session.workspace.fitted().placed_agents()[0],
                            w.session.workspace.fitted().placed_agents()[1]);
    w.window.settle();
    EXPECT_EQ(w.session.views.count(), 1u);
    EXPECT_TRUE(w.session.workspace.measuring.is_nothing()) << "other things stand there";
    EXPECT_EQ(why_not(w.session, *find_command("view.save_as")),
              "views cannot be saved in an excerpt: go back to the whole scene first");
    w.session.excerpts.leave();
    w.window.settle();
    EXPECT_EQ(kinds(), before);
    EXPECT_EQ(w.session.views.active(), 1u);
    EXPECT_FALSE(w.session.workspace.document().links.time);
    w.run("run tree.leaf 6\nkey Ctrl+Z");
    EXPECT_EQ(kinds(), before);
    w.session.files.open({w.folder.scene});
    w.window.settle();
    EXPECT_EQ(w.session.views.count(), 1u);
}

TEST(SideBySide, ThePapersComparisonIsOneClick) {
    SideBySide w;
    w.run("run query.select 0\nrun compare.paper");
    ASSERT_EQ(w.session.views.count(), 2u);
    EXPECT_EQ(w.at(0).fitted->options().tree, mobb::TreeKind::mobb);
    EXPECT_EQ(w.at(1).fitted->options().tree, mobb::TreeKind::umobb);
    for (const std::size_t place : {0u, 1u}) {
        EXPECT_FALSE(w.at(place).view.query);
        EXPECT_EQ(to_string(w.at(place).view.levels), "2");
    }
    for (const char* wrong : {"mobb", "mobb mobb", "mobb umobb moving aabb blocks", "mobb x"})
        EXPECT_THROW(run_command(w.session, "compare.fits", wrong), std::invalid_argument) << wrong;
    EXPECT_THROW(run_command(w.session, "compare.add", "umobb"), std::invalid_argument) << "it is in view";
    EXPECT_EQ(w.session.views.count(), 2u);
}

TEST(SideBySide, AnotherFitThatIsLeftIsNotSaved) {
    SideBySide w;
    w.run("run compare.fits mobb,leaf=4 umobb,leaf=4\nrun view.other");
    EXPECT_FALSE(w.session.workspace.modified()) << "nothing but looked at";
    w.run("run view.close 0");
    EXPECT_TRUE(w.session.workspace.modified());
    w.run("key Ctrl+Z");
    EXPECT_FALSE(w.session.workspace.modified());
    w.run("run view.close 1");
    EXPECT_FALSE(w.session.workspace.modified()) << "the fit of the file is left";
}

TEST(SideBySide, ATitleChangesItsOwnView) {
    SideBySide w;
    w.run("run compare.fits mobb umobb\nclick view.fit.1\nframes 2\nclick view.fit.1.moving\nframes 3");
    EXPECT_EQ(w.session.views.active(), 1u);
    EXPECT_EQ(w.at(1).fitted->options().tree, mobb::TreeKind::moving);
    EXPECT_EQ(w.at(0).fitted->options().tree, mobb::TreeKind::mobb);
    w.run("click view.title.0");
    EXPECT_EQ(w.session.views.active(), 0u);
}

TEST(SideBySide, TheTableKnowsTheCostsOfAllAndShowsALevel) {
    SideBySide w;
    EXPECT_FALSE(w.has("section.compare fits"));
    w.run("run compare.fits mobb umobb moving");
    ASSERT_TRUE(w.has("compared.verdict"));
    const ComparedFits& standard = w.session.fit_costs.compared(0);
    for (const std::size_t fit : {0u, 1u, 2u}) EXPECT_TRUE(standard.cost.values[fit]) << fit;
    w.run("click compared.level.3");
    for (const std::size_t place : {0u, 1u, 2u}) EXPECT_EQ(to_string(w.at(place).view.levels), "3");
    w.run("run tree.cost_of queries\nframes 6");
    const ComparedFits& counted = w.session.fit_costs.compared(0);
    for (const std::size_t fit : {0u, 1u, 2u}) {
        const SceneCosts costs = scene_costs(*w.at(fit).fitted);
        ASSERT_TRUE(counted.cost.values[fit]) << fit;
        EXPECT_EQ(*counted.cost.values[fit], [&] {
            const TreeCost cost = cost_in_scene(costs, 0, w.at(fit).fitted->shared_tree(0));
            return cost.ns(cost.tests);
        }());
    }
}

}  // namespace
}  // namespace mobbscope::app
