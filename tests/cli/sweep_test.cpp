// mobbscope sweep: rows that say what fits cost, one recommendation, and one line for what is no order.
#include "run_program.h"

#include <support/folders.h>
#include <support/json_keys.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope {
namespace {

Result sweep_of(const std::string& file, const std::vector<std::string>& more) {
    return run_program(with({"sweep", file}, more));
}

bool is_fit(const json& a, const json& b) {
    return std::ranges::all_of(std::vector{"tree", "leaf", "axes", "time_scale", "levels"},
                               [&](const char* key) { return a[key] == b[key]; });
}

/// What is recommended where queries are asked so, and else what is undecided; the times of rows say so, too.
void expect_advice(const json& sweep, const std::string& protocol) {
    const json& recommended = sweep[protocol == "warm" ? "recommended" : "recommended_cold"];
    std::vector<json> undecided;
    for (const json& fit : sweep["undecided"]) {
        if (fit["protocol"] == protocol) undecided.push_back(fit);
    }
    ASSERT_EQ(recommended.is_null(), undecided.size() > 1) << sweep["undecided"].dump();
    const json& best = recommended.is_null() ? undecided.front() : recommended;
    const double least = best["time_ns"][protocol];
    double error = -1;
    for (const json& row : sweep["rows"]) {
        if (row.contains("time_ns") && is_fit(row, best)) error = row["time_error_ns"][protocol];
    }
    ASSERT_GE(error, 0.01 * least) << "the fastest is a row";
    for (const json& row : sweep["rows"]) {
        if (!row.contains("time_ns") || row["time_ns"][protocol].is_null()) continue;
        const double ns = row["time_ns"][protocol], low = ns - row["time_error_ns"][protocol].get<double>();
        EXPECT_GE(ns, least);
        const bool is_told = std::ranges::any_of(undecided, [&](const json& fit) { return is_fit(fit, row); });
        // Fits that make the same trees are told of once.
        if (is_told) {
            EXPECT_LE(low, least + error);
        }
        if (ns > least && low > least + error) {
            EXPECT_FALSE(is_told);
        }
    }
    EXPECT_FALSE(sweep["why"][protocol].get<std::string>().empty());
}

TEST(Sweep, JsonHasEveryRow) {
    const Result run = sweep_of(kCrossing, {"--over", "leaf=5,10,20", "--over", "tree=mobb,umobb,blocks", "--queries",
                                            "500", "--seed", "3", "--json"});
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.err, "");
    const json sweep = json::parse(run.out);
    EXPECT_EQ(sweep["workload"]["kind"], "placements");
    EXPECT_EQ(sweep["workload"]["seed"], 3);
    EXPECT_EQ(sweep["workload"]["queries"], 500);
    EXPECT_EQ(sweep["workload"]["warm_queries"], 500);
    EXPECT_GT(sweep["workload"]["area"], 0);
    EXPECT_GT(sweep["workload"]["offset"], 0);
    EXPECT_EQ(sweep["unit"], "ns, tests times price");
    EXPECT_FALSE(sweep.contains("levels"));
    std::set<std::string> fits, clips;
    for (const json& row : sweep["rows"]) {
        EXPECT_EQ(row.contains("time_ns"), row["clip"].is_null());
        clips.insert(row["clip"].dump());
        if (!row["clip"].is_null()) continue;
        fits.insert(row["tree"].get<std::string>() + (row["levels"] == 1 ? " single" : row["leaf"].dump()));
        EXPECT_GT(row["memory"], 0);
        EXPECT_GT(row["time_ns"]["warm"], 0);
        EXPECT_GT(row["time_ns"]["cold"], 0);
        EXPECT_EQ(row["cost"].is_null(), row["tree"] == "blocks") << "tests of blocks have no price";
        if (row["cost"].is_null()) continue;
        EXPECT_GT(row["box_tests"], 0);
        EXPECT_GE(row["max"], row["p99"]);
        EXPECT_GE(row["p99"], row["p95"]);
    }
    EXPECT_EQ(fits, (std::set<std::string>{"mobb5", "mobb10", "mobb20", "mobb single", "umobb5", "umobb10", "umobb20",
                                           "umobb single", "blocks10"}));
    EXPECT_EQ(clips, (std::set<std::string>{"null", "\"bend\"", "\"straight\""}));
    for (const char* key : {"recommended", "recommended_cold"}) {
        if (sweep[key].is_null()) continue;
        EXPECT_EQ(keys(sweep[key]),
                  (std::set<std::string>{"tree", "leaf", "axes", "time_scale", "levels", "cost", "present_cost",
                                         "time_ns", "present_time_ns", "memory", "present_memory", "why"}));
    }
    expect_advice(sweep, "warm");
    expect_advice(sweep, "cold");
}

