#include "run_program.h"

#include <base/text.h>
#include <support/folders.h>
#include <support/json_keys.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <set>

namespace mobbscope {
namespace {

// 1 goes along x, 2 comes towards it a second later; they pass 0.3 m apart at 4 m/s. 3 is elsewhere.
const double kHalfOfContact = std::sqrt(0.4 * 0.4 - 0.3 * 0.3) / 4;  // seconds
const std::string kTrajectories =
    "#framerate: 2\n# id frame x/m y/m\n1 10 0 0\n1 11 1 0\n1 12 2 0\n1 13 3 0\n1 14 4 0\n2 12 4 0.3\n2 13 3 0.3\n"
    "2 14 2 0.3\n3 10 20 20\n3 11 21 20\n";
const std::string kCsv = "id,t,x,y,r\n1,5,0,0,0.2\n1,5.5,1,0,0.2\n1,6,2,0,0.2\n2,5.5,2,0.3,0.2\n2,6,1,0.3,0.2\n";

TEST(Conflicts, JsonHasThePairs) {
    const TempFolder folder;
    const std::string file = folder.write("crowd.txt", kTrajectories);
    const json found = json_of({"conflicts", file});
    EXPECT_EQ(keys(found), (std::set<std::string>{"file", "t0", "agents", "radius", "pairs", "pairs_tested", "seconds",
                                                  "warnings", "conflicts"}));
    EXPECT_EQ(found["file"], file);
    EXPECT_EQ(found["t0"], 5) << "frame 10";
    EXPECT_EQ(found["agents"], 3);
    EXPECT_EQ(found["radius"], 0.2);
    EXPECT_EQ(found["pairs"], 3);
    EXPECT_EQ(found["pairs_tested"], 1);
    EXPECT_NEAR(found["seconds"].get<double>(), 2 * kHalfOfContact, 1e-12);
    ASSERT_EQ(found["conflicts"].size(), 1u);
    const json& conflict = found["conflicts"][0];
    EXPECT_EQ(keys(conflict), (std::set<std::string>{"a", "b", "intervals", "least_clearance", "time", "a_sample",
                                                     "b_sample", "position"}));
    EXPECT_EQ(conflict["a"], "1");
    EXPECT_EQ(conflict["b"], "2");
    ASSERT_EQ(conflict["intervals"].size(), 1u);
    const json& interval = conflict["intervals"][0];
    EXPECT_NEAR(interval[0].get<double>(), 1.5 - kHalfOfContact, 1e-12)
        << "the crowd's clock begins with its first frame";
    EXPECT_NEAR(interval[1].get<double>(), 1.5 + kHalfOfContact, 1e-12);
    EXPECT_NEAR(conflict["least_clearance"].get<double>(), -0.1, 1e-12);
    EXPECT_EQ(conflict["time"], 1.5);
    EXPECT_EQ(conflict["a_sample"], 2) << "at the end of what it covers";
    EXPECT_EQ(conflict["b_sample"], 0);
    EXPECT_EQ(conflict["position"], json::parse("[3, 0.15]"));
}

TEST(Conflicts, TextIsALineAPairAndASummary) {
    const TempFolder folder;
    const std::string file = folder.write("crowd.txt", kTrajectories);
    const Result run = run_program({"conflicts", file});
    EXPECT_EQ(run.status, 0);
    EXPECT_EQ(
        run.out,
        "1 and 2: 0.132288 s, 1.43386 to 1.56614 s; least clearance -0.1 m at 1.5 s near (3, 0.15), samples 2 and "
        "0\n1 conflict among 3 agents, 0.1323 s in all; 1 of 3 pairs tested\n");
    const Result held = run_program({"conflicts", file, "--motion", "held"});
    EXPECT_EQ(held.out.find("1 and 2: 0.5 s, 1.5 to 2 s; least clearance -0.1 m at 1.5 s"), 0u) << held.out;
    EXPECT_NE(run.err.find("0.2 m are taken"), std::string::npos) << "what was assumed is said";
    const Result none = run_program({"conflicts", file, "--radius", "0.1"});
    EXPECT_EQ(none.out, "0 conflicts among 3 agents, 0 s in all; 0 of 3 pairs tested\n");
    EXPECT_EQ(none.err, "");
}

TEST(Conflicts, CheckIsStatusOneForAConflict) {
    const TempFolder folder;
    const std::string file = folder.write("crowd.txt", kTrajectories);
    EXPECT_EQ(run_program({"conflicts", file, "--check"}).status, 1);
    EXPECT_EQ(run_program({"conflicts", file, "--check", "--radius", "0.1"}).status, 0);
}

TEST(Conflicts, TracksOfACsvKeepTheirTimes) {
    const TempFolder folder;
    const json found = json_of({"conflicts", folder.write("tracks.csv", kCsv)});
    ASSERT_EQ(found["conflicts"].size(), 1u);
    // They walk towards each other at 2 m/s each, and pass at 0.75 s.
    ASSERT_EQ(found["conflicts"][0]["intervals"].size(), 1u);
    EXPECT_NEAR(found["conflicts"][0]["intervals"][0][0].get<double>(), 0.75 - kHalfOfContact, 1e-12);
    EXPECT_NEAR(found["conflicts"][0]["intervals"][0][1].get<double>(), 0.75 + kHalfOfContact, 1e-12);
    // Nobody collides with somebody who has left: 2 comes to where 1 was, when 1 is gone.
    EXPECT_EQ(
        json_of({"conflicts",
                 folder.write("gone.csv",
                              "id,t,x,y,r\n1,5,0,0,0.2\n1,6,2,0,0.2\n2,6,2,0.3,0.2\n2,7,1,0.3,0.2\n")})["conflicts"]
            .size(),
        0u);
    EXPECT_EQ(json_of({"conflicts", folder.write("one.csv", "t,x,y,r\n0,0,0,1\n1,0,0,1\n")})["pairs"], 0);
}

TEST(Conflicts, ARadiusIsForEveryClip) {
    const TempFolder folder;
    const std::string file = folder.write("s.json", R"({"clips": {"c": {"dt": 1, "samples": [[0,0,1],[1,0,1]]},
        "d": {"dt": 1, "samples": [[0,0,2]]}}, "agents": [{"name": "A", "clip": "c"},
        {"name": "B", "clip": "d", "translate": [0, 2.5]}]})");
    const json found = json_of({"conflicts", file});
    EXPECT_TRUE(found["radius"].is_null());
    EXPECT_EQ(found["conflicts"].size(), 1u);
    const Result run = run_program({"conflicts", file, "--radius", "1", "--json"});
    EXPECT_EQ(run.err, "");
    EXPECT_EQ(json::parse(run.out)["radius"], 1);
    EXPECT_TRUE(json::parse(run.out)["conflicts"].empty());
    // Queries are about the same disks.
    EXPECT_EQ(json_of({"query", file})["results"][0]["collides"], true);
    const Result query = run_program({"query", file, "--radius", "1", "--json"});
    EXPECT_EQ(query.err, "");
    EXPECT_EQ(json::parse(query.out)["results"][0]["collides"], false);
}

