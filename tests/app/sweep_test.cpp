// Which tree to ship: a sweep begun in the window, its plot and its list apply fits.
#include <app/script/state_json.h>
#include <app/window/headless_window.h>
#include <render/gl/gl_context.h>
#include <scene/scene_edits.h>

#include "app/folder_window.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace mobbscope::app {
namespace {

/// A machine on which blocks are the fastest when warm, and one level when cold.
std::vector<double> planted(Protocol protocol, const FitTrees& trees, std::span<const ClipQuery> queries,
                            std::size_t stretch) {
    const mobb::FitOptions& fit = trees.front()->options();
    const bool is_best = protocol == Protocol::warm ? fit.tree == mobb::TreeKind::blocks
                                                    : fit.tree == mobb::TreeKind::mobb && fit.levels == 1;
    return std::vector<double>((queries.size() + stretch - 1) / stretch, is_best ? 10 : 100);
}

struct SweepWindow : FolderWindow<CrossingFolder> {
    SweepWindow() : FolderWindow({1600, 1400}) {
        session.sweeps.timer = planted;
        open(folder.scene);
    }
    void click(const std::string& mark) {
        window.shell().feed(MouseMove{0.5f * (rect(mark).min + rect(mark).max)});
        window.settle();
        window.shell().feed(MouseButton{0, true});
        window.settle();
        window.shell().feed(MouseButton{0, false});
        window.settle();
    }
    void sweep() {
        run_command(session, "tree.sweep");
        window.settle();
    }
    const mobb::FitOptions& fit() const { return session.workspace.fitted().options(); }
    const SweepResult& result() const { return *session.sweeps.result()->rows; }
    std::size_t edits() const { return session.workspace.history.place(); }
};

TEST(Sweep, AppliesWhatItRecommendsAsOneEdit) {
    SweepWindow w;
    const mobb::FitOptions before = w.fit();
    w.sweep();
    const std::optional<std::size_t> recommended = w.result().of(Protocol::warm).recommended;
    ASSERT_TRUE(recommended);
    const mobb::FitOptions best = w.result().rows[*recommended].fit;
    EXPECT_EQ(best.tree, mobb::TreeKind::blocks);
    ASSERT_TRUE(w.has("sweep.apply"));
    const Rect there = w.rect("sweep.apply");
    w.click("sweep.apply");
    EXPECT_EQ(w.fit(), best);
    EXPECT_EQ(w.rect("sweep.apply").min, there.min) << "it stays under the mouse";
    EXPECT_LT(there.max.y, w.rect("sweep.why").min.y) << "no words that change stand above it";
    EXPECT_EQ(w.edits(), 1u);
    EXPECT_TRUE(w.session.sweeps.is_of_scene()) << "another fit asks the same";
    EXPECT_FALSE(find_command("tree.sweep_apply")->enabled(w.session));
    run_command(w.session, "edit.undo");
    EXPECT_EQ(w.fit(), before);
    EXPECT_TRUE(find_command("tree.sweep_apply")->enabled(w.session));
}

TEST(Sweep, SaysWhatTheCommandSaysOfWarmAndColdQueries) {
    SweepWindow w;
    w.sweep();
    ASSERT_TRUE(w.has("sweep.why"));
    ASSERT_TRUE(w.has("sweep.why_cold"));
    const nlohmann::ordered_json state = state_json(w.session)["sweep"];
    EXPECT_EQ(state["warm"]["recommended"], "blocks,leaf=4") << "as now but for the kind";
    EXPECT_TRUE(state["cold"]["recommended"].get<std::string>().starts_with("mobb,")) << state["cold"]["recommended"];
    EXPECT_TRUE(state["cold"]["undecided"].empty());
    EXPECT_EQ(state["cold"]["why"], w.result().of(Protocol::cold).why);
    EXPECT_NE(w.result().of(Protocol::cold).why.find(": 10 ns +-0.1, 90 % less than "), std::string::npos)
        << w.result().of(Protocol::cold).why;
    w.click("sweep.apply_cold");
    EXPECT_EQ(w.session.workspace.fitted().tree(0).depth(), 1);
    EXPECT_EQ(w.edits(), 1u);
}

TEST(Sweep, WhatIsUndecidedIsNotApplied) {
    SweepWindow w;
    w.session.sweeps.timer = [](Protocol, const FitTrees&, std::span<const ClipQuery> queries, std::size_t stretch) {
        return std::vector<double>((queries.size() + stretch - 1) / stretch, 100);
    };
    w.sweep();
    EXPECT_FALSE(find_command("tree.sweep_apply")->enabled(w.session));
    const nlohmann::ordered_json state = state_json(w.session)["sweep"];
    EXPECT_TRUE(state["warm"]["recommended"].is_null());
    EXPECT_GT(state["warm"]["undecided"].size(), 6u);
}

TEST(Sweep, NothingIsMeasuredForAPicture) {
    SweepWindow w;
    w.session.options.may_measure = false;
    w.sweep();
    EXPECT_FALSE(w.has("sweep.why"));
    EXPECT_FALSE(find_command("tree.sweep_apply")->enabled(w.session));
    EXPECT_TRUE(w.has("sweep.row.0"));
}

TEST(Sweep, PointsAndRowsApplyTheirFits) {
    SweepWindow w;
    w.sweep();
    std::size_t other = 0;
    for (std::size_t i = 0; i < w.result().rows.size(); ++i) {
        const mobb::FitOptions& fit = w.result().rows[i].fit;
        if (fit.tree == mobb::TreeKind::aabb && w.has("sweep.point." + std::to_string(i))) other = i;
    }
    ASSERT_NE(other, 0u);
    const mobb::FitOptions wanted = w.result().rows[other].fit;
    w.click("sweep.point." + std::to_string(other));
    EXPECT_EQ(w.fit().tree, wanted.tree);
    EXPECT_EQ(w.fit().leaf, wanted.leaf);
    w.click("sweep.row.0");
    EXPECT_NE(w.fit(), wanted);
    EXPECT_EQ(w.edits(), 2u);
}

TEST(Sweep, SaysWhenTheClipsHaveChanged) {
    SweepWindow w;
    w.sweep();
    EXPECT_FALSE(w.has("sweep.stale"));
    w.session.workspace.edit({"removing a clip", "removing"}, [](Scene& scene) {
        scene.agents.clear();
        scene.queries.clear();
        scene.clips.pop_back();
    });
    w.window.settle();
    EXPECT_TRUE(w.has("sweep.stale"));
    EXPECT_FALSE(w.has("sweep.apply"));
    EXPECT_FALSE(find_command("tree.sweep_apply")->enabled(w.session));
}

TEST(Sweep, TriesAxesAndTimeScalesWhereTheyAreChosen) {
    SweepWindow w;
    w.sweep();
    const std::size_t rows = w.result().rows.size();
    w.click("tree.sweep_axes");
    EXPECT_TRUE(w.session.sweeps.over_axes);
    w.click("sweep.start");
    EXPECT_GT(w.result().rows.size(), rows);
}

TEST(Sweep, CanBeEnded) {
    CrossingFolder folder;
    Session session{true};
    session.files.open({folder.scene});
    while (session.jobs.job()) session.poll();
    run_command(session, "tree.sweep");
    EXPECT_TRUE(session.sweeps.is_running());
    run_command(session, "tree.sweep_cancel");
    EXPECT_FALSE(session.sweeps.is_running());
    EXPECT_FALSE(session.sweeps.result());
}

TEST(Sweep, EndsWhereAnotherSceneIsOpened) {
    CrossingFolder folder;
    Session session{true};
    const auto open = [&](const std::filesystem::path& file) {
        session.files.open({file});
        while (session.jobs.job()) session.poll();
    };
    open(folder.scene);
    run_command(session, "tree.sweep");
    EXPECT_TRUE(session.sweeps.is_running());
    open(folder.file("walk.csv"));
    session.poll();
    EXPECT_FALSE(session.sweeps.is_running());
    EXPECT_FALSE(session.sweeps.is_of_scene());
}

TEST(FitCommand, SetsSeveralOptionsAsOneEdit) {
    SweepWindow w;
    run_command(w.session, "tree.fit", "moving,leaf=20");
    EXPECT_EQ(w.fit().tree, mobb::TreeKind::moving);
    EXPECT_EQ(w.fit().leaf, 20);
    EXPECT_EQ(w.edits(), 1u);
    EXPECT_THROW(run_command(w.session, "tree.fit", "moving,leaf=0"), std::invalid_argument);
    EXPECT_EQ(w.edits(), 1u);
}

}  // namespace
}  // namespace mobbscope::app