TEST(Sweep, EstimatesAreTheSameEachTime) {
    const std::vector<std::string> order{"--over", "leaf=1:50", "--queries", "300", "--json"};
    json first = json::parse(sweep_of(kCrossing, order).out), again = json::parse(sweep_of(kCrossing, order).out);
    // The search for the fastest may add rows.
    for (const json& row : first["rows"]) {
        for (const json& other : again["rows"]) {
            if (is_fit(row, other) && row["clip"] == other["clip"]) {
                EXPECT_EQ(row["cost"], other["cost"]);
            }
        }
    }
    EXPECT_EQ(first["workload"], again["workload"]);
}

TEST(Sweep, CsvHasTheRowsOfJson) {
    const auto cells_of = [](const std::string& line) {
        std::vector<std::string> out(1);
        for (const char letter : line) {
            if (letter == ',') {
                out.emplace_back();
            } else {
                out.back() += letter;
            }
        }
        return out;
    };
    const std::vector<std::string> timed{"warm", "cold"};
    std::vector<std::string> order{"--over", "leaf=5,50", "--queries", "300", "--json"};
    const json rows = json::parse(sweep_of(kCrossing, order).out)["rows"];
    order.back() = "--csv";
    std::istringstream csv(sweep_of(kCrossing, order).out);
    std::string line;
    std::getline(csv, line);
    const std::vector<std::string> names = cells_of(line);
    std::size_t count = 0;
    for (; std::getline(csv, line); ++count) {
        ASSERT_LT(count, rows.size());
        json row = rows[count];
        for (const std::string& protocol : timed) {
            const bool has = row.contains("time_ns");
            row[protocol + "_ns"] = has ? row["time_ns"][protocol] : json();
            row[protocol + "_error_ns"] = has ? row["time_error_ns"][protocol] : json();
        }
        row.erase("time_ns");
        row.erase("time_error_ns");
        for (const char* of_all : {"memory", "nodes"}) {
            if (!row.contains(of_all)) row[of_all] = json();
        }
        EXPECT_EQ(std::set<std::string>(names.begin(), names.end()), keys(row));
        const std::vector<std::string> cells = cells_of(line);
        ASSERT_EQ(cells.size(), names.size()) << line;
        for (std::size_t i = 0; i < names.size(); ++i) {
            const json& value = row[names[i]];
            if (value.is_null() || cells[i].empty()) {
                EXPECT_TRUE(value.is_null() && cells[i].empty()) << names[i] << " of " << line;
            } else if (value.is_string()) {
                EXPECT_EQ(cells[i], value.get<std::string>());
            } else if (!names[i].ends_with("_ns")) {
                // Measured time is another each time.
                EXPECT_EQ(std::stod(cells[i]), value.get<double>()) << names[i];
            }
        }
    }
    EXPECT_EQ(count, rows.size());
    EXPECT_GT(count, 0u);
}

TEST(Sweep, LevelsOfThePresentFitAreKept) {
    const std::vector<std::string> order{"--leaf", "200", "--levels", "4", "--over", "leaf=2,4", "--queries", "300"};
    const Result run = sweep_of(kCrossing, order);
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_NE(run.out.find("leaf 200, levels 4 (now)"), std::string::npos) << run.out;
    EXPECT_NE(run.out.find("MOBB, 1 level"), std::string::npos) << run.out;
    std::vector<std::string> as_json = order;
    as_json.emplace_back("--json");
    const json sweep = json::parse(sweep_of(kCrossing, as_json).out);
    for (const json& row : sweep["rows"]) EXPECT_TRUE(row["levels"] == 4 || row["levels"] == 1);
}