// Both come to cell (1, 0) at step 1; then they go on.
const std::string kOneCell =
    "schedule:\n  a:\n  - {t: 0, x: 0, y: 0}\n  - {t: 1, x: 1, y: 0}\n  - {t: 2, x: 2, y: 0}\n"
    "  b:\n  - {t: 0, x: 1, y: 1}\n  - {t: 1, x: 1, y: 0}\n  - {t: 2, x: 1, y: -1}\n";

TEST(Conflicts, OfAPlanNamesWhoIsInOneCell) {
    const TempFolder folder;
    const std::string file = folder.write("plan.yaml", kOneCell);
    const json found = json_of({"conflicts", file})["conflicts"];
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0]["plan"], json::parse(R"([{"kind": "vertex", "t0": 1, "t1": 1, "a": [1, 0], "b": [1, 0]}])"));
    EXPECT_NE(run_program({"conflicts", file}).out.find("; vertex conflict at 1 s in (1, 0)\n"), std::string::npos);
    EXPECT_FALSE(json_of({"conflicts", folder.write("crowd.txt", kTrajectories)})["conflicts"][0].contains("plan"))
        << "people are in no cells";
}

TEST(Conflicts, OfAPlanNamesWhoSwapCells) {
    const TempFolder folder;
    const std::string file = folder.write("plan.yaml",
                                          "schedule:\n  a:\n  - {t: 0, x: 0, y: 0}\n  - {t: 1, x: 1, y: 0}\n"
                                          "  b:\n  - {t: 0, x: 1, y: 0}\n  - {t: 1, x: 0, y: 0}\n");
    const json found = json_of({"conflicts", file})["conflicts"];
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0]["plan"], json::parse(R"([{"kind": "swap", "t0": 0, "t1": 1, "a": [0, 0], "b": [1, 0]}])"));
    EXPECT_NE(
        run_program({"conflicts", file}).out.find("; swap (edge) conflict from 0 to 1 s between (0, 0) and (1, 0)\n"),
        std::string::npos);
    EXPECT_EQ(run_program({"conflicts", file, "--check"}).status, 1);
}

