// Copies of what is modified: kept, removed, and opened again by the next window.
#include <app/session/recovery.h>
#include <scene/scene_edits.h>
#include <support/processes.h>

#include "app/crossing_folder.h"

#include <gtest/gtest.h>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

namespace mobbscope::app {
namespace {

/// The files below a folder.
std::vector<std::filesystem::path> files_below(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> out;
    if (!std::filesystem::exists(folder)) return out;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file()) out.push_back(entry.path());
    }
    return out;
}

/// A window of a person, without its picture. It ends as if it were killed.
struct KilledWindow {
    explicit KilledWindow(const std::filesystem::path& copies) { session.recovery.keep_in(copies); }

    void open(const std::filesystem::path& file) {
        session.files.open({file});
        finish();
    }
    void finish() {
        while (session.jobs.job()) session.poll();
    }
    void move(double x) {
        session.workspace.edit({"moving A", ""}, [&](Scene& scene) { place_agent(scene, 0, {{x, 0}, 0, 0}); });
    }
    double x() const { return session.workspace.scene().agents.at(0).placement.translate.x; }
    /// At that time of its clock.
    double poll(double now) { return session.recovery.poll(now); }
    /// Until what is due then is written.
    void keep(double now) {
        poll(now);
        poll(now + Recovery::kPause);
        wait_for_copy(now + Recovery::kPause);
    }
    void wait_for_copy(double now) {
        // It is written beside the window.
        EXPECT_TRUE(comes([&] {
            const double next = poll(now);
            return next == std::numeric_limits<double>::infinity() && !session.recovery.is_writing();
        }));
    }
    std::string said() const { return all_messages(session); }

    Session session{true};
};

/// However it is seen.
std::string scene_text(const KilledWindow& window) {
    Scene scene = window.session.workspace.scene();
    scene.view = {};
    return to_json(scene);
}

struct Recovered : ::testing::Test {
    CrossingFolder folder;
    std::filesystem::path copies = folder.file("state/unsaved");

    std::vector<std::filesystem::path> kept() const { return files_below(copies); }
    /// What the next window offers first.
    static std::string offered(KilledWindow& next) {
        next.session.recovery.look();
        return next.session.recovery.has_left() ? next.session.recovery.left().front().name : "";
    }
};

TEST_F(Recovered, ACopyIsWrittenOnceNothingChangesAndRemovedWhenAllIsSaved) {
    KilledWindow w(copies);
    w.open(folder.scene);
    EXPECT_EQ(w.poll(0), std::numeric_limits<double>::infinity()) << "nothing is modified";
    w.move(4);
    EXPECT_EQ(w.poll(1), Recovery::kPause);
    w.move(5);
    EXPECT_EQ(w.poll(2), Recovery::kPause) << "from the last change on";
    w.poll(3.9);
    EXPECT_TRUE(kept().empty());
    w.poll(4);
    w.wait_for_copy(4);
    ASSERT_EQ(kept().size(), 1u);
    EXPECT_NE(slurp(kept()[0]).find("\"translate\": [5, 0]"), std::string::npos) << slurp(kept()[0]);
    EXPECT_EQ(std::filesystem::status(kept()[0].parent_path()).permissions(), std::filesystem::perms::owner_all);
    w.session.files.save();
    w.poll(5);
    EXPECT_TRUE(kept().empty());
    w.move(6);
    w.keep(6);
    EXPECT_EQ(kept().size(), 1u);
    w.session.edits.undo();
    w.poll(9);
    EXPECT_TRUE(kept().empty()) << "undo leads back to what is saved";
    w.move(7);
    w.keep(10);
    w.session.recovery.discard_own();
    EXPECT_TRUE(kept().empty()) << "the window was closed, and its changes discarded";
}