TEST(Sweep, TextHasTwoColumnsOfTimeAndSaysWhichToTake) {
    const Result run = sweep_of(kClips, {"--queries", "1000"});
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_TRUE(run.out.starts_with("7 clips, 1,000 standard placements of each against each and itself (shift over "))
        << run.out;
    EXPECT_NE(run.out.find(", seed 0)"), std::string::npos);
    std::istringstream lines(run.out);
    std::string line;
    std::getline(lines, line);
    std::getline(lines, line);
    const std::size_t warm = line.find("warm ns"), cold = line.find("cold ns"), memory = line.find("memory"),
                      estimated = line.find("estimated ns");
    EXPECT_TRUE(warm < cold && cold < memory && memory < estimated && estimated != std::string::npos) << line;
    EXPECT_NE(run.out.find("MOBB, leaf 10 (now)"), std::string::npos);
    EXPECT_NE(run.out.find("\nwarm: "), std::string::npos) << run.out;
    EXPECT_NE(run.out.find("\ncold: "), std::string::npos) << run.out;
    EXPECT_NE(run.out.find(", over 1,000 placements"), std::string::npos) << run.out;
    EXPECT_NE(run.out.find("blocks"), std::string::npos) << run.out;
    EXPECT_LT(std::ranges::count(run.out, '\n'), 40);
}

TEST(Sweep, OfTheScenesQueriesAllAreAsked) {
    const Result run = sweep_of(kCrossing, {"--queries", "scene", "--json"});
    ASSERT_EQ(run.status, 0) << run.err;
    const json swept = json::parse(run.out), &workload = swept["workload"];
    EXPECT_EQ(workload["kind"], "queries");
    EXPECT_EQ(workload["queries"], 1);
    EXPECT_TRUE(workload["area"].is_null());
    EXPECT_TRUE(workload["seed"].is_null());
    // One query says nothing of its error.
    for (const json& row : swept["rows"]) EXPECT_TRUE(row["standard_error"].is_null());
    EXPECT_EQ(sweep_of(kCrossing, {"--queries", "scene"}).out.find("nan"), std::string::npos);
    EXPECT_EQ(sweep_of(kCrossing, {"--queries", "scene", "--csv"}).out.find("nan"), std::string::npos);
}

TEST(Sweep, OfACrowdSomeQueriesAreAskedAndIdleClipsHaveNoRow) {
    const TempFolder folder;
    const std::string file = folder.path() / "crowd.json";
    std::ostringstream agents;
    for (int i = 0; i < 200; ++i) {
        agents << (i == 0 ? "" : ", ") << R"({"name": "a)" << i << R"(", "clip": "walk", "start": )" << i % 7 << '}';
    }
    std::ofstream(file) << R"({"mobbscope": 1, "clips": {
        "walk": {"dt": 0.5, "samples": [[0, 0, 0.4], [0.3, 0, 0.4], [0.6, 0, 0.4], [0.9, 0, 0.4]]},
        "idle": {"dt": 0.5, "samples": [[0, 0, 0.3], [0, 0, 0.3]]}}, "agents": [)"
                        << agents.str() << "]}";
    const Result text = sweep_of(file, {"--queries", "scene", "--over", "leaf=1,2"});
    ASSERT_EQ(text.status, 0) << text.err;
    EXPECT_TRUE(text.out.starts_with("2 clips, 16000 of 19900 queries of the scene\n")) << text.out;
    const json rows = json::parse(sweep_of(file, {"--queries", "scene", "--over", "leaf=1,2", "--json"}).out)["rows"];
    std::set<std::string> clips;
    for (const json& row : rows) clips.insert(row["clip"].dump());
    EXPECT_EQ(clips, (std::set<std::string>{"null", "\"walk\""}));
}