/// The conflicts of a plan in the words of path finding, "vertex 4 (2,0); ", as conflicts --json has them.
std::string named_conflicts(const std::string& file, const std::vector<std::string>& options = {}) {
    const json all = json_of(with({"conflicts", file}, options));
    std::string out;
    for (const json& pair : all["conflicts"]) {
        for (const json& found : pair["plan"]) {
            out += found["kind"].get<std::string>() + ' ' + brief(found["t0"].get<double>()) + " (" +
                   brief(found["a"][0].get<double>()) + ',' + brief(found["a"][1].get<double>()) + "); ";
        }
    }
    return out;
}

TEST(Conflicts, AgentsOfAPlanStayAtTheirGoals) {
    const TempFolder folder;
    const std::string passes_by =
        "b: [{t: 0, x: 1, y: 2}, {t: 1, x: 1, y: 1}, {t: 2, x: 1, y: 0}, {t: 3, x: 1, y: -1}]";
    const std::string ends_there = "b: [{t: 0, x: 1, y: 2}, {t: 1, x: 1, y: 1}, {t: 2, x: 1, y: 0}]";
    const struct {
        std::string what, agents, conflicts;
    } cases[] = {
        {"a goal that was reached is ignored", "a: [{t: 0, x: 0, y: 0}, {t: 1, x: 1, y: 0}], " + passes_by,
         "vertex 2 (1,0); "},
        {"begins at the goal", "a: [{t: 0, x: 1, y: 0}], " + passes_by, "vertex 2 (1,0); "},
        {"one step, at another time", "a: [{t: 1, x: 1, y: 0}], " + passes_by, "vertex 2 (1,0); "},
        {"begins late", "a: [{t: 3, x: 1, y: 0}, {t: 4, x: 2, y: 0}], " + passes_by, "vertex 2 (1,0); "},
        {"one goal, reached at different times", "a: [{t: 0, x: 0, y: 0}, {t: 1, x: 1, y: 0}], " + ends_there,
         "vertex 2 (1,0); "},
        {"both arrive at the last step",
         "a: [{t: 0, x: 3, y: 0}, {t: 1, x: 2, y: 0}, {t: 2, x: 1, y: 0}], " + ends_there, "vertex 2 (1,0); "},
        {"leaves, comes back and stays",
         "a: [{t: 0, x: 1, y: 0}, {t: 1, x: 0, y: 0}, {t: 2, x: 0, y: 0}, {t: 3, x: 0, y: 0}, {t: 4, x: 1, y: 0}], " +
             passes_by,
         ""},
        {"waits by a step that is missing",
         "a: [{t: 0, x: 1, y: 0}, {t: 3, x: 1, y: 0}, {t: 4, x: 2, y: 0}], " + passes_by, "vertex 2 (1,0); "},
        {"both stay in one cell to the end",
         "a: [{t: 0, x: 1, y: 0}], " + ends_there + ", c: [{t: 0, x: 9, y: 9}, {t: 1, x: 9, y: 8}, {t: 4, x: 9, y: 5}]",
         "vertex 2 (1,0); vertex 3 (1,0); vertex 4 (1,0); "},
        {"swap before the goal",
         "a: [{t: 0, x: 1, y: 0}, {t: 1, x: 1, y: 1}], b: [{t: 0, x: 1, y: 1}, {t: 1, x: 1, y: 0}]", "swap 0 (1,0); "},
        {"goals apart", "a: [{t: 0, x: 0, y: 0}], " + ends_there, ""},
        {"nobody moves", "a: [{t: 0, x: 0, y: 0}], b: [{t: 0, x: 0, y: 0}]", "vertex 0 (0,0); "},
    };
    for (const auto& plan : cases) {
        const std::string file = folder.write("plan.yaml", "schedule: {" + plan.agents + "}\n");
        EXPECT_EQ(named_conflicts(file), plan.conflicts) << plan.what;
        EXPECT_EQ(run_program({"conflicts", file, "--check"}).status, plan.conflicts.empty() ? 0 : 1) << plan.what;
        const json direct = json_of({"conflicts", file, "--tree", "brute"})["conflicts"];
        EXPECT_EQ(json_of({"conflicts", file})["conflicts"], direct) << plan.what;
        for (const std::string tree : {"mobb", "umobb"})
            EXPECT_EQ(json_of({"conflicts", file, "--tree", tree})["conflicts"], direct) << plan.what << tree;
    }
}

