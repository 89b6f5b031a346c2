// What trees cost, in the window: the numbers of `fit --json`, or those counted over the scene's queries.
#include <app/document/described.h>
#include <app/window/headless_window.h>
#include <explain/expected_cost.h>
#include <explain/tree_cost.h>
#include <render/gl/gl_context.h>

#include "app/folder_window.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <memory>
#include <string>
#include <thread>

namespace mobbscope::app {
namespace {

using Workload = QueryWorkload::Kind;

struct CostWindow : FolderWindow<CrossingFolder> {
    explicit CostWindow(bool attended = false) : FolderWindow({1280, 1100}, 1, attended) { open(folder.scene); }
    void click(const std::string& mark) {
        ASSERT_TRUE(has(mark)) << mark;
        window.shell().feed(MouseMove{window.shell().marks().all().at(mark).center()});
        window.shell().feed(MouseButton{0, true});
        window.shell().feed(MouseButton{0, false});
        window.settle();
    }
    const mobb::Tree& tree() const { return session.workspace.fitted().tree(0); }
    std::shared_ptr<const TreeCost> cost() const { return session.workspace.cost_of(0); }
};

std::string fact_of(const Workspace& workspace, const std::string& key) {
    for (const auto& [name, value] : describe(workspace, workspace.selection).facts) {
        if (name == key) return value;
    }
    return "";
}

TEST(Cost, TheWindowHasTheNumbersOfFit) {
    CostWindow w;
    for (const char* kind : {"mobb", "umobb", "moving"}) {
        w.run("tree.kind", kind);
        const std::size_t most = w.session.fit_costs.most_counted();
        const auto counted = standard_cost(w.session.workspace.fitted().shared_tree(0), most);
        ASSERT_TRUE(w.cost()) << kind;
        EXPECT_EQ(w.cost()->queries, counted->queries);
        EXPECT_EQ(w.cost()->tests.by_kind, counted->tests.by_kind);
        EXPECT_EQ(w.cost()->shares, expected_shares(w.tree()));
        EXPECT_TRUE(w.has("cost.total"));
        EXPECT_TRUE(w.has("cost.kind.samples"));
        EXPECT_TRUE(w.has("cost.kind.time"));
        for (int level = 0; level < w.tree().depth(); ++level)
            EXPECT_TRUE(w.has("level." + std::to_string(level))) << level;
    }
    EXPECT_TRUE(w.has("cost.kind.moving"));
    EXPECT_FALSE(w.has("cost.kind.obb2d"));
}

TEST(Cost, AClickOnALevelShowsIt) {
    CostWindow w;
    w.click("level.2");
    EXPECT_EQ(w.session.workspace.view().levels, (LevelRange{2, 2, false}));
}

TEST(Cost, OfTheScenesQueriesIsCounted) {
    CostWindow w;
    w.click("tree.cost_of.queries");
    EXPECT_EQ(w.session.settings.cost_of, Workload::queries);
    ASSERT_TRUE(w.cost());
    const FittedScene& fitted = w.session.workspace.fitted();
    const SceneCosts counted = scene_costs(fitted);
    EXPECT_EQ(w.cost()->workload, Workload::queries);
    EXPECT_EQ(w.cost()->queries, fitted.queries().size());
    EXPECT_EQ(w.cost()->tests.by_kind, cost_in_scene(counted, 0, fitted.shared_tree(0)).tests.by_kind);
    // Another scene is counted anew.
    w.run("tree.leaf", "2");
    ASSERT_TRUE(w.cost());
    EXPECT_NE(w.cost()->tests.all(), static_cast<double>(counted.kinds.all()) / 3);
    w.click("tree.cost_of.placements");
    ASSERT_TRUE(w.cost());
    EXPECT_EQ(w.cost()->workload, Workload::placements);
}

TEST(Cost, WithoutQueriesThereAreStandardPlacementsAlone) {
    CostWindow w;
    w.run("tree.cost_of", "queries");
    w.session.files.open({w.folder.file("walk.csv")});
    w.window.settle();
    EXPECT_EQ(w.session.workspace.workload(), Workload::placements);
    ASSERT_TRUE(w.cost());
    EXPECT_FALSE(w.has("tree.cost_of.queries"));
    EXPECT_NE(refusal(w.session, "tree.cost_of", "queries"), "");
    EXPECT_EQ(w.session.settings.cost_of, Workload::queries) << "it is kept for scenes that ask";
}

TEST(Cost, ANodeSaysItsPartUnderTheChosenWorkload) {
    CostWindow w;
    w.run("go.node", "A 1.0");
    ASSERT_TRUE(w.cost());
    EXPECT_EQ(fact_of(w.session.workspace, "cost"),
              figure(100 * w.cost()->shares[1], 2) + " % of all box tests in standard placements");
    w.run("tree.cost_of", "queries");
    ASSERT_TRUE(w.cost());
    EXPECT_EQ(fact_of(w.session.workspace, "cost"),
              figure(100 * w.cost()->shares[1], 2) + " % of all box tests in the scene's queries");
}

TEST(Cost, BlocksAreNotCounted) {
    CostWindow w;
    w.run("tree.kind", "blocks");
    for (const char* of : {"placements", "queries"}) {
        w.run("tree.cost_of", of);
        EXPECT_FALSE(w.cost());
        EXPECT_FALSE(w.has("cost.total"));
        EXPECT_TRUE(w.has("level.0"));
        w.run("go.node", "A 1.0");
        EXPECT_EQ(fact_of(w.session.workspace, "cost"), "");
    }
}

/// Somebody looks: the first thousands come by themselves, the others beside the window, and once for a tree.
TEST(Cost, IsCountedOnBesideTheWindowAndKept) {
    CostWindow w(true);
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    const std::size_t most = w.session.fit_costs.most_counted();
    std::size_t fewest = most;
    const auto wait = [&] {
        const auto is_enough = [&] { return w.cost() && w.cost()->count.is_enough(most); };
        while (!is_enough() && std::chrono::steady_clock::now() < end) {
            // As the panel does in each frame.
            w.session.fit_costs.update(0);
            if (w.cost()) fewest = std::min(fewest, w.cost()->queries);
            std::this_thread::yield();
        }
        return is_enough() ? w.cost() : nullptr;
    };
    const std::shared_ptr<const TreeCost> first = wait();
    ASSERT_TRUE(first);
    EXPECT_LT(first->count.standard_error(), kCountedError);
    EXPECT_LT(fewest, first->queries) << "an earlier count was shown";
    w.run("tree.kind", "umobb");
    const std::shared_ptr<const TreeCost> second = wait();
    ASSERT_TRUE(second);
    EXPECT_NE(second->tests.by_kind, first->tests.by_kind);
    w.run("edit.undo");
    EXPECT_EQ(w.cost(), first) << "it is known still";
}

}  // namespace
}  // namespace mobbscope::app
