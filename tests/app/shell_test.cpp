// The window without its frame, on every backend.
#include <app/script/script.h>
#include <app/window/headless_window.h>
#include <app/window/window_gl.h>
#include <base/error.h>
#include <render/drawlist/picture_options.h>
#include <render/gl/renderer.h>
#include <render/image/png.h>
#include <render/parts/highlights.h>
#include <render/pictures/build_draw_list.h>
#include <scene/load_files.h>

#include <support/temp_folder.h>

#include "render/backends.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <string>

namespace mobbscope::app {
namespace {

constexpr PictureSize kSize{800, 500};

class ShellTest : public ::testing::TestWithParam<Backend> {
  protected:
    void SetUp() override {
        if (!has_or_skip(GetParam())) return;
        window = std::make_unique<HeadlessWindow>(GlContext::open(GetParam()), session, kSize, 1);
        session.files.open_demo();
        window->settle();
    }

    std::string run(const std::string& script) {
        std::ostringstream out;
        Script::parse(script, "test").run(session, *window, out);
        return out.str();
    }

    void hover_over_a_disk() {
        const DrawList& list = *window->shell().shown();
        const DiskInstance& disk = list.disks[3];
        const glm::vec2 pixel = list.projection.project(disk.base + glm::vec3(0, 0, 0.5f * disk.height())).value();
        window->shell().feed(MouseMove{window->shell().marks().all().at("viewport").min + pixel});
        window->settle();
        ASSERT_TRUE(session.workspace.hovered.on_path());
    }

    Session session{false};
    std::unique_ptr<HeadlessWindow> window;
};

TEST_P(ShellTest, AFrameIsDrawn) {
    const Image image = window->shell().read_back();
    ASSERT_EQ(image.width, kSize.width);
    std::set<std::uint32_t> colors;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const std::uint8_t* pixel = image.at(x, y);
            ASSERT_EQ(pixel[3], 255) << x << ' ' << y;
            colors.insert(static_cast<std::uint32_t>(pixel[0] << 16 | pixel[1] << 8 | pixel[2]));
        }
    }
    EXPECT_GE(colors.size(), 2u);
    EXPECT_GT(window->shell().marks().all().size(), 2u);
}

TEST_P(ShellTest, TheThemeIsTheViews) {
    const auto brightness = [&] {
        const Image image = window->shell().read_back();
        return static_cast<int>(*image.at(2, image.height - 2));
    };
    EXPECT_LT(brightness(), 60);
    session.workspace.change_view([](ViewState& view) { view.theme = Theme::light; });
    window->settle();
    EXPECT_GT(brightness(), 200);
}

TEST_P(ShellTest, AFieldUndoesNothingThatWasTypedIntoAnotherDialogs) {
    run("key Ctrl+P\ntype abcdefgh\nkey Escape\nkey Ctrl+P\nkey Ctrl+Z\nkey Ctrl+Z\ntype xy");
    EXPECT_EQ(session.dialogs.input.text, "xy");
}

TEST_P(ShellTest, FramesThatNobodyLooksAtAreNotDrawn) {
    run("key B\nclick viewport\ndrag viewport 40 20\nscroll viewport 2\nkey T\nkey B");
    EXPECT_EQ(window->shell().frames_drawn(), 0);
    const Image seen = window->shell().read_back();
    EXPECT_EQ(window->shell().frames_drawn(), 1);
    EXPECT_EQ(window->shell().read_back().rgba, seen.rgba);
    EXPECT_EQ(window->shell().frames_drawn(), 1) << "it is there already";
    run("key B");
    EXPECT_NE(window->shell().read_back().rgba, seen.rgba);
}

TEST_P(ShellTest, WhatPlaysIsNotWaitedFor) {
    run("run time.play\nkey B\nkey B\nclick viewport");
    EXPECT_TRUE(session.playback.playing());
    EXPECT_LT(*session.workspace.view().time, 1) << "a few frames for each";
}