TEST(Conflicts, OfAPlanAreTheSameWhereverItGoes) {
    const TempFolder folder;
    const std::string file = folder.write("plan.yaml",
                                          "schedule: {a: [{t: 0, x: 0, y: 0}, {t: 1, x: 1, y: 0}], b: [{t: 0, x: 1, y: "
                                          "3}, {t: 3, x: 1, y: 0}, {t: 5, x: 1, y: 2}]}");
    const json whole = json_of({"conflicts", file})["conflicts"];
    ASSERT_EQ(whole.size(), 1u);
    EXPECT_EQ(named_conflicts(file), "vertex 3 (1,0); ");
    EXPECT_EQ(named_conflicts(file, {"--trim", "2:5"}), "vertex 3 (1,0); ");
    EXPECT_EQ(named_conflicts(file, {"--trim", "4:5"}), "");
    EXPECT_EQ(named_conflicts(file, {"--dt", "0.5", "--unit", "2"}), "vertex 1.5 (2,0); ");
    for (const char* name : {"plan.csv", "plan.json"}) {
        const std::string copy = (folder.path() / name).string();
        ASSERT_EQ(run_program({"convert", file, "-o", copy}).status, 0);
        const json found = json_of({"conflicts", copy})["conflicts"];
        ASSERT_EQ(found.size(), 1u) << name;
        for (const char* key : {"a", "b", "intervals", "time", "position"})
            EXPECT_EQ(found[0][key], whole[0][key]) << name << key;
    }
}

TEST(Conflicts, OfTextPlansAreNamedToo) {
    const TempFolder folder;
    EXPECT_EQ(named_conflicts(
                  folder.write("lacam.txt", "agents=2\nsolution=\n0:(0,0),(1,2),\n1:(1,0),(1,1),\n2:(1,0),(1,0),\n")),
              "vertex 2 (1,0); ");
    EXPECT_EQ(
        named_conflicts(folder.write("eecbs.txt", "Agent 0: (0,0)->(0,1)->\nAgent 1: (2,1)->(1,1)->(0,1)->(0,2)->\n")),
        "vertex 2 (1,0); ");
}

TEST(Conflicts, OfThePublicPlansAreWhatIsExpected) {
    const std::filesystem::path data = kSharedData / "public";
    if (!std::filesystem::exists(data)) GTEST_SKIP() << "no test data at " << data;
    const std::pair<const char*, const char*> expected[] = {{"mapf_passes_over_reached_goal.yaml", "vertex 4 (2,0); "},
                                                            {"mapf_starts_at_goal.yaml", "vertex 3 (1,0); "}};
    for (const auto& [name, found] : expected) {
        const std::string file = (data / name).string();
        EXPECT_EQ(named_conflicts(file), found) << name;
        EXPECT_EQ(run_program({"conflicts", file, "--check"}).status, 1) << name;
    }
}

TEST(Conflicts, AHeldCrowdIsWarnedOfOnceByItsLongestStep) {
    const TempFolder folder;
    const Result run = run_program({"conflicts", folder.write("plan.yaml", kOneCell), "--motion", "held", "--dt", "1",
                                    "--unit", "2", "--radius", "0.5"});
    EXPECT_EQ(run.status, 0);
    EXPECT_TRUE(is_one_line(run.err)) << run.err;
    EXPECT_NE(
        run.err.find("clip 'a' (and 1 more clip): its disks are held, but it moves 2 m from sample 0 to the next, "
                     "more than its radius of 0.5 m"),
        std::string::npos)
        << run.err;
    EXPECT_NE(run.err.find("--motion linear"), std::string::npos);
}

