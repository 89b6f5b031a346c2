#include "run_program.h"

#include <gtest/gtest.h>
#include <mobb/kinds.h>
#include <support/folders.h>
#include <support/temp_folder.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {
namespace {

TEST(Bench, Table2OnBuiltInClips) {
    const Result run = run_program({"bench", "table2", "--queries", "2000", "--rounds", "1", "--json"});
    ASSERT_EQ(run.status, 0) << run.err;
    const nlohmann::json json = nlohmann::json::parse(run.out);
    EXPECT_EQ(json["workload"], "table2");
    EXPECT_EQ(json["queries"], 2000);
    EXPECT_EQ(json["clips"]["count"], 14);
    EXPECT_NEAR(json["clips"]["mean_duration"].get<double>(), 42, 6);
    std::vector<std::string> methods;
    for (const nlohmann::json& row : json["rows"]) methods.push_back(row["method"]);
    std::vector<std::string_view> expected{"brute", "mobb_1level", "umobb_1level"};
    for (const mobb::TreeKind kind : mobb::kTreeKinds) expected.push_back(mobb::info(kind).name);
    for (const std::string_view method : expected) {
        EXPECT_NE(std::find(methods.begin(), methods.end(), method), methods.end()) << method;
    }
}

TEST(Bench, CountsDependOnTheSeedAlone) {
    const auto counts = [](const std::string& seed) {
        const Result run =
            run_program({"bench", "table2", "--queries", "500", "--rounds", "1", "--seed", seed, "--json"});
        const nlohmann::json json = nlohmann::json::parse(run.out);
        std::string out;
        for (const nlohmann::json& row : json["rows"]) {
            out += row["method"].get<std::string>() + row["obb2d"].dump() + row["obb3d"].dump() + row["samples"].dump();
        }
        return out;
    };
    EXPECT_EQ(counts("4"), counts("4"));
    EXPECT_NE(counts("4"), counts("5"));
}

TEST(Bench, TakesEverySeedThatStaysTheSameInJson) {
    const auto run = [](const std::string& seed) {
        return run_program({"bench", "table2", "--queries", "50", "--rounds", "1", "--seed", seed, "--json"});
    };
    EXPECT_EQ(nlohmann::json::parse(run("9007199254740992").out)["seed"], 9007199254740992);
    EXPECT_EQ(run("9007199254740993").status, 2);
}

TEST(Bench, AgentsWithoutQueriesAreAskedInPairs) {
    const std::string scene = kCrossing;
    const TempFolder folder;
    nlohmann::json agents_alone = nlohmann::json::parse(std::ifstream(scene));
    agents_alone.erase("queries");
    for (nlohmann::json& clip : agents_alone["clips"]) {
        if (clip.contains("source")) {
            clip["source"] = (std::filesystem::path(scene).parent_path() / clip["source"].get<std::string>()).string();
        }
    }
    const std::size_t agents = agents_alone["agents"].size();
    const std::string file = (folder.path() / "agents.json").string();
    std::ofstream(file) << agents_alone;
    const Result run = run_program({"bench", "table1", file, "--rounds", "1", "--json"});
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(nlohmann::json::parse(run.out)["queries"], agents * (agents - 1) / 2);
}

TEST(Bench, Table2OnAFolder) {
    const std::string folder = kSharedData / "bvh/long";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "needs " << folder;
    const Result run = run_program({"bench", "table2", folder, "--queries", "3000", "--rounds", "1", "--json"});
    ASSERT_EQ(run.status, 0) << run.err;
    const nlohmann::json json = nlohmann::json::parse(run.out);
    EXPECT_EQ(json["clips"]["count"], 17);
    EXPECT_NEAR(json["positive"].get<double>(), 0.28, 0.08);
    const auto row = [&](const std::string& method) {
        for (const nlohmann::json& each : json["rows"]) {
            if (each["method"] == method) return each;
        }
        return nlohmann::json();
    };
    // The paper: 306 sample tests to 4, with 27 box tests.
    EXPECT_GT(row("mobb_1level")["sample_steps"].get<double>(), 150);
    EXPECT_LT(row("mobb")["sample_steps"].get<double>(), 10);
    EXPECT_LT(row("mobb")["obb2d"].get<double>(), 28);
}

TEST(Bench, SweepAndVariantsAreLists) {
    const Result run =
        run_program({"bench", "table2", "--queries", "200", "--rounds", "1", "--sweep", "--variants", "--json"});
    ASSERT_EQ(run.status, 0) << run.err;
    const nlohmann::json json = nlohmann::json::parse(run.out);
    int largest = 0;
    for (const nlohmann::json& row : json["leaf_sweep"]) largest = std::max(largest, row["leaf"].get<int>());
    EXPECT_EQ(largest, 200);
    EXPECT_EQ(json["leaf_sweep"][0]["method"], "brute");
    std::vector<std::string> variants;
    for (const nlohmann::json& row : json["variants"]) variants.push_back(row["method"]);
    for (const char* variant : {"mobb_1level", "mobb", "mobb_covariance", "umobb_w2", "mobb_walk_boxes"}) {
        EXPECT_NE(std::find(variants.begin(), variants.end(), variant), variants.end()) << variant;
    }
}

TEST(Bench, SaysHowQueriesWereDrawn) {
    const auto bench = [](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), "bench");
        arguments.insert(arguments.end(), {"--queries", "1000", "--rounds", "1", "--json"});
        const Result run = run_program(arguments);
        EXPECT_EQ(run.status, 0) << run.err;
        return nlohmann::json::parse(run.out);
    };
    // What is nearer collides more.
    const nlohmann::json near = bench({"table2", "--range", "1"}), far = bench({"table2", "--range", "8"});
    EXPECT_GT(near["positive"].get<double>(), 2 * far["positive"].get<double>());
    EXPECT_NE(far["description"].get<std::string>().find("within 8 m"), std::string::npos);
    // Who chooses where the last move ends is asked of what plays then: the roots always overlap in time.
    const nlohmann::json at_once = bench({"table1", "--ahead", "0", "--within", "5"}), ahead = bench({"table1"});
    EXPECT_GT(at_once["rows"][1]["root_box_tests"], 0.95);
    EXPECT_LT(ahead["rows"][1]["root_box_tests"], 0.6);
    EXPECT_LT(at_once["positive"], ahead["positive"]);  // most are far away
    EXPECT_NE(ahead["description"].get<std::string>().find("choosing 2.5 s ahead, of all within 1 m"),
              std::string::npos);
}

TEST(Bench, BadUsageIsSaidInOneLine) {
    const std::string crossing = kCrossing;
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{"bench"},
                                                      {"bench", "table3"},
                                                      {"bench", "table2", "--queries", "0"},
                                                      {"bench", "table2", "--rounds", "x"},
                                                      {"bench", "table1", "--ahead", "-1"},
                                                      {"bench", "table1", "--within", "nan"},
                                                      {"bench", "table2", "--range", "0"},
                                                      {"bench", "table2", "--ahead", "1"},
                                                      {"bench", "table2", "--within", "1"},
                                                      {"bench", "table1", "--range", "2"},
                                                      {"bench", "table1", crossing, "--ahead", "1"},
                                                      {"bench", "table2", "no/such/folder"}}) {
        const Result run = run_program(arguments);
        EXPECT_EQ(run.status, 2);
        EXPECT_EQ(run.out, "");
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    }
}

}  // namespace
}  // namespace mobbscope