TEST_P(ShellTest, UntilRunsFramesUntilItHolds) {
    run("run time.play\nuntil 30 /time ~ 1 0.2\nrun time.play\nuntil 1 viewport\nuntil 0 /playing != true");
    for (const char* script : {"until 0.2 /time -1", "until 0.2 no.widget"}) {
        try {
            run(script);
            ADD_FAILURE() << script;
        } catch (const ExpectationError& error) {
            EXPECT_NE(std::string(error.what()).find("also after 0.2 s"), std::string::npos) << error.what();
        }
    }
}

TEST_P(ShellTest, MarksGoToAFile) {
    const TempFolder folder;
    const std::string file = folder.path() / "marks.txt";
    EXPECT_EQ(run("marks " + file), "");
    EXPECT_EQ(slurp(file), run("marks"));
}

TEST_P(ShellTest, ADragOfAWidgetByNameMovesIt) {
    const float before = window->shell().marks().all().at("splitter.left").min.x;
    run("drag splitter.left 15 0");
    EXPECT_NEAR(session.settings.left_width, before + 15, 1.5);
    EXPECT_NEAR(window->shell().marks().all().at("splitter.left").min.x, before + 15, 1.5) << "it follows the mouse";
}

TEST_P(ShellTest, APressAndReleaseInOneBatchAreBothSeen) {
    const Rect rect = window->shell().marks().all().at("splitter.left");
    Shell& shell = window->shell();
    shell.feed(MouseMove{rect.center()});
    shell.feed(MouseButton{0, true});
    shell.feed(MouseMove{rect.center() + glm::vec2(15, 0)});
    shell.feed(MouseButton{0, false});
    shell.feed(MouseMove{rect.center() + glm::vec2(300, 0)});
    window->settle();
    EXPECT_NEAR(session.settings.left_width, rect.min.x + 15, 1.5);
}

TEST_P(ShellTest, NoFrameIsWantedWhenNothingHappens) {
    Shell& shell = window->shell();
    shell.feed(MouseMove{{5, 5}});
    EXPECT_EQ(shell.frame(kSize, 1000), 0);
    double next = 0;
    for (int i = 1; i < 200 && next < 1e9; ++i) next = shell.frame(kSize, 1000 + i);
    EXPECT_GT(next, 1e9);
}

TEST_P(ShellTest, ThePictureIsTheOneThatRenderDrawsOfTheSavedView) {
    const TempFolder folder;
    const std::string file = folder.path() / "saved.json";
    // Turned, zoomed and panned; then the mouse leaves, as what is under it is marked in the window.
    run("drag viewport 90 -35\nscroll viewport 2\nmove 5 5\nrun file.save_as " + file + "\n");
    while (!session.notifications.all().empty()) session.notifications.dismiss(0);
    window->settle();
    ASSERT_NE(session.workspace.view().camera, Camera{});
    const Rect rect = window->shell().marks().all().at("viewport");
    const PictureSize size{static_cast<int>(rect.size().x), static_cast<int>(rect.size().y)};

    const Scene saved = load_scene(file);
    const PictureOptions options{.size = size, .controls = true};
    const DrawList list = build_draw_list(FittedScene(saved, saved.fit), saved.view, options);
    const Image rendered = Renderer(GetParam()).draw(list);
    EXPECT_EQ(window->shell().viewport_picture().rgba, rendered.rgba);
    const Image shown = window->shell().read_back();
    int differing = 0;
    for (int y = 0; y < size.height; ++y) {
        const std::uint8_t* row = shown.at(static_cast<int>(rect.min.x), static_cast<int>(rect.min.y) + y);
        if (!std::equal(row, row + 4 * size.width, rendered.at(0, y))) ++differing;
    }
    EXPECT_EQ(differing, 0) << "of " << size.height << " rows";
}

/// The roles of what is pointed out in the picture.
std::set<HighlightLine::Role> pointed_out(const Shell& shell) {
    std::set<HighlightLine::Role> out;
    for (const HighlightLine& line : shell.shown()->highlights) out.insert(line.role);
    return out;
}