// 1 is not seen from 0.5 to 3.5 s, when it would meet 2; both meet 3 where they are seen.
TEST(Conflicts, WhatRestsOnInventedMotionIsMarkedAndLeftOut) {
    const TempFolder folder;
    std::string text = "id,t,x,y\n";
    for (int i = 0; i <= 40; ++i) {
        const double t = 0.1 * i;
        if (i <= 5 || i >= 35) text += "1," + format_double(t) + ',' + format_double(t) + ",0\n";
        text += "2," + format_double(t) + ',' + format_double(4 - t) + ",0.1\n";
        text += "3," + format_double(t) + ",3.8,0.1\n";
    }
    const std::string file = folder.write("crowd.csv", text);
    const json found = json_of({"conflicts", file});
    ASSERT_EQ(found["conflicts"].size(), 3u);
    int marked = 0;
    for (const json& conflict : found["conflicts"]) {
        const bool is_marked = conflict.contains("invented");
        marked += is_marked;
        EXPECT_EQ(is_marked, conflict["a"] == "1" && conflict["b"] == "2") << conflict;
    }
    EXPECT_EQ(marked, 1);
    const json strict = json_of({"conflicts", file, "--strict-motion"});
    EXPECT_EQ(strict["conflicts"].size(), 2u);
    EXPECT_LT(strict["seconds"], found["seconds"]);
    const Result run = run_program({"conflicts", file, "--strict-motion"});
    EXPECT_EQ(run.out.find("rests on invented motion;"), std::string::npos) << run.out;
    EXPECT_NE(run.out.find("1 conflict rests on invented motion and is left out\n"), std::string::npos) << run.out;
    EXPECT_NE(run_program({"conflicts", file}).out.find("; rests on invented motion\n"), std::string::npos);
}

TEST(Conflicts, NoConflictStandsBesideADoubtThatIsNotSaid) {
    const TempFolder folder;
    std::string text = "id,t,x,y\n";
    for (int i = 0; i <= 40; ++i) text += "1," + format_double(0.1 * i) + ',' + format_double(100.0 * i) + ",0\n";
    const std::string file = folder.write("crowd.csv", text);
    const Result refused = run_program({"conflicts", file});
    EXPECT_EQ(refused.status, 2);
    EXPECT_NE(refused.err.find("give unit 0.001"), std::string::npos) << refused.err;
    EXPECT_EQ(run_program({"conflicts", file, "--unit", "0.001"}).out,
              "0 conflicts among 1 agent, 0 s in all; 0 of 0 pairs tested\n");
    const Result insisted = run_program({"conflicts", file, "--unit", "m"});
    EXPECT_NE(insisted.out.find("\nin doubt: the median speed of who moves is 1000 m/s"), std::string::npos)
        << insisted.out;
    const json warnings = json_of({"conflicts", file, "--unit", "m"})["warnings"];
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].get<std::string>().find("is 1000 m/s"), std::string::npos) << warnings;
    EXPECT_EQ(json_of({"conflicts", file, "--unit", "0.001"})["warnings"], json::array());
    // Of a scene, whichever of its files it is.
    folder.write("walk.csv", "id,t,x,y\n1,0,0,0\n1,1,1,0\n");
    const std::string scene = folder.write("scene.json", R"({"mobbscope": 1, "clips": {"a": {"source": "walk.csv"},
                          "b": {"source": "crowd.csv", "unit": "m"}}, "agents": [{"name": "1", "clip": "a"}, {"name": "2", "clip": "b"}]})");
    EXPECT_EQ(json_of({"conflicts", scene})["warnings"], warnings);
    EXPECT_NE(run_program({"conflicts", scene}).out.find("\nin doubt: the median speed"), std::string::npos);
}

