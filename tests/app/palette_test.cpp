// What the palette finds.
#include <app/commands/palette_entries.h>

#include "app/crossing_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mobbscope::app {
namespace {

struct PaletteWindow {
    CrossingFolder folder;
    Session session{false};

    PaletteWindow() { session.files.open({folder.scene}); }
    PaletteEntry first(const std::string& text) const {
        const auto entries = palette_entries(session, text);
        return entries.empty() ? PaletteEntry{} : entries.front();
    }
    std::string first_id(const std::string& text) const {
        const PaletteEntry entry = first(text);
        return entry.command ? std::string(entry.command->id) : "";
    }
};

TEST(Fuzzy, LettersStandInTheirOrder) {
    EXPECT_TRUE(fuzzy_score("tk", "Tree kind"));
    EXPECT_TRUE(fuzzy_score("TREE", "tree kind"));
    EXPECT_FALSE(fuzzy_score("kt", "Tree kind"));
    EXPECT_FALSE(fuzzy_score("eid", "Tree kind")) << "strewn about";
    EXPECT_FALSE(fuzzy_score("a", ""));
    EXPECT_EQ(fuzzy_score("", "anything"), 0);
}

TEST(Palette, HidesShowsAloneAndPinsByName) {
    PaletteWindow w;
    run_command(w.session, "go.agent", "B");
    run_command(w.session, "agent.rename", "Jos\u00E9 am Tor");
    for (const auto& [text, id] : {std::pair("hide Jos\u00E9 Tor", "agents.hide"),
                                   {"alone Jos\u00E9 Tor", "agents.solo"},
                                   {"pin Jos\u00E9 Tor", "agents.pin"}}) {
        const PaletteEntry entry = w.first(text);
        ASSERT_NE(entry.command, nullptr) << text;
        EXPECT_EQ(entry.command->id, id) << text;
        EXPECT_EQ(entry.argument, "Jos\u00E9 am Tor") << text;
        EXPECT_NO_THROW(run_command(w.session, entry.command->id, entry.argument));
    }
    EXPECT_EQ(w.session.workspace.view().pinned, std::vector<std::string>{"Jos\u00E9 am Tor"});
    const PaletteEntry of_clip = w.first("hide clip walk");
    ASSERT_NE(of_clip.command, nullptr);
    EXPECT_EQ(of_clip.command->id, "agents.hide");
    EXPECT_EQ(of_clip.argument, "clip:walk");
}

TEST(Fuzzy, StartsOfWordsAndRunsCountMore) {
    EXPECT_GT(fuzzy_score("top", "view.top"), fuzzy_score("top", "Theme of pictures"));
    EXPECT_GT(fuzzy_score("kind", "Tree kind"), fuzzy_score("ree", "Tree kind"));
    EXPECT_GT(fuzzy_score("open", "Open"), fuzzy_score("open", "Open the demo"));
}

TEST(PaletteEntries, WithoutTextAreAllCommandsThatCanBeDoneFirst) {
    const PaletteWindow p;
    const auto entries = palette_entries(p.session, "");
    const auto belongs = [&](const Command& command) { return belongs_here(p.session, command); };
    ASSERT_EQ(static_cast<std::ptrdiff_t>(entries.size()), std::ranges::count_if(commands(), belongs));
    EXPECT_EQ(entries.front().command->id, "file.open");
    const auto first_not =
        std::find_if(entries.begin(), entries.end(), [](const auto& e) { return !e.why_not.empty(); });
    EXPECT_TRUE(std::all_of(first_not, entries.end(), [](const auto& e) { return !e.why_not.empty(); }));
    EXPECT_NE(first_not, entries.end());
}

TEST(PaletteEntries, CommandsAreFoundByAFewLetters) {
    const PaletteWindow p;
    EXPECT_EQ(p.first_id("tree kind"), "tree.kind");
    EXPECT_EQ(p.first_id("kind tree"), "tree.kind");
    EXPECT_EQ(p.first_id("above"), "view.top");
    EXPECT_EQ(p.first_id("view.top"), "view.top");
    EXPECT_EQ(p.first_id("map"), "map.show");
    EXPECT_EQ(p.first_id("looks down"), "view.top") << "by what the explanation says";
    EXPECT_EQ(p.first_id("undo"), "edit.undo");
    EXPECT_EQ(p.first_id("export"), "file.export_picture");
    EXPECT_EQ(p.first_id("theme"), "view.theme");
    EXPECT_EQ(p.first_id("step forward"), "step.forward");
    EXPECT_EQ(p.first_id("compare"), "compare.paper");
    EXPECT_EQ(p.first_id("compare mobb umobb"), "compare.paper");
    EXPECT_EQ(p.first_id("best"), "tree.sweep");
    EXPECT_EQ(p.first("volume").title, "Colour boxes by: volume");
    for (const char* asked : {"side by side", "tighter", "better"})
        EXPECT_TRUE(p.first_id(asked).starts_with("compare.")) << asked << ": " << p.first_id(asked);
    EXPECT_EQ(p.first_id("zzqx"), "");
}

TEST(PaletteEntries, ChoicesAreFoundWithTheirCommand) {
    const PaletteWindow p;
    const PaletteEntry kind = p.first("tk umobb");
    EXPECT_EQ(kind.command->id, "tree.kind");
    EXPECT_EQ(kind.argument, "umobb");
    EXPECT_EQ(kind.title, "Tree kind: umobb");
    EXPECT_EQ(p.first("light").command->id, "view.theme");
    EXPECT_EQ(p.first("light").argument, "light");
}

TEST(PaletteEntries, AgentsClipsQueriesAndNodesAreFound) {
    const PaletteWindow p;
    EXPECT_EQ(p.first("stand").argument, "stand");
    EXPECT_EQ(p.first_id("b"), "go.agent") << "before what can be done with it";
    const PaletteEntry query = p.first("a against c");
    EXPECT_EQ(query.command->id, "query.select");
    EXPECT_EQ(query.argument, "1");
    const PaletteEntry node = p.first("b 2.1");
    EXPECT_EQ(node.command->id, "go.node");
    EXPECT_EQ(node.title, "B 2.1");
    const auto agents = palette_entries(p.session, "agent B");
    EXPECT_TRUE(std::any_of(agents.begin(), agents.end(),
                            [](const auto& e) { return e.command->id == "go.agent" && e.argument == "B"; }));
    EXPECT_NE(p.first_id("b 99.1"), "go.node");
}

/// What people say who come from other tools, and what they must find among the first three.
TEST(PaletteEntries, AreFoundByWhatPeopleSay) {
    const std::vector<std::pair<std::string, std::vector<std::string>>> table{
        {"compare", {"compare.with", "compare.paper", "compare.add"}},
        {"side by side", {"compare.paper", "compare.fits", "compare.add"}},
        {"tighter", {"compare.paper", "compare.fits", "tree.kind"}},
        {"better", {"compare.paper", "compare.fits"}},
        {"waste", {"nodes.sort", "view.color_by", "tree.next_finding"}},
        {"false positive", {"query.blame", "step.next_avoidable"}},
        {"tight", {"tree.kind", "tree.axes", "tree.next_finding"}},
        {"loose", {"tree.next_finding", "tree.kind", "view.color_by"}},
        {"worst", {"query.worst", "nodes.sort", "tree.next_finding"}},
        {"best", {"tree.sweep"}},
        {"volume", {"view.color_by", "nodes.sort"}},
        {"histogram", {"view.color_by", "view.color_range"}},
        {"heat", {"view.heat"}},
        {"slice", {"view.slice"}},
        {"measure", {"view.measure"}},
        {"fastest", {"tree.sweep"}},
        {"breakpoint", {"breakpoint.add"}},
        {"record", {"file.export_film"}},
        {"video", {"file.export_film"}},
        {"film", {"file.export_film"}},
        {"movie", {"file.export_film"}},
        {"animation", {"time.play"}},
        {"screenshot", {"file.export_picture", "file.copy_picture"}},
        {"svg", {"file.export_picture"}},
        {"pdf", {"file.export_picture"}},
        {"why", {"reasons.at"}},
        {"isolate", {"agent.solo", "agents.solo"}},
        {"heat map", {"map.panel", "view.heat"}},
        {"table", {"events.show", "bottom.show"}},
        {"event browser", {"events.show"}},
        {"csv", {"events.copy_csv"}},
        {"bookmark", {"bookmark.add", "view.save_as"}},
        {"plan", {"view.plan", "view.top"}},
        {"home", {"view.frame_all"}},
        {"reset", {"view.frame_all"}},
        {"zoom to fit", {"view.frame_all", "view.frame"}},
        {"focus", {"view.frame"}},
        {"orthographic", {"view.perspective"}},
        {"isometric", {"view.iso"}},
        {"undo", {"edit.undo"}},
        {"revert", {"edit.undo"}},
        {"dark mode", {"view.theme"}},
        {"preferences", {"view.theme", "window.scale"}},
        {"font", {"window.larger", "window.smaller"}},
        {"delete", {"agent.remove"}},
        {"clone", {"agent.duplicate"}},
        {"translate", {"agent.move"}},
        {"rotate", {"agent.turn", "view.orbit"}},
        {"unhide", {"agent.show_all"}},
        {"import", {"clip.import", "file.open"}},
        {"append", {"file.add"}},
        {"collision", {"conflicts.find", "query.select"}},
        {"certificate", {"proof.save"}},
        {"hotkeys", {"help.shortcuts"}},
        {"exit", {"file.quit"}},
        {"motion graph", {"crowd.build_graph"}},
        {"simulation", {"crowd.simulate"}},
    };
    PaletteWindow p;
    run_command(p.session, "query.select", "0");
    run_command(p.session, "go.agent", "A");
    for (const auto& [words, wanted] : table) {
        std::vector<std::string> first;
        for (const PaletteEntry& entry : palette_entries(p.session, words)) {
            if (first.size() < 3) first.emplace_back(entry.command->id);
        }
        for (const std::string& id : wanted) {
            EXPECT_NE(std::ranges::find(first, id), first.end())
                << words << " finds " << (first.empty() ? "nothing" : first[0]) << ", not " << id;
        }
    }
}

TEST(PaletteEntries, StrewnLettersDrownNoWord) {
    const PaletteWindow p;
    const auto finds = [&](const std::string& text, std::string_view id) {
        const auto entries = palette_entries(p.session, text);
        return std::ranges::any_of(entries, [&](const PaletteEntry& entry) { return entry.command->id == id; });
    };
    EXPECT_FALSE(finds("waste", "picture.write"));
    EXPECT_FALSE(finds("tight", "view.theme"));
    EXPECT_TRUE(finds("tk", "tree.kind")) << "where there is no word, letters are found";
    EXPECT_TRUE(finds("xport", "file.export_picture")) << "and so is the middle of a word";
}

TEST(PaletteEntries, OtherWordsFindLessThanTheTitle) {
    const PaletteWindow p;
    EXPECT_EQ(p.first_id("history"), "edit.history");
    EXPECT_EQ(p.first_id("play"), "time.play");
    const PaletteEntry svg = p.first("svg");
    EXPECT_EQ(svg.title, "Export picture...");
    EXPECT_TRUE(svg.says.starts_with("Writes the picture ")) << "its title does not say why it is there";
    EXPECT_EQ(p.first("export").says, "");
}

TEST(PaletteEntries, CommandsAreFoundWithWhatTheyTake) {
    PaletteWindow p;
    run_command(p.session, "query.select", "0");
    const std::vector<std::array<std::string, 4>> table{
        {"step 400", "step.to", "400", "Go to step: 400"},
        {"go to step 3", "step.to", "3", "Go to step: 3"},
        {"leaf 20", "tree.leaf", "20", "Samples in a leaf: 20"},
        {"level 3", "view.level", "3", "Show levels: 3"},
        {"levels 1:2", "view.level", "1:2", "Show levels: 1:2"},
        {"time 2.5", "time.at", "2.5", "Time cursor at: 2.5"},
        {"slab 1:2.5", "view.slab", "1:2.5", "Slab in time: 1:2.5"},
        {"slab none", "view.slab", "none", "Slab in time: none"},
        {"side by side mobb,leaf=10 moving aabb", "compare.fits", "mobb,leaf=10 moving aabb",
         "Compare two to four fits: mobb,leaf=10 moving aabb"},
        {"motion graph hubs=3 seconds=1:2", "crowd.build_graph", "hubs=3 seconds=1:2",
         "Build a motion graph: hubs=3 seconds=1:2"},
        {"speed 2", "time.speed", "2", "Speed of playing: 2"},
        {"tree umobb", "tree.kind", "umobb", "Tree kind: umobb"},
        {"place agent 1.5 -2", "agent.move", "1.5 -2", "Place agent at: 1.5 -2"},
    };
    run_command(p.session, "go.agent", "A");
    for (const auto& [text, id, argument, title] : table) {
        const PaletteEntry entry = p.first(text);
        ASSERT_NE(entry.command, nullptr) << text;
        EXPECT_EQ(entry.command->id, id) << text;
        EXPECT_EQ(entry.argument, argument) << text;
        EXPECT_EQ(entry.title, title) << text;
        EXPECT_EQ(entry.why_not, "") << text;
    }
    run_command(p.session, "step.to", "2");
    const PaletteEntry step = p.first("step 1");
    run_command(p.session, step.command->id, step.argument);
    EXPECT_EQ(p.session.workspace.step(), 1);
    for (const PaletteEntry& entry : palette_entries(p.session, "leaf twenty")) {
        EXPECT_NE(entry.argument, "twenty") << "no number";
    }
    for (const PaletteEntry& entry : palette_entries(p.session, "leaf 2.5")) {
        EXPECT_NE(entry.argument, "2.5") << "no whole number: " << entry.title;
    }
}

TEST(PaletteEntries, WhatCannotBeDoneSaysWhy) {
    const PaletteWindow p;
    EXPECT_EQ(p.first("duplicate").why_not, "no agent is selected");
    for (const PaletteEntry& entry : palette_entries(p.session, "step over")) {
        if (entry.command->id == "step.over") {
            EXPECT_EQ(entry.why_not, "no query is shown");
        }
    }
    const Session empty(false);
    EXPECT_EQ(palette_entries(empty, "view from above").front().why_not, "nothing is open");
}

TEST(PaletteEntries, WhatIsOfferedCanBeRun) {
    CrossingFolder folder;
    for (const char* text : {"umobb", "walk", "against", "A 1.0", "level"}) {
        const PaletteWindow offering;
        for (const PaletteEntry& entry : palette_entries(offering.session, text)) {
            if (!entry.why_not.empty() || (entry.argument.empty() && entry.command->needs_argument())) continue;
            if (entry.command->id.starts_with("file.")) continue;
            // What is done changes what can be done.
            Session session(false);
            session.files.open({folder.scene});
            EXPECT_NO_THROW(run_command(session, entry.command->id, entry.argument)) << entry.title;
        }
    }
}

TEST(PaletteEntries, ChoicesOfOneCommand) {
    const PaletteWindow p;
    const Command& kind = *find_command("tree.kind");
    EXPECT_EQ(matching_choices(p.session, kind, "").size(), mobb::tree_kind_names().size());
    EXPECT_EQ(matching_choices(p.session, kind, "um"), std::vector<std::string>{"umobb"});
    EXPECT_TRUE(matching_choices(p.session, *find_command("tree.leaf"), "").empty());
}

}  // namespace
}  // namespace mobbscope::app