TEST(Sweep, TimeScalesComeWithTheirLevels) {
    const Result run = sweep_of(kClips / "wander.glb", {"--over", "time_scale=0.5,2", "--over", "tree=mobb,umobb",
                                                        "--queries", "200", "--json"});
    ASSERT_EQ(run.status, 0) << run.err;
    const json levels = json::parse(run.out)["levels"];
    ASSERT_EQ(levels.size(), 4u) << "two kinds without, and two time scales";
    EXPECT_EQ(levels[0]["tree"], "mobb");
    EXPECT_EQ(levels[1]["tree"], "moving");
    EXPECT_EQ(levels[2]["time_scale"], 0.5);
    EXPECT_EQ(levels[3]["time_scale"], 2);
    EXPECT_GT(levels[3]["levels"][0]["volume"], 0);
    EXPECT_GT(levels[3]["levels"][0]["cost"], 0);
}

TEST(Sweep, WhatIsNoOrderIsOneLine) {
    const TempFolder folder;
    for (const std::vector<std::string>& bad :
         std::vector<std::vector<std::string>>{{"--over", "leaf=200:1"},
                                               {"--over", "leaf=5", "--over", "leaf=10"},
                                               {"--over", "leaf=0"},
                                               {"--over", "leaf="},
                                               {"--over", "leaf=nan"},
                                               {"--over", "leaf=1:1000000000"},
                                               {"--over", "tree=oak"},
                                               {"--over", "axes=x"},
                                               {"--over", "time_scale=nan:1"},
                                               {"--over", "time_scale=0:1"},
                                               {"--over", "levels=1:3"},
                                               {"--over"},
                                               {"--queries", "1000000000"},
                                               {"--queries", "0"},
                                               {"--queries", "some"},
                                               {"--seed", "-1"},
                                               {"--cost", "price"},
                                               {"--json", "--csv"},
                                               {"--leaf", "0"}}) {
        const Result run = sweep_of(kCrossing, bad);
        EXPECT_EQ(run.status, 2) << bad.back();
        EXPECT_TRUE(is_one_line(run.err)) << run.err;
        EXPECT_EQ(run.out, "");
    }
    std::string many = "leaf=1";
    for (int i = 2; i < 6000; ++i) {
        many += ',';
        many += std::to_string(i);
    }
    const std::string far = folder.path() / "far.json";
    std::ofstream(far)
        << R"({"mobbscope": 1, "clips": {"far": {"dt": 0.5, "samples": [[9e8, 9e8, 0.4], [9e8, 9e8, 0.4]]}}})";
    for (const auto& [file, over] : {std::pair(kCrossing, many), std::pair(far, std::string("leaf=1:20"))}) {
        const Result run = sweep_of(file, {"--over", over});
        EXPECT_EQ(run.status, 2) << file;
        EXPECT_TRUE(is_one_line(run.err)) << run.err;
        EXPECT_NE(run.err.find(file), std::string::npos) << run.err;
        EXPECT_EQ(run.out, "");
    }
    const std::string alone = kClips / "wander.glb", empty = folder.path() / "empty";
    std::filesystem::create_directory(empty);
    const std::string mixed = folder.path() / "mixed";
    std::filesystem::create_directory(mixed);
    std::filesystem::copy_file(alone, mixed + "/good.glb");
    std::ofstream(mixed + "/bad.bvh") << "HIERARCHY\n";
    for (const std::vector<std::string>& bad : std::vector<std::vector<std::string>>{
             {alone, "--queries", "scene"}, {empty}, {mixed}, {folder.path() / "none.bvh"}}) {
        const Result run = sweep_of(bad.front(), {bad.begin() + 1, bad.end()});
        EXPECT_EQ(run.status, 2) << bad.front();
        EXPECT_TRUE(is_one_line(run.err)) << run.err;
        EXPECT_EQ(run.out, "");
    }
}

}  // namespace
}  // namespace mobbscope
