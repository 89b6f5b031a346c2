// Menus, palette, dialogs and messages in the window, by keys and clicks.
#include <app/commands/camera_commands.h>
#include <app/ui/style.h>
#include <app/window/headless_window.h>
#include <render/drawlist/camera.h>
#include <render/drawlist/view_projection.h>
#include <render/gl/gl_context.h>
#include <render/image/png.h>
#include <render/pictures/build_draw_list.h>

#include "app/folder_window.h"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <vector>

namespace mobbscope::app {
namespace {

struct Window : FolderWindow<CrossingFolder> {
    PictureSize size;

    explicit Window(PictureSize of = {1024, 640}, double scale = 1) : FolderWindow(of, scale), size(of) {
        open(folder.scene);
    }

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
        ASSERT_EQ(w.session.workspace.scene().agents.size(), left);
        EXPECT_EQ(w.session.workspace.selection, Selection{});
    }
    EXPECT_EQ(w.session.workspace.scene().agents[0].name, "C");
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
    ASSERT_TRUE(w.session.workspace.history.undo_title().starts_with("moving"));
    for (int i = 0; i < 3; ++i) w.key("Ctrl+Z");
    EXPECT_EQ(w.session.workspace.scene().agents.size(), 4u);
    shell.feed(MouseMove{at + glm::vec2(60, 0)});
    shell.feed(MouseButton{0, false});
    w.window.settle();
    w.key("Ctrl+Z");
    EXPECT_EQ(w.session.workspace.history.redo_title().substr(0, 6), "moving");
    EXPECT_EQ(w.session.workspace.scene().agents.size(), 4u);
}

/// A click on the panel itself folds it; neither the camera nor the selection notices.
TEST(Panels, OverlaysFoldByAClick) {
    Window w({1440, 900});
    run_command(w.session, "query.select", "0");
    run_command(w.session, "time.at", "1");
    run_command(w.session, "view.past", "all");
    run_command(w.session, "go.agent", "A");
    w.window.settle();
    const Camera camera = w.session.workspace.view().camera;
    const auto overlay = [&](Overlay::Kind kind) {
        const auto& all = w.window.shell().shown()->overlays;
        return *std::ranges::find(all, kind, &Overlay::kind);
    };
    const std::vector<std::pair<std::string, Overlay::Kind>> panels{{"overlay.caption", Overlay::Kind::caption},
                                                                    {"overlay.legend", Overlay::Kind::legend},
                                                                    {"overlay.inset", Overlay::Kind::inset}};
    for (const auto& [mark, kind] : panels) {
        EXPECT_FALSE(overlay(kind).folded) << mark;
        w.click(mark);
        EXPECT_TRUE(overlay(kind).folded) << mark;
    }
    EXPECT_TRUE(w.session.workspace.view().fold_caption && w.session.workspace.view().fold_legend &&
                w.session.workspace.view().fold_inset);
    for (const auto& [mark, kind] : panels) {
        w.click(mark);
        EXPECT_FALSE(overlay(kind).folded) << mark;
    }
    const float before = overlay(Overlay::Kind::legend).rect.size().y;
    w.click("overlay.legend.more");
    EXPECT_TRUE(w.session.workspace.view().whole_legend);
    EXPECT_GT(overlay(Overlay::Kind::legend).rect.size().y, before);
    w.click("overlay.legend.more");
    EXPECT_EQ(overlay(Overlay::Kind::legend).rect.size().y, before);
    EXPECT_EQ(w.session.workspace.view().camera, camera);
    EXPECT_EQ(w.session.workspace.selection, (Selection{Selection::Kind::path, {0, -1, 0}, -1}));

    // What lies behind a panel is neither pointed at nor selected through it.
    const Rect legend = overlay(Overlay::Kind::legend).rect;
    const glm::vec2 at = w.window.shell().marks().all().at("viewport").min + legend.center();
    w.window.shell().feed(MouseMove{at});
    w.window.settle();
    EXPECT_EQ(w.session.workspace.hovered, Selection{});
    w.window.shell().feed(MouseButton{0, true});
    w.window.shell().feed(MouseButton{0, false});
    w.window.settle();
    EXPECT_EQ(w.session.workspace.selection, (Selection{Selection::Kind::path, {0, -1, 0}, -1}));
    EXPECT_FALSE(w.session.workspace.view().fold_legend) << "only its chevron folds it";
}

TEST(Panels, AMomentIsWalkedThroughAndHasNoHandles) {
    Window w;
    run_command(w.session, "go.agent", "A");
    w.window.settle();
    ASSERT_TRUE(w.has("handle.move"));
    const Camera in_space_time = w.session.workspace.view().camera;
    ASSERT_TRUE(in_space_time.target) << "what framed the scene stands";
    w.key("M");
    ASSERT_EQ(w.session.workspace.view().show, Show::moment);
    EXPECT_FALSE(w.has("handle.move")) << "they stand where a path begins, in space-time";
    // What the viewport shows is what is picked: a click on a wall selects the sample that holds then.
    run_command(w.session, "time.at", "1.2");
    w.window.settle();
    w.change_view("moment");
    const DrawList list =
        build_draw_list(w.session.workspace.fitted(), w.session.workspace.view(), w.session.views.picture->size);
    ASSERT_FALSE(list.disks.empty());
    const DiskInstance& disk = list.disks.front();
    const auto pixel = list.projection.project(disk.base + glm::vec3(0, 0, 0.9f));
    ASSERT_TRUE(pixel);
    const glm::vec2 at = w.window.shell().marks().all().at("viewport").min + *pixel;
    w.window.shell().feed(MouseMove{at});
    w.window.shell().feed(MouseButton{0, true});
    w.window.shell().feed(MouseButton{0, false});
    w.window.settle();
    EXPECT_EQ(w.session.workspace.selection.kind, Selection::Kind::sample);
    EXPECT_EQ(w.session.workspace.selection.index, disk.id.index);
    // Dragging turns the camera; time keeps the height that it has in space-time.
    const double time_height = w.session.workspace.view().time_height;
    w.window.shell().feed(MouseMove{at});
    w.window.shell().feed(MouseButton{0, true});
    w.window.shell().feed(MouseMove{at + glm::vec2(60, 20)});
    w.window.shell().feed(MouseButton{0, false});
    w.window.settle();
    EXPECT_TRUE(w.session.workspace.view().camera.target);
    EXPECT_EQ(w.session.workspace.view().time_height, time_height);
    w.key("M");
    EXPECT_EQ(w.session.workspace.view().show, Show::space_time);
    EXPECT_EQ(w.session.workspace.view().camera, in_space_time) << "each picture has its own camera";
}

TEST(StillCamera, NothingThatIsShownMovesIt) {
    Window w;
    const Camera opened = w.session.workspace.view().camera;
    ASSERT_TRUE(opened.target) << "it frames the scene once";
    const double time_height = w.session.workspace.view().time_height;
    EXPECT_GT(time_height, 0);
    EXPECT_FALSE(w.session.workspace.history.can_undo()) << "framing is not a step of its own";
    const auto expect_still = [&](const std::string& after) {
        EXPECT_EQ(w.session.workspace.view().camera, opened) << after;
        EXPECT_EQ(w.session.workspace.view().time_height, time_height) << after;
    };
    for (const std::string key : {"]", "[", "E", ".", ","}) {
        w.key(key);
        expect_still(key);
    }
    run_command(w.session, "query.select", "0");
    w.window.settle();
    expect_still("a query");
    for (const std::string key : {"Shift+Left", "Right", "Right", "Shift+Right", "Left", "S", "O"}) {
        w.key(key);
        expect_still(key);
    }
    const mobb::TreeKind before = w.session.workspace.fitted().options().tree;
    run_command(w.session, "tree.kind", before == mobb::TreeKind::umobb ? "mobb" : "umobb");
    w.window.settle();
    expect_still("another kind of tree");
    run_command(w.session, "go.agent", "B");
    w.window.settle();
    expect_still("a selection");
    run_command(w.session, "query.none");
    w.window.settle();
    expect_still("no query");
}

/// The camera that frames the window's view by itself.
Camera framing_of(const Window& w) {
    ViewState view = w.session.workspace.view();
    view.camera = without_target(view.camera);
    const PictureOptions options{.size = w.session.views.picture->size, .controls = true};
    return build_draw_list(w.session.workspace.fitted(), view, options).camera;
}

/// Its direction apart.
void expect_framed(const Window& w) {
    const Camera camera = w.session.workspace.view().camera, expected = framing_of(w);
    EXPECT_EQ(camera.target, expected.target);
    EXPECT_EQ(camera.distance, expected.distance);
    EXPECT_EQ(camera.shift, expected.shift);
}

TEST(StillCamera, ItFramesAgainWhenTheWindowIsResizedUntilItIsMoved) {
    Window w;
    const auto resize = [&](PictureSize size) {
        w.window.resize(size);
        w.window.settle();
    };
    const auto camera = [&] { return w.session.workspace.view().camera; };
    const Camera opened = camera();
    expect_framed(w);
    resize({900, 800});
    EXPECT_NE(camera(), opened);
    expect_framed(w);
    EXPECT_FALSE(w.session.workspace.history.can_undo());
    // Turned it still holds the whole.
    const Camera narrow = camera();
    run_command(w.session, "view.orbit", "20 0");
    w.window.settle();
    EXPECT_EQ(camera().target, narrow.target);
    resize({1300, 700});
    expect_framed(w);
    // The picture of a moment has a camera of its own.
    w.key("M");
    w.key("M");
    resize({1000, 900});
    expect_framed(w);
    run_command(w.session, "view.pan", "5 0");
    w.window.settle();
    const Camera moved = camera();
    resize({1300, 700});
    EXPECT_EQ(camera().target, moved.target);
    w.key("Home");
    w.window.settle();
    resize({1200, 800});
    expect_framed(w);
}

TEST(StillCamera, AMovedOneKeepsItsScaleWhenTheWindowIsResized) {
    Window w;
    run_command(w.session, "query.select", "0");
    w.window.settle();
    w.key("Shift+Right");
    const Camera opened = w.session.workspace.view().camera;
    w.key("F");
    EXPECT_LT(w.session.workspace.view().camera.distance, 0.9 * opened.distance) << "the pair under test";
    w.key("Home");
    run_command(w.session, "view.zoom", "1.5");
    w.window.settle();
    const Camera near = w.session.workspace.view().camera;
    const auto pixels = [&] {
        const DrawList list =
            build_draw_list(w.session.workspace.fitted(), w.session.workspace.view(), w.session.views.picture->size);
        return list.projection.pixels_per_metre(list.space.from_target(*w.session.workspace.view().camera.target));
    };
    const float scale = pixels();
    const int height = w.session.views.picture->size.height;
    w.window.resize({900, 800});
    w.window.settle();
    ASSERT_NE(w.session.views.picture->size.height, height);
    EXPECT_EQ(w.session.workspace.view().camera.target, near.target);
    EXPECT_NEAR(pixels(), scale, 1e-3 * scale);
    w.session.edits.previous_view();
    w.window.settle();
    EXPECT_NE(w.session.workspace.view().camera.distance, near.distance);
    expect_framed(w);
}

TEST(StillCamera, HomeFindsAnotherHeightOfASecondUnlessOneWasChosen) {
    Window w;
    const double opened = w.session.workspace.view().time_height;
    run_command(w.session, "go.agent", "A");
    run_command(w.session, "agent.move", "300 0");
    w.window.settle();
    EXPECT_EQ(w.session.workspace.view().time_height, opened) << "an edit moves nothing";
    w.key("Home");
    w.window.settle();
    EXPECT_GT(w.session.workspace.view().time_height, 5 * opened) << "about as tall as wide again";
    run_command(w.session, "view.time_height", "2");
    w.key("Home");
    w.window.settle();
    EXPECT_EQ(w.session.workspace.view().time_height, 2);
}

TEST(StillCamera, ASplitQueryIsAsFarOnInBothHalves) {
    Window w;
    run_command(w.session, "query.select", "0");
    run_command(w.session, "step.last");
    run_command(w.session, "view.split");
    w.window.settle();
    ASSERT_EQ(w.session.views.count(), 2u);
    for (std::size_t place : {0u, 1u}) {
        const SceneView seen = w.session.views.at(place);
        EXPECT_NO_THROW(build_draw_list(*seen.fitted, seen.view, PictureSize{400, 300})) << place;
    }
}

TEST(StillCamera, ItFollowsTheTestWhereThatIsAskedFor) {
    Window w;
    run_command(w.session, "query.select", "0");
    w.window.settle();
    w.key("Shift+Left");
    run_command(w.session, "view.zoom", "6");
    w.window.settle();
    const Camera near = w.session.workspace.view().camera;
    w.key("Shift+Right");
    EXPECT_EQ(w.session.workspace.view().camera, near);
    run_command(w.session, "view.follow_test");
    w.window.settle();
    EXPECT_NE(w.session.workspace.view().camera, near) << "the last pair was not in the picture";
    const Camera there = w.session.workspace.view().camera;
    run_command(w.session, "view.orbit", "10 0");
    w.window.settle();
    EXPECT_NE(w.session.workspace.view().camera, there) << "a hand is not overruled";
}

TEST(StillCamera, FollowingATestHasItBesideThePanelsAndDoesNotWander) {
    for (const PictureSize size : {PictureSize{1280, 800}, PictureSize{1024, 640}}) {
        Window w(size);
        run_command(w.session, "query.select", "0");
        run_command(w.session, "step.first");
        run_command(w.session, "view.follow_test");
        w.window.settle();
        int flights = 0;
        const int steps = w.session.workspace.recorded()->trace.size();
        for (int step = 0; step < steps; ++step) {
            run_command(w.session, "step.to", std::to_string(step));
            const Camera before = w.session.workspace.view().camera;
            w.window.settle();
            flights += w.session.workspace.view().camera == before ? 0 : 1;
            const DrawList& shown = *w.window.shell().shown();
            std::vector<Rect> panels;
            for (const Overlay& overlay : shown.overlays) panels.push_back(overlay.rect);
            ASSERT_FALSE(panels.empty());
            EXPECT_TRUE(is_well_seen(*corners_of_test(w.session.workspace), shown, panels)) << "step " << step;
        }
        EXPECT_GT(flights, 0);
        EXPECT_LT(3 * flights, steps) << "a camera that flies at every step shows nothing";
    }
}

TEST(StillCamera, ABoxThatIsCutOffOrBelowAPanelIsNotWellSeen) {
    Window w({1280, 800});
    run_command(w.session, "query.select", "0");
    run_command(w.session, "step.to", "3");
    w.window.settle();
    const DrawList& shown = *w.window.shell().shown();
    const TestCorners boxes = *corners_of_test(w.session.workspace);
    const auto at = [&](const glm::dvec3& p) { return *shown.projection.project(shown.space.point(p.x, p.y, p.z)); };
    glm::vec2 low(1e6f);
    glm::vec2 high(-1e6f);
    for (const auto& box : boxes) {
        for (const glm::dvec3& corner : box) {
            low = glm::min(low, at(corner));
            high = glm::max(high, at(corner));
        }
    }
    ASSERT_TRUE(is_well_seen(boxes, shown, {}));
    const Rect corner{at(boxes[0][0]) - 2.0f, at(boxes[0][0]) + 2.0f};
    EXPECT_FALSE(is_well_seen(boxes, shown, std::array{corner})) << "a panel over a corner";
    EXPECT_TRUE(is_well_seen(boxes, shown, std::array{Rect{low - 30.0f, {high.x, low.y - 1}}})) << "beside it";
    PictureFrame cut = shown;
    cut.size.width = static_cast<int>(high.x - 1);
    EXPECT_FALSE(is_well_seen(boxes, cut, {})) << "cut off at the edge";
    PictureFrame far = shown;
    far.size = {20000, 20000};
    EXPECT_FALSE(is_well_seen(boxes, far, {})) << "small";
}

TEST(Panels, TheCameraGoesOnFromWhatKeysHaveMade) {
    Window w;
    w.window.shell().feed(KeyPress{Key::n2, true});
    w.window.shell().feed(KeyPress{Key::equal, true});
    w.window.settle();
    EXPECT_NEAR(orientation(w.session.workspace.view().camera).pitch_deg, 90, 1e-9) << "from above, and nearer";
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
    EXPECT_EQ(w.session.workspace.scene().agents[0].name, name + "!");
}

TEST(Panels, ThePaletteRunsWhatWasTyped) {
    Window w;
    w.key("Ctrl+P");
    ASSERT_EQ(w.session.dialogs.now, Dialog::palette);
    w.change_view("palette");
    w.type("tk umobb");
    w.change_view("palette_typed");
    w.key("Enter");
    EXPECT_EQ(w.session.dialogs.now, Dialog::none);
    EXPECT_EQ(w.session.workspace.scene().fit.tree, mobb::TreeKind::umobb);
}

TEST(Panels, ThePaletteGoesThroughItsListAndAsksForArguments) {
    Window w;
    w.key("Ctrl+P");
    w.type("samples in a leaf");
    w.key("Enter");
    ASSERT_EQ(w.session.dialogs.now, Dialog::palette);
    EXPECT_EQ(w.session.dialogs.input.command, "tree.leaf");
    w.change_view("palette_argument");
    w.type("7");
    w.key("Enter");
    EXPECT_EQ(w.session.workspace.scene().fit.leaf, 7);
    w.key("Ctrl+P");
    w.type("theme");
    w.key("Enter");
    ASSERT_EQ(w.session.dialogs.input.command, "view.theme");
    w.key("Down");
    w.key("Enter");
    EXPECT_EQ(w.session.workspace.view().theme, Theme::light);
    w.key("Ctrl+P");
    w.type("theme");
    w.key("Enter");
    EXPECT_EQ(w.session.dialogs.input.picked, 1) << "it begins with what is chosen";
    w.key("Up");
    w.key("Enter");
    EXPECT_EQ(w.session.workspace.view().theme, Theme::dark);
    w.key("Ctrl+P");
    w.key("Escape");
    EXPECT_EQ(w.session.dialogs.now, Dialog::none);
}

TEST(Panels, MenusRunCommands) {
    Window w;
    w.click("menu.view");
    w.change_view("menu_view");
    w.click("menu.view.top");
    EXPECT_EQ(w.session.workspace.view().camera.preset, CameraPreset::top);
    w.click("menu.tree");
    w.click("menu.tree.kind");
    w.change_view("menu_tree");
    w.click("menu.tree.kind.hybrid1");
    EXPECT_EQ(w.session.workspace.scene().fit.tree, mobb::TreeKind::hybrid1);
    w.click("menu.search");
    EXPECT_EQ(w.session.dialogs.now, Dialog::palette);
}

TEST(Panels, OpeningByKeysAlone) {
    Window w;
    w.key("Ctrl+O");
    ASSERT_EQ(w.session.dialogs.now, Dialog::open);
    EXPECT_EQ(w.session.dialogs.browser.way().back(), w.folder.scene.parent_path()) << "where one was last";
    w.change_view("open");
    w.type("wa");
    w.key("Tab");
    EXPECT_EQ(w.session.dialogs.input.text, "walk.csv");
    w.key("Enter");
    EXPECT_EQ(w.session.dialogs.now, Dialog::none);
    EXPECT_EQ(w.session.workspace.title(), "walk");
    EXPECT_EQ(all_messages(w.session), "");
}

TEST(Panels, OpeningByTheList) {
    Window w;
    w.key("Ctrl+O");
    w.key("Down");
    w.key("Enter");
    EXPECT_EQ(w.session.workspace.title(), "stand") << "scene.json, stand.csv, walk.csv";
}

TEST(Panels, SeveralAreOpenedByTheDialogAlone) {
    Window w;
    w.key("Ctrl+O");
    w.key("Down");
    w.key("Shift+Down");
    EXPECT_EQ(w.session.dialogs.browser.chosen_count(), 2u);
    w.change_view("open_several");
    w.key("Enter");
    EXPECT_EQ(w.session.dialogs.now, Dialog::none);
    EXPECT_EQ(w.session.workspace.scene().clips.size(), 2u);
    EXPECT_TRUE(w.session.workspace.scene().agents.empty());
    // And by the mouse: a click keeps the list, one with Ctrl adds to what is chosen.
    w.key("Ctrl+O");
    w.click("open.entry.stand.csv");
    EXPECT_TRUE(w.has("open.entry.walk.csv"));
    EXPECT_EQ(w.session.dialogs.browser.entries().size(), 3u);
    w.window.shell().feed(KeyPress{Key::ctrl, true});
    w.click("open.entry.scene.json");
    w.window.shell().feed(KeyPress{Key::ctrl, false});
    EXPECT_EQ(w.session.dialogs.browser.chosen_count(), 2u);
    w.click("open.ok");
    EXPECT_EQ(w.session.workspace.scene().clips.size(), 3u);
    // In a folder that was typed too.
    w.key("Ctrl+O");
    w.type(w.folder.scene.parent_path().string() + "/");
    w.key("Down");
    w.key("Shift+Down");
    w.key("Enter");
    EXPECT_EQ(w.session.workspace.scene().clips.size(), 2u);
    w.key("Ctrl+O");
    w.key("Ctrl+A");
    w.key("Enter");
    EXPECT_EQ(w.session.workspace.scene().clips.size(), 4u) << "all that is listed";
}

TEST(Panels, TheDialogGoesUpAndIntoFolders) {
    Window w;
    std::filesystem::create_directory(w.folder.file("deep"));
    w.folder.write("deep/other.csv", slurp(w.folder.file("walk.csv")));
    w.key("Ctrl+O");
    w.type("deep");
    w.key("Enter");
    EXPECT_EQ(w.session.dialogs.browser.way().back(), w.folder.file("deep"));
    EXPECT_EQ(w.session.dialogs.input.text, "");
    w.key("Backspace");
    EXPECT_EQ(w.session.dialogs.browser.way().back(), w.folder.scene.parent_path());
    w.key("Enter");
    EXPECT_EQ(w.session.dialogs.browser.way().back(), w.folder.file("deep")) << "the cursor was on where one came from";
    w.click("open.up");
    w.click("open.crumb.1");
    EXPECT_EQ(w.session.dialogs.browser.way().back(), w.folder.scene.parent_path().parent_path());
    w.key("Escape");
    w.key("Ctrl+O");
    EXPECT_EQ(w.session.dialogs.browser.way().back(), w.folder.scene.parent_path().parent_path()) << "where one was";
    w.type(w.folder.file("deep").string());
    w.key("Enter");
    w.click("open.folder");
    EXPECT_EQ(w.session.workspace.scene().clips.size(), 1u);
    EXPECT_EQ(w.session.workspace.scene().clips[0].name, "other");
}

TEST(Panels, TheHeadsOfTheListOrderIt) {
    Window w;
    std::filesystem::last_write_time(w.folder.file("walk.csv"),
                                     std::filesystem::file_time_type::clock::now() + std::chrono::hours(1));
    w.key("Ctrl+O");
    w.click("open.order.date");
    EXPECT_EQ(w.session.dialogs.browser.entries().front().name, "walk.csv") << "the latest first";
    w.click("open.order.date");
    EXPECT_EQ(w.session.dialogs.browser.entries().back().name, "walk.csv");
    w.key("Ctrl+1");
    EXPECT_EQ(w.session.dialogs.browser.entries().front().name, "scene.json");
    w.key("Ctrl+3");
    EXPECT_EQ(w.session.settings.file_order, "-date");
}

TEST(Panels, AClickOnAFileNamesTheOneToBeWritten) {
    Window w;
    w.key("Ctrl+Shift+S");
    EXPECT_EQ(w.session.dialogs.input.text, "scene.json");
    w.folder.write("there.json", "old");
    w.key("Escape");
    w.key("Ctrl+Shift+S");
    w.click("save.entry.there.json");
    EXPECT_EQ(w.session.dialogs.input.text, "there.json");
    EXPECT_TRUE(w.has("save.entry.scene.json")) << "the list stays";
    w.click("save.ok");
    EXPECT_TRUE(w.session.dialogs.input.confirming);
    w.key("Escape");
    EXPECT_EQ(slurp(w.folder.file("there.json")), "old");
}

TEST(Panels, WhatCannotBeOpenedIsSaidOverTheDialog) {
    Window w;
    w.folder.write("broken.json", "{");
    w.key("Ctrl+O");
    w.type("broken.json");
    w.key("Enter");
    EXPECT_EQ(w.session.workspace.title(), "scene.json");
    ASSERT_EQ(w.session.notifications.all().size(), 1u);
    w.change_view("message");
    w.click("message.0.dismiss");
    EXPECT_TRUE(w.session.notifications.all().empty());
}

TEST(Panels, OverwritingAsks) {
    Window w;
    w.folder.write("there.json", "old");
    w.key("Ctrl+Shift+S");
    w.session.dialogs.input.set_text(w.folder.file("there").string());
    w.window.settle();
    w.key("Enter");
    EXPECT_EQ(w.session.dialogs.now, Dialog::save_as);
    w.change_view("overwrite");
    EXPECT_EQ(slurp(w.folder.file("there.json")), "old");
    w.key("Enter");
    EXPECT_EQ(all_messages(w.session), "Saved " + w.folder.file("there.json").string() + "\n");
    EXPECT_EQ(w.session.dialogs.now, Dialog::none);
    EXPECT_EQ(w.session.workspace.title(), "there.json");
}

TEST(Panels, UnsavedChangesAreAskedAbout) {
    Window w;
    run_command(w.session, "go.agent", "A");
    run_command(w.session, "agent.nudge", "1 0");
    w.key("Ctrl+Q");
    w.change_view("unsaved");
    w.click("unsaved.cancel");
    EXPECT_FALSE(w.session.files.closed());
    w.key("Ctrl+Q");
    w.click("unsaved.save");
    EXPECT_TRUE(w.session.files.closed());
    EXPECT_FALSE(w.session.workspace.modified());
}

TEST(Panels, MessagesGoBehindTheBellWhereTheyAreRead) {
    Window w;
    w.session.notifications.tell(MessageLevel::info, "Saved it");
    w.session.notifications.tell(MessageLevel::error, "This went wrong");
    const auto up = [&] { return std::ranges::count(w.session.notifications.all(), true, &Message::up); };
    w.window.run_for(3.5);
    EXPECT_EQ(up(), 2);
    w.window.run_for(1);
    EXPECT_EQ(up(), 1) << "what was only done goes first";
    w.change_view("bell");
    w.window.run_for(6.5);
    EXPECT_EQ(up(), 0);
    EXPECT_FALSE(w.has("message.1"));
    EXPECT_EQ(w.session.notifications.unread(), 1u) << "nobody has opened the list";
    w.click("menu.bell");
    EXPECT_EQ(w.session.dialogs.now, Dialog::messages);
    EXPECT_EQ(w.session.notifications.unread(), 0u);
    w.change_view("message_list");
    TestDesktop desktop;
    w.session.desktop = &desktop;
    w.click("messages.0.copy");
    EXPECT_EQ(desktop.text, "This went wrong") << "the latest stands first";
    w.click("messages.0.dismiss");
    ASSERT_EQ(all_messages(w.session), "Saved it\n");
    w.key("Delete");
    EXPECT_TRUE(w.session.notifications.all().empty());
    w.key("Escape");
    EXPECT_EQ(w.session.dialogs.now, Dialog::none);
}

TEST(Panels, MessagesCoverNeitherLegendNorCaption) {
    for (const PictureSize size : {PictureSize{1024, 700}, {1280, 800}, {800, 600}}) {
        SCOPED_TRACE(size.width);
        Window w(size);
        run_command(w.session, "query.select", "0");
        run_command(w.session, "step.last");
        const std::string path = "/home/somebody/" + std::string(40, 'x') + "/a/long/way/" + std::string(40, 'y');
        for (int i = 0; i < 3; ++i) {
            w.session.notifications.tell(MessageLevel::error,
                                         "Saved " + path + '/' + std::to_string(i) + "/crossing.json");
        }
        w.window.run_for(0.2);
        const Rect viewport = w.window.shell().marks().all().at("viewport");
        // In a small picture only the latest have room.
        EXPECT_TRUE(w.has("message.2"));
        EXPECT_EQ(w.has("message.0"), size.width > 800);
        for (int i = 0; i < 3; ++i) {
            if (!w.has("message." + std::to_string(i))) continue;
            const Rect message = w.window.shell().marks().all().at("message." + std::to_string(i));
            EXPECT_LT(message.max.y - message.min.y, size.width > 800 ? 40 : 60) << "a long path loses its middle";
            EXPECT_TRUE(viewport.contains(message)) << "they hide nothing of timeline and tests";
            for (const Overlay& overlay : w.window.shell().shown()->overlays) {
                const Rect lies{viewport.min + overlay.rect.min, viewport.min + overlay.rect.max};
                const bool apart = message.min.x >= lies.max.x || message.max.x <= lies.min.x ||
                                   message.min.y >= lies.max.y || message.max.y <= lies.min.y;
                EXPECT_TRUE(apart) << i;
            }
        }
    }
}

TEST(Panels, SeveralMessagesAreCountedAndListedByOneClick) {
    Window w;
    for (const char* text : {"The unit was guessed", "The root was guessed", "Frames are missing", "It is a T-pose"}) {
        w.session.notifications.tell(MessageLevel::warning, text);
    }
    w.window.run_for(0.2);
    EXPECT_TRUE(w.has("message.3"));
    EXPECT_FALSE(w.has("message.0")) << "three lie over the picture";
    w.change_view("counted");
    w.click("message.all");
    EXPECT_EQ(w.session.dialogs.now, Dialog::messages);
    EXPECT_TRUE(w.has("messages.3"));
    EXPECT_FALSE(w.has("message.all"));
}

TEST(Panels, MessagesStayWhileTheMouseIsOnThem) {
    Window w;
    w.session.notifications.tell(MessageLevel::info, "Saved it");
    w.window.run_for(0.2);
    w.window.shell().feed(MouseMove{w.window.shell().marks().all().at("message.0").center()});
    w.window.run_for(8);
    EXPECT_TRUE(w.has("message.0"));
    w.window.shell().feed(MouseMove{{300, 200}});
    w.window.run_for(2.5);
    EXPECT_FALSE(w.has("message.0"));
}

TEST(Panels, EscapePutsErrorsAwayBeforeItLeavesTheQuery) {
    Window w;
    run_command(w.session, "query.select", "0");
    w.session.notifications.tell(MessageLevel::error, "This went wrong");
    w.window.settle();
    w.key("Escape");
    EXPECT_FALSE(w.has("message.0"));
    EXPECT_EQ(w.session.workspace.view().query, 0);
    EXPECT_EQ(w.session.notifications.unread(), 1u);
}

TEST(Panels, WhatAMessageOffersIsAButton) {
    Window w;
    w.session.notifications.tell(MessageLevel::warning, "The unit was guessed", {{"view.top", "", "Look from above"}});
    w.window.run_for(0.2);
    w.change_view("offer");
    w.click("message.0.offer");
    EXPECT_EQ(w.session.workspace.view().camera.preset, CameraPreset::top);
    EXPECT_FALSE(w.has("message.0"));
    w.key("F8");
    w.click("messages.0.offer");
    EXPECT_EQ(w.session.dialogs.now, Dialog::none);
    run_command(w.session, "file.demo");
    EXPECT_TRUE(w.session.notifications.all()[0].offers.empty()) << "it was about what was open";
}

TEST(Panels, TheHelpSheetOpensAndCloses) {
    Window w;
    w.key("F1");
    EXPECT_TRUE(w.has("help.close"));
    w.change_view("help");
    w.key("Escape");
    EXPECT_EQ(w.session.dialogs.now, Dialog::none);
    run_command(w.session, "help.about");
    w.window.settle();
    w.change_view("about");
    w.click("about.close");
    EXPECT_EQ(w.session.dialogs.now, Dialog::none);
}

TEST(Panels, NothingIsCutOffAtAnySize) {
    for (const auto& [size, scale] :
         {std::pair{PictureSize{1024, 640}, 1.0}, {{1024, 640}, 2.0}, {{2560, 1440}, 2.0}}) {
        for (const char* command :
             {"", "help.shortcuts", "help.about", "help.messages", "file.open", "file.save_as", "go.palette"}) {
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
    EXPECT_FALSE(session.workspace.empty());
}

}  // namespace
}  // namespace mobbscope::app