TEST_F(Recovered, SteadyChangesAreKeptAfterAWhileAndLookingAroundOnceItEnds) {
    KilledWindow w(copies);
    w.open(folder.scene);
    double now = 0;
    for (; now < Recovery::kLongest; ++now) {
        w.move(1 + now);
        w.poll(now);
        ASSERT_TRUE(kept().empty()) << now;
    }
    w.move(99);
    w.poll(now);
    EXPECT_TRUE(comes([&] { return !kept().empty(); }));
    w.wait_for_copy(now + 3);
    const std::string before = slurp(kept()[0]);
    for (int i = 0; i < 30; ++i) {
        w.session.workspace.change_view([&](ViewState& view) { view.time = 0.01 * i; });
        w.poll(++now + 3);
    }
    EXPECT_FALSE(w.session.recovery.is_writing());
    EXPECT_EQ(slurp(kept()[0]), before);
    w.keep(now + 10);
    EXPECT_NE(slurp(kept()[0]), before);
}

TEST_F(Recovered, TheNextWindowGoesOnWhereAKilledOneWas) {
    std::string scene;
    ViewState view;
    {
        KilledWindow w(copies);
        w.open(folder.scene);
        w.move(4);
        run_command(w.session, "query.select", "0");
        run_command(w.session, "step.to", "1");
        run_command(w.session, "view.top");
        run_command(w.session, "go.agent", "B");
        run_command(w.session, "view.split");
        w.keep(0);
        scene = scene_text(w);
        view = w.session.workspace.view();
    }
    KilledWindow next(copies);
    const std::string name = offered(next);
    EXPECT_TRUE(name.starts_with("scene.json from ")) << name;
    EXPECT_NE(next.said().find("Unsaved work on scene.json from "), std::string::npos) << next.said();
    const std::vector<MessageOffer> offers = next.session.notifications.all().front().offers;
    ASSERT_EQ(offers.size(), 2u);
    EXPECT_EQ(offers[0].label + ' ' + offers[1].label, "Restore Discard");
    next.open(folder.file("walk.csv"));
    EXPECT_EQ(next.session.notifications.all().front().offers.size(), 2u) << "it is not about what is open";
    run_command(next.session, offers[0].command, offers[0].argument);
    next.finish();
    EXPECT_EQ(scene_text(next), scene);
    EXPECT_EQ(next.session.workspace.view(), view);
    EXPECT_EQ(next.session.workspace.step(), 1);
    EXPECT_EQ(next.session.workspace.selection, (Selection{Selection::Kind::path, {1, -1, 0}, -1}));
    ASSERT_EQ(next.session.views.count(), 2u);
    EXPECT_NE(next.session.views.at(1).fitted->options().tree, next.session.views.at(0).fitted->options().tree);
    EXPECT_TRUE(next.session.workspace.modified());
    EXPECT_FALSE(next.session.recovery.has_left());
    EXPECT_EQ(next.said().find("Unsaved work"), std::string::npos) << "the offer is over: " << next.said();
    next.poll(0);
    ASSERT_EQ(kept().size(), 1u) << "the copy is this window's now";
    // Save writes the file that it was of.
    next.session.files.save();
    EXPECT_NE(slurp(folder.scene).find("\"translate\": [4, 0]"), std::string::npos);
    EXPECT_NE(slurp(folder.scene).find("\"source\": \"walk.csv\""), std::string::npos) << "it leads where it led";
    next.poll(1);
    EXPECT_TRUE(kept().empty());
}

TEST_F(Recovered, WhatHappenedToTheFileMeanwhileIsSaid) {
    {
        KilledWindow w(copies);
        w.open(folder.scene);
        w.move(4);
        w.keep(0);
    }
    const auto time = std::filesystem::last_write_time(folder.scene);
    std::filesystem::last_write_time(folder.scene, time + std::chrono::seconds(5));
    KilledWindow next(copies);
    next.session.recovery.restore(offered(next));
    next.finish();
    EXPECT_NE(refusal(next.session, "file.save").find("another program has written it"), std::string::npos);
}

TEST_F(Recovered, AWindowThatLivesIsNotOffered) {
    KilledWindow w(copies);
    w.open(folder.scene);
    w.move(4);
    w.keep(0);
    KilledWindow other(copies);
    EXPECT_EQ(offered(other), "");
    other.open(folder.scene);
    other.move(5);
    other.keep(0);
    EXPECT_EQ(kept().size(), 2u) << "each has its own";
    EXPECT_EQ(offered(w), "");
}