using Roles = std::set<HighlightLine::Role>;

TEST_P(ShellTest, WhatIsUnderTheMouseIsPointedOutAndNothingElseIsDrawnAnew) {
    Shell& shell = window->shell();
    run("move 5 5");
    const Image before = shell.read_back();
    ASSERT_EQ(pointed_out(shell), Roles{});
    hover_over_a_disk();
    EXPECT_EQ(pointed_out(shell), Roles{HighlightLine::Role::hover});
    EXPECT_NE(shell.read_back().rgba, before.rgba);
    const DrawStatistics& statistics = shell.statistics();
    EXPECT_EQ(statistics.world_bytes + statistics.state_bytes, 0u);
    EXPECT_EQ(statistics.overlay_bytes, shell.shown()->highlights.size() * 17 * sizeof(float));
    // What is selected too is not pointed out twice.
    session.workspace.select(session.workspace.hovered);
    window->settle();
    EXPECT_EQ(pointed_out(shell), Roles{HighlightLine::Role::selection});
    session.workspace.select({});
    run("move 5 5");
    EXPECT_EQ(pointed_out(shell), Roles{});
    EXPECT_EQ(shell.read_back().rgba, before.rgba);
}

/// A picture that was asked for and not yet looked at is not taken for one that stands there.
TEST_P(ShellTest, WhatIsPointedOutInANewPictureIsDrawnWithAllOfIt) {
    Shell& shell = window->shell();
    shell.read_back();
    session.workspace.change_view([](ViewState& view) { view.theme = Theme::light; });
    window->settle();
    session.workspace.select({Selection::Kind::path, {0, -1, 0}, -1});
    window->settle();
    const glm::ivec2 corner(shell.marks().all().at("viewport").min + 3.0f);
    EXPECT_GT(*shell.read_back().at(corner.x, corner.y), 100) << "the ground is light";
    EXPECT_EQ(pointed_out(shell), Roles{HighlightLine::Role::selection});
}

TEST_P(ShellTest, ThePictureShowsWhatIsSelectedAsRenderDoes) {
    session.workspace.select({Selection::Kind::node, {1, -1, 0}, 2});
    window->settle();
    hover_over_a_disk();
    EXPECT_EQ(pointed_out(window->shell()), (Roles{HighlightLine::Role::selection, HighlightLine::Role::hover}));
    const Rect rect = window->shell().marks().all().at("viewport");
    const PictureOptions options{.size = {static_cast<int>(rect.size().x), static_cast<int>(rect.size().y)},
                                 .controls = true};
    DrawList list = build_draw_list(session.workspace.fitted(), session.workspace.view(), options);
    const Image without = Renderer(GetParam()).draw(list);
    const std::string name = session.workspace.fitted().placed_agents()[1].name;
    add_selection(list, session.workspace.fitted(), session.workspace.view(), {name, {AgentPart::Kind::node, 2}},
                  metrics_of(list.size).scale);
    EXPECT_EQ(window->shell().viewport_picture().rgba, Renderer(GetParam()).draw(list).rgba);
    EXPECT_NE(window->shell().viewport_picture().rgba, without.rgba);
}

