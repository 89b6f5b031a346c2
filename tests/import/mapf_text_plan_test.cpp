// Plans in text, as other solvers write them.
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

/// "0: (0,0) (1,0); 1: ...": the agents of a plan in a .txt file, and where they are at each step.
std::string plan_in(const std::string& text) {
    const TempFolder folder;
    std::string out;
    for (const ImportedClip& clip : import_clips(folder.write("plan.txt", text), {})) {
        EXPECT_EQ(clip.facts.format, "mapf");
        EXPECT_EQ(clip.clip->dt(), 1);
        EXPECT_EQ(clip.start, 0);
        out += clip.id + ':';
        for (const mobb::Disk& disk : clip.clip->samples()) out += " (" + brief(disk.x) + ',' + brief(disk.y) + ')';
        out += "; ";
    }
    return out;
}

/// What is said of such a file beyond second, metre and radius.
std::string remark_on(const std::string& text) {
    std::string out;
    const auto read = track_clips(parse_mapf_text_plan(text, "f"), "f", {});
    for (const ImportWarning& warning : read[0].facts.warnings) {
        if (warning.option.empty()) out += warning.text + "; ";
    }
    return out;
}

const std::string kTwoSteps = "0: (5,6) (6,6); 1: (1,2) (1,3); ";

TEST(TextPlan, ALineAStepIsAsLacamAndPibtWrite) {
    EXPECT_EQ(plan_in("agents=2\nmap_file=empty-8-8.map\nsolver=planner\nsolved=1\nsoc=2\nmakespan=1\ncomp_time=0\n"
                      "seed=0\nstarts=(5,6),(1,2),\ngoals=(6,6),(1,3),\nsolution=\n0:(5,6),(1,2),\n1:(6,6),(1,3),\n"),
              kTwoSteps);
    EXPECT_EQ(plan_in("instance=../a.txt\nagents=2\nlb_soc=2\nsolution=\n0:(5,6),(1,2),\n1:(6,6),(1,3),\n"), kTwoSteps);
    EXPECT_EQ(plan_in("0:(5,6),(1,2),\n1:(6,6),(1,3),\n"), kTwoSteps) << "pypibt writes no keys";
    EXPECT_EQ(plan_in("solution=\r\n0: (5, 6), (1, 2)\r\n\r\n1: (6, 6), (1, 3)\r\n"), kTwoSteps);
    EXPECT_EQ(plan_in("# a remark\n0:(5,6,X_PLUS),(1,2,Y_MINUS),\n1:(6,6,X_PLUS),(1,3,Y_MINUS),\n"), kTwoSteps);
    EXPECT_EQ(plan_in("t=0: (5,6) (1,2)\nt=1: (6,6) (1,3)\n"), kTwoSteps);
    EXPECT_EQ(plan_in("at[0]: (5,6),(1,2)\nat[1]: (6,6),(1,3)\n"), kTwoSteps);
    EXPECT_EQ(remark_on("0:(5,6),\n1:(6,6),\n"), "");
}

TEST(TextPlan, PickupsAndDeliveriesAreRead) {
    const std::string text =
        "agents=2\nstarts=(5,6),(1,2),\ntask=\n0:12->13,appear=0,finished=9\nsolution=\n"
        "0:(5,6)->(9,9):0,(1,2)->(1,2):-1,\n1:(6,6)->(9,9):0,(1,3)->(1,2):-1,\n";
    EXPECT_EQ(plan_in(text), kTwoSteps);
    EXPECT_EQ(remark_on(text), "where agents are headed ('->') is ignored; ");
}

TEST(TextPlan, ALineAnAgentHasRowsAndColumns) {
    const std::string eecbs = "Agent 0: (6,5)->(6,6)->\nAgent 1: (2,1)->(3,1)->\n";
    EXPECT_EQ(plan_in(eecbs), kTwoSteps);
    EXPECT_EQ(plan_in("Agent 0:(6,5)->(6,6)->\nAgent 1:(2,1)->(3,1)->\n"), kTwoSteps) << "MAPF-LNS2";
    EXPECT_EQ(plan_in("agent 0: (6, 5) -> (6, 6)\nagent 1: (2, 1) -> (3, 1)\n"), kTwoSteps);
    EXPECT_EQ(plan_in("\xef\xbb\xbf"
                      "Agent 0: (6,5)->(6,6)->\r\nAgent 1: (2,1)->(3,1)->\r\n"),
              kTwoSteps);
    EXPECT_EQ(plan_in("Agent 0: (6,5),(6,6)\nAgent 1: (2,1),(3,1)\n"), kTwoSteps);
    EXPECT_EQ(
        remark_on(eecbs),
        "cells of a line an agent are taken as (row, column), as EECBS and MAPF-LNS2 write them: x is the column, y "
        "the row; ");
}

