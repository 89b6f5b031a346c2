// The table as a whole: ids, shortcuts, arguments, what can be done when.
#include "app/crossing_folder.h"

#include <app/commands/picture_order.h>
#include <app/panels/panels.h>
#include <base/text.h>
#include <review/review_screen.h>
#include <support/folders.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace mobbscope::app {
namespace {

std::vector<std::string> words_in(std::string_view text) {
    std::istringstream in{std::string(text)};
    std::vector<std::string> out;
    for (std::string word; in >> word;) out.push_back(word);
    return out;
}

TEST(CommandTable, IdsAreUniqueAndEverythingIsSaid) {
    const std::set<std::string_view> menus{"File", "Edit", "View", "Tree", "Query", "Go", "Review", "Help"};
    std::set<std::string_view> ids;
    for (const Command& command : commands_with_review()) {
        SCOPED_TRACE(command.id);
        EXPECT_TRUE(ids.insert(command.id).second);
        EXPECT_FALSE(command.title.empty());
        EXPECT_TRUE(command.doc.ends_with('.'));
        EXPECT_TRUE(command.run);
        EXPECT_TRUE(command.menu.empty() || menus.contains(command.menu.substr(0, command.menu.find('/'))));
        EXPECT_TRUE(command.choices || !command.chosen);
        EXPECT_TRUE(!command.choices || !command.argument.empty());
        EXPECT_TRUE(command.shortcut.empty() || !command.menu.empty()) << "shortcuts stand in menus";
        EXPECT_TRUE(command.shortcut.empty() || !command.needs_argument()) << "a key gives none";
        EXPECT_EQ(find_command(command.id, commands_with_review()), &command);
    }
}

TEST(CommandTable, EveryChordIsReadAndCallsOneCommand) {
    CrossingFolder folder;
    Session scene(false);
    Session cases(false);
    folder.write("a.case.json", "{}");
    add_review(scene);
    ReviewScreen& reviews = add_review(cases);
    reviews.case_drawer.program = "/bin/false";
    reviews.open(folder.scene.parent_path());
    std::size_t count = 0;
    for (const Session* session : {&scene, &cases}) {
        std::set<std::string> chords;
        for (const Command& command : commands(*session)) {
            if (!belongs_here(*session, command)) continue;
            SCOPED_TRACE(command.id);
            for (const std::string& name : words_in(command.shortcut)) {
                const std::optional<Chord> chord = chord_from_name(name);
                ASSERT_TRUE(chord) << name;
                EXPECT_EQ(command_for(*session, *chord), &command);
                EXPECT_TRUE(chords.insert(to_string(*chord)).second) << name << " is another command's too";
            }
        }
        count += chords.size();
    }
    EXPECT_GT(count, 80u);
    EXPECT_EQ(command_for(scene, {Key::f12}), nullptr);
}

TEST(HelpSheet, SaysOfTheMouseWhatTheDocumentSays) {
    const std::string document = slurp(kSource / "docs/window.md");
    for (const auto& [keys, what] : mouse_help()) {
        std::string row = "| " + std::string(keys) + " | " + what;
        char& first = row[row.size() - std::string_view(what).size()];
        first = static_cast<char>(std::tolower(static_cast<unsigned char>(first)));
        EXPECT_NE(document.find(row), std::string::npos) << row;
    }
}

TEST(CommandTable, DocumentsNameMenuItemsThatThereAre) {
    const std::string document = slurp(kSource / "docs/window.md");
    std::set<std::string> items;
    for (const Command& command : commands_with_review()) {
        std::string_view title = command.title;
        if (title.ends_with("...")) title.remove_suffix(3);
        const std::string menu = std::regex_replace(std::string(command.menu), std::regex("/"), " / ");
        items.insert(menu);
        items.insert(menu + " / " + std::string(title));
    }
    const std::regex named(R"(\*((File|Edit|View|Tree|Query|Go|Help) / [^*]+)\*)");
    int count = 0;
    for (std::sregex_iterator at(document.begin(), document.end(), named), end; at != end; ++at, ++count) {
        std::string item = (*at)[1];
        std::ranges::replace(item, '\n', ' ');
        EXPECT_TRUE(items.contains(item)) << item;
    }
    EXPECT_GT(count, 5);
}

TEST(CommandTable, WhatThereIsNotIsRefusedWithTheNearest) {
    Session session(false);
    EXPECT_EQ(refusal(session, "view.topp"), "there is no command 'view.topp' (did you mean 'view.top'?)");
}

TEST(CommandTable, AnEmptySessionOnlyOpensAndHelps) {
    for (const Command& row : commands_with_review()) {
        SCOPED_TRACE(row.id);
        Session session(false);
        add_review(session);
        const Command& command = command_named(row.id, commands(session));
        const std::string group(command.id.substr(0, command.id.find('.')));
        if (group == "agent" || group == "tree" || group == "query" || group == "step" || group == "edit") {
            EXPECT_FALSE(command.enabled(session));
        }
        // Whatever can be done must not fail for want of a scene.
        if (command.enabled(session) && !command.needs_argument()) {
            EXPECT_NO_THROW(run_command(session, command.id));
        }
    }
    Session session(false);
    EXPECT_EQ(refusal(session, "view.top"), "\"View from above\" cannot be done now");
}

TEST(CommandTable, ArgumentsAreCheckedInOneSentence) {
    CrossingFolder folder;
    Session session(false);
    session.files.open({folder.scene});
    run_command(session, "go.agent", "A");
    run_command(session, "query.select", "0");
    const std::vector<std::array<std::string, 3>> bad{
        {"agent.move", "1", "the place cannot be '1': give two numbers, such as 1.5 -2"},
        {"agent.move", "1 nan", "the place cannot be '1 nan': give two numbers, such as 1.5 -2"},
        {"agent.move", "1e300 0", "translate must be finite and within 1e9 m"},
        {"agent.turn", "north", "the angle cannot be 'north': give a number from -1e+09 to 1e+09"},
        {"agent.color", "red", "the colour cannot be 'red': give one like #E69F00, or none"},
        {"agent.rename", "B", "there is an agent 'B' already"},
        {"agent.rename", " ", "an agent needs a name"},
        {"agent.add", "wolk", "there is no clip 'wolk' (did you mean 'walk'?)"},
        {"tree.kind", "rtree", "the trees cannot be 'rtree': give one of " + listed(mobb::tree_kind_names())},
        {"tree.kind", "production", "`production` is called `blocks`"},
        {"tree.axes", "x", "the axes cannot be 'x': give one of endpoints, covariance, minarea"},
        {"tree.leaf", "0", "the samples of a leaf cannot be '0': give a whole number from 1 to 2147483647"},
        {"view.zoom", "0", "the factor cannot be '0': give a number from 0.001 to 1000"},
        {"view.theme", "blue", "a theme cannot be 'blue': give dark or light"},
        {"view.past", "none", "past tests cannot be 'none': give pair, ancestors, siblings or all"},
        {"query.select", "3", "the query cannot be '3': give a whole number from 0 to 2"},
        {"query.add", "A", "an agent cannot be queried against itself"},
        {"go.node", "A", "the node cannot be 'A': give a name and a number, such as A 12"},
        {"go.node", "Z 1", "there is no agent 'Z' (did you mean 'A'?)"},
        {"go.node", "A 9.0", "the level cannot be '9': give a whole number from 0 to 4"},
        {"go.sample", "A 60", "the sample cannot be '60': give a whole number from 0 to 59"},
        {"agent.move", "", "\"Place agent at\" needs X Y"},
        {"view.top", "now", "\"View from above\" takes nothing, but was given 'now'"},
    };
    const auto before = session.workspace.document().fitted;
    for (const auto& [id, argument, message] : bad) EXPECT_EQ(refusal(session, id, argument), message);
    EXPECT_EQ(session.workspace.document().fitted, before);
}

TEST(CommandTable, NumbersThatNobodyMeansAreRefusedEverywhere) {
    CrossingFolder folder;
    for (const Command& command : commands_with_review()) {
        const bool names_files = command.argument.find("FILE") != std::string_view::npos || command.id == "file.review";
        if (command.argument.empty() || names_files) continue;
        for (const char* text : {"nan", "1e999", "1 2 3 4", "\xff", "-"}) {
            Session session(false);
            add_review(session);
            session.files.open({folder.scene});
            run_command(session, "go.agent", "A");
            run_command(session, "query.select", "0");
            // Names are free.
            if (command.id == "agent.rename" || command.id == "bookmark.add" || command.id == "view.save_as") continue;
            EXPECT_THROW(run_command(session, command.id, text), std::invalid_argument) << command.id << ' ' << text;
        }
    }
}

TEST(CommandTable, AsInvokedWhatGoesWrongIsAMessage) {
    Session session(false);
    invoke(session, "view.top");
    EXPECT_TRUE(session.notifications.all().empty()) << "it has not run yet";
    session.queue.run();
    ASSERT_EQ(session.notifications.all().size(), 1u);
    EXPECT_EQ(session.notifications.all()[0].level, MessageLevel::error);
    EXPECT_EQ(session.notifications.all()[0].text, "\"View from above\" cannot be done now");
}

/// Panels may keep references into the document while they draw.
TEST(CommandTable, WhatIsInvokedRunsInOrderOnceTheFrameIsDrawn) {
    CrossingFolder folder;
    Session session(false);
    session.files.open({folder.scene});
    const Document& shown = session.workspace.document();
    const ViewState before = shown.view;
    invoke(session, "view.top");
    invoke(session, "step.out");  // cannot be done: what follows runs all the same
    session.queue.push([&] { invoke(session, "view.side"); });
    EXPECT_EQ(&session.workspace.document(), &shown);
    EXPECT_EQ(shown.view, before);
    EXPECT_TRUE(session.queue.run());
    EXPECT_EQ(session.workspace.view().camera.preset, CameraPreset::side) << "what a command enqueues runs too";
    ASSERT_EQ(session.notifications.all().size(), 1u);
    EXPECT_FALSE(session.queue.run());
    run_command(session, "view.previous");
    EXPECT_EQ(session.workspace.view(), before);
}

TEST(CommandTable, ChoicesCanAllBeChosen) {
    CrossingFolder folder;
    for (const Command& command : commands()) {
        // review_test.cpp has picture tests.
        if (!command.choices || command.id.starts_with("review.")) continue;
        // recovery_test.cpp has unsaved work.
        if (command.id == "file.recover" || command.id == "file.discard_unsaved") continue;
        SCOPED_TRACE(command.id);
        const auto prepare = [&](Session& session) {
            session.files.open({folder.scene});
            run_command(session, "go.agent", "A");
            run_command(session, "view.save_as", "the corner");
            if (!command.menu.starts_with("Query/")) return;
            run_command(session, "query.select", "0");
            run_command(session, "events.filter", "outcome = separated");
            run_command(session, "events.save", "apart");
            run_command(session, "breakpoint.add", "gap < 0.1");
            run_command(session, "bookmark.add", "the end");
        };
        Session session(false);
        session.settings.recent = {folder.file("walk.csv")};
        prepare(session);
        const std::vector<std::string> choices = command.choices(session);
        EXPECT_FALSE(choices.empty());
        for (const std::string& choice : choices) {
            Session other(false);
            prepare(other);
            const std::string told = all_messages(other);
            EXPECT_NO_THROW(run_command(other, command.id, choice)) << choice;
            EXPECT_EQ(all_messages(other), told);
            if (command.chosen) {
                EXPECT_TRUE(command.chosen(other, choice)) << choice;
            }
        }
    }
}

TEST(CommandTable, ClipsBecomeAgentsWhenOneIsEdited) {
    CrossingFolder folder;
    Session session(false);
    session.files.open({folder.file("walk.csv"), folder.file("stand.csv")});
    run_command(session, "go.agent", "stand");
    run_command(session, "agent.move", "3 4");
    ASSERT_EQ(session.workspace.scene().agents.size(), 2u);
    EXPECT_EQ(session.workspace.scene().agents[1].placement.translate, glm::dvec2(3, 4));
    EXPECT_EQ(session.workspace.fitted().queries().size(), 1u);
    run_command(session, "edit.undo");
    EXPECT_TRUE(session.workspace.scene().agents.empty());
}

TEST(CommandTable, StepsEndWhereTheTraceDoes) {
    CrossingFolder folder;
    Session session(false);
    session.files.open({folder.scene});
    run_command(session, "query.select", "0");
    EXPECT_FALSE(find_command("step.over")->enabled(session));
    run_command(session, "step.first");
    EXPECT_FALSE(find_command("step.out")->enabled(session));
    run_command(session, "query.select", "2");
    run_command(session, "step.next_hit");
    EXPECT_EQ(all_messages(session), "There is no later test that found a hit\n");
    EXPECT_FALSE(find_command("go.contact")->enabled(session)) << "B and C never meet";
}

TEST(CommandTable, LevelsStayWithinTheTrees) {
    CrossingFolder folder;
    Session session(false);
    session.files.open({folder.scene});
    const int deepest = session.workspace.fitted().tree(0).depth() - 1;
    while (find_command("view.finer")->enabled(session)) run_command(session, "view.finer");
    EXPECT_EQ(session.workspace.view().levels, (LevelRange{deepest, deepest, false}));
    while (find_command("view.coarser")->enabled(session)) run_command(session, "view.coarser");
    EXPECT_EQ(session.workspace.view().levels, (LevelRange{0, 0, false}));
    run_command(session, "view.level", "900");
    run_command(session, "view.coarser");
    EXPECT_EQ(session.workspace.view().levels.last, deepest) << "levels that no tree has are ignored";
}

TEST(CommandTable, TimeStepsStayWithinTheSpan) {
    CrossingFolder folder;
    Session session(false);
    session.files.open({folder.scene});
    run_command(session, "time.back");
    EXPECT_EQ(session.workspace.view().time, time_span(session.workspace).t0);
    run_command(session, "time.end");
    run_command(session, "time.forward");
    EXPECT_EQ(session.workspace.view().time, time_span(session.workspace).t1);
}

TEST(CommandTable, TheLineToCopyTellsThePicture) {
    CrossingFolder folder;
    TestDesktop desktop;
    const std::string& copied = desktop.text;
    Session session(false);
    session.desktop = &desktop;
    const std::filesystem::path odd = folder.write("o'dd name.json", slurp(folder.scene));
    session.files.open({odd});
    const auto options = [&] {
        run_command(session, "file.copy_command");
        const std::size_t file_end = copied.find("name.json'") + 10;
        return copied.substr(file_end, copied.find(" --size") - file_end);
    };
    EXPECT_EQ(options(), "");
    EXPECT_NE(copied.find(" --size 1280x720 -o"), std::string::npos) << "the scale that suits the size is not said";
    session.window_scale = 2;
    session.views.picture = {{640, 360}, 0};
    EXPECT_EQ(options(), "");
    EXPECT_NE(copied.find(" --size 640x360 -o"), std::string::npos) << copied;
    session.views.picture->scale = 1.75;
    EXPECT_EQ(options(), "");
    EXPECT_NE(copied.find(" --size 640x360 --scale 1.75 -o"), std::string::npos) << "the viewport's, not the panels'";
    EXPECT_NE(copied.find("o'\\''dd name.json'"), std::string::npos) << copied;
    run_command(session, "view.top");
    run_command(session, "query.select", "1");
    run_command(session, "step.to", "0");
    EXPECT_EQ(options(), " --view top --query 1 --step 0");
    run_command(session, "query.none");
    run_command(session, "view.level", "1:3");
    run_command(session, "time.at", "0.1");
    run_command(session, "view.theme", "light");
    run_command(session, "view.color_by", "level");
    run_command(session, "view.iso");
    run_command(session, "view.perspective");
    EXPECT_EQ(options(), " --view iso --ortho --level 1:3 --time 0.1 --color-by level --theme light");
    run_command(session, "time.clear");
    run_command(session, "view.floor");
    run_command(session, "view.labels");
    EXPECT_EQ(options(), " --view iso --ortho --level 1:3 --color-by level --theme light --no-floor --no-labels");
    run_command(session, "view.front");
    run_command(session, "view.zoom_in");
    EXPECT_NE(options().find("--view free --yaw -90 --pitch 0 --ortho --target "), std::string::npos) << copied;
    EXPECT_NE(options().find(" --distance "), std::string::npos) << copied;
    run_command(session, "file.save");
    EXPECT_EQ(options(), "");
    // What is selected, where the picture shows it.
    run_command(session, "go.agent", "A");
    EXPECT_EQ(options(), " --select A");
    run_command(session, "go.node", "A 2");
    EXPECT_EQ(options(), " --select A:node:2");
    session.workspace.change_view([](ViewState& view) { view.show = Show::moment; });
    EXPECT_EQ(options().find("--select"), std::string::npos) << "a moment has no nodes: " << copied;
    session.workspace.change_view([](ViewState& view) { view.show = Show::space_time; });
    session.workspace.select({Selection::Kind::clip, {}, 0});
    EXPECT_EQ(options(), "");
    session.workspace.select({Selection::Kind::path, {2, -1, 0}, -1});
    EXPECT_EQ(options(), " --select C");
    run_command(session, "query.select", "0");
    session.workspace.select({Selection::Kind::path, {2, -1, 0}, -1});
    EXPECT_EQ(options().find("--select"), std::string::npos) << "the picture is of A and B: " << copied;
    run_command(session, "query.none");
    run_command(session, "go.agent", "A");
    run_command(session, "agent.nudge", "1 0");
    // No file has this scene: it gets one, whatever else is there, and its line.
    run_command(session, "file.copy_command");
    ASSERT_TRUE(session.dialogs.exporting.temporary);
    const std::filesystem::path temporary = session.dialogs.exporting.temporary->file;
    EXPECT_NE(copied.find(shell_word(temporary.string())), std::string::npos) << copied;
    EXPECT_EQ(load_scene(temporary).agents[0].placement.translate,
              session.workspace.scene().agents[0].placement.translate);
    EXPECT_EQ(load_scene(temporary).view, session.workspace.view());
    EXPECT_TRUE(session.workspace.modified()) << "it is not saved by that";
    // The same scene seen otherwise takes options, another scene another file.
    run_command(session, "view.floor");
    run_command(session, "file.copy_command");
    EXPECT_EQ(session.dialogs.exporting.temporary->file, temporary);
    EXPECT_NE(copied.find(" --"), std::string::npos) << copied;
    run_command(session, "agent.nudge", "1 0");
    EXPECT_EQ(render_line(session.workspace, session.files, session.dialogs,
                          order_of_viewport(session.workspace, session.views), "picture.png"),
              std::nullopt);
    run_command(session, "file.copy_command");
    EXPECT_NE(session.dialogs.exporting.temporary->file, temporary);
    std::filesystem::remove_all(temporary.parent_path());
    std::filesystem::remove_all(session.dialogs.exporting.temporary->file.parent_path());
}

}  // namespace
}  // namespace mobbscope::app
