// Every shortcut of the help sheet, pressed in the window.
#include <app/script/state_json.h>
#include <app/window/headless_window.h>
#include <render/gl/gl_context.h>
#include <review/review_screen.h>

#include "app/crossing_folder.h"

#include <imgui.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::app {
namespace {

using Json = nlohmann::ordered_json;
using Steps = std::vector<std::pair<std::string, std::string>>;

/// What a person may have done before pressing a key: for every command there must be one where it does something.
const std::vector<Steps> kSituations{
    {},
    {{"go.agent", "A"}},
    {{"query.select", "0"}},
    {{"query.select", "0"}, {"step.to", "1"}},
    {{"query.select", "0"}, {"step.first", ""}},
    {{"query.select", "1"}, {"step.first", ""}},
    {{"query.select", "0"}, {"recursion.zoom", "1:3"}},
    {{"go.node", "B 1.0"}},
    {{"go.node", "B 1.1"}},
    {{"view.level", "2"}},
    {{"view.top", ""}},
    {{"view.zoom", "3"}},
    {{"time.at", "0.5"}},
    {{"agents.hide", "A"}},
    {{"agents.foreground", "A"}},
    {{"view.split", ""}},
    {{"window.scale", "2"}},
    {{"go.agent", "A"}, {"agent.move", "3 3"}},
    {{"go.agent", "A"}, {"agent.move", "3 3"}, {"edit.undo", ""}},
    {{"view.top", ""}, {"view.previous", ""}},
    {{"query.select", "0"},
     {"step.to", "6"},
     {"step.to", "9"},
     {"step.visited_back", ""},
     {"breakpoint.add", "outcome = overlap"}},
};

/// A window, again and again on a new folder's scene after what was done.
struct KeyWorld {
    std::unique_ptr<CrossingFolder> folder;
    std::unique_ptr<Session> session;
    std::unique_ptr<HeadlessWindow> window;
    std::shared_ptr<const FittedScene> opened;

    void begin(const Steps& before) {
        if (!session || session->files.closed()) {
            window.reset();
            session = std::make_unique<Session>(false);
            add_review(*session);
            window = std::make_unique<HeadlessWindow>(GlContext::open(Backend::automatic), *session,
                                                      PictureSize{800, 500}, 1);
        }
        folder = std::make_unique<CrossingFolder>();
        session->dialogs.close();
        session->files.open({folder->scene});
        session->files.answer_unsaved(Files::Unsaved::discard);
        while (!session->notifications.all().empty()) session->notifications.dismiss(0);
        session->settings = {};
        window->settle();
        for (const auto& [id, argument] : before) {
            run_command(*session, id, argument);
            window->settle();
        }
        opened = session->workspace.document().fitted;
    }

    void press(const Chord& chord) const {
        std::vector<Key> keys;
        if (chord.ctrl) keys.push_back(Key::ctrl);
        if (chord.alt) keys.push_back(Key::alt);
        if (chord.shift) keys.push_back(Key::shift);
        keys.push_back(chord.key);
        for (const Key key : keys) window->shell().feed(KeyPress{key, true});
        for (auto key = keys.rbegin(); key != keys.rend(); ++key) window->shell().feed(KeyPress{*key, false});
        window->settle();
    }

