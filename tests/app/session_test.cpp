// Opening, saving, unsaved changes, undo and jobs.
#include <scene/scene_edits.h>

#include "app/crossing_folder.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace mobbscope::app {
namespace {

/// A session that has the scene open, with agent A moved.
struct Edited {
    CrossingFolder folder;
    Session session{false};

    Edited() {
        session.files.open({folder.scene});
        move(4);
    }
    void move(double x) {
        session.workspace.edit({"moving A", "drag A"}, [&](Scene& scene) { place_agent(scene, 0, {{x, 0}, 0, 0}); });
    }
    double x() const { return session.workspace.scene().agents[0].placement.translate.x; }
};

/// A scene whose tightest trees take long.
std::filesystem::path long_walk(const CrossingFolder& folder) {
    std::string text = "t,x,y,r\n";
    for (int i = 0; i < 20'000; ++i) {
        text += std::to_string(i / 30.0) + ',' + std::to_string(std::cos(0.01 * i)) + ',' +
                std::to_string(std::sin(0.013 * i)) + ",0.4\n";
    }
    return folder.write("long.csv", text);
}

// --- undo

TEST(Undo, OneInteractionIsTakenBackAtOnce) {
    Edited e;
    e.move(5);
    e.move(6);
    e.session.edits.undo();
    EXPECT_EQ(e.x(), 0);
    EXPECT_FALSE(e.session.workspace.history.can_undo());
    e.session.edits.redo();
    EXPECT_EQ(e.x(), 6);
}

TEST(Undo, InteractionsThatEndedStandApart) {
    Edited e;
    e.session.workspace.close_group();
    e.move(5);
    e.session.edits.undo();
    EXPECT_EQ(e.x(), 4);
    e.move(7);
    EXPECT_FALSE(e.session.workspace.history.can_redo()) << "what was undone is forgotten by another edit";
    e.session.edits.undo();
    EXPECT_EQ(e.x(), 4) << "an edit after an undo is its own";
}

TEST(Undo, TakesTheEditBackAndKeepsTheView) {
    Edited e;
    run_command(e.session, "tree.leaf", "12");
    run_command(e.session, "view.top");
    run_command(e.session, "view.boxes");
    EXPECT_EQ(e.session.workspace.history.undo_title(), "changing the leaves: 12");
    const ViewState seen = e.session.workspace.view();
    e.session.edits.undo();
    EXPECT_EQ(e.session.workspace.scene().fit.leaf, 4);
    EXPECT_EQ(e.x(), 4);
    EXPECT_EQ(e.session.workspace.view(), seen);
    run_command(e.session, "view.side");
    EXPECT_TRUE(e.session.workspace.history.can_redo()) << "looking around costs no redo";
    e.session.edits.redo();
    EXPECT_EQ(e.session.workspace.scene().fit.leaf, 12);
    EXPECT_EQ(e.session.workspace.view().camera.preset, CameraPreset::side);
}

TEST(Undo, TakesBackWhatTheEditItselfShowed) {
    Edited e;
    const auto edited = [](Scene& scene) {
        scene.fit.leaf = 9;
        scene.view.levels = {3, 3, false};
    };
    e.session.workspace.edit({"both", ""}, edited);
    run_command(e.session, "view.top");
    e.session.edits.undo();
    EXPECT_EQ(e.session.workspace.view().levels, LevelRange{});
    EXPECT_EQ(e.session.workspace.view().camera.preset, CameraPreset::top);
    e.session.edits.redo();
    EXPECT_EQ(e.session.workspace.view().levels.first, 3);
    run_command(e.session, "view.level", "1");
    e.session.edits.undo();
    EXPECT_EQ(e.session.workspace.view().levels.first, 1) << "it was changed again since";
}

TEST(Undo, FindsTheQueryInViewAgainAmongOthers) {
    Edited e;
    Session& session = e.session;
    const auto shown = [&]() -> std::string {
        const std::optional<int> query = session.workspace.view().query;
        if (!query) return "";
        const SceneQuery asked = session.workspace.fitted().queries()[static_cast<std::size_t>(*query)];
        return asked.a.name + asked.b.name;
    };
    run_command(session, "query.select", "0");
    const std::string first = shown();
    run_command(session, "query.remove");
    const std::string next = shown();
    EXPECT_NE(next, first);
    session.edits.undo();
    EXPECT_EQ(shown(), first);
    session.edits.redo();
    EXPECT_EQ(shown(), next);
    run_command(session, "query.select", "1");
    const std::string last = shown();
    session.edits.undo();
    EXPECT_EQ(shown(), last) << "that was opened since";
    EXPECT_EQ(session.workspace.view().query, 2);
    run_command(session, "query.select", "0");
    session.edits.redo();
    EXPECT_EQ(shown(), "") << "nobody asks it there";
}

TEST(Undo, AndRedoLeadBackToTheViewThatWasLeft) {
    Edited e;
    Session& session = e.session;
    e.move(0.5);
    session.workspace.close_group();
    run_command(session, "query.select", "0");
    run_command(session, "step.last");
    run_command(session, "step.back");
    const Step left = session.workspace.view().step;
    session.edits.undo();
    session.edits.redo();
    EXPECT_EQ(session.workspace.view().step, left) << "the trace in between may be shorter";
    session.edits.undo();
    run_command(session, "view.top");
    session.edits.redo();
    EXPECT_EQ(session.workspace.view().camera.preset, CameraPreset::top) << "who looks around goes on from there";
}

TEST(Undo, BringsBackTheSceneThatWasSaved) {
    Edited e;
    e.session.files.save();
    ASSERT_FALSE(e.session.workspace.modified());
    const FittedScene* saved = e.session.workspace.saved.get();
    for (int i = 0; i < 3; ++i) {
        e.session.workspace.close_group();
        e.move(10 + i);
    }
    e.session.edits.go_to_state(0);
    EXPECT_TRUE(e.session.workspace.modified());
    e.session.edits.go_to_state(1);
    EXPECT_FALSE(e.session.workspace.modified());
    EXPECT_EQ(&e.session.workspace.scene(), &saved->scene());
}

TEST(Undo, TakesMemoryForWhatChangedWhateverTheSceneHolds) {
    const auto bytes_of_edits = [](int agents) {
        Scene scene = Edited().session.workspace.scene();
        while (static_cast<int>(scene.agents.size()) < agents) duplicate_agent(scene, 0);
        History history(document_of(std::move(scene), nullptr));
        for (int i = 0; i < 20; ++i) {
            Scene next = history.now().fitted->scene();
            i % 2 == 0 ? place_agent(next, agents / 2, {{i, 0}, 0, 0}) : static_cast<void>(duplicate_agent(next, 0));
            history.change(with_scene(history.now(), std::move(next)), {"edit", ""});
        }
        return history.bytes();
    };
    EXPECT_GT(bytes_of_edits(10), 0u);
    EXPECT_EQ(bytes_of_edits(10), bytes_of_edits(3000));
}

TEST(Undo, LeadsThroughEveryKindOfEditAndBack) {
    Edited e;
    Session& session = e.session;
    std::vector<std::string> states{to_json(session.workspace.scene())};
    const auto done = [&](std::string_view command, const std::string& argument = "") {
        session.workspace.close_group();
        run_command(session, command, argument);
        states.push_back(to_json(session.workspace.scene()));
    };
    run_command(session, "go.agent", "A");
    done("agent.duplicate");
    done("agent.rename", "a long name that is nobody else's");
    done("tree.kind", "umobb");
    done("agent.color", "#123456");
    session.views.split("loose", {.leaf = 9});
    states.push_back(to_json(session.workspace.scene()));
    done("tree.leaf", "7");
    run_command(session, "go.agent", "B");
    done("agent.remove");
    run_command(session, "go.agent", "C");
    done("agent.nudge", "1 2");
    const std::size_t first = session.workspace.history.count() - states.size();
    for (std::size_t i = states.size(); i-- > 0;) {
        session.edits.go_to_state(first + i);
        EXPECT_EQ(to_json(session.workspace.scene()), states[i]) << i;
    }
    for (const std::size_t i : {3u, 7u, 1u, 8u, 0u, 5u}) {
        session.edits.go_to_state(first + i);
        EXPECT_EQ(to_json(session.workspace.scene()), states[i]) << i;
    }
}

TEST(Undo, GoesBackFiveHundredStatesAtMost) {
    Edited e;
    for (int i = 0; i < 600; ++i) {
        e.session.workspace.close_group();
        e.move(10 + i);
    }
    int undone = 0;
    for (; e.session.workspace.history.can_undo(); ++undone) e.session.edits.undo();
    EXPECT_EQ(undone, 499);
    EXPECT_EQ(e.x(), 10 + 599 - 499);
}

TEST(Undo, TakesBackADragWhileItPlaysAtOnce) {
    Edited e;
    e.session.workspace.close_group();
    const std::size_t before = e.session.workspace.history.count();
    run_command(e.session, "time.play");
    for (int i = 0; i < 20; ++i) {
        e.session.playback.advance(0.01);
        e.move(5 + i);
    }
    EXPECT_EQ(e.session.workspace.history.count(), before + 1);
    e.session.edits.undo();
    EXPECT_EQ(e.x(), 4);
    EXPECT_NEAR(*e.session.workspace.view().time, 0.2, 1e-9) << "it stands where it has come to";
}

TEST(Undo, StopsWhatPlays) {
    Edited e;
    for (const char* back : {"edit.undo", "edit.redo", "view.previous", "view.next"}) {
        run_command(e.session, "time.play");
        e.session.playback.advance(0.1);
        if (std::string_view(back) == "view.next") {
            e.session.edits.previous_view();
            run_command(e.session, "time.play");
        }
        run_command(e.session, back);
        EXPECT_FALSE(e.session.playback.playing()) << back;
    }
}

TEST(Undo, ForgetsTheOldestOfWhatTakesTooMuchMemory) {
    CrossingFolder folder;
    Session session(false);
    session.files.open({long_walk(folder)});
    const auto fitted_with = [&](int leaf) {
        Scene scene = session.workspace.scene();
        scene.fit.leaf = leaf;
        const mobb::FitOptions fit = scene.fit;
        return Document{
            std::make_shared<const FittedScene>(std::move(scene), fit, session.workspace.document().fitted.get()),
            session.workspace.view()};
    };
    const Document start = session.workspace.document();
    const std::size_t each = fitted_with(20).fitted->bytes_beyond(start.fitted->fits());
    History history(start, 3 * each);
    for (int i = 0; i < 10; ++i) {
        history.change(fitted_with(20 + i), {"fitting", ""});
        EXPECT_LE(history.bytes(), 3 * each);
    }
    EXPECT_EQ(history.count(), 3u);
    while (history.can_undo()) history.undo();
    EXPECT_GT(history.now().fitted->options().leaf, 24) << "the oldest that is left";
    history.reset(start);
    EXPECT_EQ(history.bytes(), 0u);
}

TEST(Undo, OneDragOfAFitOptionIsOneEdit) {
    Edited e;
    for (const char* scale : {"1.5", "1.6", "1.7"}) run_command(e.session, "tree.time_scale", scale);
    e.session.edits.undo();
    EXPECT_EQ(e.session.workspace.scene().fit.time_scale, 1);
    EXPECT_EQ(e.x(), 4);
}

TEST(Undo, AFailedEditChangesNothing) {
    Edited e;
    const auto before = e.session.workspace.document().fitted;
    EXPECT_THROW(e.session.edits.refit({"leaf", ""}, [](mobb::FitOptions& fit) { fit.leaf = 0; }),
                 std::invalid_argument);
    EXPECT_EQ(e.session.workspace.document().fitted, before);
    EXPECT_TRUE(e.session.workspace.history.can_undo());
}

// --- previous and next view

TEST(PreviousView, TakesBackOneKindOfLookingAtATime) {
    CrossingFolder folder;
    Session session(false);
    session.files.open({folder.scene});
    const Camera camera = session.workspace.view().camera;
    session.workspace.change_view([](ViewState& view) { view.query = 0; });
    session.workspace.change_view([](ViewState& view) { view.step = {Step::Unit::event, 3}; });
    session.workspace.change_view([](ViewState& view) { view.step = {Step::Unit::event, 5}; });
    session.workspace.change_view([](ViewState& view) { view.camera.preset = CameraPreset::top; });
    session.workspace.change_view([](ViewState& view) { view.camera.preset = CameraPreset::side; });
    const ViewState end = session.workspace.view();
    EXPECT_FALSE(session.workspace.history.can_undo()) << "nothing was edited";
    session.edits.previous_view();
    EXPECT_EQ(session.workspace.view().camera, camera);
    EXPECT_EQ(session.workspace.view().step.value, 5) << "the steps are another matter";
    session.edits.previous_view();
    EXPECT_EQ(session.workspace.view().step, Step{});
    EXPECT_EQ(session.workspace.view().query, 0);
    session.edits.previous_view();
    EXPECT_EQ(session.workspace.view().query, std::nullopt);
    EXPECT_FALSE(session.workspace.history.can_look_back());
    session.edits.previous_view();
    for (int i = 0; i < 3; ++i) session.edits.next_view();
    EXPECT_EQ(session.workspace.view(), end);
    EXPECT_FALSE(session.workspace.history.can_look_forward());
    session.edits.next_view();
    session.edits.previous_view();
    run_command(session, "view.front");
    EXPECT_FALSE(session.workspace.history.can_look_forward()) << "another way was taken";
}

TEST(PreviousView, LeavesTheSceneAsItWasEdited) {
    Edited e;
    run_command(e.session, "view.top");
    e.move(7);
    run_command(e.session, "view.side");
    e.session.edits.previous_view();
    EXPECT_EQ(e.session.workspace.view().camera.preset, CameraPreset::top);
    e.session.edits.previous_view();
    EXPECT_EQ(e.session.workspace.view().camera.preset, CameraPreset::iso);
    EXPECT_EQ(e.x(), 7);
}

TEST(PreviousView, FindsItsQueryUnderAnotherIndexOrNot) {
    Edited e;
    Session& session = e.session;
    run_command(session, "go.agent", "A");
    run_command(session, "agent.duplicate");
    const std::size_t queries = session.workspace.fitted().queries().size();
    session.workspace.change_view([&](ViewState& view) { view.query = static_cast<int>(queries) - 1; });
    const SceneQuery shown = session.workspace.fitted().queries()[queries - 1];
    run_command(session, "view.top");
    session.workspace.change_view([](ViewState& view) { view.query.reset(); });
    session.workspace.edit({"removing", ""}, [&](Scene& scene) {
        for (int i = 0; i < static_cast<int>(scene.agents.size()); ++i) {
            if (i == shown.a.agent || i == shown.b.agent) continue;
            return remove_agent(scene, i);
        }
    });
    session.edits.previous_view();
    ASSERT_TRUE(session.workspace.view().query);
    const SceneQuery again =
        session.workspace.fitted().queries()[static_cast<std::size_t>(*session.workspace.view().query)];
    EXPECT_EQ(again.a.name + again.b.name, shown.a.name + shown.b.name);
    session.edits.next_view();
    session.workspace.edit({"removing", ""}, [&](Scene& scene) { remove_agent(scene, again.a.agent); });
    session.edits.previous_view();
    EXPECT_EQ(session.workspace.view().query, std::nullopt) << "nobody asks it any more";
}

TEST(PreviousView, WhatPlaysIsOneLook) {
    Edited e;
    run_command(e.session, "time.at", "0.5");
    e.session.playback.speed = 0;
    run_command(e.session, "view.top");
    run_command(e.session, "time.play");
    for (int i = 0; i < 3; ++i) e.session.playback.advance(0.1);
    EXPECT_EQ(e.session.workspace.history.look_back_title(), "moving the view") << "what stands still is not a look";
    e.session.playback.speed = 1;
    for (int i = 0; i < 20; ++i) e.session.playback.advance(0.01);
    e.session.edits.previous_view();
    EXPECT_EQ(e.session.workspace.view().time, 0.5);
    EXPECT_EQ(e.session.workspace.view().camera.preset, CameraPreset::top);
    e.session.edits.next_view();
    EXPECT_NEAR(*e.session.workspace.view().time, 0.7, 1e-9);
}

TEST(Session, AFileThatIsNotThereAsksNothing) {
    CrossingFolder folder;
    Session session(false);
    session.files.open({folder.scene});
    session.workspace.edit({"moving A", ""}, [](Scene& scene) { place_agent(scene, 0, {{1, 1}, 0, 0}); });
    session.files.open({folder.file("none.csv")});
    EXPECT_EQ(session.dialogs.now, Dialog::none);
    ASSERT_EQ(session.notifications.all().size(), 1u);
    EXPECT_NE(session.notifications.all()[0].text.find("no such file"), std::string::npos);
}

// --- opening

TEST(Opening, ErrorsKeepWhatWasOpen) {
    CrossingFolder folder;
    Session session(false);
    session.files.open({folder.scene});
    const auto before = session.workspace.document().fitted;
    const std::filesystem::path broken = folder.write("broken.json", "{");
    for (const auto& file : {broken, folder.file("none.csv"), folder.file("scene.txt")}) {
        SCOPED_TRACE(file);
        session.files.open({file});
        EXPECT_EQ(session.workspace.document().fitted, before);
        EXPECT_EQ(session.workspace.file, folder.scene);
        ASSERT_FALSE(session.notifications.all().empty());
        EXPECT_EQ(session.notifications.all().back().level, MessageLevel::error);
        EXPECT_NE(session.notifications.all().back().text.find(file.filename().string()), std::string::npos);
        session.files.add({file});
        EXPECT_EQ(session.workspace.document().fitted, before);
    }
}

TEST(Opening, SeveralFilesAndFoldersBecomeOneScene) {
    CrossingFolder folder;
    Session session(false);
    session.files.open({folder.file("walk.csv"), folder.file("stand.csv")});
    EXPECT_EQ(session.workspace.scene().clips.size(), 2u);
    EXPECT_FALSE(session.workspace.file) << "clips have no scene to save to";
    session.files.open({folder.scene.parent_path()});
    EXPECT_EQ(session.workspace.scene().clips.size(), 2u) << "a folder stands for its clips, not for its scenes";
    EXPECT_TRUE(session.workspace.scene().agents.empty());
    session.files.open({folder.file("stand.csv"), folder.scene});
    EXPECT_EQ(session.workspace.scene().clips.size(), 3u);
    EXPECT_EQ(session.workspace.scene().agents.size(), 4u) << "bare clips become agents next to agents";
    EXPECT_EQ(session.workspace.file, folder.scene);
    session.files.open({folder.file("stand.csv"), folder.file("walk.csv")});
    run_command(session, "file.reload");
    EXPECT_EQ(session.workspace.scene().clips.size(), 2u) << "all that was opened is read again";
    EXPECT_EQ(all_messages(session), "");
}

TEST(Opening, OnlyWhatCouldBeOpenedIsRemembered) {
    CrossingFolder folder;
    Session session(true);
    session.files.open({folder.file("none.csv")});
    while (session.jobs.job()) session.poll();
    EXPECT_TRUE(session.settings.recent.empty());
    session.files.open({folder.scene});
    while (session.jobs.job()) session.poll();
    EXPECT_EQ(session.settings.recent, std::vector{folder.scene});
}

TEST(Opening, AllThatWasOpenedBecomesRecent) {
    CrossingFolder folder;
    Session session(true);
    const auto done = [&] {
        while (session.jobs.job()) session.poll();
    };
    session.files.open({folder.file("walk.csv"), folder.file("stand.csv")});
    done();
    EXPECT_EQ(session.settings.recent, (std::vector{folder.file("walk.csv"), folder.file("stand.csv")}));
    session.files.add({folder.scene});
    done();
    EXPECT_EQ(session.settings.recent.front(), folder.scene);
    session.files.save_as(folder.file("mine.json"));
    EXPECT_EQ(session.settings.recent.front(), folder.file("mine.json"));
    EXPECT_EQ(session.settings.folder, folder.scene.parent_path());
}

// --- other programs

/// Another program has written it some time later.
void touch(const std::filesystem::path& file) {
    std::filesystem::last_write_time(file, std::filesystem::last_write_time(file) + std::chrono::seconds(5));
}

TEST(OtherPrograms, WhatTheyDoToFilesIsSaidOnce) {
    Edited e;
    e.session.files.tell_of_changed_files();
    EXPECT_EQ(all_messages(e.session), "");
    touch(e.folder.file("walk.csv"));
    touch(e.folder.scene);
    e.session.files.tell_of_changed_files();
    EXPECT_EQ(all_messages(e.session), e.folder.scene.string() + " was changed by another program (and 1 more file)\n");
    EXPECT_EQ(e.session.notifications.all()[0].offers.at(0).command, "file.reload");
    e.session.notifications.clear();
    e.session.files.tell_of_changed_files();
    EXPECT_EQ(all_messages(e.session), "");
    EXPECT_EQ(e.x(), 4) << "nothing is reloaded unasked";
    EXPECT_NE(refusal(e.session, "file.save").find("another program has written it"), std::string::npos);
}

TEST(OtherPrograms, AFileThatTheyRemoveIsSavedAgainWithAWord) {
    Edited e;
    std::filesystem::remove(e.folder.scene);
    e.session.files.tell_of_changed_files();
    EXPECT_EQ(all_messages(e.session),
              e.folder.scene.string() + " was removed by another program; Save writes it again\n");
    e.session.notifications.clear();
    EXPECT_TRUE(e.session.workspace.modified());
    e.session.files.save();
    EXPECT_EQ(all_messages(e.session), "Saved " + e.folder.scene.string() + ", which another program had removed\n");
    EXPECT_TRUE(std::filesystem::exists(e.folder.scene));
    e.session.notifications.clear();
    e.session.files.tell_of_changed_files();
    e.session.files.save();
    EXPECT_EQ(all_messages(e.session), "Saved " + e.folder.scene.string() + "\n")
        << "what this window wrote is not new";
    std::filesystem::remove_all(e.folder.scene.parent_path());
    EXPECT_NE(refusal(e.session, "file.save").find("cannot be written"), std::string::npos);
}

TEST(OtherPrograms, ASourceThatTheyChangeIsSaidWhenTheSceneIsSaved) {
    Edited e;
    touch(e.folder.file("walk.csv"));
    e.session.files.save();
    EXPECT_EQ(all_messages(e.session), e.folder.file("walk.csv").string() + " was changed by another program\nSaved " +
                                           e.folder.scene.string() + "\n");
}

TEST(Opening, RecentFilesAreOnTheDiskAtOnce) {
    CrossingFolder folder;
    const std::filesystem::path file = folder.file("settings.json");
    Session session(true);
    session.settings_file = SettingsFile(file);
    session.files.open({folder.scene});
    while (session.jobs.job()) session.poll();
    EXPECT_EQ(load_settings(file).recent, std::vector{folder.scene}) << "also if the window is killed now";
    EXPECT_EQ(load_settings(file).folder, folder.scene.parent_path());
}

TEST(Opening, TheLastSessionIsOpenedAgainAsItWasSeen) {
    CrossingFolder folder;
    Settings kept;
    {
        Session session(true);
        EXPECT_FALSE(session.files.has_last());
        session.files.open({folder.scene});
        while (session.jobs.job()) session.poll();
        session.workspace.change_view([](ViewState& view) {
            view.query = 1;
            view.camera.preset = CameraPreset::top;
        });
        session.files.note_session();
        kept = session.settings;
    }
    Session next(true, kept);
    ASSERT_TRUE(next.files.has_last());
    EXPECT_EQ(next.files.last_title(), "scene.json");
    run_command(next, "file.reopen_last");
    while (next.jobs.job()) next.poll();
    EXPECT_EQ(next.workspace.title(), "scene.json");
    EXPECT_EQ(next.workspace.view().query, 1);
    EXPECT_EQ(next.workspace.view().camera.preset, CameraPreset::top);
    EXPECT_EQ(next.workspace.scene().view, ViewState{}) << "the file says nothing of it";
    std::filesystem::remove(folder.scene);
    EXPECT_FALSE(Session(true, kept).files.has_last()) << "what is gone is not offered";
}

TEST(Opening, TheThemeOfThePersonIsThatOfScenesThatSayNone) {
    CrossingFolder folder;
    Session session(true);
    session.files.open({folder.scene});
    while (session.jobs.job()) session.poll();
    session.workspace.change_view([](ViewState& view) { view.theme = Theme::light; });
    session.files.open({folder.file("walk.csv")});
    while (session.jobs.job()) session.poll();
    EXPECT_EQ(session.workspace.view().theme, Theme::light);
    Session script(false, session.settings);
    script.files.open({folder.scene});
    EXPECT_EQ(script.workspace.view().theme, Theme::dark) << "scripts find the same everywhere";
}

TEST(Opening, WhatIsDroppedOnSomethingAsks) {
    CrossingFolder folder;
    Session session(false);
    session.files.drop({folder.file("walk.csv")});
    EXPECT_EQ(session.workspace.title(), "walk") << "nothing was open";
    session.files.drop({folder.file("stand.csv"), folder.scene});
    EXPECT_EQ(session.dialogs.now, Dialog::dropped);
    EXPECT_EQ(session.dialogs.input.files.size(), 2u);
    EXPECT_EQ(session.workspace.title(), "walk");
    session.files.open_demo();
    session.dialogs.close();
    session.files.drop({folder.scene});
    EXPECT_EQ(session.workspace.title(), "scene.json") << "the demo is nobody's";
}

TEST(Opening, AnEmptyFolderIsRefused) {
    CrossingFolder folder;
    Session session(false);
    std::filesystem::create_directory(folder.file("empty"));
    session.files.open({folder.file("empty")});
    EXPECT_NE(all_messages(session).find("there are no clips in this folder"), std::string::npos);
}

// --- saving

TEST(Saving, ElsewhereKeepsTheSourcesAndReadsBackEqual) {
    Edited e;
    run_command(e.session, "view.top");
    std::filesystem::create_directories(e.folder.file("deep/down"));
    const std::filesystem::path there = e.folder.file("deep/down/copy.json");
    e.session.files.save_as(there);
    EXPECT_FALSE(e.session.workspace.modified());
    EXPECT_EQ(e.session.workspace.file, there);
    Session other(false);
    other.files.open({there});
    EXPECT_EQ(all_messages(other), "");
    EXPECT_EQ(to_json(other.workspace.scene(), true), to_json(e.session.workspace.scene(), true));
    EXPECT_EQ(other.workspace.view(), e.session.workspace.view());
    EXPECT_EQ(other.workspace.scene().clips[0].source, "../../walk.csv");
    // And back up again.
    e.session.files.save_as(e.folder.file("again.json"));
    EXPECT_EQ(e.session.workspace.scene().clips[0].source, "walk.csv");
}

TEST(Saving, TheSourceOfAClipIsNotReplaced) {
    Edited e;
    std::filesystem::create_hard_link(e.folder.file("walk.csv"), e.folder.file("same.json"));
    const std::string why = refusal(e.session, "file.save_as", e.folder.file("same.json").string());
    EXPECT_NE(why.find("comes from this file"), std::string::npos) << why;
    EXPECT_TRUE(e.session.workspace.modified());
}

TEST(Saving, WhatCannotBeWrittenStaysUnsaved) {
    Edited e;
    EXPECT_NE(refusal(e.session, "file.save_as", (e.folder.file("none/x.json")).string()), "");
    EXPECT_NE(refusal(e.session, "file.save_as", (e.folder.file("x.csv")).string()).find(".json"), std::string::npos);
    EXPECT_TRUE(e.session.workspace.modified());
    EXPECT_EQ(e.session.workspace.file, e.folder.scene);
    Session empty(false);
    EXPECT_THROW(empty.files.save_as(e.folder.file("x.json")), InputError);
}

TEST(Saving, UndoneChangesAreNoChanges) {
    Edited e;
    EXPECT_TRUE(e.session.workspace.modified());
    e.session.edits.undo();
    EXPECT_FALSE(e.session.workspace.modified());
    e.session.edits.redo();
    e.session.files.save();
    EXPECT_FALSE(e.session.workspace.modified());
    e.session.edits.undo();
    EXPECT_TRUE(e.session.workspace.modified()) << "the file has the later state";
}

// --- unsaved changes

TEST(Unsaved, DiscardGoesOn) {
    Edited e;
    run_command(e.session, "file.open", e.folder.file("walk.csv").string());
    EXPECT_EQ(e.session.dialogs.now, Dialog::unsaved);
    EXPECT_EQ(e.x(), 4) << "nothing happens before the answer";
    e.session.files.answer_unsaved(Files::Unsaved::discard);
    EXPECT_EQ(e.session.dialogs.now, Dialog::none);
    EXPECT_EQ(e.session.workspace.title(), "walk");
    EXPECT_EQ(load_scene(e.folder.scene).agents[0].placement.translate.x, 0);
}

TEST(Unsaved, CancelForgetsWhatWaited) {
    Edited e;
    run_command(e.session, "file.quit");
    e.session.files.answer_unsaved(Files::Unsaved::cancel);
    EXPECT_EQ(e.session.dialogs.now, Dialog::none);
    EXPECT_EQ(e.x(), 4);
    e.session.files.save();
    EXPECT_FALSE(e.session.files.closed()) << "a later save does not quit";
}

TEST(Unsaved, SaveWritesAndGoesOn) {
    Edited e;
    run_command(e.session, "file.quit");
    e.session.files.answer_unsaved(Files::Unsaved::save);
    EXPECT_TRUE(e.session.files.closed());
    EXPECT_EQ(e.session.dialogs.now, Dialog::none);
    EXPECT_EQ(load_scene(e.folder.scene).agents[0].placement.translate.x, 4);
}

TEST(Unsaved, SaveWithoutAFileAsksForItAndGoesOnWhenItIsGiven) {
    CrossingFolder folder;
    Session session(false);
    session.files.open({folder.file("walk.csv"), folder.file("stand.csv")});
    run_command(session, "go.agent", "walk");
    run_command(session, "agent.nudge", "1 0");
    run_command(session, "file.quit");
    session.files.answer_unsaved(Files::Unsaved::save);
    EXPECT_EQ(session.dialogs.now, Dialog::save_as);
    EXPECT_FALSE(session.files.closed());
    // A name that cannot be had does not end it.
    EXPECT_THROW(session.files.save_as(folder.file("none/x.json")), std::exception);
    EXPECT_EQ(session.dialogs.now, Dialog::save_as);
    EXPECT_FALSE(session.files.closed());
    session.files.save_as(folder.file("saved.json"));
    EXPECT_TRUE(session.files.closed());
    EXPECT_EQ(session.dialogs.now, Dialog::none);
}

TEST(Unsaved, ANameThatIsNotGivenForgetsWhatWaited) {
    CrossingFolder folder;
    Session session(false);
    session.files.open({folder.file("walk.csv")});
    run_command(session, "go.agent", "walk");
    run_command(session, "agent.nudge", "1 0");
    run_command(session, "file.quit");
    session.files.answer_unsaved(Files::Unsaved::save);
    session.dialogs.close();
    session.files.save_as(folder.file("saved.json"));
    EXPECT_FALSE(session.files.closed());
}

TEST(Unsaved, ASaveThatFailsAsksOn) {
    CrossingFolder folder;
    Session session(false);
    std::filesystem::create_directory(folder.file("sub"));
    std::filesystem::rename(folder.scene, folder.file("sub/scene.json"));
    std::filesystem::copy(folder.file("walk.csv"), folder.file("sub/walk.csv"));
    std::filesystem::copy(folder.file("stand.csv"), folder.file("sub/stand.csv"));
    session.files.open({folder.file("sub/scene.json")});
    run_command(session, "go.agent", "A");
    run_command(session, "agent.nudge", "1 0");
    std::filesystem::remove_all(folder.file("sub"));
    run_command(session, "file.quit");
    EXPECT_THROW(session.files.answer_unsaved(Files::Unsaved::save), MachineError);
    EXPECT_EQ(session.dialogs.now, Dialog::unsaved);
    EXPECT_FALSE(session.files.closed());
    session.files.answer_unsaved(Files::Unsaved::discard);
    EXPECT_TRUE(session.files.closed());
}

// --- views

TEST(Views, AreOfOneSceneWithAFitEach) {
    CrossingFolder folder;
    Session session(false);
    session.files.open({folder.scene});
    run_command(session, "tree.kind", "mobb");
    session.files.answer_unsaved(Files::Unsaved::discard);
    mobb::FitOptions tilted = session.workspace.fitted().options();
    tilted.tree = mobb::TreeKind::umobb;
    session.views.split("UMOBB", tilted);
    ASSERT_EQ(session.views.count(), 2u);
    EXPECT_EQ(session.views.active(), 0u);
    EXPECT_EQ(session.views.at(0).fitted->options().tree, mobb::TreeKind::mobb);
    EXPECT_EQ(session.views.at(1).fitted->options().tree, mobb::TreeKind::umobb);
    EXPECT_EQ(&session.views.at(1).fitted->scene(), &session.workspace.scene());

    // All that is linked is shared.
    session.workspace.change_view([](ViewState& view) {
        view.time = 0.5;
        view.camera.yaw_deg = 12;
        view.disks = false;
    });
    EXPECT_EQ(session.views.at(1).view.time, 0.5);
    EXPECT_EQ(session.views.at(1).view.camera.yaw_deg, 12);
    EXPECT_FALSE(session.views.at(1).view.disks);
    session.views.link(&ViewLinks::camera, false);
    session.views.link(&ViewLinks::level, false);
    session.workspace.change_view([](ViewState& view) {
        view.camera.yaw_deg = 40;
        view.disks = true;
    });
    EXPECT_EQ(session.views.at(1).view.camera.yaw_deg, 12);
    EXPECT_FALSE(session.views.at(1).view.disks);

    // Commands are about the active view; edits of the scene reach all.
    session.views.activate(1);
    EXPECT_EQ(session.views.active(), 1u);
    EXPECT_EQ(session.workspace.fitted().options().tree, mobb::TreeKind::umobb);
    EXPECT_EQ(session.workspace.view().camera.yaw_deg, 12);
    run_command(session, "tree.leaf", "7");
    EXPECT_EQ(session.views.at(1).fitted->options().leaf, 7);
    EXPECT_EQ(session.views.at(0).fitted->options().leaf, 4);
    EXPECT_EQ(session.workspace.scene().fit.leaf, 4) << "the scene's own fit is the first";
    run_command(session, "go.agent", "A");
    run_command(session, "agent.nudge", "1 0");
    EXPECT_EQ(session.views.at(0).fitted->scene().agents.front().placement.translate.x, 1);
    EXPECT_EQ(&session.views.at(0).fitted->tree(0), &session.workspace.fitted().using_fit(0).tree(0));
    session.edits.undo();
    EXPECT_EQ(session.views.at(0).fitted->scene().agents.front().placement.translate.x, 0);

    session.views.close_others();
    EXPECT_EQ(session.views.count(), 1u);
    EXPECT_EQ(session.workspace.fitted().options().tree, mobb::TreeKind::umobb);
    session.edits.undo();
    EXPECT_EQ(session.views.count(), 2u);
}

TEST(Views, StandWhereTheyStandWhicheverIsActive) {
    CrossingFolder folder;
    Session session(false);
    session.files.open({folder.scene});
    for (const char* name : {"second", "third"}) session.views.split(name, {.leaf = name[0] == 's' ? 2 : 3});
    const auto leaves = [&] {
        std::vector<int> out;
        for (std::size_t place = 0; place < session.views.count(); ++place)
            out.push_back(session.views.at(place).fitted->options().leaf);
        return out;
    };
    const std::vector<int> as_split{4, 2, 3};
    EXPECT_EQ(leaves(), as_split);
    for (const std::size_t place : {2u, 0u, 1u, 2u, 1u, 0u, 9u}) {
        session.views.activate(place);
        EXPECT_EQ(leaves(), as_split) << place;
        EXPECT_EQ(session.workspace.fitted().options().leaf, as_split[session.views.active()]);
    }
}

TEST(Views, WhatIsSavedIsTheActiveOne) {
    CrossingFolder folder;
    Session session(false);
    session.files.open({folder.scene});
    session.views.split("fine", {.leaf = 2});
    EXPECT_FALSE(session.workspace.modified()) << "a view more is not a change of the scene";
    session.crowds.find_conflicts();
    ASSERT_NE(session.crowds.conflicts(), nullptr);
    session.views.activate(1);
    EXPECT_NE(session.crowds.conflicts(), nullptr) << "they are the scene's, whatever the fit";
    session.views.activate(0);
    session.views.activate(1);
    session.files.save_as(folder.file("saved.json"));
    EXPECT_EQ(session.views.count(), 2u);
    EXPECT_FALSE(session.workspace.modified());
    EXPECT_EQ(load_scene(folder.file("saved.json")).fit.leaf, 2);
}

// --- jobs

TEST(Excerpts, OfAnAgentAgainstItselfHaveItTwice) {
    CrossingFolder folder;
    Session session(false);
    session.files.open({folder.scene});
    const PlacedAgent who = session.workspace.fitted().placed_agents()[0];
    session.excerpts.open(who, who);
    const Scene& scene = session.workspace.scene();
    ASSERT_EQ(scene.clips.size(), 1u);
    ASSERT_EQ(scene.agents.size(), 2u);
    EXPECT_EQ(scene.agents[0].name, "A");
    EXPECT_EQ(scene.agents[1].name, "A (2)");
    ASSERT_TRUE(session.workspace.recorded());
    EXPECT_TRUE(session.workspace.recorded()->contact);
}

TEST(Jobs, ACancelledFitLeavesTheDocument) {
    CrossingFolder folder;
    Session opened(true);
    opened.options.patience = {};
    opened.files.open({long_walk(folder)});
    while (opened.jobs.job()) opened.poll();
    const auto before = opened.workspace.document().fitted;
    run_command(opened, "tree.axes", "minarea");
    ASSERT_TRUE(opened.jobs.job()) << "a window does not wait for it";
    EXPECT_EQ(opened.jobs.job()->title(), "Fitting trees");
    opened.jobs.cancel(0);
    EXPECT_FALSE(opened.jobs.job());
    EXPECT_EQ(opened.workspace.document().fitted, before);
    EXPECT_NE(all_messages(opened).find("Cancelled"), std::string::npos);
    run_command(opened, "tree.leaf", "5");
    while (opened.jobs.job()) opened.poll();
    EXPECT_EQ(opened.workspace.scene().fit.leaf, 5);
    EXPECT_EQ(opened.workspace.scene().fit.axes, mobb::Axes::endpoints);
}

/// A long walk against itself as an excerpt, with a fit under way.
void fit_in_excerpt(Session& session, CrossingFolder& folder) {
    session.files.open({long_walk(folder)});
    while (session.jobs.job()) session.poll();
    const PlacedAgent who = session.workspace.fitted().placed_agents().front();
    session.excerpts.open(who, who);
    run_command(session, "tree.axes", "minarea");
}

TEST(Jobs, EditsGoOnMeanwhileAndAreKept) {
    CrossingFolder folder;
    Session session(true);
    session.options.patience = {};
    session.files.open({long_walk(folder), folder.file("walk.csv")});
    while (session.jobs.job()) session.poll();
    run_command(session, "tree.axes", "minarea");
    ASSERT_EQ(session.jobs.count(), 1u);
    run_command(session, "go.agent", "walk");
    run_command(session, "agent.nudge", "1 0");
    session.workspace.change_view([](ViewState& view) { view.disks = false; });
    EXPECT_EQ(session.workspace.scene().agents.back().placement.translate.x, 1) << "at once";
    ASSERT_EQ(session.jobs.count(), 1u);
    while (session.jobs.job()) session.poll();
    EXPECT_EQ(session.workspace.scene().fit.axes, mobb::Axes::minarea);
    EXPECT_EQ(session.workspace.fitted().options().axes, mobb::Axes::minarea);
    EXPECT_EQ(session.workspace.scene().agents.back().placement.translate.x, 1);
    EXPECT_FALSE(session.workspace.view().disks);
    session.edits.undo();
    EXPECT_EQ(session.workspace.scene().fit.axes, mobb::Axes::endpoints);
    EXPECT_EQ(session.workspace.scene().agents.back().placement.translate.x, 1);
}

TEST(Jobs, UndoOutOfAnExcerptEndsThem) {
    CrossingFolder folder;
    Session session(true);
    session.options.patience = {};
    fit_in_excerpt(session, folder);
    ASSERT_TRUE(session.jobs.job());
    session.edits.undo();
    EXPECT_FALSE(session.workspace.in_excerpt());
    EXPECT_FALSE(session.jobs.job());
    EXPECT_EQ(session.workspace.fitted().options().axes, mobb::Axes::endpoints) << "it was meant for the excerpt";
}

TEST(Jobs, SeveralRunAtOnceAndEachIsTakenIn) {
    CrossingFolder folder;
    Session session(true);
    session.options.patience = {};
    session.files.open({long_walk(folder)});
    while (session.jobs.job()) session.poll();
    run_command(session, "tree.axes", "minarea");
    run_command(session, "tree.leaf", "3");
    run_command(session, "tree.kind", "umobb");
    EXPECT_GE(session.jobs.count(), 1u);
    while (session.jobs.job()) session.poll();
    EXPECT_EQ(session.workspace.fitted().options().axes, mobb::Axes::minarea);
    EXPECT_EQ(session.workspace.fitted().options().leaf, 3);
    EXPECT_EQ(session.workspace.fitted().options().tree, mobb::TreeKind::umobb);
    EXPECT_EQ(session.workspace.scene().fit, session.workspace.fitted().options());
}

TEST(Jobs, WhatIsOpenedAsksForEditsThatWereMadeMeanwhile) {
    CrossingFolder folder;
    Session session(true);
    session.options.patience = {};
    session.files.open({folder.scene});
    while (session.jobs.job()) session.poll();
    long_walk(folder);
    session.files.open(std::vector(20, folder.file("long.csv")));
    ASSERT_TRUE(session.jobs.job()) << "a window does not wait for it";
    run_command(session, "go.agent", "A");
    run_command(session, "agent.nudge", "1 0");
    while (session.jobs.job()) session.poll();
    EXPECT_EQ(session.dialogs.now, Dialog::unsaved);
    EXPECT_EQ(session.workspace.scene().agents.front().placement.translate.x, 1);
    session.files.answer_unsaved(Files::Unsaved::discard);
    EXPECT_NE(session.workspace.scene().clips.front().name.find("long"), std::string::npos);
}

TEST(Jobs, ADroppedOneWakesNobodyAndIsCountedUntilItEnds) {
    std::atomic<bool> may_end = false;
    std::atomic<int> woken = 0;
    {
        const Job job(
            "waiting",
            [&](JobControl&) -> Job::Finish {
                while (!may_end) std::this_thread::yield();
                return nullptr;
            },
            [&] { ++woken; });
        EXPECT_FALSE(job.done());
    }
    EXPECT_TRUE(Job::any_left());
    may_end = true;
    while (Job::any_left()) std::this_thread::yield();
    EXPECT_EQ(woken, 0);
}

TEST(Jobs, WhatPlaysGoesOn) {
    CrossingFolder folder;
    Session session(true);
    session.options.patience = {};
    session.files.open({long_walk(folder)});
    while (session.jobs.job()) session.poll();
    run_command(session, "time.play");
    run_command(session, "tree.axes", "minarea");
    ASSERT_TRUE(session.jobs.job());
    session.playback.advance(0.1);
    const std::optional<double> time = session.workspace.view().time;
    ASSERT_TRUE(time);
    while (session.jobs.job()) session.poll();
    EXPECT_EQ(session.workspace.view().time, time) << "a job does not set it back";
}

TEST(Jobs, TheDocumentIsNotLeftForAnExcerptMeanwhile) {
    CrossingFolder folder;
    Session session(true);
    session.options.patience = {};
    fit_in_excerpt(session, folder);
    ASSERT_TRUE(session.jobs.job());
    const auto before = session.workspace.document().fitted;
    const PlacedAgent who = session.workspace.fitted().placed_agents().front();
    EXPECT_THROW(session.excerpts.open(who, who), std::invalid_argument);
    EXPECT_THROW(session.excerpts.leave(), std::invalid_argument);
    EXPECT_EQ(session.workspace.document().fitted, before);
}

TEST(Jobs, UnattendedTheyAreWaitedFor) {
    CrossingFolder folder;
    Session session(false);
    session.files.open({long_walk(folder)});
    EXPECT_FALSE(session.jobs.job());
    EXPECT_EQ(session.workspace.scene().clips.size(), 1u);
}

// --- messages

TEST(Messages, AreFiftyAtMostAndSaidOnce) {
    Session session(false);
    for (int i = 0; i < 62; ++i) session.notifications.tell(MessageLevel::info, std::to_string(i % 60));
    ASSERT_EQ(session.notifications.all().size(), 50u);
    EXPECT_EQ(session.notifications.all().back().text, "1");
    session.notifications.dismiss(49);
    EXPECT_EQ(session.notifications.all().back().text, "0");
    session.notifications.dismiss(170);
    EXPECT_EQ(session.notifications.all().size(), 49u);
}

TEST(Messages, OfTheLastDocumentGoBehindTheBell) {
    CrossingFolder folder;
    Session session(false);
    session.files.open({folder.file("none.csv")});
    EXPECT_TRUE(session.notifications.all().front().up);
    session.files.open({folder.scene});
    EXPECT_FALSE(session.notifications.all().front().up);
    EXPECT_EQ(session.notifications.unread(), 0u) << "the bell is about what is open";
    EXPECT_EQ(session.notifications.all().size(), 1u) << "but it can still be read";
}

/// Each press of a button remembers the past, in case the drag is cancelled.
TEST(History, ACopyHasTheSameStatesAndIsItsOwn) {
    Edited e;
    Session& session = e.session;
    session.workspace.change_view([](ViewState& view) { view.floor = !view.floor; });
    History copy = session.workspace.history;
    EXPECT_EQ(&copy.now(), &session.workspace.history.now()) << "no state is copied";
    const bool floor = session.workspace.view().floor;
    copy.look_back();
    copy.undo();
    copy.amend_views([](ViewState& view) { view.labels = !view.labels; });
    EXPECT_EQ(copy.now().view.floor, !floor);
    EXPECT_EQ(session.workspace.view().floor, floor);
    EXPECT_EQ(e.x(), 4);
    session.edits.undo();
    EXPECT_EQ(e.x(), 0);
    EXPECT_NE(session.workspace.view().labels, copy.now().view.labels);
}

}  // namespace
}  // namespace mobbscope::app
