#include "run_program.h"

#include <mobb/query.h>
#include <scene/crowd_run.h>
#include <scene/motion_graph.h>
#include <scene/scene.h>
#include <support/folders.h>
#include <support/json_keys.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

/// A straight walk and one that turns, as tracks of a file in a folder of its own.
class Simulate : public ::testing::Test {
  protected:
    Simulate() {
        std::filesystem::create_directories(folder.path() / "clips");
        folder.write("clips/walk.csv", "t,x,y,r\n0,0,0,0.4\n0.2,0.2,0,0.4\n0.4,0.4,0,0.4\n0.6,0.6,0,0.4\n");
        folder.write("clips/turn.csv", "t,x,y,r\n0,0,0,0.4\n0.2,0.2,0,0.4\n0.4,0.35,0.15,0.4\n");
        graph = folder.write("graph.json", R"({"clips": {"walk": {"source": "clips/walk.csv"},
            "turn": {"source": "clips/turn.csv"}}, "graph": {"hubs": [{"name": "step"}], "moves": [
            {"clip": "walk", "from": 0, "to": 0, "entry": [0, 0, 0], "exit": [0.8, 0, 0]},
            {"clip": "turn", "from": 0, "to": 0, "entry": [0, 0, 0], "exit": [0.4, 0.3, 60]}]}})");
        run = (folder.path() / "run.json").string();
    }

    Result simulate(std::vector<std::string> more = {}) const {
        std::vector<std::string> arguments{"simulate", graph.string(), "-o",        run,  "--agents", "12",
                                           "--area",   "8x9",          "--seconds", "12", "--seed",   "3"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_program(arguments);
    }

    TempFolder folder;
    std::filesystem::path graph;
    std::string run;
};

TEST_F(Simulate, WritesARunThatIsReadAgain) {
    const Result result = simulate({"--ahead", "0.5"});
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.out.substr(0, result.out.find(',')),
              "12 agents for 12 s: " + result.out.substr(20, result.out.find(',') - 20));
    EXPECT_NE(result.err.find("mobbscope: simulated 12 of 12 s: 12 agents"), std::string::npos) << result.err;
    const Scene scene = load_scene(run);
    ASSERT_TRUE(scene.crowd);
    EXPECT_EQ(scene.crowd->agents.size(), 12u);
    EXPECT_EQ(scene.crowd->area, glm::dvec2(8, 9));
    EXPECT_EQ(scene.crowd->seed, 3u);
    EXPECT_EQ(scene.crowd->ahead, 0.5);
    EXPECT_EQ(scene.clips[0].source, "clips/walk.csv");
}

TEST_F(Simulate, AStoredRunIsCheckedChoiceByChoice) {
    using nlohmann::json;
    ASSERT_EQ(simulate().status, 0);
    const Result same = run_program({"simulate", run, "--check"});
    EXPECT_EQ(same.status, 0) << same.err;
    EXPECT_NE(same.out.find("come out as the run says"), std::string::npos) << same.out;
    json edited = json::parse(slurp(run));
    json& agents = edited["crowd"]["agents"];
    // The other of the two moves: as the last play nothing has to join it.
    const json& moves = edited["graph"]["moves"];
    json& last = agents[5]["plays"].back();
    const int was = last["move"];
    const int other = moves[static_cast<std::size_t>(was)].contains("turned") ? 0 : 1 - was;
    last["move"] = other;
    last.erase("kind");
    const std::string file = folder.write("edited.json", edited.dump());
    const Result found = run_program({"simulate", file, "--check"});
    EXPECT_EQ(found.status, 1) << found.err;
    EXPECT_TRUE(found.out.starts_with("6 plays " + std::string(other == 0 ? "walk" : "turn") + " at ")) << found.out;
    EXPECT_NE(found.out.find("\n  then: "), std::string::npos) << found.out;
    EXPECT_NE(found.out.find("\n  now: "), std::string::npos) << found.out;
    EXPECT_NE(found.err.find("does not come out as the run says\n"), std::string::npos) << found.err;
    const json difference = json::parse(run_program({"simulate", file, "--check", "--json"}).out)["difference"];
    EXPECT_EQ(difference["agent"], "6");
    EXPECT_EQ(difference["play"], agents[5]["plays"].size() - 1);
    EXPECT_EQ(difference["then"]["move"], other);
    EXPECT_TRUE(difference["now"]["clip"].is_string());
    EXPECT_FALSE(difference["candidates"].empty());
    EXPECT_EQ(json::parse(run_program({"simulate", run, "--check", "--json"}).out)["agrees"], true);
    for (const std::vector<std::string>& wrong : std::vector<std::vector<std::string>>{
             {graph.string(), "--check"}, {run, "--check", "--seed", "4"}, {run, "--check", "-o", run}, {run}}) {
        std::vector<std::string> all{"simulate"};
        all.insert(all.end(), wrong.begin(), wrong.end());
        EXPECT_EQ(run_program(all).status, 2) << wrong.back();
    }
}

