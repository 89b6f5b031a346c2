// Motion graphs and crowds made in the window: by commands, and by clicks and keys in their dialogs.
#include <app/document/job.h>
#include <app/session/crowd_maker.h>
#include <app/window/headless_window.h>
#include <crowd/graph/build_graph.h>
#include <render/gl/gl_context.h>
#include <render/image/png.h>
#include <scene/arrangement.h>
#include <scene/motion_graph.h>
#include <support/folders.h>

#include "app/folder_window.h"
#include "crowd/walker_moves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace mobbscope::app {
namespace {

constexpr const char* kSmallGraph = "candidates=60 hubs=2 moves=4";

/// A session in a window, as a person has it or as a script does.
struct MakerWindow : FolderWindow<TempFolder> {
    explicit MakerWindow(bool attended = false) : FolderWindow({1280, 800}, 1, attended) {}

    void open(const std::vector<std::filesystem::path>& files) {
        session.files.open(files);
        wait();
    }
    /// The walkers of the crowd tests, with their graph.
    void open_walkers() { open({folder.write("walkers.json", to_json(walker_scene(), true))}); }
    void wait() {
        const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(2);
        while (session.jobs.job() && std::chrono::steady_clock::now() < end) {
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
            session.poll();
        }
        window.settle();
    }
    /// Also for the job that was cancelled: it must not outlive the test. Frames let go of those that are done.
    void wait_for_all() {
        while (Job::any_left()) window.frame();
    }
    void click(const std::string& mark) {
        ASSERT_TRUE(has(mark)) << mark;
        window.shell().feed(MouseMove{window.shell().marks().all().at(mark).center()});
        window.settle();
        window.shell().feed(MouseButton{0, true});
        window.frame();
        window.shell().feed(MouseButton{0, false});
        window.settle();
    }
    void key(Key key) {
        window.shell().feed(KeyPress{key, true});
        window.shell().feed(KeyPress{key, false});
        window.settle();
    }
    void type_into(const std::string& mark, const std::string& text) {
        click(mark);
        for (const char c : text) window.shell().feed(TypedText{static_cast<char32_t>(c)});
        window.settle();
        key(Key::enter);
    }
    const Scene& scene() const { return session.workspace.scene(); }
    /// A picture to look at, where MOBBSCOPE_LOOK names a folder.
    void look(const std::string& file) {
        const char* const there = std::getenv("MOBBSCOPE_LOOK");
        if (there) write_png(std::filesystem::path(there) / (file + ".png"), window.shell().read_back());
    }
};

std::string refused(const std::string& options) {
    try {
        parse_graph_options(options);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "";
}

TEST(GraphOptions, AreReadAsTheCommandLineHasThem) {
    const GraphOptions options = parse_graph_options("pose-distance=0.1,hubs=3 seconds=0.5:2 seed=7 whole");
    EXPECT_EQ(options.bounds.pose_distance, 0.1);
    EXPECT_EQ(options.bounds.root_speed, GraphOptions{}.bounds.root_speed);
    EXPECT_EQ(options.hubs, 3);
    EXPECT_EQ(options.least_seconds, 0.5);
    EXPECT_EQ(options.most_seconds, 2);
    EXPECT_EQ(options.seed, 7u);
    EXPECT_TRUE(options.whole);
    const CrowdOrder order = parse_crowd_order("agents=12 area=20x15.5 turn-rate=0 seed=9007199254740992");
    EXPECT_EQ(order.options.agents, 12);
    EXPECT_EQ(order.options.area, glm::dvec2(20, 15.5));
    EXPECT_EQ(order.turn_rate, 0);
    EXPECT_EQ(order.options.seed, std::uint64_t{1} << 53);
    EXPECT_EQ(refused("hubbs=3"), "there is no option 'hubbs' (did you mean 'hubs'?)");
    EXPECT_EQ(refused("hubs"), "hubs needs a value: hubs=8");
    EXPECT_EQ(refused("hubs=2.5"), "'2.5' is not a whole number from 1 to 10000");
    EXPECT_NE(refused("seed=9007199254740993"), "") << "a double cannot tell it from the largest";
    EXPECT_EQ(refused("seconds=0:1"), "'0:1' is not like A:B: give two numbers such as 1:4, each from 1e-09 to 3600");
    EXPECT_EQ(refused("seconds=0.0001:1"), "");
    EXPECT_EQ(refused("seconds=3:1"), "'3:1' is in the wrong order: give the smaller number first, such as 1:4");
}

/// What is typed for it in a script, and what its dialog shows, is the same.
TEST(GraphOptions, AreWrittenAsTheyAreRead) {
    for (const NumberOption<GraphOptions>& option : graph_options()) {
        GraphOptions options;
        const Numbers numbers = option.get(options);
        option.set(options, {numbers[0] + 1, numbers[1] + 1});
        EXPECT_EQ(parse_numbers(option, text_of(option, option.get(options))), option.get(options)) << option.key;
        EXPECT_NE(option.get(options), numbers) << option.key;
    }
    for (const NumberOption<CrowdOrder>& option : crowd_options()) {
        EXPECT_EQ(parse_numbers(option, text_of(option, option.get({}))), option.get({})) << option.key;
        EXPECT_FALSE(option.title.empty()) << option.key;
    }
}

TEST(BuildGraph, IsThatOfTheCommandLine) {
    MakerWindow w;
    w.open({kClips});
    w.run("crowd.build_graph", kSmallGraph);
    ASSERT_TRUE(w.scene().graph) << all_messages(w.session);
    const GraphOptions options = parse_graph_options(kSmallGraph);
    const Scene recordings = load_recordings(clip_files({kClips}), kClips / "graph.json", {}, true).scene;
    BuiltGraph built = make_graph(recordings, options, "clips");
    lay_out_clips(built.scene);
    EXPECT_EQ(*w.scene().graph, *built.scene.graph);
    EXPECT_EQ(to_json(w.scene()), to_json(built.scene));
    // Unsaved, and said in a line.
    EXPECT_TRUE(w.session.workspace.modified());
    EXPECT_FALSE(w.session.workspace.file);
    EXPECT_EQ(w.session.workspace.title(), "graph");
    const Message& said = w.session.notifications.all().back();
    EXPECT_TRUE(said.text.starts_with("Built a graph of ")) << said.text;
    EXPECT_NE(said.text.find(" moves, from 7 recordings, "), std::string::npos) << said.text;
    ASSERT_EQ(said.offers.size(), 1u);
    EXPECT_EQ(said.offers[0].command, "crowd.simulate");
    EXPECT_EQ(why_not(w.session, *find_command("crowd.build_graph")),
              "a motion graph is open already: open recordings");
}

TEST(BuildGraph, SavedItIsReadAgain) {
    MakerWindow w;
    w.open({kClips});
    w.run("crowd.build_graph", kSmallGraph);
    const MotionGraph built = *w.scene().graph;
    w.run("file.save_as", (w.folder.path() / "mine.json").string());
    w.open({w.folder.path() / "mine.json"});
    ASSERT_TRUE(w.scene().graph) << all_messages(w.session);
    EXPECT_EQ(*w.scene().graph, built);
}

TEST(BuildGraph, WhatCannotBeBuiltIsALineAndLosesNothing) {
    CrossingFolder folder;
    MakerWindow w;
    w.open({folder.scene});
    const auto before = w.session.workspace.document().fitted;
    w.run("crowd.build_graph", "seed=2");
    EXPECT_EQ(w.session.workspace.document().fitted, before);
    ASSERT_EQ(w.session.notifications.all().size(), 1u);
    EXPECT_EQ(w.session.notifications.all()[0].level, MessageLevel::error);
    EXPECT_EQ(w.session.notifications.all()[0].text,
              "scene.json: no clip has joints, so no pose can be compared; give motion files, or take clips whole "
              "(--whole)");
    w.run("crowd.build_graph", "whole");
    ASSERT_TRUE(w.scene().graph);
    EXPECT_EQ(w.scene().graph->moves.size(), 2u);
    EXPECT_TRUE(w.scene().agents.empty());
}

TEST(BuildGraph, InItsDialogByClicksAndKeys) {
    MakerWindow w(true);
    w.open({kClips});
    w.run("crowd.build_graph");
    ASSERT_EQ(w.session.dialogs.now, Dialog::build_graph);
    w.look("build-graph");
    w.type_into("graph.candidates", "60");
    w.type_into("graph.hubs", "2");
    w.type_into("graph.seconds.first", "1.5");
    EXPECT_EQ(w.session.dialogs.now, Dialog::build_graph) << "Enter ends the number, not the dialog";
    EXPECT_EQ(w.session.crowd_maker.graph.candidates, 60);
    EXPECT_EQ(w.session.crowd_maker.graph.least_seconds, 1.5);
    EXPECT_EQ(w.session.crowd_maker.graph.most_seconds, 4);
    w.click("graph.defaults");
    EXPECT_EQ(w.session.crowd_maker.graph.candidates, 400);
    w.click("graph.whole");
    EXPECT_TRUE(w.session.crowd_maker.graph.whole);
    w.click("graph.whole");
    w.type_into("graph.candidates", "60");
    w.click("graph.ok");
    EXPECT_EQ(w.session.dialogs.now, Dialog::none);
    w.wait();
    EXPECT_TRUE(w.scene().graph) << all_messages(w.session);
}

TEST(BuildGraph, IsCancelledAndLosesNothing) {
    MakerWindow w(true);
    w.session.options.patience = std::chrono::milliseconds(0);
    w.open({kClips});
    const auto before = w.session.workspace.document().fitted;
    run_command(w.session, "crowd.build_graph", kSmallGraph);
    ASSERT_EQ(w.session.jobs.count(), 1u);
    EXPECT_EQ(w.session.jobs.job()->title(), "Building a motion graph");
    w.session.jobs.cancel(0);
    w.wait();
    EXPECT_EQ(w.session.workspace.document().fitted, before);
    EXPECT_EQ(w.session.notifications.all().back().text, "Cancelled");
    w.wait_for_all();
}

TEST(BuildGraph, AsksAboutUnsavedChangesFirst) {
    CrossingFolder folder;
    MakerWindow w;
    w.open({folder.scene});
    w.run("go.agent", "A");
    w.run("agent.move", "5 5");
    w.run("crowd.build_graph", "whole");
    EXPECT_EQ(w.session.dialogs.now, Dialog::unsaved);
    EXPECT_FALSE(w.scene().graph);
    w.click("unsaved.discard");
    EXPECT_TRUE(w.scene().graph);
}

TEST(SimulateCrowd, OpensTheRunOfTheOpenGraph) {
    MakerWindow w;
    w.open_walkers();
    w.run("crowd.simulate", "agents=5 area=20x20 seconds=20 plan=0");
    ASSERT_TRUE(w.session.workspace.crowd()) << all_messages(w.session);
    EXPECT_EQ(w.session.workspace.crowd()->agents.size(), 5u);
    EXPECT_EQ(*w.session.workspace.crowd(), *with_run(walker_scene(), 5, {20, 20}).crowd);
    EXPECT_EQ(w.session.workspace.title(), "run");
    EXPECT_TRUE(w.session.workspace.modified());
    const std::string said = all_messages(w.session);
    EXPECT_TRUE(said.starts_with("Simulated 5 agents for 20 s: ")) << said;
}

TEST(SimulateCrowd, OfARunBeginsAnew) {
    MakerWindow w;
    w.open_walkers();
    w.run("crowd.simulate", "agents=5 area=20x20 seconds=6");
    w.run("file.save_as", (w.folder.path() / "run.json").string());
    w.run("crowd.simulate", "agents=3 area=20x20 seconds=6");
    ASSERT_TRUE(w.session.workspace.crowd());
    EXPECT_EQ(w.session.workspace.crowd()->agents.size(), 3u);
}

TEST(SimulateCrowd, NeedsAGraphAndRoom) {
    CrossingFolder folder;
    MakerWindow w;
    w.open({folder.scene});
    EXPECT_EQ(why_not(w.session, *find_command("crowd.simulate")), "there is no motion graph: build one first");
    w.open_walkers();
    w.run("crowd.simulate", "agents=100 area=4x4 seconds=6");
    EXPECT_FALSE(w.session.workspace.crowd());
    const std::string said = all_messages(w.session);
    EXPECT_NE(said.find("there is no room for agent "), std::string::npos) << said;
    EXPECT_EQ(std::ranges::count(said, '\n'), 1) << said;
}

/// What a run holds is not lost with it, so nobody is asked; what else there is, is.
TEST(SimulateCrowd, OfAGraphThatIsNotSavedAsksNothing) {
    CrossingFolder folder;
    MakerWindow w;
    w.open({folder.file("walk.csv"), folder.file("stand.csv")});
    w.run("crowd.build_graph", "whole");
    w.run("crowd.simulate", "agents=2 area=30x30 seconds=4");
    EXPECT_TRUE(w.session.workspace.crowd()) << all_messages(w.session);
    w.run("crowd.simulate", "agents=3 area=30x30 seconds=4");
    EXPECT_EQ(w.session.dialogs.now, Dialog::unsaved) << "another run would replace the first";
}

TEST(SimulateCrowd, InItsDialogByClicksAndKeys) {
    MakerWindow w(true);
    w.open_walkers();
    w.run("crowd.simulate");
    ASSERT_EQ(w.session.dialogs.now, Dialog::simulate);
    w.look("simulate");
    w.type_into("simulate.agents", "4");
    w.type_into("simulate.area.second", "25");
    w.type_into("simulate.seconds", "5");
    EXPECT_EQ(w.session.crowd_maker.crowd.options.area, glm::dvec2(30, 25));
    w.key(Key::enter);
    EXPECT_EQ(w.session.dialogs.now, Dialog::none);
    w.wait();
    ASSERT_TRUE(w.session.workspace.crowd()) << all_messages(w.session);
    EXPECT_EQ(w.session.workspace.crowd()->agents.size(), 4u);
}

TEST(SimulateCrowd, IsCancelledAndLosesNothing) {
    MakerWindow w(true);
    w.session.options.patience = std::chrono::milliseconds(0);
    w.open_walkers();
    const auto before = w.session.workspace.document().fitted;
    w.run("crowd.simulate", "agents=20 area=25x25 seconds=50000");
    w.window.frame();
    ASSERT_EQ(w.session.jobs.count(), 1u);
    w.click("job.0.cancel");
    EXPECT_EQ(w.session.jobs.count(), 0u);
    EXPECT_EQ(w.session.workspace.document().fitted, before);
    w.wait_for_all();
}

}  // namespace
}  // namespace mobbscope::app
