// Menus, palette, dialogs and messages in the window, by keys and clicks.
#include <app/ui/style.h>
#include <app/window/headless_window.h>
#include <render/drawlist/view_projection.h>
#include <render/gl/gl_context.h>
#include <render/image/png.h>
#include <render/pictures/build_draw_list.h>

#include "app/crossing_folder.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace mobbscope::app {
namespace {

using testing::all_messages;
using testing::CrossingFolder;

struct Window {
    CrossingFolder folder;
    Session session{false};
    HeadlessWindow window;
    PictureSize size;

    explicit Window(PictureSize of = {1024, 640}, double scale = 1)
        : window(GlContext::open(Backend::automatic), session, of, scale), size(of) {
        session.open({folder.scene});
        window.settle();
    }

    void key(const std::string& name) {
        const Chord chord = *chord_from_name(name);
        const auto send = [&](Key key, bool down) { window.shell().feed(KeyPress{key, down}); };
        if (chord.ctrl) send(Key::ctrl, true);
        if (chord.shift) send(Key::shift, true);
        send(chord.key, true);
        send(chord.key, false);
        if (chord.shift) send(Key::shift, false);
        if (chord.ctrl) send(Key::ctrl, false);
        window.settle();
    }
    void type(const std::string& text) {
        for (const char c : text) window.shell().feed(TypedText{static_cast<char32_t>(c)});
        window.settle();
    }
    bool has(const std::string& mark) { return window.shell().marks().all().contains(mark); }
    void click(const std::string& mark, int button = 0) {
        const auto at = window.shell().marks().all().find(mark);
        ASSERT_NE(at, window.shell().marks().all().end()) << mark;
        window.shell().feed(MouseMove{at->second.center()});
        window.shell().feed(MouseButton{button, true});
        window.shell().feed(MouseButton{button, false});
        window.settle();
    }
    /// A picture to look at, where MOBBSCOPE_LOOK names a folder.
    void change_view(const std::string& name) {
        const char* const there = std::getenv("MOBBSCOPE_LOOK");
        if (there) write_png(std::filesystem::path(there) / (name + ".png"), window.shell().read_back());
    }
    void expect_inside() {
        for (const auto& [name, rect] : window.shell().marks().all()) {
            if (name.starts_with("palette.") || name.starts_with("open.")) continue;  // lists scroll
            EXPECT_GE(rect.min.x, -1) << name;
            EXPECT_LE(rect.max.x, static_cast<float>(size.width) + 1) << name;
        }
    }
};

TEST(Panels, ARowsMenuRemovesItsAgent) {
    Window w;
    for (const std::size_t left : {2u, 1u}) {
        w.click("agent.0", 1);
        w.click("context.agent.remove");
        ASSERT_EQ(w.session.scene().agents.size(), left);
        EXPECT_EQ(w.session.selection, Selection{});
    }
    EXPECT_EQ(w.session.scene().agents[0].name, "C");
}

TEST(Panels, KeysDoNothingToWhatIsBeingDragged) {
    Window w;
    run_command(w.session, "go.agent", "A");
    run_command(w.session, "agent.duplicate");
    w.window.settle();
    Shell& shell = w.window.shell();
    const glm::vec2 at = shell.marks().all().at("handle.move").center();
    shell.feed(MouseMove{at});
    shell.feed(MouseButton{0, true});
    shell.feed(MouseMove{at + glm::vec2(40, 0)});
    w.window.settle();
    ASSERT_TRUE(w.session.history().undo_title().starts_with("moving"));
    for (int i = 0; i < 3; ++i) w.key("Ctrl+Z");
    EXPECT_EQ(w.session.scene().agents.size(), 4u);
    shell.feed(MouseMove{at + glm::vec2(60, 0)});
    shell.feed(MouseButton{0, false});
    w.window.settle();
    w.key("Ctrl+Z");
    EXPECT_EQ(w.session.history().redo_title().substr(0, 6), "moving");
    EXPECT_EQ(w.session.scene().agents.size(), 4u);
}

TEST(Panels, AMomentIsWalkedThroughAndHasNoHandles) {
    Window w;
    run_command(w.session, "go.agent", "A");
    w.window.settle();
    ASSERT_TRUE(w.has("handle.move"));
    w.key("M");
    ASSERT_EQ(w.session.view().show, Show::moment);
    EXPECT_FALSE(w.has("handle.move")) << "they stand where a path begins, in space-time";
    // What the viewport shows is what is picked: a click on a wall selects the sample that holds then.
    run_command(w.session, "time.at", "1.2");
    w.window.settle();
    w.change_view("moment");
    const DrawList list = build_draw_list(w.session.fitted(), w.session.view(), w.session.hooks.viewport_size());
    ASSERT_FALSE(list.disks.empty());
    const DiskInstance& disk = list.disks.front();
    const auto pixel = list.projection.project(disk.base + glm::vec3(0, 0, 0.9f));
    ASSERT_TRUE(pixel);
    const glm::vec2 at = w.window.shell().marks().all().at("viewport").min + *pixel;
    w.window.shell().feed(MouseMove{at});
    w.window.shell().feed(MouseButton{0, true});
    w.window.shell().feed(MouseButton{0, false});
    w.window.settle();
    EXPECT_EQ(w.session.selection.kind, Selection::Kind::sample);
    EXPECT_EQ(w.session.selection.index, disk.id.index);
    // Dragging turns the camera; time keeps the height that it has in space-time.
    const double time_height = w.session.view().time_height;
    w.window.shell().feed(MouseMove{at});
    w.window.shell().feed(MouseButton{0, true});
    w.window.shell().feed(MouseMove{at + glm::vec2(60, 20)});
    w.window.shell().feed(MouseButton{0, false});
    w.window.settle();
    EXPECT_TRUE(w.session.view().camera.target);
    EXPECT_EQ(w.session.view().time_height, time_height);
    w.key("M");
    EXPECT_EQ(w.session.view().show, Show::space_time);
    EXPECT_FALSE(w.session.view().camera.target);
}

TEST(Panels, TheCameraGoesOnFromWhatKeysHaveMade) {
    Window w;
    w.window.shell().feed(KeyPress{Key::n2, true});
    w.window.shell().feed(KeyPress{Key::equal, true});
    w.window.settle();
    EXPECT_NEAR(orientation(w.session.view().camera).pitch_deg, 90, 1e-9) << "from above, and nearer";
}

TEST(Panels, ALongNameIsKeptWhole) {
    Window w;
    const std::string name = "\u00E9" + std::string(300, 'x');
    run_command(w.session, "go.agent", "A");
    run_command(w.session, "agent.rename", name);
    w.window.settle();
    w.click("agent.name");
    w.key("End");
    w.type("!");
    w.key("Enter");
    EXPECT_EQ(w.session.scene().agents[0].name, name + "!");
}

TEST(Panels, ThePaletteRunsWhatWasTyped) {
    Window w;
    w.key("Ctrl+P");
    ASSERT_EQ(w.session.dialog, Dialog::palette);
    w.change_view("palette");
    w.type("tk umobb");
    w.change_view("palette_typed");
    w.key("Enter");
    EXPECT_EQ(w.session.dialog, Dialog::none);
    EXPECT_EQ(w.session.scene().fit.tree, mobb::TreeKind::umobb);
}

TEST(Panels, ThePaletteGoesThroughItsListAndAsksForArguments) {
    Window w;
    w.key("Ctrl+P");
    w.type("samples in a leaf");
    w.key("Enter");
    ASSERT_EQ(w.session.dialog, Dialog::palette);
    EXPECT_EQ(w.session.input.command, "tree.leaf");
    w.change_view("palette_argument");
    w.type("7");
    w.key("Enter");
    EXPECT_EQ(w.session.scene().fit.leaf, 7);
    w.key("Ctrl+P");
    w.type("theme");
    w.key("Enter");
    ASSERT_EQ(w.session.input.command, "view.theme");
    w.key("Down");
    w.key("Enter");
    EXPECT_EQ(w.session.view().theme, Theme::light);
    w.key("Ctrl+P");
    w.key("Escape");
    EXPECT_EQ(w.session.dialog, Dialog::none);
}

TEST(Panels, MenusRunCommands) {
    Window w;
    w.click("menu.view");
    w.change_view("menu_view");
    w.click("menu.view.top");
    EXPECT_EQ(w.session.view().camera.preset, CameraPreset::top);
    w.click("menu.tree");
    w.click("menu.tree.kind");
    w.change_view("menu_tree");
    w.click("menu.tree.kind.hybrid1");
    EXPECT_EQ(w.session.scene().fit.tree, mobb::TreeKind::hybrid1);
    w.click("menu.search");
    EXPECT_EQ(w.session.dialog, Dialog::palette);
}

TEST(Panels, OpeningByKeysAlone) {
    Window w;
    w.key("Ctrl+O");
    ASSERT_EQ(w.session.dialog, Dialog::open);
    EXPECT_EQ(w.session.input.text, w.folder.scene.parent_path().string() + "/");
    w.change_view("open");
    w.type("wa");
    w.key("Tab");
    EXPECT_TRUE(w.session.input.text.ends_with("/walk.csv")) << w.session.input.text;
    w.key("Enter");
    EXPECT_EQ(w.session.dialog, Dialog::none);
    EXPECT_EQ(w.session.title(), "walk");
    EXPECT_EQ(all_messages(w.session), "");
}

TEST(Panels, OpeningByTheList) {
    Window w;
    w.key("Ctrl+O");
    w.key("Down");
    w.key("Enter");
    EXPECT_EQ(w.session.title(), "stand") << "scene.json, stand.csv, walk.csv";
}

TEST(Panels, WhatCannotBeOpenedIsSaidOverTheDialog) {
    Window w;
    w.folder.write("broken.json", "{");
    w.key("Ctrl+O");
    w.type("broken.json");
    w.key("Enter");
    EXPECT_EQ(w.session.title(), "scene.json");
    ASSERT_EQ(w.session.messages().size(), 1u);
    w.change_view("message");
    w.click("message.0.dismiss");
    EXPECT_TRUE(w.session.messages().empty());
}

TEST(Panels, OverwritingAsks) {
    Window w;
    w.folder.write("there.json", "old");
    w.key("Ctrl+Shift+S");
    w.session.input.set_text(w.folder.file("there").string());
    w.window.settle();
    w.key("Enter");
    EXPECT_EQ(w.session.dialog, Dialog::save_as);
    w.change_view("overwrite");
    EXPECT_EQ(mobbscope::testing::slurp(w.folder.file("there.json")), "old");
    w.key("Enter");
    EXPECT_EQ(all_messages(w.session), "Saved " + w.folder.file("there.json").string() + "\n");
    EXPECT_EQ(w.session.dialog, Dialog::none);
    EXPECT_EQ(w.session.title(), "there.json");
}

TEST(Panels, UnsavedChangesAreAskedAbout) {
    Window w;
    run_command(w.session, "go.agent", "A");
    run_command(w.session, "agent.nudge", "1 0");
    w.key("Ctrl+Q");
    w.change_view("unsaved");
    w.click("unsaved.cancel");
    EXPECT_FALSE(w.session.closed());
    w.key("Ctrl+Q");
    w.click("unsaved.save");
    EXPECT_TRUE(w.session.closed());
    EXPECT_FALSE(w.session.modified());
}

TEST(Panels, InfoGoesByItselfAndErrorsStay) {
    Window w;
    w.session.tell(Message::Level::info, "Saved it");
    w.session.tell(Message::Level::error, "This went wrong");
    w.window.run_for(3.5);
    EXPECT_EQ(w.session.messages().size(), 2u);
    w.window.run_for(1);
    ASSERT_EQ(w.session.messages().size(), 1u);
    w.key("Escape");
    EXPECT_TRUE(w.session.messages().empty());
}

TEST(Panels, TheHelpSheetOpensAndCloses) {
    Window w;
    w.key("F1");
    EXPECT_TRUE(w.has("help.close"));
    w.change_view("help");
    w.key("Escape");
    EXPECT_EQ(w.session.dialog, Dialog::none);
    run_command(w.session, "help.about");
    w.window.settle();
    w.change_view("about");
    w.click("about.close");
    EXPECT_EQ(w.session.dialog, Dialog::none);
}

TEST(Panels, NothingIsCutOffAtAnySize) {
    for (const auto& [size, scale] :
         {std::pair{PictureSize{1024, 640}, 1.0}, {{1024, 640}, 2.0}, {{2560, 1440}, 2.0}}) {
        for (const char* command : {"", "help.shortcuts", "help.about", "file.open", "file.save_as", "go.palette"}) {
            SCOPED_TRACE(std::string(command) + " at " + std::to_string(size.width) + ", scale " +
                         std::to_string(scale));
            Window w(size, scale);
            if (*command) run_command(w.session, command);
            w.window.settle();
            w.expect_inside();
            EXPECT_TRUE(w.has("menu.title"));
            w.change_view(std::string("at_") + std::to_string(size.width) + "_" +
                          std::to_string(static_cast<int>(scale)) + command);
        }
    }
}

TEST(Panels, AnEmptyWindowSaysWhatToDo) {
    Session session(false);
    HeadlessWindow window(GlContext::open(Backend::automatic), session, {1024, 640}, 1);
    window.settle();
    for (const Key key : {Key::f5, Key::space, Key::f, Key::right, Key::d, Key::home}) {
        window.shell().feed(KeyPress{key, true});
        window.shell().feed(KeyPress{key, false});
        window.settle();
    }
    EXPECT_EQ(all_messages(session), "");
    const auto at = window.shell().marks().all().find("welcome.demo");
    ASSERT_NE(at, window.shell().marks().all().end());
    window.shell().feed(MouseMove{at->second.center()});
    window.shell().feed(MouseButton{0, true});
    window.shell().feed(MouseButton{0, false});
    window.settle();
    EXPECT_FALSE(session.empty());
}

}  // namespace
}  // namespace mobbscope::app