TEST_F(Recovered, OneOfTwoWindowsTakesIt) {
    {
        KilledWindow w(copies);
        w.open(folder.scene);
        w.move(4);
        w.keep(0);
    }
    KilledWindow one(copies);
    KilledWindow two(copies);
    const std::string name = offered(one);
    EXPECT_EQ(offered(two), name);
    one.session.recovery.restore(name);
    one.finish();
    EXPECT_EQ(one.x(), 4);
    EXPECT_NE(refusal(two.session, "file.recover", name).find("another window has taken it"), std::string::npos);
    EXPECT_FALSE(two.session.recovery.has_left());
    EXPECT_NE(refusal(two.session, "file.recover", name).find("cannot be done now"), std::string::npos);
}

TEST_F(Recovered, WhatIsDiscardedIsGone) {
    for (int i = 0; i < 2; ++i) {
        KilledWindow w(copies);
        w.open(folder.scene);
        w.move(4 + i);
        w.keep(0);
    }
    KilledWindow next(copies);
    const std::string name = offered(next);
    ASSERT_EQ(next.session.recovery.left().size(), 2u);
    EXPECT_EQ(next.session.recovery.left()[1].name, name + " (2)");
    run_command(next.session, "file.discard_unsaved", name);
    EXPECT_EQ(kept().size(), 1u);
    EXPECT_EQ(next.session.recovery.left().size(), 1u);
    run_command(next.session, "file.discard_unsaved", name + " (2)");
    EXPECT_FALSE(next.session.recovery.has_left());
    EXPECT_TRUE(std::filesystem::is_empty(copies));
}

TEST_F(Recovered, WhatCannotBeReadIsKeptAndSaid) {
    std::filesystem::create_directories(copies / "7");
    const std::filesystem::path copy = folder.write("state/unsaved/7/scene.unsaved", "half a l");
    KilledWindow next(copies);
    next.session.recovery.look();
    EXPECT_NE(next.said().find("cannot be read, and is kept"), std::string::npos) << next.said();
    EXPECT_EQ(slurp(copy), "half a l");
    // A source that is gone.
    {
        KilledWindow w(copies);
        w.open(folder.scene);
        w.move(4);
        w.keep(0);
    }
    std::filesystem::rename(folder.file("walk.csv"), folder.file("away.csv"));
    KilledWindow last(copies);
    ASSERT_EQ((offered(last), last.session.recovery.left().size()), 2u);
    const std::string name = last.session.recovery.left()[0].name;
    last.session.recovery.restore(name);
    last.finish();
    EXPECT_NE(last.said().find("walk.csv: no such file"), std::string::npos) << last.said();
    EXPECT_NE(last.said().find("the copy is kept"), std::string::npos) << last.said();
    std::filesystem::rename(folder.file("away.csv"), folder.file("walk.csv"));
    last.session.recovery.restore(name);
    last.finish();
    EXPECT_EQ(last.x(), 4);
}

TEST_F(Recovered, WhereNoCopyCanBeKeptThatIsSaidOnce) {
    KilledWindow w(folder.file("walk.csv") / "unsaved");
    w.open(folder.scene);
    double now = 0;
    for (int i = 0; i < 60; ++i) {
        w.move(4 + i);
        w.poll(now += 2.5);
    }
    EXPECT_NE(w.said().find("No copy of unsaved work can be kept, so save it"), std::string::npos) << w.said();
    w.session.notifications.clear();
    w.move(3);
    w.poll(now += 20);
    w.poll(now += 20);
    EXPECT_EQ(w.said(), "");
}

TEST_F(Recovered, AFullDiskIsSaidOnceAndTheCopyBeforeStays) {
    const pid_t child = ::fork();
    if (child == 0) {
        int wrong = 0;
        {
            KilledWindow w(copies);
            w.open(folder.scene);
            w.move(4);
            w.keep(0);
            ::signal(SIGXFSZ, SIG_IGN);
            const rlimit least{100, RLIM_INFINITY};
            ::setrlimit(RLIMIT_FSIZE, &least);
            w.move(5);
            for (double now = 10; now < 40; now += 0.5) {
                w.poll(now);
                comes([&] { return !w.session.recovery.is_writing() || (w.poll(now), false); });
            }
            const std::vector<Message>& all = w.session.notifications.all();
            const auto count = std::ranges::count_if(
                all, [](const Message& message) { return message.text.find("File too large") != std::string::npos; });
            if (count != 1) wrong += 1;
            // And what is saved by hand is not lost either.
            const std::string before = slurp(folder.scene);
            w.session.queue.push([&] { w.session.files.save(); });
            w.session.queue.run();
            if (w.said().find("scene.json: cannot be written: File too large") == std::string::npos) wrong += 2;
            if (!w.session.workspace.modified() || slurp(folder.scene) != before) wrong += 4;
        }
        ::_exit(wrong);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0) << WEXITSTATUS(status);
    KilledWindow next(copies);
    next.session.recovery.restore(offered(next));
    next.finish();
    EXPECT_EQ(next.x(), 4);
}