    /// All that a command can change.
    Json outcome() const {
        Json json = state_json(*session);
        json.erase("file");  // every time another folder
        const auto take_folder_out = [here = folder->scene.parent_path().string()](Json& said) {
            std::string text = said;
            const std::size_t at = text.find(here);
            if (at != std::string::npos) said = text.erase(at, here.size());
        };
        for (Json& message : json["messages"]) take_folder_out(message["text"]);
        if (json.contains("export")) take_folder_out(json["export"]["file"]);
        if (session->playback.playing()) {
            // Frames go by until it is looked at.
            json.erase("time");
            json["view"].erase("time");
        }
        json["closed"] = session->files.closed();
        json["scale"] = session->settings.ui_scale;
        json["reread"] = session->workspace.document().fitted != opened;
        return json;
    }
};

std::vector<std::string> chords_of(std::string_view text) {
    std::istringstream in{std::string(text)};
    std::vector<std::string> out;
    for (std::string word; in >> word;) out.push_back(word);
    return out;
}

/// That in some situation the chord does what the command does, and that is something.
void expect_works(KeyWorld& world, const Command& command, const Chord& chord) {
    for (const Steps& situation : kSituations) {
        world.begin(situation);
        if (!command.enabled(*world.session)) continue;
        const Json before = world.outcome();
        run_command(*world.session, command.id);
        world.window->settle();
        const Json wanted = world.outcome();
        if (wanted == before) continue;
        world.begin(situation);
        world.press(chord);
        EXPECT_EQ(world.outcome(), wanted);
        return;
    }
    ADD_FAILURE() << "it does nothing in any situation";
}

TEST(Shortcuts, EachDoesWhatItsCommandDoes) {
    KeyWorld world;
    int tried = 0;
    for (const Command& command : commands()) {
        // crowd.script presses those of crowds.
        const bool of_crowds = command.id.starts_with("crowd.") || command.id.starts_with("conflicts.");
        if (of_crowds && command.id != "crowd.follow") continue;
        // review_test.cpp those of picture tests.
        if (command.id.starts_with("review.")) continue;
        for (const std::string& name : chords_of(command.shortcut)) {
            SCOPED_TRACE(std::string(command.id) + " by " + name);
            expect_works(world, command, *chord_from_name(name));
            ++tried;
        }
    }
    EXPECT_GT(tried, 50);
}

/// As a keyboard sends a key that is held: it goes down again and again.
void hold(const KeyWorld& world, Key key, int times) {
    for (int i = 0; i < times; ++i) {
        world.window->shell().feed(KeyPress{key, true});
        world.window->settle();
    }
    world.window->shell().feed(KeyPress{key, false});
    world.window->settle();
}

TEST(Shortcuts, HeldKeysGoOnWhereTheirCommandRepeats) {
    KeyWorld world;
    world.begin({{"query.select", "0"}, {"step.first", ""}});
    hold(world, Key::right, 3);
    EXPECT_EQ(world.session->workspace.step(), 3);
    hold(world, Key::d, 2);
    EXPECT_FALSE(world.session->workspace.view().disks) << "a toggle is one";
}

/// A letter as a keyboard sends it: the key, and what it types.
void type(const KeyWorld& world, Key key, char32_t code) {
    world.window->shell().feed(KeyPress{key, true});
    world.window->shell().feed(TypedText{code});
    world.window->shell().feed(KeyPress{key, false});
    world.window->settle();
}

TEST(Shortcuts, TextFieldsKeepTheirLetters) {
    KeyWorld world;
    world.begin({{"go.agent", "A"}});
    const auto mark = world.window->shell().marks().all().find("agent.name");
    ASSERT_NE(mark, world.window->shell().marks().all().end());
    world.window->shell().feed(MouseMove{mark->second.center()});
    world.window->shell().feed(MouseButton{0, true});
    world.window->shell().feed(MouseButton{0, false});
    world.window->settle();
    ASSERT_TRUE(ImGui::GetIO().WantTextInput);
    world.press(*chord_from_name("Ctrl+A"));
    const Json before = world.outcome();
    std::string typed;
    for (const Command& command : commands_with_review()) {
        for (const std::string& name : chords_of(command.shortcut)) {
            if (name.size() != 1) continue;  // a chord, or a key that types nothing
            const char c = name[0] >= 'A' && name[0] <= 'Z' ? static_cast<char>(name[0] - 'A' + 'a') : name[0];
            type(world, chord_from_name(name)->key, static_cast<char32_t>(c));
            typed += c;
        }
    }
    EXPECT_GT(typed.size(), 20u);
    Json after = world.outcome();
    after["hovered"] = before["hovered"];
    EXPECT_EQ(after["view"], before["view"]) << "no letter is a command meanwhile";
    EXPECT_EQ(after["query"], before["query"]);
    EXPECT_EQ(after["selection"]["kind"], before["selection"]["kind"]);
    world.press(*chord_from_name("Enter"));
    EXPECT_EQ(world.session->workspace.scene().agents[0].name, typed);
    // With the field left, letters are commands again.
    world.press(*chord_from_name("D"));
    EXPECT_FALSE(world.session->workspace.view().disks);
}

}  // namespace
}  // namespace mobbscope::app