TEST_P(ShellTest, WhatIsDraggedLeavesAGhostWhereItStood) {
    Shell& shell = window->shell();
    run("run go.agent A");
    const mobb::PlacedTree before = session.workspace.fitted().placed(session.workspace.fitted().placed_agents()[0]);
    const mobb::Disk first = before.placed_clip().disk(0);
    const glm::vec2 at = shell.marks().all().at("handle.move").center();
    shell.feed(MouseMove{at});
    shell.feed(MouseButton{0, true});
    window->settle();
    EXPECT_EQ(pointed_out(shell), Roles{HighlightLine::Role::selection}) << "nothing has moved yet";
    shell.feed(MouseMove{at + glm::vec2(60, 0)});
    window->settle();
    EXPECT_EQ(pointed_out(shell), (Roles{HighlightLine::Role::selection, HighlightLine::Role::ghost}));
    const HighlightLine& line = shell.shown()->highlights.front();
    ASSERT_EQ(line.role, HighlightLine::Role::ghost);
    const glm::dvec3 place = shell.shown()->space.place(line.from);
    EXPECT_NEAR(std::hypot(place.x - first.x, place.y - first.y), first.r, 1e-3) << "where it stood";
    ASSERT_NE(session.workspace.scene().agents[0].placement.translate, glm::dvec2(0));
    shell.feed(MouseButton{0, false});
    window->settle();
    EXPECT_FALSE(pointed_out(shell).contains(HighlightLine::Role::ghost));
}

TEST_P(ShellTest, TheCloseButtonEndsTheSession) {
    window->shell().feed(CloseRequest{});
    window->settle();
    EXPECT_TRUE(session.files.closed());
}

TEST_P(ShellTest, WhatIsDroppedIsOpened) {
    const TempFolder folder;
    window->shell().feed(Drop{{folder.write("a.csv", "t,x,y,r\n0,0,0,0.3\n1,1,0,0.3\n")}});
    window->settle();
    EXPECT_EQ(session.workspace.scene().clips.size(), 1u) << "a clip replaces the demo";
    window->shell().feed(Drop{{folder.write("b.csv", "t,x,y,r\n0,0,0,0.3\n1,1,0,0.3\n")}});
    window->settle();
    EXPECT_EQ(session.dialogs.now, Dialog::dropped) << "what a person opened is not replaced without asking";
    run("key Enter");
    EXPECT_EQ(session.workspace.scene().clips.size(), 2u) << "Enter adds";
    window->shell().feed(Drop{{demo_scene_file()}});
    window->shell().feed(Drop{{folder.path() / "none.csv"}});
    window->settle();
    EXPECT_FALSE(session.notifications.all().empty());
}

TEST_P(ShellTest, ScriptsSeeTheStateAndTakePictures) {
    const TempFolder folder;
    const std::string picture = folder.path() / "window.png";
    const std::string out = run("size 700x450\npicture " + picture +
                                "\nexpect /title \"crossing\"\nexpect /scene/agents/0/start 0\n"
                                "expect /scene/agents/1/start ~ 0.8 0.11\nexpect /scene/agents/1/start != 0.8\n"
                                "expect /no/such/thing null\nexpect /scene/agents/0/color \"#E69F00\" # a comment\n"
                                "marks\nwait 0.05\nframes 2\nmove 10 10\nscroll 10 10 1\nkey Escape\n");
    EXPECT_EQ(read_png(picture).width, 700);
    EXPECT_NE(out.find("splitter.left"), std::string::npos);
}

TEST_P(ShellTest, FileNamesMayHaveBlanksAndBeNoText) {
    const TempFolder folder;
    run("picture \"" + (folder.path() / "my window.png").string() + "\"");
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "my window.png"));
    session.files.open({folder.write("a\xff.csv", "t,x,y,r\n0,0,0,0.3\n1,1,0,0.3\n")});
    EXPECT_NE(run("state").find("\"title\": \"a"), std::string::npos);
}

TEST_P(ShellTest, AnExpectationThatFailsNamesItsLine) {
    for (const auto& [script, says] : std::vector<std::pair<std::string, std::string>>{
             {"\n# two\nexpect /title \"other\"", "test: line 3: /title is \"crossing\", expected \"other\""},
             {"expect /modified != false", "line 1: /modified is false, expected anything but false"},
             {"expect /" + std::string(5000, 'x') + " \"" + std::string(5000, 'y') + "\"",
              "x\u2026" + std::string(99, 'x') + " is null, expected \"" + std::string(99, 'y') + "\u2026"},
             {"expect /scene/agents/1/start ~ 0.8 0.01",
              "line 1: /scene/agents/1/start is 0.9, expected 0.8 within 0.01"},
             {"expect /scene/agents {}", "line 1: /scene/agents is ["}}) {
        try {
            run(script);
            ADD_FAILURE() << script;
        } catch (const ExpectationError& error) {
            EXPECT_NE(std::string(error.what()).find(says), std::string::npos) << error.what();
        }
    }
    EXPECT_THROW(run("click no.such.widget"), InputError);
}

