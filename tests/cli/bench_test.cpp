#include "run_program.h"

#include <gtest/gtest.h>
#include <support/temp_folder.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

using testing::Result;
using testing::run_program;

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
    for (const char* method : {"brute", "mobb_1level", "umobb_1level", "mobb", "umobb", "hybrid1", "hybrid2"}) {
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
    const std::string scene = MOBBSCOPE_SOURCE_DIR "/assets/scenes/crossing.json";
    const testing::TempFolder folder;
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
    const std::string folder = MOBBSCOPE_SHARED_DATA "/bvh/long";
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

TEST(Bench, BadUsageIsSaidInOneLine) {
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{"bench"},
                                                      {"bench", "table3"},
                                                      {"bench", "table2", "--queries", "0"},
                                                      {"bench", "table2", "--rounds", "x"},
                                                      {"bench", "table2", "no/such/folder"}}) {
        const Result run = run_program(arguments);
        EXPECT_EQ(run.status, 2);
        EXPECT_EQ(run.out, "");
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    }
}

}  // namespace
}  // namespace mobbscope
