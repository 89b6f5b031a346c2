// The workspace that a visit suspends, and what undo, a reload and a job must leave as it is.
#include <app/document/shown_agents.h>
#include <app/window/headless_window.h>
#include <base/error.h>
#include <render/gl/gl_context.h>
#include <review/review_screen.h>
#include <scene/scene_edits.h>

#include "app/crossing_folder.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <string>

namespace mobbscope::app {
namespace {

namespace fs = std::filesystem;

/// The crossing scene in a window, and a picture test of it that an earlier run has drawn nothing of.
struct SuspendedWorld {
    CrossingFolder folder;
    Session session{false};
    ReviewScreen& reviews = add_review(session);
    HeadlessWindow window{GlContext::open(Backend::automatic), session, PictureSize{1024, 700}, 1};

    SuspendedWorld() {
        fs::create_directories(folder.file("cases"));
        fs::create_directories(folder.file("drawn"));
        folder.write("drawn/report.json", R"({"mobbscope_report": 1, "cases": []})");
        folder.write("cases/one.case.json", R"({"mobbscope_case": 1, "scene": "../scene.json", "size": "160x120"})");
        session.files.open({folder.scene});
        window.settle();
    }
    void review() {
        reviews.open(folder.file("cases"), folder.file("drawn"));
        window.settle();
    }
    void open_case() {
        review();
        reviews.open_case(0);
        window.settle();
    }
    void leave() {
        reviews.leave();
        window.settle();
    }
    void resize(PictureSize size) {
        window.resize(size);
        window.settle();
    }
    void nudge() {
        run_command(session, "go.agent", "A");
        run_command(session, "agent.nudge", "1 0");
        window.settle();
    }
    /// Pixels that a metre takes at the camera's target, up to a factor.
    double pixels_a_metre() const {
        return session.views.picture->size.height / session.workspace.view().camera.distance;
    }
};

constexpr PictureSize kSmaller{800, 560};

// --- cameras

TEST(Suspended, AResizeKeepsTheScaleOfWhatAnExcerptWasTakenFrom) {
    SuspendedWorld w;
    run_command(w.session, "view.zoom", "1.5");
    const double before = w.pixels_a_metre();
    const auto& agents = w.session.workspace.fitted().placed_agents();
    w.session.excerpts.open(agents[0], agents[1]);
    w.window.settle();
    w.resize(kSmaller);
    w.session.excerpts.leave();
    w.window.settle();
    EXPECT_NEAR(w.pixels_a_metre(), before, 1e-9 * before);
    w.session.edits.undo();
    w.session.edits.undo();
    w.window.settle();
    EXPECT_FALSE(w.session.workspace.in_excerpt());
    EXPECT_NEAR(w.pixels_a_metre(), before, 1e-9 * before);
}

TEST(Suspended, AResizeKeepsTheScaleOfWhatIsOpenBesideACase) {
    for (const bool shown : {true, false}) {
        SuspendedWorld w;
        run_command(w.session, "view.zoom", "1.5");
        const double before = w.pixels_a_metre();
        w.review();
        // With the case's scene in the picture, or with no picture at all.
        if (!shown) w.resize(kSmaller);
        w.reviews.open_case(0);
        w.window.settle();
        if (shown) w.resize(kSmaller);
        w.leave();
        ASSERT_FALSE(w.reviews.shown());
        EXPECT_NEAR(w.pixels_a_metre(), before, 1e-9 * before) << shown;
    }
}

TEST(Suspended, EachOpeningHasANumberAndComingBackFindsIt) {
    SuspendedWorld w;
    const int file = w.session.workspace.document().opening;
    const auto& agents = w.session.workspace.fitted().placed_agents();
    w.session.excerpts.open(agents[0], agents[1]);
    const int excerpt = w.session.workspace.document().opening;
    EXPECT_NE(excerpt, file) << "the first file is not the first excerpt";
    w.session.edits.undo();
    EXPECT_EQ(w.session.workspace.document().opening, file);
    w.session.edits.redo();
    EXPECT_EQ(w.session.workspace.document().opening, excerpt);
    w.session.excerpts.leave();
    EXPECT_EQ(w.session.workspace.document().opening, file);
    w.open_case();
    EXPECT_NE(w.session.workspace.document().opening, file);
    EXPECT_NE(w.session.workspace.document().opening, excerpt);
    w.leave();
    EXPECT_EQ(w.session.workspace.document().opening, file);
}

TEST(Suspended, UndoWithinAnExcerptThatWasSavedCancelsNothing) {
    SuspendedWorld w;
    const auto& agents = w.session.workspace.fitted().placed_agents();
    w.session.excerpts.open(agents[0], agents[1]);
    w.nudge();
    run_command(w.session, "view.moment");
    w.window.settle();
    run_command(w.session, "view.moment");
    w.session.files.save_as(w.folder.file("two.json"));
    ASSERT_FALSE(w.session.workspace.other_cameras.empty());
    w.session.edits.undo();
    EXPECT_FALSE(w.session.workspace.other_cameras.empty()) << "it is the same excerpt";
}

// --- a case's scene

TEST(Suspended, LeavingACaseBringsBackWhatWasOpenAndSaysNothingTwice) {
    SuspendedWorld w;
    w.folder.write("big.csv", "t,x,y,r\n0,0,0,0.3\n0.5,1,0,0.3\n1.3,2,0,0.3\n");
    w.folder.write("warned.json", R"({"clips": {"big": {"source": "big.csv"}}})");
    w.session.files.open({w.folder.file("warned.json")});
    w.window.settle();
    ASSERT_NE(all_messages(w.session).find("big: "), std::string::npos);
    const std::vector<fs::path> recent = w.session.settings.recent;
    w.session.workspace.filter = "bi";
    run_command(w.session, "go.agent", "big");
    const Selection selected = w.session.workspace.selection;
    w.open_case();
    EXPECT_EQ(w.session.workspace.filter, "");
    w.session.settings.folder = "elsewhere";
    w.session.notifications.clear();
    w.leave();
    EXPECT_EQ(all_messages(w.session), "");
    EXPECT_EQ(w.session.settings.recent, recent);
    EXPECT_EQ(w.session.settings.folder, "elsewhere") << "nothing was opened";
    EXPECT_EQ(w.session.workspace.filter, "bi");
    EXPECT_EQ(w.session.workspace.selection, selected);
}

/// 20,000 samples: their tightest boxes take long.
std::string long_csv() {
    std::string text = "t,x,y,r\n";
    for (int i = 0; i < 20'000; ++i) {
        text += std::to_string(i / 30.0) + ',' + std::to_string(std::cos(0.01 * i)) + ',' +
                std::to_string(std::sin(0.013 * i)) + ",0.4\n";
    }
    return text;
}

void wait_for_jobs(Session& session) {
    while (session.jobs.job()) session.poll();
}

TEST(Suspended, JobsOfASuspendedWorkspaceAreTakenInOnceItIsBack) {
    CrossingFolder folder;
    Session session(true);
    ReviewScreen& reviews = add_review(session);
    session.options.patience = {};
    folder.write("long.csv", long_csv());
    fs::create_directories(folder.file("cases"));
    fs::create_directories(folder.file("drawn"));
    folder.write("drawn/report.json", R"({"mobbscope_report": 1, "cases": []})");
    folder.write("cases/one.case.json", R"({"mobbscope_case": 1, "scene": "../scene.json", "size": "160x120"})");
    session.files.open({folder.file("long.csv")});
    wait_for_jobs(session);
    run_command(session, "tree.axes", "minarea");
    ASSERT_EQ(session.jobs.count(), 1u);
    reviews.open(folder.file("cases"), folder.file("drawn"));
    reviews.open_case(0);
    while (session.files.visited().empty()) session.poll();
    EXPECT_EQ(session.jobs.count(), 0u) << "the case has none";
    run_command(session, "go.agent", "A");
    run_command(session, "agent.rename", "first");
    reviews.leave();
    session.files.answer_unsaved(Files::Unsaved::discard);
    ASSERT_EQ(session.jobs.count(), 1u);
    wait_for_jobs(session);
    EXPECT_EQ(session.workspace.title(), "long");
    EXPECT_EQ(session.workspace.fitted().options().axes, mobb::Axes::minarea);
}

TEST(Suspended, AFileThatCannotBeLoadedLeavesTheCaseOpen) {
    SuspendedWorld w;
    w.open_case();
    w.nudge();
    w.session.files.open({w.folder.write("broken.json", "{")});
    w.window.settle();
    EXPECT_EQ(w.session.files.visited(), "one");
    EXPECT_EQ(w.session.dialogs.now, Dialog::none) << "nobody is asked for nothing";
    EXPECT_TRUE(w.session.workspace.modified());
    w.session.files.open({w.folder.file("walk.csv")});
    EXPECT_EQ(w.session.dialogs.now, Dialog::unsaved) << "the case's scene is lost";
    w.session.files.answer_unsaved(Files::Unsaved::cancel);
    EXPECT_EQ(w.session.files.visited(), "one");
    w.session.files.open({w.folder.file("walk.csv")});
    w.session.files.answer_unsaved(Files::Unsaved::discard);
    EXPECT_EQ(w.session.files.visited(), "");
    EXPECT_EQ(w.session.workspace.title(), "walk");
}

TEST(Suspended, AFileThatTakesThePlaceOfACaseAsksForWhatWasOpenBefore) {
    SuspendedWorld w;
    w.nudge();
    w.open_case();
    w.session.files.open({w.folder.file("walk.csv")});
    EXPECT_EQ(w.session.dialogs.now, Dialog::unsaved);
    EXPECT_EQ(w.session.workspace.title(), "scene.json");
    EXPECT_TRUE(w.session.workspace.modified());
    w.session.files.answer_unsaved(Files::Unsaved::discard);
    EXPECT_EQ(w.session.workspace.title(), "walk");
}

// --- what is dropped

TEST(Suspended, WhatIsDroppedOnPictureTestsIsOpenedOrNot) {
    SuspendedWorld w;
    w.nudge();
    w.review();
    w.session.files.drop({w.folder.file("walk.csv")});
    w.window.settle();
    ASSERT_EQ(w.session.dialogs.now, Dialog::dropped);
    EXPECT_FALSE(w.session.files.may_add());
    const auto& marks = w.window.shell().marks().all();
    EXPECT_FALSE(marks.contains("dropped.add")) << "there is no scene in sight to add to";
    EXPECT_TRUE(marks.contains("dropped.open"));
    w.session.dialogs.close();
    EXPECT_THROW(w.session.files.add({w.folder.file("walk.csv")}), InputError);
    EXPECT_EQ(w.session.workspace.scene().clips.size(), 2u);
}

// --- import warnings

TEST(Suspended, FilesThatAreAddedInAJobSayWhatIsWrongWithThem) {
    CrossingFolder folder;
    // Not uniform in time, so that they are resampled; and so many that a job fits them.
    std::string far = "t,x,y,r\n";
    for (int i = 0; i < 60'000; ++i) {
        far += std::to_string((i + i % 2 * 0.3) / 30.0) + ',' + std::to_string(0.04 * i) + ",0,0.4\n";
    }
    folder.write("far.csv", far);
    for (const bool attended : {false, true}) {
        Session session(attended);
        session.files.open({folder.scene});
        wait_for_jobs(session);
        session.files.add({folder.file("far.csv")});
        wait_for_jobs(session);
        ASSERT_EQ(session.workspace.scene().clips.size(), 3u);
        ASSERT_FALSE(session.workspace.scene().clips.back().facts.warnings.empty());
        EXPECT_NE(all_messages(session).find("far: "), std::string::npos) << attended << all_messages(session);
    }
}

// --- names

TEST(Suspended, AnotherNameIsKnownInAllViewsAndWhereverItIsRemembered) {
    SuspendedWorld w;
    w.session.views.split("UMOBB", {.tree = mobb::TreeKind::umobb, .leaf = 4});
    w.session.views.link(&ViewLinks::camera, false);
    w.session.views.link(&ViewLinks::level, false);
    run_command(w.session, "view.other");
    run_command(w.session, "agents.hide", "C");
    run_command(w.session, "agents.pin", "A");
    run_command(w.session, "view.other");
    run_command(w.session, "agents.solo", "B");
    run_command(w.session, "query.select", "0");
    run_command(w.session, "step.to", "1");
    run_command(w.session, "query.none");
    for (const auto& [from, to] : {std::pair("A", "first"), std::pair("C", "third")}) {
        run_command(w.session, "go.agent", from);
        run_command(w.session, "agent.rename", to);
    }
    const ViewState other = w.session.views.at(1).view;
    EXPECT_EQ(other.hidden, AgentNames{"third"});
    EXPECT_EQ(other.pinned, AgentNames{"first"});
    EXPECT_EQ(w.session.workspace.view().hidden, (AgentNames{"first", "third"}));
    run_command(w.session, "query.select", "0");
    EXPECT_EQ(w.session.workspace.step(), 1) << "where it was left";
    run_command(w.session, "query.none");
    run_command(w.session, "agents.solo", "B");
    EXPECT_TRUE(w.session.workspace.view().hidden.empty()) << "what was in the picture before";
}

// --- steps

struct SteppedWorld : SuspendedWorld {
    SteppedWorld() { run("query.select", "0"); }
    void run(const std::string& id, const std::string& argument = "") {
        run_command(session, id, argument);
        session.workspace.close_group();
    }
    int last() const { return session.workspace.recorded()->trace.size() - 1; }
};

TEST(Suspended, ARenamedAgentLeavesNoStepsUnderItsOldName) {
    SuspendedWorld w;
    run_command(w.session, "query.select", "0");
    run_command(w.session, "step.to", "3");
    run_command(w.session, "go.agent", "A");
    run_command(w.session, "agent.rename", "first");
    for (const auto& [key, steps] : w.session.workspace.document().steps) EXPECT_NE(std::get<0>(key.first), "A");
}

TEST(Saving, AsksOnceMoreWhereAnotherProgramHasWrittenTheFile) {
    SuspendedWorld w;
    w.nudge();
    const std::string theirs = slurp(w.folder.scene) + "\n";
    w.folder.write("scene.json", theirs);
    fs::last_write_time(w.folder.scene, fs::last_write_time(w.folder.scene) + std::chrono::seconds(2));
    EXPECT_THROW(w.session.files.save(), InputError);
    EXPECT_EQ(slurp(w.folder.scene), theirs);
    EXPECT_TRUE(w.session.workspace.modified());
    w.session.files.save();
    EXPECT_FALSE(w.session.workspace.modified());
    w.nudge();
    w.session.files.save();
    EXPECT_FALSE(w.session.workspace.modified()) << "what was saved here is this program's";
}

TEST(Saving, SaysWhichFilesOfClipsAreGone) {
    SuspendedWorld w;
    w.nudge();
    fs::remove(w.folder.file("stand.csv"));
    w.session.files.save();
    EXPECT_NE(all_messages(w.session).find("stand.csv, which is not there any more"), std::string::npos);
}

TEST(Steps, AreRememberedForEachKindOfTrees) {
    SteppedWorld w;
    ASSERT_GT(w.last(), 4);
    w.run("step.to", "2");
    const int of_mobb = w.last();
    w.run("tree.kind", "umobb");
    EXPECT_NEAR(w.session.workspace.step(), 2.0 / of_mobb * w.last(), 1) << "as far on";
    w.run("step.to", "3");
    w.run("tree.kind", "mobb");
    EXPECT_EQ(w.session.workspace.step(), 2);
    w.run("tree.kind", "umobb");
    EXPECT_EQ(w.session.workspace.step(), 3);
    w.run("query.none");
    w.run("tree.kind", "mobb");
    w.run("query.select", "0");
    EXPECT_EQ(w.session.workspace.step(), 2) << "reopened with the other kind";
    w.run("query.none");
    w.run("tree.kind", "umobb");
    w.run("query.select", "0");
    EXPECT_EQ(w.session.workspace.step(), 3);
}

TEST(Steps, OneKeyGoesToAndFroBetweenTwo) {
    SteppedWorld w;
    w.run("step.first");
    for (int i = 0; i < 4; ++i) w.run("step.forward");
    w.run("step.before");
    EXPECT_EQ(w.session.workspace.step(), 0) << "where the run began";
    w.run("step.before");
    EXPECT_EQ(w.session.workspace.step(), 4);
    w.run("step.forward");
    w.run("step.before");
    EXPECT_EQ(w.session.workspace.step(), 4);
    w.run("step.before");
    w.run("step.back");
    EXPECT_EQ(w.session.workspace.step(), 4);
    w.run("step.before");
    EXPECT_EQ(w.session.workspace.step(), 5) << "a run that turned round: what was seen last";
}

TEST(Steps, ADragOverThemIsOneMove) {
    SteppedWorld w;
    w.run("step.to", "1");
    for (const int event : {2, 4, 3, 5}) {
        w.session.workspace.change_view([&](ViewState& view) {
            view.step = {Step::Unit::event, static_cast<double>(event)};
        });
    }
    w.session.workspace.close_group();
    w.run("step.before");
    EXPECT_EQ(w.session.workspace.step(), 1);
    w.run("step.before");
    EXPECT_EQ(w.session.workspace.step(), 5);
}

TEST(Steps, TheKeyFlicksInTheWindow) {
    SteppedWorld w;
    const auto press = [&](Key key, bool shift = false) {
        if (shift) w.window.shell().feed(KeyPress{Key::shift, true});
        w.window.shell().feed(KeyPress{key, true});
        w.window.shell().feed(KeyPress{key, false});
        if (shift) w.window.shell().feed(KeyPress{Key::shift, false});
        w.window.settle();
    };
    press(Key::left, true);
    for (int i = 0; i < 3; ++i) press(Key::right);
    const Camera camera = w.session.workspace.view().camera;
    for (const int step : {0, 3, 0, 3}) {
        press(Key::j);
        EXPECT_EQ(w.session.workspace.step(), step);
        EXPECT_EQ(w.session.workspace.view().camera, camera);
    }
}

TEST(Steps, TheCameraThatFollowsTheTestIsNoLookOfItsOwn) {
    SteppedWorld w;
    w.run("step.first");
    w.run("view.follow_test");
    w.window.settle();
    w.run("view.zoom", "6");
    w.run("view.pan", "900 0");
    w.window.settle();
    const Camera first = w.session.workspace.view().camera;
    w.run("time.at", "0.5");
    w.run("step.last");
    w.window.settle();
    const Camera last = w.session.workspace.view().camera;
    ASSERT_NE(last, first) << "the camera has followed";
    for (int i = 0; i < 2; ++i) {
        w.session.edits.previous_view();
        w.window.settle();
        EXPECT_EQ(w.session.workspace.view().camera, first) << "with the step";
        EXPECT_EQ(w.session.workspace.step(), 0);
        w.session.edits.next_view();
        w.window.settle();
        EXPECT_EQ(w.session.workspace.view().camera, last);
    }
    EXPECT_FALSE(w.session.workspace.history.can_look_forward());
}

// --- the history as a list

/// What the history lists, the newest last.
std::vector<std::string> titles(const Session& session) {
    std::vector<std::string> out;
    for (std::size_t i = 1; i < session.workspace.history.count(); ++i)
        out.push_back(session.workspace.history.title(i));
    return out;
}

struct ListedWorld : SuspendedWorld {
    void press(Key key) {
        window.shell().feed(KeyPress{key, true});
        window.shell().feed(KeyPress{key, false});
        window.settle();
    }
    void click(const std::string& mark) {
        const auto at = window.shell().marks().all().find(mark);
        ASSERT_NE(at, window.shell().marks().all().end()) << mark;
        window.shell().feed(MouseMove{at->second.center()});
        window.shell().feed(MouseButton{0, true});
        window.shell().feed(MouseButton{0, false});
        window.settle();
    }
};

TEST(HistoryList, ANumberThatKeysChangeIsOneEntryWithItsValue) {
    ListedWorld w;
    run_command(w.session, "go.agent", "A");
    w.window.settle();
    const auto step = [&](int tabs, Key key, int times) {
        w.click("agent.name");
        for (int i = 0; i < tabs; ++i) w.press(Key::tab);
        for (int i = 0; i < times; ++i) w.press(key);
    };
    step(1, Key::up, 5);
    step(2, Key::down, 2);
    step(1, Key::up, 1);
    using Titles = std::vector<std::string>;
    EXPECT_EQ(titles(w.session), (Titles{"moving A: x 0.50 m", "moving A: y -0.20 m", "moving A: x 0.60 m"}));
    w.session.edits.undo();
    w.session.edits.undo();
    EXPECT_EQ(w.session.workspace.scene().agents[0].placement.translate, glm::dvec2(0.5, 0));
    w.press(Key::up);
    EXPECT_EQ(titles(w.session), (Titles{"moving A: x 0.50 m", "moving A: x 0.60 m"}))
        << "what was led back to stays as it was";
}

TEST(HistoryList, SaysWhatWasDoneWithItsValue) {
    ListedWorld w;
    const auto run = [&](const std::string& id, const std::string& argument = "") {
        run_command(w.session, id, argument);
        w.session.workspace.close_group();
    };
    run("go.agent", "A");
    run("agent.move", "1 2");
    run("agent.turn", "30");
    run("agent.start", "0.5");
    run("agent.color", "#123456");
    run("agent.rename", "first");
    run("tree.leaf", "7");
    run("view.level", "3");
    run("view.finer");
    run("view.floor");
    run("view.theme", "light");
    run("agents.hide", "C");
    run("agents.hide", "B");
    run("agents.hide", "B");
    run("query.select", "0");
    for (int i = 0; i < 3; ++i) run("step.back");
    run("time.at", "0.5");
    run("view.top");
    run("view.moment");
    const std::string step = std::to_string(w.session.workspace.step());
    EXPECT_EQ(titles(w.session), (std::vector<std::string>{"moving A: x 1.00 m, y 2.00 m", "turning A: 30.0\u00B0",
                                                           "shifting A: starts at 0.50 s", "colouring A: #123456",
                                                           "renaming A to first", "changing the leaves: 7"}))
        << "how it is seen is not an edit";
    std::vector<std::string> looks;
    for (; w.session.workspace.history.can_look_back(); w.session.edits.previous_view()) {
        looks.push_back(w.session.workspace.history.look_back_title());
    }
    EXPECT_EQ(looks,
              (std::vector<std::string>{"showing the moment", "moving the view", "moving in time to 0.50 s",
                                        "stepping to " + step, "showing first against B", "showing B again", "hiding B",
                                        "hiding C", "theme: light", "floor: off", "showing level 4"}));
}

}  // namespace
}  // namespace mobbscope::app