TEST_F(Simulate, TheSameBytesOnAnyNumberOfThreads) {
    ASSERT_EQ(simulate({"--threads", "1"}).status, 0);
    const std::string one = slurp(run);
    for (const char* threads : {"2", "5"}) {
        ASSERT_EQ(simulate({"--threads", threads}).status, 0);
        EXPECT_EQ(slurp(run), one);
    }
    ASSERT_EQ(simulate().status, 0);
    EXPECT_EQ(slurp(run), one);
    ASSERT_EQ(simulate({"--grace", "0"}).status, 0);
    EXPECT_NE(slurp(run), one);
}

TEST_F(Simulate, MovesAreTurnedOnTheWayAsFastAsAllowed) {
    const Result turned = simulate();
    EXPECT_NE(turned.out.find(" on the way, at most 120 degrees/s; "), std::string::npos) << turned.out;
    const Scene scene = load_scene(run);
    EXPECT_EQ(scene.crowd->turn_rate, 120);
    const auto is_turned = [](const GraphMove& move) { return move.turned.has_value(); };
    EXPECT_GT(std::ranges::count_if(scene.graph->moves, is_turned), 0);
    // A run is simulated anew from the moves that its own are made of.
    const std::string again = (folder.path() / "again.json").string();
    ASSERT_EQ(
        run_program({"simulate", run, "-o", again, "--agents", "12", "--area", "8x9", "--seconds", "12", "--seed", "3"})
            .status,
        0);
    EXPECT_EQ(load_scene(again).graph->moves, scene.graph->moves);
    ASSERT_EQ(simulate({"--turn-rate", "0"}).status, 0);
    EXPECT_EQ(std::ranges::count_if(load_scene(run).graph->moves, is_turned), 0);
    EXPECT_EQ(simulate({"--turn-rate", "-1"}).status, 2);
    EXPECT_EQ(simulate({"--turn-rate", "3601"}).status, 2);
}

TEST_F(Simulate, SourcesLeadWhereTheyLed) {
    std::filesystem::create_directories(folder.path() / "out");
    const std::string moved = (folder.path() / "out" / "moved.json").string();
    const std::string queries = (folder.path() / "out" / "queries.json").string();
    ASSERT_EQ(run_program({"simulate", graph.string(), "-o", moved, "--agents", "12", "--area", "8x9", "--seconds", "5",
                           "--record", queries})
                  .status,
              0);
    EXPECT_EQ(load_scene(moved).clips[0].source, "../clips/walk.csv");
    EXPECT_EQ(load_scene(queries).clips[0].source, "../clips/walk.csv");
    ASSERT_EQ(simulate({"--inline"}).status, 0);
    EXPECT_FALSE(load_scene(run).clips[0].source);
}

TEST_F(Simulate, TheSummaryAsJson) {
    const Result result = simulate({"--json"});
    const json summary = json::parse(result.out);
    EXPECT_EQ(
        keys(summary),
        (std::set<std::string>{"agents", "simulated_seconds", "plays", "choices", "candidates", "off_floor",
                               "colliding", "no_way_on", "in_the_way", "pivots", "forced", "queries", "most_held",
                               "wall_seconds", "queries_per_second", "turn_rate", "continuity", "continuity_forced"}));
    const Scene scene = load_scene(run);
    std::size_t plays = 0;
    for (const CrowdAgent& agent : scene.crowd->agents) plays += agent.plays.size();
    EXPECT_EQ(summary["plays"], plays);
    EXPECT_EQ(summary["choices"], plays - 12);
    EXPECT_EQ(summary["simulated_seconds"], 12);
    // Tracks have no skeletons.
    EXPECT_EQ(
        summary["continuity"]["joins"].get<std::size_t>() + summary["continuity_forced"]["joins"].get<std::size_t>(),
        plays - 12);
    EXPECT_EQ(summary["continuity"]["measured"], 0);
    EXPECT_TRUE(summary["continuity"]["joint_position"]["ratio"].is_null());
    EXPECT_NE(simulate().out.find("was not measured: no two clips that join have one skeleton\n"), std::string::npos);
}

TEST_F(Simulate, WhatIsSavedOfOtherAgentsDoesNotStay) {
    const std::string marked = folder.write("marked.json", R"({"clips": {"walk": {"source": "clips/walk.csv"},
        "turn": {"source": "clips/turn.csv"}}, "agents": [{"name": "A", "clip": "walk"}, {"name": "B", "clip": "turn"}],
        "debug": {"filters": [{"name": "tight", "where": "gap < 0.05"}],
        "bookmarks": [{"name": "m", "query": 0, "step": 1}], "views": [{"name": "v", "view": {"query": 0}}]}})");
    const Result result = run_program({"simulate", marked, "--whole", "-o", run, "--agents", "5", "--seconds", "5"});
    ASSERT_EQ(result.status, 0) << result.err;
    const Scene scene = load_scene(run);
    EXPECT_TRUE(scene.debug.bookmarks.empty());
    EXPECT_TRUE(scene.debug.views.empty());
    EXPECT_EQ(scene.debug.filters.size(), 1u);
}