TEST(Conflicts, KeptJumpsAreOneTrack) {
    const TempFolder folder;
    std::string text = "id,t,x,y\n";
    for (int i = 0; i <= 40; ++i)
        text += "17," + format_double(0.1 * i + (i > 20 ? 60 : 0)) + ',' + format_double(0.1 * i) + ",0\n";
    const std::string file = folder.write("crowd.csv", text);
    EXPECT_EQ(json_of({"conflicts", file})["agents"], 2);
    EXPECT_EQ(json_of({"conflicts", file, "--keep-jumps"})["agents"], 1);
    const std::string scene = folder.write(
        "a.json", R"({"mobbscope": 1, "clips": {"a": {"source": "crowd.csv", "id": "17", "keep_jumps": true},
                     "b": {"source": "crowd.csv", "id": "17#2"}}})");
    const json info = json_of({"info", scene});
    EXPECT_EQ(info["clips"][0]["samples"], 41 + 600);
    EXPECT_EQ(info["clips"][1]["samples"], 20);
}

TEST(Conflicts, WithoutAgentsItIsRefused) {
    const TempFolder folder;
    const Result run =
        run_program({"conflicts", folder.write("s.json", R"({"clips": {"c": {"dt": 1, "samples": [[0,0,1]]}}})")});
    EXPECT_EQ(run.status, 2);
    EXPECT_TRUE(is_one_line(run.err)) << run.err;
    EXPECT_EQ(run.out, "");
}

TEST(Trajectories, ASceneOfThemHasAnAgentForEachTrack) {
    const TempFolder folder;
    const std::string file = folder.write("crowd.txt", kTrajectories);
    const std::string scene = (folder.path() / "crowd.json").string();
    ASSERT_EQ(run_program({"convert", file, "-o", scene}).status, 0);
    const json written = json::parse(slurp(scene));
    ASSERT_EQ(written["agents"].size(), 3u);
    EXPECT_EQ(written["agents"][1]["name"], "2");
    EXPECT_EQ(written["agents"][1]["start"], 1);
    EXPECT_EQ(json_of({"conflicts", scene})["conflicts"], json_of({"conflicts", file})["conflicts"]);
    EXPECT_EQ(json::parse(run_program({"query", file, "--json"}).out)["results"].size(), 3u);
}

TEST(Trajectories, AsCsvTheyKeepTheirTimes) {
    const TempFolder folder;
    const std::string file = folder.write("crowd.txt", kTrajectories);
    const std::string csv = (folder.path() / "crowd.csv").string();
    ASSERT_EQ(run_program({"convert", file, "-o", csv}).status, 0);
    const std::string text = slurp(csv);
    EXPECT_TRUE(text.starts_with("id,t,x,y,r\n1,0,0,0,0.2")) << text;
    EXPECT_NE(text.find("\n2,1.5,3,0.3,"), std::string::npos) << text;
    EXPECT_EQ(json_of({"conflicts", csv})["conflicts"], json_of({"conflicts", file})["conflicts"]);
}

TEST(Trajectories, WhatHoldsForAllIsSaidOnce) {
    const TempFolder folder;
    const Result run = run_program({"info", folder.write("crowd.txt", kTrajectories)});
    EXPECT_EQ(run.status, 0);
    const std::size_t at = run.out.find("0.2 m are taken");
    ASSERT_NE(at, std::string::npos);
    EXPECT_EQ(run.out.find("0.2 m are taken", at + 1), std::string::npos) << run.out;
}

/// A small run; `kind` in place of "forced".
std::string small_run(const std::string& kind) {
    const std::string source = kSource;
    std::string text = slurp(source + "/tests/app/goldens/files/run.json");
    const auto replace_all = [&](const std::string& part, const std::string& by) {
        for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + by.size()))
            text.replace(at, part.size(), by);
    };
    replace_all("../../../../assets", source + "/assets");
    replace_all("\"forced\"", '"' + kind + '"');
    return text;
}

TEST(ConflictsOfARun, ThoseWithoutAForcedPlayAreCounted) {
    const TempFolder folder;
    const std::string run = folder.write("run.json", small_run("forced"));
    const std::string edited = folder.write("edited.json", small_run("pivoted"));
    EXPECT_EQ(json_of({"conflicts", run})["unforced"], 0);
    EXPECT_GT(json_of({"conflicts", edited})["unforced"], 0);
    EXPECT_EQ(run_program({"conflicts", run}).out.find("without a forced play"), std::string::npos);
    EXPECT_NE(run_program({"conflicts", edited}).out.find("without a forced play: an answer was wrong"),
              std::string::npos);
}

}  // namespace
}  // namespace mobbscope
