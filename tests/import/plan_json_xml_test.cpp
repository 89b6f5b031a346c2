// Plans in JSON and XML: Robot Runners, Continuous-CBS.
#include <base/text.h>
#include <import/import.h>
#include <import/tracks/mapf_plan.h>
#include <support/input_error.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

/// "0: (0,0) (1,0); 1: ...": the agents of a plan, whatever its name, and where they are at each sample.
std::string plan_cells(const std::string& text, const std::string& name = "plan.json") {
    const TempFolder folder;
    std::string out;
    for (const ImportedClip& clip : import_clips(folder.write(name, text), {})) {
        EXPECT_EQ(clip.facts.format, "mapf");
        EXPECT_EQ(clip.start, 0);
        out += clip.id + ':';
        for (const mobb::Disk& disk : clip.clip->samples()) out += " (" + brief(disk.x) + ',' + brief(disk.y) + ')';
        out += "; ";
    }
    return out;
}

std::string runners(const std::string& model, const std::string& start, const std::string& paths) {
    return R"({"actionModel": ")" + model + R"(", "teamSize": 2, "start": )" + start + R"(, "actualPaths": )" + paths +
           R"(, "plannerPaths": ["W", "W"]})";
}

const std::string kStarts = R"([[0, 0, "E"], [2, 2, "N"]])";

TEST(RobotRunners, RobotsMoveOrTurnAndGoForward) {
    EXPECT_EQ(plan_cells(runners("MAPF", kStarts, R"(["R,R,W", "U,D,L"])")),
              "0: (0,0) (1,0) (2,0) (2,0); 1: (2,2) (2,1) (2,2) (1,2); ");
    EXPECT_EQ(plan_cells(runners("MAPF_T", kStarts, R"(["F,R,F,R,F,T", "F,C,F"])")),
              "0: (0,0) (1,0) (1,0) (1,1) (1,1) (0,1) (0,1); 1: (2,2) (2,1) (2,1) (1,1) (1,1) (1,1) (1,1); ")
        << "R turns clockwise as rows go down; the second one waits where it ended";
    for (const char* name : {"plan.txt", "plan", "plan.json.gz"})
        EXPECT_EQ(plan_cells(runners("MAPF", kStarts, R"(["", "W"])"), name), "0: (0,0) (0,0); 1: (2,2) (2,2); ");
}

TEST(RobotRunners, WhatWasTakenIsSaid) {
    const auto warnings = [](const std::string& text) {
        std::string out;
        const std::vector<ImportedClip> clips = track_clips(parse_robot_runners(text, "f"), "f", {});
        for (const ImportWarning& warning : clips[0].facts.warnings) {
            if (warning.option.empty()) out += warning.text + "; ";
        }
        return out;
    };
    const std::string cells = "cells are (row, column): x is the column, y the row; ";
    EXPECT_EQ(warnings(runners("MAPF_T", kStarts, R"(["F", "F"])")), cells);
    EXPECT_EQ(warnings(R"({"start": [[0, 0, "E"]], "plannerPaths": ["F"]})"),
              cells + "there are no actualPaths: plannerPaths are taken, which the robots need not have followed; ");
}

TEST(RobotRunners, BadPlansAreNamed) {
    const struct {
        std::string text, message;
    } cases[] = {
        {R"({"actualPaths": ["F"]})", "p: line 1: the key 'start' is missing"},
        {R"({"start": [[0, 0, "E"]]})", "p: line 1: the key 'plannerPaths' is missing"},
        {runners("MAPF_X", kStarts, R"(["F", "F"])"),
         "p: line 1, /actionModel: 'MAPF_X' is not an action model that is known; give MAPF or MAPF_T"},
        {runners("MAPF", kStarts, R"(["W"])"),
         "p: line 1, /actualPaths: has 1 path for 2 starts; give every robot one of each"},
        {runners("MAPF", kStarts, R"(["W", "W,F"])"),
         "p: line 1, /actualPaths/1: step 2 is 'F', which is none of R, D, L, U, W and T"},
        {runners("MAPF_T", kStarts, R"(["U", "W"])"),
         "p: line 1, /actualPaths/0: step 1 is 'U', which is none of F, R, C, W and T"},
        {runners("MAPF_T", R"([[0, 0], [1, 1]])", R"(["F", "F"])"),
         "p: line 1, /start/0: has no heading; give [row, column, \"E\"], or S, W or N"},
        {runners("MAPF_T", R"([[0, 0, "X"], [1, 1, "E"]])", R"(["F", "F"])"),
         "p: line 1, /start/0/2: 'X' is no heading; give E, S, W or N"},
        {runners("MAPF", R"([[0], [1, 1]])", R"(["W", "W"])"),
         "p: line 1, /start/0: must be [row, column], and with turns a heading such as \"E\""},
    };
    for (const auto& bad : cases)
        EXPECT_EQ(input_error([&] { parse_robot_runners(bad.text, "p"); }).substr(0, bad.message.size()), bad.message);
}

std::string section(const std::string& from, const std::string& to, const std::string& duration) {
    const auto at = [](const std::string& cell, const std::string& which) {
        return which + "_i=\"" + cell.substr(0, 1) + "\" " + which + "_j=\"" + cell.substr(1) + "\" ";
    };
    return "<section number=\"0\" " + at(from, "start") + at(to, "goal") + "duration=\"" + duration + "\"/>\n";
}

std::string ccbs(const std::string& sections_0, const std::string& sections_1) {
    return "<?xml version=\"1.0\" ?>\n<root>\n<agent start_i=\"0\"/><log>\n<agent number=\"0\"><path>\n" + sections_0 +
           "</path></agent><agent number=\"1\"><path>" + sections_1 + "</path></agent></log></root>\n";
}

