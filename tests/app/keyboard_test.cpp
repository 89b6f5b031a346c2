// The keyboard in panels, lists, menus and dialogs, and Escape, by keys pushed into the window.
#include <app/commands/command.h>
#include <app/commands/situations.h>
#include <app/window/headless_window.h>
#include <base/file.h>
#include <render/gl/gl_context.h>

#include "app/folder_window.h"

#include <support/folders.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>

namespace mobbscope::app {
namespace {

struct KeyboardWindow : FolderWindow<CrossingFolder> {
    KeyboardWindow() : FolderWindow({1024, 700}) { open(folder.scene); }

    void send(const InputEvent& event) {
        window.shell().feed(event);
        window.settle();
    }
    void key(const std::string& name, int times = 1) {
        const Chord chord = *chord_from_name(name);
        for (int i = 0; i < times; ++i) {
            for (const bool down : {true, false}) {
                if (chord.ctrl) window.shell().feed(KeyPress{Key::ctrl, down});
                if (chord.alt) window.shell().feed(KeyPress{Key::alt, down});
                if (chord.shift) window.shell().feed(KeyPress{Key::shift, down});
                window.shell().feed(KeyPress{chord.key, down});
            }
            window.settle();
        }
    }
    /// As fast hands do it: the modifier is down for long, and is let go before the key.
    void quick(Key modifier, Key key) {
        send(KeyPress{modifier, true});
        window.shell().feed(KeyPress{key, true});
        window.shell().feed(KeyPress{modifier, false});
        window.shell().feed(KeyPress{key, false});
        window.settle();
    }
    void type(const std::string& text) {
        for (const char c : text) window.shell().feed(TypedText{static_cast<char32_t>(c)});
        window.settle();
    }
    glm::vec2 at(const std::string& mark) {
        const auto& all = window.shell().marks().all();
        const auto found = all.find(mark);
        EXPECT_NE(found, all.end()) << mark;
        return found == all.end() ? glm::vec2(0) : found->second.center();
    }
    void click(const std::string& mark) {
        send(MouseMove{at(mark)});
        send(MouseButton{0, true});
        send(MouseButton{0, false});
    }
    /// Takes hold of a widget and drags it, without letting go.
    void hold(const std::string& mark, glm::vec2 by) {
        const glm::vec2 from = at(mark);
        send(MouseMove{from});
        send(MouseButton{0, true});
        for (int i = 1; i <= 4; ++i) send(MouseMove{from + by * (static_cast<float>(i) / 4)});
    }
};

TEST(Keyboard, TabGoesThroughAllWidgetsAndAround) {
    KeyboardWindow w;
    // The panel is not scrolled then: a list is entered where it is seen.
    for (const char* section : {"cost", "noticed"}) w.session.settings.folded[section] = true;
    w.window.settle();
    std::set<std::string> seen;
    for (int i = 0; i < 100; ++i) {
        w.key("Tab");
        ASSERT_NE(w.session.keys.focus, "");
        if (!seen.insert(w.session.keys.focus).second) break;
    }
    for (const char* mark : {"agent.0", "clip.0", "query.0", "scene.add_agent", "tree.kind", "tree.leaf", "view.level",
                             "view.leaves", "toolbar.view.top", "timeline.time.play"}) {
        EXPECT_TRUE(seen.contains(mark)) << mark;
    }
    for (const char* mark : {"viewport", "splitter.left", "agent.1", "menu.file", "tree.time_scale"}) {
        EXPECT_FALSE(seen.contains(mark)) << mark;
    }
    const std::size_t count = seen.size();
    std::set<std::string> back;
    for (std::size_t i = 0; i < count; ++i) {
        w.key("Shift+Tab");
        back.insert(w.session.keys.focus);
    }
    EXPECT_EQ(back, seen);
}

TEST(Keyboard, ArrowsStepWhileNothingHasTheFocus) {
    KeyboardWindow w;
    run_command(w.session, "query.select", "0");
    run_command(w.session, "step.first");
    w.window.settle();
    w.key("Right", 2);
    EXPECT_EQ(w.session.workspace.step(), 2);
    w.key("Tab");
    w.key("Ctrl+F6");
    EXPECT_EQ(w.session.keys.focus, "toolbar.view.iso");
    w.key("Right");
    EXPECT_EQ(w.session.keys.focus, "toolbar.view.top");
    EXPECT_EQ(w.session.workspace.step(), 2) << "the arrow was for the focus";
    w.key("Space");
    EXPECT_EQ(w.session.workspace.view().camera.preset, CameraPreset::top);
    EXPECT_FALSE(w.session.playback.playing()) << "and so was the blank";
    w.key("Escape");
    w.key("Right");
    EXPECT_EQ(w.session.workspace.step(), 3);
}

TEST(Keyboard, AListIsGoneThroughBeyondWhatIsDrawn) {
    KeyboardWindow w;
    std::string agents;
    for (int i = 0; i < 60; ++i) {
        agents += std::string(i > 0 ? "," : "") + R"({"name":"P)" + std::to_string(i) + R"(","clip":"walk"})";
    }
    w.folder.write("many.json", R"({"clips":{"walk":{"source":"walk.csv"}},"agents":[)" + agents +
                                    R"(],"queries":[{"a":"P0","b":"P1"}]})");
    w.open(w.folder.file("many.json"));
    ASSERT_EQ(all_messages(w.session), "");
    w.key("Tab");
    EXPECT_EQ(w.session.keys.focus, "scene.filter") << "long lists have a filter";
    w.key("Tab");
    EXPECT_EQ(w.session.keys.focus, "agent.0");
    w.key("Down", 30);
    EXPECT_EQ(w.session.keys.focus, "agent.30");
    w.key("End");
    EXPECT_EQ(w.session.keys.focus, "agent.59");
    w.key("Down");
    EXPECT_EQ(w.session.keys.focus, "agent.59");
    w.key("Enter");
    EXPECT_EQ(w.session.workspace.selection.path.agent, 59);
    w.key("PageUp");
    EXPECT_EQ(w.session.keys.focus, "agent.51");
    w.key("Home");
    EXPECT_EQ(w.session.keys.focus, "agent.0");
    w.key("Tab");
    EXPECT_EQ(w.session.keys.focus, "scene.add_agent") << "a list is one stop";
    w.key("Shift+Tab");
    EXPECT_TRUE(w.session.keys.focus.starts_with("agent.")) << w.session.keys.focus;
}

TEST(Keyboard, TheMouseTakesTheKeysBack) {
    KeyboardWindow w;
    w.key("Tab");
    EXPECT_EQ(w.session.keys.focus, "agent.0");
    w.click("clip.0");
    EXPECT_EQ(w.session.keys.focus, "");
    w.key("Tab");
    EXPECT_EQ(w.session.keys.focus, "scene.add_files") << "it goes on from what was clicked";
}

TEST(Keyboard, TabGoesOnWhereWhatHadTheFocusIsGone) {
    KeyboardWindow w;
    run_command(w.session, "go.agent", "A");
    w.window.settle();
    for (int i = 0; i < 100 && w.session.keys.focus != "agent.remove"; ++i) w.key("Tab");
    ASSERT_EQ(w.session.keys.focus, "agent.remove");
    w.key("Enter");
    EXPECT_EQ(w.session.workspace.scene().agents.size(), 2u);
    EXPECT_EQ(w.session.keys.focus, "") << "the viewport has the keys";
    w.key("Tab");
    EXPECT_NE(w.session.keys.focus, "");
    EXPECT_NE(w.session.keys.focus, "agent.0") << "not all over again";
}

TEST(Keyboard, EscapeClosesOneThingAfterTheOther) {
    KeyboardWindow w;
    run_command(w.session, "query.select", "0");
    run_command(w.session, "go.agent", "A");
    w.session.notifications.tell(MessageLevel::error, "This went wrong");
    w.window.settle();
    w.key("Tab");
    const std::string focus = w.session.keys.focus;
    ASSERT_NE(focus, "");
    w.key("F10");
    w.key("Alt");
    w.key("F10");
    EXPECT_TRUE(w.session.keys.focus.starts_with("menu.file.")) << w.session.keys.focus;
    w.key("Escape");
    EXPECT_EQ(w.session.keys.focus, focus) << "the menu is closed, the focus where it was";
    EXPECT_TRUE(w.session.notifications.all().front().up);
    w.key("Escape");
    EXPECT_EQ(w.session.keys.focus, "");
    EXPECT_TRUE(w.session.notifications.all().front().up);
    w.key("Escape");
    EXPECT_FALSE(w.session.notifications.all().front().up) << "it is behind the bell";
    EXPECT_EQ(w.session.workspace.selection.kind, Selection::Kind::path);
    w.key("Escape");
    EXPECT_EQ(w.session.workspace.selection.kind, Selection::Kind::none);
    w.key("Escape", 3);
    EXPECT_EQ(w.session.workspace.view().query, 0) << "the query stays";
    w.key("Q");
    EXPECT_FALSE(w.session.workspace.view().query);
}

TEST(Keyboard, EscapePutsBackWhatIsDragged) {
    KeyboardWindow w;
    run_command(w.session, "go.agent", "A");
    w.window.settle();
    const auto x = [&] { return w.session.workspace.scene().agents[0].placement.translate.x; };
    const double before = x();
    for (const char* held : {"agent.x", "handle.move"}) {
        SCOPED_TRACE(held);
        w.hold(held, {60, 10});
        EXPECT_NE(x(), before);
        w.key("Escape");
        EXPECT_EQ(x(), before);
        EXPECT_FALSE(w.session.workspace.history.can_undo()) << w.session.workspace.history.undo_title();
        w.send(MouseMove{{500, 300}});
        EXPECT_EQ(x(), before) << "the hand has not let go yet, but the drag is over";
        w.send(MouseButton{0, false});
        EXPECT_EQ(x(), before);
        EXPECT_EQ(w.session.workspace.selection.kind, Selection::Kind::path) << "and it was not a click";
    }
    const Camera camera = w.session.workspace.view().camera;
    w.hold("viewport", {80, 0});
    EXPECT_FALSE(w.session.workspace.view().camera == camera);
    w.key("Escape");
    EXPECT_EQ(w.session.workspace.view().camera, camera);
    w.send(MouseButton{0, false});
    const double width = w.session.settings.left_width;
    w.hold("splitter.left", {40, 0});
    EXPECT_NE(w.session.settings.left_width, width);
    w.key("Escape");
    EXPECT_EQ(w.session.settings.left_width, width);
    w.send(MouseButton{0, false});
}

TEST(Keyboard, AltAloneOpensTheMenus) {
    KeyboardWindow w;
    w.key("Alt");
    EXPECT_EQ(w.session.keys.focus, "menu.file.open");
    w.key("Alt");
    EXPECT_EQ(w.session.keys.focus, "");
    // Another window got the keys while it was down, or it was for something else.
    w.send(KeyPress{Key::alt, true});
    w.send(KeysLost{});
    w.send(KeyPress{Key::alt, false});
    EXPECT_EQ(w.session.keys.focus, "");
    w.send(KeyPress{Key::alt, true});
    w.send(MouseButton{0, true});
    w.send(MouseButton{0, false});
    w.send(KeyPress{Key::alt, false});
    EXPECT_EQ(w.session.keys.focus, "");
}

TEST(Keyboard, AMenuGoesAsTheKeysSayWhereverTheMouseRests) {
    KeyboardWindow w;
    w.send(MouseMove{w.at("menu.view")});
    w.key("Alt+F");
    EXPECT_EQ(w.session.keys.focus, "menu.file.open");
    w.key("End");
    EXPECT_EQ(w.session.keys.focus, "menu.file.quit");
    w.key("Down");
    EXPECT_EQ(w.session.keys.focus, "menu.file.open") << "around";
    w.key("S");
    EXPECT_EQ(w.session.keys.focus, "menu.file.save");
    w.key("Escape");
    // Opened by the mouse, gone on with by keys.
    w.click("menu.tree");
    EXPECT_EQ(w.session.keys.focus, "");
    w.key("Down", 2);
    EXPECT_EQ(w.session.keys.focus, "menu.tree.axes");
    w.key("Right");
    w.key("Down");
    w.key("Enter");
    EXPECT_EQ(w.session.workspace.scene().fit.axes, mobb::Axes::covariance);
    EXPECT_EQ(w.session.keys.focus, "");
}

TEST(Keyboard, TextEditsKeepTheirChords) {
    KeyboardWindow w;
    run_command(w.session, "go.agent", "A");
    run_command(w.session, "agent.nudge", "1 0");
    w.window.settle();
    w.click("agent.name");
    for (const char c : std::string("xy")) w.send(TypedText{static_cast<char32_t>(c)});
    w.key("Ctrl+A");
    w.key("Ctrl+X");
    w.key("Ctrl+V");
    w.key("Ctrl+V");
    w.key("Ctrl+Z");
    EXPECT_EQ(w.session.workspace.history.undo_title(), "moving A: x 1.00 m") << "nothing of the scene was undone";
    EXPECT_EQ(w.session.keys.focus, "agent.name");
    w.key("Tab");
    EXPECT_EQ(w.session.workspace.scene().agents[0].name, "Axy") << "Tab takes what was typed";
    EXPECT_EQ(w.session.keys.focus, "agent.x");
}

TEST(Keyboard, NumbersAreTypedWithTheirUnitAndBroughtIntoRange) {
    KeyboardWindow w;
    w.click("tree.leaf");
    EXPECT_EQ(w.session.workspace.scene().fit.leaf, 4) << "a click alone changes nothing";
    const auto type = [&](const std::string& text) {
        w.send(MouseMove{w.at("tree.leaf")});
        w.window.run_for(1);
        for (int i = 0; i < 2; ++i) {
            w.window.shell().feed(MouseButton{0, true});
            w.window.shell().feed(MouseButton{0, false});
        }
        w.window.settle();
        EXPECT_EQ(w.session.keys.focus, "tree.leaf");
        for (const char c : text) w.send(TypedText{static_cast<char32_t>(c)});
        w.key("Enter");
    };
    type("12");
    EXPECT_EQ(w.session.workspace.scene().fit.leaf, 12);
    type("0");
    EXPECT_EQ(w.session.workspace.scene().fit.leaf, 1);
    EXPECT_EQ(all_messages(w.session), "The number of samples of a leaf is at least 1\n");
    w.session.notifications.dismiss(0);
    type("many");
    EXPECT_EQ(w.session.workspace.scene().fit.leaf, 1);
    EXPECT_NE(all_messages(w.session).find("not a number"), std::string::npos) << all_messages(w.session);
    EXPECT_EQ(w.session.keys.focus, "") << "the mouse had begun";
}

TEST(Keyboard, AClickOnANumberIsGoneOnWithByDigits) {
    KeyboardWindow w;
    const auto press = [&](Key key, char letter) {
        w.window.shell().feed(KeyPress{key, true});
        w.window.shell().feed(TypedText{static_cast<char32_t>(letter)});
        w.window.shell().feed(KeyPress{key, false});
    };
    // As fast as a hand may be: nothing waits for a frame.
    const auto click = [&](const std::string& mark) {
        const glm::vec2 at = w.at(mark);
        w.window.shell().feed(MouseMove{at});
        w.window.shell().feed(MouseButton{0, true});
        w.window.shell().feed(MouseButton{0, false});
    };
    const Camera camera = w.session.workspace.view().camera;
    click("tree.leaf");
    press(Key::n1, '1');
    press(Key::n2, '2');
    w.key("Enter");
    EXPECT_EQ(w.session.workspace.scene().fit.leaf, 12);
    click("agent.1");
    w.window.settle();
    const auto placement = [&] { return w.session.workspace.scene().agents[1].placement; };
    click("agent.y");
    press(Key::minus, '-');
    press(Key::n1, '1');
    press(Key::period, '.');
    press(Key::n5, '5');
    // A click on a field above takes what was typed, and begins there.
    w.window.settle();
    click("agent.x");
    press(Key::n3, '3');
    w.key("Enter");
    EXPECT_EQ(placement().translate, glm::dvec2(3, -1.5));
    EXPECT_EQ(w.session.workspace.view().camera, camera);
    EXPECT_FALSE(w.session.workspace.view().time);
    // A hand that trembles still clicks; one that moves drags.
    w.hold("agent.x", {3, 2});
    w.send(MouseButton{0, false});
    EXPECT_EQ(w.session.keys.focus, "agent.x");
    EXPECT_EQ(placement().translate.x, 3);
    w.key("Escape");
    w.hold("agent.x", {40, 0});
    w.send(MouseButton{0, false});
    EXPECT_EQ(w.session.keys.focus, "");
    EXPECT_GT(placement().translate.x, 3);
}

TEST(Keyboard, TheFirstArrowGoesOnFromTheChosenRowOfAListThatTheMouseHasOpened) {
    KeyboardWindow w;
    run_command(w.session, "tree.kind", "umobb");
    w.window.settle();
    w.click("tree.kind");
    w.key("Down");
    const std::string next = w.session.keys.focus;
    w.key("Up");
    EXPECT_EQ(w.session.keys.focus, "tree.kind.umobb");
    EXPECT_NE(next, "tree.kind.umobb");
    w.key("Up");
    EXPECT_EQ(w.session.keys.focus, "tree.kind.mobb");
    w.key("Escape");
    // A menu has no row that is chosen: it begins with its first.
    w.click("menu.file");
    w.key("Down");
    EXPECT_EQ(w.session.keys.focus, "menu.file.open");
}

TEST(Keyboard, ADialogGivesTheFocusBack) {
    KeyboardWindow w;
    w.key("Tab", 2);
    const std::string before = w.session.keys.focus;
    w.key("Ctrl+P");
    EXPECT_EQ(w.session.keys.focus, "palette.input");
    w.key("Escape");
    EXPECT_EQ(w.session.keys.focus, before);
    run_command(w.session, "go.agent", "A");
    run_command(w.session, "agent.nudge", "1 0");
    w.key("Ctrl+Q");
    ASSERT_EQ(w.session.dialogs.now, Dialog::unsaved);
    w.key("Tab", 3);
    EXPECT_EQ(w.session.keys.focus, "unsaved.cancel");
    w.key("Right");
    w.key("Left");
    EXPECT_EQ(w.session.keys.focus, "unsaved.discard");
    w.key("Tab");
    w.key("Enter");
    EXPECT_EQ(w.session.dialogs.now, Dialog::none) << "the button with the focus, not the usual one";
    EXPECT_FALSE(w.session.files.closed());
}

TEST(Keyboard, ASuggestedNameIsReplacedByWhatIsTyped) {
    KeyboardWindow w;
    w.key("Ctrl+E");
    EXPECT_EQ(w.session.dialogs.input.text, w.folder.file("scene.png"));
    w.type("made");
    EXPECT_EQ(w.session.dialogs.input.text, w.folder.file("made.png"));
    w.quick(Key::ctrl, Key::a);
    w.type("other");
    EXPECT_EQ(w.session.dialogs.input.text, "other");
    w.key("Home");
    w.type("an");
    w.quick(Key::shift, Key::end);
    w.type("d");
    EXPECT_EQ(w.session.dialogs.input.text, "and");
    w.key("Escape");
    w.key("Ctrl+Shift+S");
    EXPECT_EQ(w.session.dialogs.input.text, "scene.json");
    w.type("mine.json");
    w.key("Enter");
    EXPECT_EQ(w.session.workspace.file, w.folder.file("mine.json")) << "and not mine.json.json";
}

TEST(Keyboard, FilesAreChosenAsFileManagersDo) {
    KeyboardWindow w;
    const auto chosen = [&] {
        std::string out;
        for (const auto& path : w.session.dialogs.browser.chosen()) out += path.filename().string() + ' ';
        return out;
    };
    w.key("Ctrl+O");
    EXPECT_EQ(chosen(), "scene.json ");
    w.quick(Key::shift, Key::down);
    EXPECT_EQ(chosen(), "scene.json stand.csv ");
    w.quick(Key::shift, Key::down);
    EXPECT_EQ(chosen(), "scene.json stand.csv walk.csv ");
    w.quick(Key::shift, Key::up);
    EXPECT_EQ(chosen(), "scene.json stand.csv ");
    w.click("open.entry.walk.csv");
    EXPECT_EQ(chosen(), "walk.csv ");
    w.quick(Key::shift, Key::up);
    EXPECT_EQ(chosen(), "stand.csv walk.csv ") << "from the row that was clicked";
    w.click("open.entry.scene.json");
    w.send(KeyPress{Key::ctrl, true});
    w.click("open.entry.walk.csv");
    w.send(KeyPress{Key::ctrl, false});
    EXPECT_EQ(chosen(), "scene.json walk.csv ");
    w.send(KeyPress{Key::shift, true});
    w.click("open.entry.stand.csv");
    w.send(KeyPress{Key::shift, false});
    EXPECT_EQ(chosen(), "stand.csv walk.csv ") << "from the row that was clicked last";
    w.quick(Key::ctrl, Key::a);
    EXPECT_EQ(chosen(), "scene.json stand.csv walk.csv ");
}

TEST(Keyboard, LettersInAMenuAreTheBeginningOfAName) {
    KeyboardWindow w;
    w.key("Alt+F");
    EXPECT_EQ(w.session.keys.focus, "menu.file.open");
    w.key("Z");
    EXPECT_EQ(w.session.keys.focus, "menu.file.open") << "nothing begins so";
    w.window.run_for(1.5);
    w.key("O");
    EXPECT_EQ(w.session.keys.focus, "menu.file.demo") << "the next one";
    w.window.run_for(1.5);
    w.key("O");
    w.key("O");
    EXPECT_EQ(w.session.keys.focus, "menu.file.demo") << "around";
    w.window.run_for(1.5);
    w.key("S");
    w.key("A");
    w.key("V");
    w.key("E");
    EXPECT_EQ(w.session.keys.focus, "menu.file.save") << "where it began it stays";
    w.window.run_for(1.5);
    w.key("C");
    w.key("O");
    EXPECT_EQ(w.session.keys.focus, "menu.file.copy_command");
    w.key("Z");
    EXPECT_EQ(w.session.keys.focus, "menu.file.copy_command");
}

TEST(Keyboard, WhatIsDoneByEnterGivesTheKeysToThePicture) {
    KeyboardWindow w;
    for (int i = 0; i < 100 && w.session.keys.focus != "query.0"; ++i)
        w.key(w.session.keys.focus == "query.0" ? "Down" : "Tab");
    ASSERT_EQ(w.session.keys.focus, "query.0");
    w.key("Enter");
    EXPECT_EQ(w.session.workspace.view().query, 0);
    EXPECT_EQ(w.session.keys.focus, "");
    w.key("Shift+Left");
    w.key("Right");
    EXPECT_EQ(w.session.workspace.step(), 1) << "the arrows are for the query that was opened";
    w.key("Tab");
    EXPECT_EQ(w.session.keys.focus, "query.0") << "Tab leads back";
    w.key("Escape");
    w.key("Ctrl+F6");
    for (int i = 0; i < 10 && w.session.keys.focus != "toolbar.view.iso"; ++i) w.key("Ctrl+F6");
    ASSERT_EQ(w.session.keys.focus, "toolbar.view.iso");
    w.key("Right");
    w.key("Enter");
    EXPECT_EQ(w.session.workspace.view().camera.preset, CameraPreset::top);
    EXPECT_EQ(w.session.keys.focus, "");
    w.key("Right");
    EXPECT_EQ(w.session.workspace.step(), 2);
    w.key("Tab");
    ASSERT_EQ(w.session.keys.focus, "toolbar.view.top");
    w.key("F");
    w.key("Left");
    EXPECT_EQ(w.session.keys.focus, "toolbar.view.iso");
    w.key("Left");
    EXPECT_EQ(w.session.workspace.step(), 1) << "beside the first button is nothing: the key is the picture's";
    // The palette too.
    w.key("Q");
    w.key("Ctrl+P");
    w.type("A against B");
    w.key("Enter");
    EXPECT_EQ(w.session.workspace.view().query, 0);
    EXPECT_EQ(w.session.keys.focus, "");
}

TEST(Keyboard, ArrowsThroughAgentsSelectThem) {
    KeyboardWindow w;
    w.key("Tab");
    EXPECT_EQ(w.session.keys.focus, "agent.0");
    EXPECT_EQ(w.session.workspace.selection.kind, Selection::Kind::none) << "Tab only passes by";
    w.key("Down");
    EXPECT_EQ(w.session.keys.focus, "agent.1");
    w.key("V");
    EXPECT_EQ(w.session.workspace.view().hidden, std::vector<std::string>{"B"});
    w.key("Down");
    w.key("V");
    EXPECT_EQ(w.session.workspace.view().hidden, (std::vector<std::string>{"B", "C"}));
    w.key("Ctrl+Z");
    EXPECT_EQ(w.session.keys.focus, "agent.2");
}

TEST(Keyboard, ADialogOverTheHelpForgetsWhatWaitedForAnAnswer) {
    KeyboardWindow w;
    run_command(w.session, "go.agent", "A");
    run_command(w.session, "agent.nudge", "1 0");
    w.window.settle();
    w.key("Ctrl+Q");
    ASSERT_EQ(w.session.dialogs.now, Dialog::unsaved);
    w.key("F1");
    w.send(Drop{{w.folder.file("stand.csv")}});
    ASSERT_EQ(w.session.dialogs.now, Dialog::dropped);
    run_command(w.session, "file.save_as", w.folder.file("mine.json").string());
    EXPECT_FALSE(w.session.files.closed()) << "nobody has said that it is to end";
}

TEST(Keyboard, TheStripOfStepsStandsStill) {
    KeyboardWindow w;
    run_command(w.session, "query.select", "0");
    run_command(w.session, "step.first");
    w.window.settle();
    ASSERT_GT(w.session.workspace.recorded()->trace.size(), 10);
    const float left = w.window.shell().marks().all().at("query.strip").min.x;
    run_command(w.session, "step.last");
    w.window.settle();
    EXPECT_EQ(w.window.shell().marks().all().at("query.strip").min.x, left);
}

TEST(Keyboard, NoPanelHasAnotherKindOfNumber) {
    for (const char* folder : {"panels", "viewport"}) {
        for (const auto& file : std::filesystem::directory_iterator(std::string(kSource / "src/app/") + folder)) {
            const std::string text = slurp(file.path());
            for (const char* other : {"ImGui::Drag", "ImGui::Slider", "ImGui::VSlider", "ImGui::InputInt",
                                      "ImGui::InputFloat", "ImGui::InputDouble", "ImGui::InputScalar"}) {
                EXPECT_EQ(text.find(other), std::string::npos) << file.path() << ": " << other;
            }
        }
    }
}

TEST(Help, BeginsWithThePresentSituation) {
    Session empty(false);
    EXPECT_EQ(present_situation(empty).title, "Nothing is open");
    KeyboardWindow w;
    EXPECT_EQ(present_situation(w.session).title, "You look at a scene");
    run_command(w.session, "go.agent", "A");
    EXPECT_EQ(present_situation(w.session).title, "An agent is selected");
    run_command(w.session, "query.select", "0");
    EXPECT_EQ(present_situation(w.session).title, "You look at a query");
    run_command(w.session, "view.moment");
    EXPECT_EQ(present_situation(w.session).title, "You look at one moment");
    w.key("Ctrl+O");
    w.key("F1");
    ASSERT_EQ(w.session.dialogs.now, Dialog::help);
    EXPECT_EQ(present_situation(w.session).title, "Choosing a file");
    w.key("Escape");
    EXPECT_EQ(w.session.dialogs.now, Dialog::open) << "back to where it was asked for";
    for (const Situation& situation : situations()) {
        for (const std::string_view id : situation.commands) EXPECT_NE(find_command(id), nullptr) << id;
    }
}

TEST(Keyboard, AClickWorksWhereTheMouseRestedWhileKeysCloseAMenu) {
    KeyboardWindow w;
    w.click("menu.view");
    const auto is_open = [&] { return w.window.shell().marks().all().contains("menu.view.frame_all"); };
    ASSERT_TRUE(is_open());
    w.key("Escape");
    ASSERT_FALSE(is_open());
    w.send(MouseButton{0, true});
    w.send(MouseButton{0, false});
    EXPECT_TRUE(is_open()) << "the mouse has not moved";
}

TEST(Keyboard, AKeyThatCanDoNothingNowSaysWhy) {
    KeyboardWindow w;
    run_command(w.session, "query.select", "0");
    w.window.settle();
    w.key("]");
    EXPECT_NE(all_messages(w.session).find("Finer level: a query is in the picture"), std::string::npos)
        << all_messages(w.session);
}

TEST(Help, RunsWhatIsPicked) {
    KeyboardWindow w;
    run_command(w.session, "query.select", "0");
    run_command(w.session, "step.first");
    w.window.settle();
    w.key("F1");
    w.key("Enter");
    EXPECT_EQ(w.session.dialogs.now, Dialog::none);
    EXPECT_EQ(w.session.workspace.step(), 1) << "the first of what can be done with a query: step forward";
    w.key("F1");
    for (const char c : std::string("theme")) w.send(TypedText{static_cast<char32_t>(c)});
    w.key("Enter");
    EXPECT_EQ(w.session.dialogs.now, Dialog::palette);
    EXPECT_EQ(w.session.dialogs.input.command, "view.theme");
    w.key("Escape");
    w.key("F1");
    for (const char c : std::string("node on its level")) w.send(TypedText{static_cast<char32_t>(c)});
    w.key("Enter");
    EXPECT_EQ(w.session.dialogs.now, Dialog::help) << "it cannot be done without a node";
}

}  // namespace
}  // namespace mobbscope::app