TEST_F(Recovered, AnExcerptThatWasEditedAndItsWholeAreBothKept) {
    {
        KilledWindow w(copies);
        w.open(folder.scene);
        w.move(4);
        run_command(w.session, "query.select", "0");
        const auto agents = w.session.workspace.fitted().placed_agents();
        w.session.excerpts.open(agents[0], agents[1]);
        w.move(9);
        w.keep(0);
        w.keep(10);
    }
    ASSERT_EQ(kept().size(), 2u);
    KilledWindow next(copies);
    next.session.recovery.look();
    ASSERT_EQ(next.session.recovery.left().size(), 2u);
    const std::vector<Recovery::Left> left = next.session.recovery.left();
    next.session.recovery.restore(left[0].name);
    next.finish();
    EXPECT_EQ(next.session.workspace.scene().agents.size(), 2u);
    EXPECT_EQ(next.x(), 9);
    EXPECT_FALSE(next.session.workspace.file) << "Save asks where";
    next.session.dialogs.close();
    KilledWindow other(copies);
    other.session.recovery.look();
    EXPECT_EQ(other.session.recovery.left().size(), 1u);
    other.session.recovery.restore(other.session.recovery.left()[0].name);
    other.finish();
    EXPECT_EQ(other.x(), 4);
}

TEST_F(Recovered, WhatWasSuspendedIsKept) {
    KilledWindow w(copies);
    w.open(folder.scene);
    w.move(4);
    w.keep(0);
    const std::string before = slurp(kept().at(0));
    w.session.files.visit(document_of(Scene(w.session.workspace.scene()), nullptr), "a case");
    w.keep(10);
    ASSERT_EQ(kept().size(), 1u);
    w.move(8);
    w.keep(20);
    EXPECT_EQ(kept().size(), 2u) << "and what is visited, if it is edited";
}

TEST_F(Recovered, ANameThatIsNoUtf8IsFoundAgain) {
    const std::filesystem::path odd = folder.file(
        "b\xfc"
        "cher");
    std::filesystem::create_directory(odd);
    std::filesystem::copy(folder.scene, odd / "scene.json");
    std::filesystem::copy(folder.file("walk.csv"), odd / "walk.csv");
    std::filesystem::copy(folder.file("stand.csv"), odd / "stand.csv");
    {
        KilledWindow w(copies);
        w.open(odd / "scene.json");
        w.move(4);
        w.keep(0);
    }
    KilledWindow next(copies);
    next.session.recovery.restore(offered(next));
    next.finish();
    EXPECT_EQ(next.session.workspace.file, odd / "scene.json");
    EXPECT_EQ(next.x(), 4);
}

TEST_F(Recovered, WhatIsNotKeptYetIsKeptAtOnceWhenTheWindowEndsUnasked) {
    {
        KilledWindow w(copies);
        w.open(folder.scene);
        w.move(4);
        w.poll(0);
        w.session.recovery.keep_now();
    }
    KilledWindow next(copies);
    next.session.recovery.restore(offered(next));
    next.finish();
    EXPECT_EQ(next.x(), 4);
}

TEST_F(Recovered, WithoutAFolderNothingIsKept) {
    KilledWindow w("");
    w.open(folder.scene);
    w.move(4);
    EXPECT_EQ(w.poll(0), std::numeric_limits<double>::infinity());
    w.session.recovery.keep_now();
    w.session.recovery.look();
    EXPECT_FALSE(w.session.recovery.has_left());
}

}  // namespace
}  // namespace mobbscope::app