TEST(TextPlan, WhoArrivesWaits) {
    EXPECT_EQ(plan_in("Agent 0: (0,0)->(0,1)->(0,2)->\nAgent 1: (2,1)->\n"),
              "0: (0,0) (1,0) (2,0); 1: (1,2) (1,2) (1,2); ");
    EXPECT_EQ(plan_in("Agent 7: (2,1)->\nAgent 3: (0,0)->(0,1)->(0,1)->\n"),
              "7: (1,2) (1,2) (1,2); 3: (0,0) (1,0) (1,0); ");
    EXPECT_EQ(plan_in("0:(5,6),\n1:(6,6),\n3:(8,6),\n"), "0: (5,6) (6,6) (7,6) (8,6); ") << "steps that are missing";
}

TEST(TextPlan, BadPlansAreRefused) {
    const struct {
        std::string text, message;
    } cases[] = {
        {"agents=2\nsolved=0\n", "has no step; a plan in text has a line a step"},
        {"0:(1,2),(3,4),\n1:(1,2),\n", "line 2: has 1 cell but the steps before it have 2; give every agent one"},
        {"0:(1,2),\n1:(1,2),(3,4),\n", "line 2: has 2 cells but the steps before it have 1"},
        {"1:(1,2),\n1:(1,2),\n", "line 2: step 1 stands after step 1"},
        {"0:(1,2),\n1:\n", "line 2: the step has no cell"},
        {"0:(1,2),\n1:(1,2", "line 2: cell 1: the bracket of a cell is not closed"},
        {"0:(1,2),\n1:(1),\n", "line 2: cell 1: a cell has two numbers"},
        {"0:(1,2),\n1:(1,b),\n", "line 2: cell 1: 'b' is not a finite number"},
        {"0:(1,2),\n1:(1,nan),\n", "line 2: cell 1: 'nan' is not a finite number"},
        {"0:(1,2),\n1:(1,1e12),\n", "line 2: cell 1: a cell is beyond"},
        {"0:(1,2),\n1:[1,2],\n", "line 2: cell 1: a cell in brackets was expected"},
        {"0:(1,2)->(1,3)->\n", "line 1: cell 1: an arrow and no task after it"},
        {"0:(1,2),\n99999999999999999999:(1,2),\n", "line 2: '99999999999999999999' is beyond"},
        {"0:(1,2),\n1:(1,2),\n90000000:(1,2),\n", "line 3: agents stay where they are until"},
        {"0:(1,2),\nAgent 1: (1,2)->\n", "line 2: lines of agents and of steps are mixed"},
        {"Agent 0: (1,2)->\nAgent 0: (1,2)->\n", "line 2: agent 0 has a line already"},
        {"Agent 0: (1,2)->\nAgent 1:\n", "line 2: agent 1 has no cell"},
        {"Agent 0: (1,2)->\nfound in 3 s\n", "line 2: is not a line of a plan"},
        {"2\n12,13,14,\n7,7,7,\n", "line 1: cells are numbers here, as MAPF-LNS writes them"},
    };
    for (const auto& bad : cases) {
        ASSERT_TRUE(looks_like_mapf_text_plan(bad.text)) << bad.text;
        const std::string said = input_error([&] { parse_mapf_text_plan(bad.text, "f.txt"); });
        EXPECT_NE(said.find("f.txt: " + bad.message), std::string::npos) << bad.message << "\n" << said;
    }
}

TEST(TextPlan, OtherTextIsNone) {
    for (const std::string text :
         {"", "# agents=2\n", "10 1 1.5 2\n", "1 43 100 200 183\n", "id=1 2 3\n", "schedule: 3\n", "a: (1,2)\n",
          "0: 1 2\n", "id,x,y\n", "3\n1 2 3\n", "fps=25\n1 2 3 4\n", "0 10 20 30 60 5 0 0 0 \"Pedestrian\"\n"}) {
        EXPECT_FALSE(looks_like_mapf_text_plan(text)) << text;
    }
}

}  // namespace
}  // namespace mobbscope
