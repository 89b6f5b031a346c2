// Which tree to ship: a sweep begun in the window, its plot and its list apply fits.
#include <app/window/headless_window.h>
#include <render/gl/gl_context.h>
#include <scene/scene_edits.h>

#include "app/folder_window.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace mobbscope::app {
namespace {

struct SweepWindow : FolderWindow<CrossingFolder> {
    SweepWindow() : FolderWindow({1600, 1400}) { open(folder.scene); }
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
    const SweepResult& result = w.result();
    ASSERT_NE(result.recommended, result.present);
    const mobb::FitOptions best = result.rows[result.recommended].fit;
    EXPECT_LT(result.rows[result.recommended].cost.mean, result.rows[result.present].cost.mean);
    ASSERT_TRUE(w.has("sweep.apply"));
    w.click("sweep.apply");
    EXPECT_EQ(w.fit(), best);
    EXPECT_EQ(w.edits(), 1u);
    EXPECT_TRUE(w.session.sweeps.is_of_scene()) << "another fit asks the same";
    EXPECT_FALSE(find_command("tree.sweep_apply")->enabled(w.session));
    run_command(w.session, "edit.undo");
    EXPECT_EQ(w.fit(), before);
    EXPECT_TRUE(find_command("tree.sweep_apply")->enabled(w.session));
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