TEST(CcbsPlan, SectionsLastAsLongAsTheySay) {
    EXPECT_EQ(plan_cells(ccbs(section("00", "01", "1") + section("01", "02", "1"), section("22", "12", "1")), "p.xml"),
              "0: (0,0) (1,0) (2,0); 1: (2,2) (2,1) (2,1); ");
    EXPECT_EQ(plan_cells(ccbs(section("00", "00", "0.5") + section("00", "01", "1"), section("22", "12", "1.5"))),
              "0: (0,0) (0,0) (0.5,0) (1,0); 1: (2,2) (2,1.66667) (2,1.33333) (2,1); ");
    // Of no common step: the way is looked at more often.
    const auto clips = track_clips(
        parse_ccbs_plan(ccbs(section("00", "11", "1.4142135623730951"), section("22", "12", "1")), "p"), "p", {});
    EXPECT_EQ(clips[1].clip->dt(), 1.0 / 30);
    EXPECT_NEAR(clips[1].clip->samples()[15].y, 1.5, 1e-9);
}

TEST(CcbsPlan, BadPlansAreNamed) {
    const std::string good = section("00", "01", "1");
    const struct {
        std::string text, message;
    } cases[] = {
        {"<root>\n<agent start_i=\"0\"/>\n</root>",
         "p: line 1, <root>: has no log: is this the task for Continuous-CBS? Give the log that it writes, whose name "
         "ends with _log.xml"},
        {"<root><agent/><log>\n<agent number=\"1\"", "p: line 2: is not XML: "},
        {"<root>\n<log/></root>", "p: line 2, <log>: has no agent with a path; was a solution found?"},
        {ccbs(good + section("02", "03", "1"), good),
         "p: line 6, <section>: begins where the section before does not end; check them"},
        {ccbs(section("00", "01", "x"), good),
         "p: line 5, <section>: duration is 'x', which is no finite number; write it like 0.25"},
        {ccbs(section("00", "01", "-1"), good), "p: line 5, <section>: its duration is negative; give 0 or more"},
        {ccbs(section("00", "01", "0"), good), "p: line 5, <section>: goes elsewhere in no time; check its duration"},
        {ccbs("", good), "p: line 4, <agent>: has no section; give its path one"},
        {"<root><log>\n<agent><path/></agent></log></root>", "p: line 2, <agent>: has no number; add it"},
    };
    for (const auto& bad : cases)
        EXPECT_EQ(input_error([&] { parse_ccbs_plan(bad.text, "p"); }).substr(0, bad.message.size()), bad.message);
}

const std::string kScenario =
    "version 1\n0\tm.map\t32\t32\t0\t0\t4\t0\t4\n0 m.map 32 32 2 2 2 0 2.5\n1\tm.map\t32\t32\t9\t9\t0\t0\t9\n";

TEST(MapfTracker, MovesStartWhereTheScenarioSays) {
    const TempFolder folder;
    const auto cells = [&](const std::string& name, const std::string& text) {
        std::string out;
        for (const ImportedClip& clip : import_clips(folder.write(name, text), {})) {
            EXPECT_EQ(clip.facts.format, "mapf");
            out += clip.id + ':';
            for (const mobb::Disk& disk : clip.clip->samples()) out += " (" + brief(disk.x) + ',' + brief(disk.y) + ')';
            out += "; ";
        }
        return out;
    };
    folder.write("m-32-random-1.scen", kScenario);
    const std::string same = "0: (0,0) (1,0) (2,0) (2,0); 1: (2,2) (2,1) (2,0) (2,1); ";
    EXPECT_EQ(cells("any.csv",
                    "map_name,scen_type,type_id,agents,lower_cost,solution_plan\n"
                    "m-32,random,1,2,5,\"rrw\nuud\"\n"),
              same);
    EXPECT_EQ(cells("m-32_random_1_2.csv", "\"agents\",\"solution_cost\",\"path\"\r\n\"2\",\"5\",\"rr\nuud\n\"\r\n"),
              same);
}

TEST(MapfTracker, BadPlansAreNamed) {
    const TempFolder folder;
    const std::string scenario = folder.write("m-even-1.scen", kScenario);
    const std::string file = folder.path() / "p.csv";
    const std::string header = "map_name,scen_type,type_id,agents,solution_cost,solution_plan\n";
    const struct {
        std::string text, message;
    } cases[] = {
        {header + "n,even,1,1,1,r\n",
         ": is a plan of the MAPF tracker, without where its agents start: put its scenario beside it, as "
         "'n-even-1.scen'"},
        {"agents,solution_cost\n1,1\n", ": line 1: the header names no column solution_plan or path; add it"},
        {header + "m,even,1,1,1\n", ": line 2: has 5 values but the header names 6; the file may be cut off"},
        {header + "m,even,1,1,1,r\nm,even,1,2,1,r\n", ": line 3: holds a second plan; leave one"},
        {header + "m,even,1,1,1,\n", ": line 2: the plan is empty; give one with a solution"},
        {header + "m,even,1,2,2,\"r\nx\"\n", ": line 3: 'x' is no move; they are u, d, l, r and w"},
        {header + "m,even,1,2,2,\"r\nr\nr\nr\"\n", ": line 5: has more agents than " + scenario + " has starts, 3"},
    };
    for (const auto& bad : cases)
        EXPECT_EQ(input_error([&] { parse_mapf_tracker(bad.text, file); }), file + bad.message);
    folder.write("m-even-1.scen", "version 1\n0 m.map 32\n");
    EXPECT_EQ(input_error([&] { parse_mapf_tracker(header + "m,even,1,1,1,r\n", file); }),
              scenario + ": line 2: is no row of a scenario, which has a start x y in its columns 5 and 6");
}

}  // namespace
}  // namespace mobbscope