TEST_P(ShellTest, APressMakesAViewTheActiveOneAndLinkedCamerasMoveTogether) {
    window->resize({1200, 600});
    run("run view.split");
    const std::uint32_t width = static_cast<std::uint32_t>(window->shell().viewport_picture().width);
    const Rect left = window->shell().marks().all().at("viewport");
    const Rect right = window->shell().marks().all().at("viewport.1");
    EXPECT_EQ(left.size(), right.size());
    EXPECT_LT(left.max.x, right.min.x);
    EXPECT_EQ(width, left.size().x);
    const Image mobb = window->shell().viewport_picture();
    const Camera before = session.workspace.view().camera;
    run("drag viewport.1 40 20");
    EXPECT_EQ(session.views.active(), 1u);
    EXPECT_NE(session.workspace.view().camera, before);
    EXPECT_EQ(session.views.at(0).view.camera, session.workspace.view().camera);
    EXPECT_NE(window->shell().viewport_picture().rgba, mobb.rgba);
    run("click viewport.0");
    EXPECT_EQ(session.views.active(), 0u);
    run("run view.link_cameras\nscroll viewport 3");
    EXPECT_NE(session.views.at(1).view.camera, session.workspace.view().camera);
    run("run view.split");
    EXPECT_EQ(window->shell().marks().all().count("viewport.1"), 0u);
    EXPECT_GT(window->shell().viewport_picture().width, 2 * static_cast<int>(width) - 10);
}

INSTANTIATE_TEST_SUITE_P(Backends, ShellTest, ::testing::Values(Backend::osmesa, Backend::egl), backend_name);

class UiPassTest : public ::testing::TestWithParam<Backend> {};

TEST_P(UiPassTest, ClipsInPixelsOfTheFramebuffer) {
    const std::unique_ptr<Renderer> renderer = open_or_skip(GetParam());
    if (!renderer) return;
    ImGuiContext* imgui = ImGui::CreateContext();
    ImGui::SetCurrentContext(imgui);
    constexpr PictureSize size{100, 60};
    ImGui::GetIO().DisplaySize = {size.width, size.height};
    ImGui::GetIO().IniFilename = nullptr;
    ImGui::GetIO().BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    make_style(Theme::dark, 1);
    UiPass pass(renderer->context());
    pass.upload(*ImGui::GetIO().Fonts);
    const WindowTarget target(size);
    target.clear(Rgba(0, 0, 0, 1));
    ImGui::NewFrame();
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.PushClipRect({10, 5}, {40, 25});
    list.AddRectFilled({0, 0}, {100, 60}, IM_COL32(255, 0, 0, 255));
    list.PopClipRect();
    list.AddRectFilled({60, 30}, {80, 50}, IM_COL32(0, 0, 255, 128));
    ImGui::Render();
    pass.draw(*ImGui::GetDrawData(), size);
    const Image image = target.read();
    renderer->context().check("testing");
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            const bool inside = x >= 10 && x < 40 && y >= 5 && y < 25;
            EXPECT_EQ(image.at(x, y)[0], inside ? 255 : 0) << x << ' ' << y;
            EXPECT_EQ(image.at(x, y)[3], 255);
        }
    }
    EXPECT_NEAR(image.at(70, 40)[2], 128, 1);
    ImGui::DestroyContext(imgui);
}

INSTANTIATE_TEST_SUITE_P(Backends, UiPassTest, ::testing::Values(Backend::osmesa, Backend::egl), backend_name);

}  // namespace
}  // namespace mobbscope::app