TEST_F(Simulate, HowContinuousTheRunIsIsTold) {
    const std::string clips = kClips;
    const std::vector<std::string> whole{"simulate", clips, "--whole", "-o", run, "--agents", "10", "--seconds", "20"};
    const Result words = run_program(whole);
    ASSERT_EQ(words.status, 0) << words.err;
    for (const char* part :
         {"changes where moves join, against those inside them: a ratio over 1.25 at ",
          " different); largest: joint position ", ", heading ", ", root velocity ", "feet slide "}) {
        EXPECT_NE(words.out.find(part), std::string::npos) << part << " in " << words.out;
    }
    std::vector<std::string> as_json = whole;
    as_json.emplace_back("--json");
    const json summary = json::parse(run_program(as_json).out);
    const json& continuity = summary["continuity"];
    EXPECT_TRUE(continuity["bound"].is_null());
    EXPECT_EQ(continuity["joins"].get<std::int64_t>() + summary["continuity_forced"]["joins"].get<std::int64_t>(),
              summary["choices"]);
    EXPECT_EQ(continuity["measured"], continuity["joins"]);
    for (const char* change : {"joint_position", "heading", "root_velocity", "joint_velocity"}) {
        const json& largest = continuity[change];
        EXPECT_NEAR(largest["ratio"].get<double>(), largest["across"].get<double>() / largest["inside"].get<double>(),
                    1e-9);
        EXPECT_LE(largest["over"], continuity["joins"]);
    }
    EXPECT_GT(continuity["foot_slide"]["contacts"], 0);
}

TEST_F(Simulate, RecordedQueriesAreAnswered) {
    const std::string recorded = (folder.path() / "queries.json").string();
    const Result result = simulate({"--json", "--record", recorded, "--record-queries", "40"});
    ASSERT_EQ(result.status, 0) << result.err;
    const json summary = json::parse(result.out);
    EXPECT_EQ(summary["recorded"], 40);
    EXPECT_EQ(summary["recorded_of"], summary["queries"]);
    const Result answers = run_program({"query", recorded, "--json"});
    ASSERT_EQ(answers.status, 0) << answers.err;
    const json results = json::parse(answers.out)["results"];
    ASSERT_EQ(results.size(), 40u);
    int positive = 0;
    for (const json& found : results) positive += found["collides"].get<bool>();
    EXPECT_GT(positive, 0);
    EXPECT_LT(positive, 40);
    ASSERT_EQ(simulate({"--json", "--record", recorded, "--record-queries", "0"}).status, 0);
    EXPECT_EQ(load_scene(recorded).queries.size(), summary["queries"].get<std::size_t>());
    const Result all = simulate({"--json", "--record", recorded, "--record-all-pairs"});
    EXPECT_GT(json::parse(all.out)["recorded_of"], summary["queries"]);
}

TEST_F(Simulate, WholeClipsOfAFolder) {
    const Result bare = run_program({"simulate", (folder.path() / "clips").string(), "-o", run});
    EXPECT_EQ(bare.status, 2);
    EXPECT_NE(bare.err.find("there is no motion graph; make one with graph build, or give --whole"), std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(run));
    const Result whole = run_program(
        {"simulate", (folder.path() / "clips").string(), "-o", run, "--whole", "--agents", "5", "--seconds", "5"});
    ASSERT_EQ(whole.status, 0) << whole.err;
    const std::vector<GraphMove> moves = load_scene(run).graph->moves;
    EXPECT_EQ(std::ranges::count_if(moves, [](const GraphMove& move) { return !move.turned; }), 2);
}

TEST_F(Simulate, BadUsageIsRefusedAndNothingWritten) {
    const std::vector<std::vector<std::string>> cases = {
        {"--agents", "0"},      {"--agents", "x"},     {"--area", "30"},
        {"--area", "30x"},      {"--area", "-3x4"},    {"--seconds", "0"},
        {"--seed", "1.5"},      {"--seed", "-1"},      {"--plan", "-1"},
        {"--ahead", "-1"},      {"--grace", "-1"},     {"--threads", "0"},
        {"--record", ""},       {"--record", "q.csv"}, {"--record-queries", "5"},
        {"--record-all-pairs"}, {"--record", run},     {"--area", "2x2"},
        {"-o", run + ".png"},   {"--area", "1e9x1"},   {"--seed", "9007199254740993"},
    };
    for (const std::vector<std::string>& more : cases) {
        std::vector<std::string> arguments{"simulate", graph.string()};
        if (more.front() != "-o") arguments.insert(arguments.end(), {"-o", run});
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Result result = run_program(arguments);
        EXPECT_EQ(result.status, 2) << more.front() << " " << result.err;
        EXPECT_TRUE(is_one_line(result.err)) << result.err;
        EXPECT_EQ(result.out, "");
        EXPECT_FALSE(std::filesystem::exists(run));
    }
}

}  // namespace
}  // namespace mobbscope
