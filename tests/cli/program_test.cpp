// Exit statuses, streams and messages that hold for every command.
#include "run_program.h"

#include <support/folders.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <signal.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <regex>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope {
namespace {

TEST(Program, HelpAndVersionAreResults) {
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--help"},
                                                      {"-h"},
                                                      {"--version"},
                                                      {"fit", "--help"},
                                                      {"query", "-h"},
                                                      {"convert", "--version"}}) {
        const Result run = run_program(arguments);
        EXPECT_EQ(run.status, 0) << arguments[0];
        EXPECT_NE(run.out, "");
        EXPECT_EQ(run.err, "");
    }
    EXPECT_NE(run_program({"query", "--help"}).out.find("--all-contacts"), std::string::npos);
}

TEST(Program, BadUsageIsOneLineAndStatusTwo) {
    const std::string scene = kCrossing;
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{"querry", scene},
                                                      {"fit"},
                                                      {"fit", scene, "more"},
                                                      {"fit", scene, "--leef", "3"},
                                                      {"fit", scene, "--leaf", "0"},
                                                      {"fit", scene, "--leaf", "x"},
                                                      {"fit", scene, "--leaf", "99999999999999"},
                                                      {"fit", scene, "--leaf"},
                                                      {"fit", scene, "--levels", "-1"},
                                                      {"fit", scene, "--tree", "oak"},
                                                      {"fit", scene, "--tree", "brute"},
                                                      {"fit", scene, "--axes", "x"},
                                                      {"fit", scene, "--time-scale", "nan"},
                                                      {"fit", scene, "--time-scale", "0"},
                                                      {"fit", scene, "--fps", "-1"},
                                                      {"fit", scene, "--trim", "5"},
                                                      {"fit", scene, "--trim", "5:2"},
                                                      {"fit", scene, "--dt", "inf"},
                                                      {"fit", scene, "--unit", "ell"},
                                                      {"convert", scene},
                                                      {"convert", scene, "-o", "x.txt"},
                                                      {"nonsense\nwith a line break"}}) {
        const Result run = run_program(arguments);
        EXPECT_EQ(run.status, 2) << arguments.back() << run.err;
        EXPECT_TRUE(is_one_line(run.err)) << run.err;
        EXPECT_EQ(run.out, "");
    }
}

TEST(Program, AnOldNameOfAKindOfTreesIsRefusedWithTheNewOne) {
    const std::string scene = kCrossing;
    const TempFolder folder;
    const std::string old =
        folder.write("old.json", R"({"mobbscope": 1, "clips": {"c": {"dt": 1, "samples": [[0, 0, 1]]}},
 "fit": {"tree": "production"}})");
    const std::string script = folder.write("old.script", "frames 1\nrun tree.kind production\n");
    const std::string expecting = folder.write("expecting.script", "\nexpect /scene/fit/tree \"production\"\n");
    for (const auto& [arguments, place] : std::vector<std::pair<std::vector<std::string>, std::string>>{
             {{"fit", scene, "--tree", "production"}, "--tree: "},
             {{"query", scene, "--tree", "production"}, "--tree: "},
             {{"conflicts", scene, "--tree", "production"}, "--tree: "},
             {{"query", old}, old + ": line 2, /fit/tree: "},
             {{"--script", script, scene}, "line 2: "},
             {{"--script", expecting, scene}, "line 2: "}}) {
        const Result run = run_program(arguments);
        expect_refused(run, 2, place + "`production` is called `blocks`");
    }
}

TEST(Program, BadUsageNamesTheHelpThatListsTheOption) {
    EXPECT_NE(run_program({"graph", "build", "--bogus"}).err.find("see mobbscope graph build --help"),
              std::string::npos);
    EXPECT_NE(run_program({"fit", "--bogus"}).err.find("see mobbscope fit --help"), std::string::npos);
}

TEST(Program, NumbersAreReadAsTheFilesHaveThem) {
    const std::string csv = kScenes / "walk.csv";
    for (const char* option : {"--leaf", "--levels", "--time-scale", "--fps", "--dt", "--radius", "--unit", "--trim"}) {
        for (const char* bad : {"", "0x10", " 5", "5 ", "nan", "inf", "1e999", "1,5", "5m"}) {
            const Result run = run_program({"fit", csv, option, bad});
            EXPECT_EQ(run.status, 2) << option << " '" << bad << "'";
            EXPECT_TRUE(is_one_line(run.err)) << run.err;
            EXPECT_NE(run.err.find(option), std::string::npos) << run.err;
        }
    }
    // Ten, not the octal eight.
    EXPECT_EQ(run_program({"fit", csv, "--leaf", "010"}).out, run_program({"fit", csv, "--leaf", "10"}).out);
    EXPECT_NE(run_program({"fit", csv, "--leaf", "010"}).out, run_program({"fit", csv, "--leaf", "8"}).out);
}

TEST(Program, RangesAreToldWithBothTheirBounds) {
    const std::string csv = kScenes / "walk.csv";
    const auto complaint = [&](const std::vector<std::string>& option) {
        std::vector<std::string> arguments{"fit", csv};
        arguments.insert(arguments.end(), option.begin(), option.end());
        const Result run = run_program(arguments);
        EXPECT_EQ(run.status, 2) << option[0];
        return run.err;
    };
    EXPECT_NE(complaint({"--radius", "1e10"}).find("from 0 to 1e+09"), std::string::npos);
    EXPECT_NE(
        complaint({"--dt", "1e13"})
            .find("over 2e-09 seconds, as what two samples share for at most 1e-9 s is not tested, and at most 1e+12"),
        std::string::npos);
    EXPECT_NE(complaint({"--trim", "0:1e13"}).find("0 <= A < B <= 1e+12"), std::string::npos);
    EXPECT_NE(complaint({"--fps", "1e7"}).find("over 0 and at most 1000000"), std::string::npos);
}

TEST(Program, FilesBeforeACommandAreNotDropped) {
    for (const std::string& file : {std::string("nofile.json"), kCrossing}) {
        const Result run = run_program({file, "query", kCrossing});
        expect_refused(run, 2, "stands before the command query");
    }
}

TEST(Program, AnEmptyNameIsSaidToBeEmpty) {
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"fit", ""}, {"info", ""}, {"convert", kScenes / "walk.csv", "-o", ""}, {""}}) {
        const Result run = run_program(arguments);
        EXPECT_EQ(run.status, 2);
        EXPECT_NE(run.err.find("the name of a file is empty"), std::string::npos) << run.err;
    }
}

TEST(Program, BadInputIsOneLineAndStatusTwoForEveryCommand) {
    const TempFolder folder;
    const std::string files[] = {folder.write("syntax.json", "{\"clips\": \n oops}"),
                                 folder.write("key.json", R"({"clips": {}, "agnets": []})"),
                                 folder.write("nan.csv", "t,x,y,r\n0,0,0,0\n1,nan,0,0\n"),
                                 folder.write("empty.json", ""),
                                 folder.write("walk.bvh", "HIERARCHY"),
                                 folder.write("source.json", R"({"clips": {"c": {"source": "nan.csv"}}})"),
                                 folder.write("line\nbreak.csv", "nothing"),
                                 folder.path() / "none.json",
                                 folder.path()};
    for (const std::string& file : files) {
        for (const std::vector<std::string>& arguments : {std::vector<std::string>{"fit", file},
                                                          {"fit", file, "--json"},
                                                          {"info", file},
                                                          {"info", file, "--json"},
                                                          {file},
                                                          {"query", file},
                                                          {"query", file, "--json"},
                                                          {"convert", file, "-o", folder.path() / "out.csv"},
                                                          {"render", file, "-o", folder.path() / "out.png"}}) {
            const Result run = run_program(arguments);
            EXPECT_EQ(run.status, 2) << arguments[0] << ' ' << file << run.err;
            EXPECT_TRUE(is_one_line(run.err)) << run.err;
            EXPECT_EQ(run.out, "");
        }
    }
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "out.csv"));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "out.png"));
}

TEST(Program, LongNamesAreCutInTheMiddle) {
    const TempFolder folder;
    const std::string scene = kCrossing;
    const std::string png = folder.path() / "o.png";
    std::string blanks;
    while (blanks.size() < 5000) blanks += "a ";
    for (const std::string& name : {std::string(5000, 'x'), blanks}) {
        const std::vector<std::vector<std::string>> usages{
            {"--" + name},
            {"-" + name},
            {"fit", scene, name, name},
            {"fit", scene, "--" + name},
            {"fit", scene, "--" + name + "=" + name},
            {"fit", scene, "--json=" + name},
            {"fit", scene, "--tree", name},
            {"fit", scene, "--leaf", name},
            {"fit", scene, "--axes=" + name},
            {"fit", scene, "--unit", name},
            {"query", scene, "--" + name},
            {"convert", scene, "--" + name},
            {"conflicts", scene, "--radius", name},
            {"bench", "--" + name},
            {"graph", name},
            {"graph", "build", "--" + name},
            {"graph", "build", kScenes, "-o", "x.json", "--seconds", name},
            {"simulate", scene, "-o", "x.json", "--area", name},
            {"test", "--" + name},
            {"diff", scene, scene, "--threshold", name},
            {"render", scene, "-o", png, "--view", name},
            {"render", scene, "-o", png, "--show", name},
            {"render", scene, "-o", png, "--level", name},
            {"render", scene, "-o", png, "--query", name},
            {"render", scene, "-o", png, "--query", "0", "--step", name},
            {"render", scene, "-o", png, "--follow", name},
            {"render", scene, "-o", png, "--target", name},
            {"render", scene, "-o", png, "--size", name},
            {"render", scene, "-o", png, "--background", name},
            {"render", scene, "-o", png, "--backend", name},
            {"--size", name},
            {"fit", folder.write("key.json", R"({")" + name + R"(": 1})")},
            {"fit", folder.write("twice.json", R"({")" + name + R"(": 1, ")" + name + R"(": 1})")},
            {"fit", folder.write("clip.json", R"({"clips": {")" + name + R"(": {"dt": 0}}})")},
            {"fit", folder.write("word.json", name)},
            {"fit", folder.write("text.json", R"({"clips": ")" + name + R"("})")},
            {"fit",
             folder.write("agent.json", R"({"clips": {"c": {"dt": 1, "samples": [[0,0,1]]}}, "agents": [{"name": ")" +
                                            name + R"(", "clip": ")" + name + R"("}]})")},
            {"fit",
             folder.write("color.json", R"({"clips": {"c": {"dt": 1, "samples": [[0,0,1]]}}, "agents": [{"name": "a",
                "clip": "c", "color": ")" + name +
                                            R"("}]})")},
            {"fit", folder.write("header.csv", name + "\n1\n")},
            {"fit", folder.write("cell.csv", "x,y,r\n0,0," + name + "\n")},
            {"fit", folder.write("word.bvh", name)},
            {"fit", folder.write("joint.bvh", "HIERARCHY\nROOT " + name + "\n{\n" + name)},
            {"fit", folder.write("word.txt", name)},
            {"fit", folder.write("plan.yaml", "schedule: " + name)},
            {"fit", folder.write("scene.gltf", R"({"asset": {"version": ")" + name + R"("}, "extensionsRequired": [")" +
                                                   name + R"("]})")},
            {"render", scene, "-o", png, "--view-state",
             folder.write("view.json", R"({"camera": {"preset": ")" + name + R"("}})")},
            {"render", scene, "-o", png, "--view-state",
             folder.write("follow.json", R"({"follow": ")" + name + R"("})")},
            {"render", "--batch", folder.write("list.txt", scene + " -o " + png + " --" + name)},
            {"test", folder.write("a.case.json", R"({"mobbscope_case": 1, ")" + name + R"(": 1})")},
        };
        for (const std::vector<std::string>& arguments : usages) {
            const Result run = run_program(arguments);
            const std::string said = run.out + run.err;
            EXPECT_EQ(run.status, 2) << said.substr(0, 300);
            EXPECT_LT(said.size(), 700u) << said;
        }
        const std::vector<std::vector<std::string>> files{{name},
                                                          {"bench", name},
                                                          {"conflicts", name},
                                                          {"convert", name, "-o", "x.csv"},
                                                          {"convert", scene, "-o", name},
                                                          {"diff", name, name},
                                                          {"fit", name},
                                                          {"graph", "build", name, "-o", "x.json"},
                                                          {"graph", "draw", name, "-o", png},
                                                          {"graph", "info", name},
                                                          {"info", name},
                                                          {"query", name},
                                                          {"render", name, "-o", png},
                                                          {"render", scene, "-o", name + ".png"},
                                                          {"render", scene, "-o", png, "--view-state", name},
                                                          {"render", "--batch", name},
                                                          {"simulate", name, "-o", "x.json"},
                                                          {"test", name},
                                                          {"--script", name}};
        for (const std::vector<std::string>& arguments : files) {
            const Result run = run_program(arguments);
            EXPECT_TRUE(run.status == 2 || run.status == 3) << run.status << arguments[0] << run.err;
            EXPECT_EQ(run.out, "") << arguments[0];
            EXPECT_TRUE(is_one_line(run.err)) << run.err;
            EXPECT_LT(run.err.size(), 1100u) << arguments[0];
        }
    }
    EXPECT_FALSE(std::filesystem::exists(png));
}

TEST(Program, NamesThatMisleadTheEyeAreShownAsTheyAre) {
    const TempFolder folder;
    const std::string name = "e\u202evil";
    const std::string scene = folder.write(name + ".json", R"({"clips": {")" + name +
                                                               R"(": {"dt": 0.5, "samples": [[0, 0, 1], [1, 0, 1]]}},
        "agents": [{"name": ")" + name + R"(", "clip": ")" + name +
                                                               R"("}, {"name": "B", "clip": ")" + name + R"("}]})");
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{"info", scene},
                                                      {"info", scene, "--json"},
                                                      {"fit", scene},
                                                      {"fit", scene, "--json"},
                                                      {"query", scene, "--trace"},
                                                      {"query", scene, "--json"},
                                                      {"conflicts", scene},
                                                      {"conflicts", scene, "--json"},
                                                      {"info", scene + "x"},
                                                      {"fit", scene, "--tree", name}}) {
        const Result run = run_program(arguments);
        const std::string said = run.out + run.err;
        EXPECT_EQ(said.find("\u202e"), std::string::npos) << said;
        EXPECT_NE(said.find("e\\u202evil"), std::string::npos) << said;
    }
}

/// What it says, but for how far it is: a slow machine makes it tell that.
std::string said_but_progress(const Result& run) {
    static const std::regex progress("mobbscope: [a-z]+ [0-9]+ of [0-9]+ [^\n]*\n");
    return std::regex_replace(run.err, progress, "");
}

TEST(Program, ResultsThatCannotBeWrittenAreStatusThree) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
    const std::string scene = kCrossing;
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--help"},
                                                      {"fit", scene},
                                                      {"fit", scene, "--json"},
                                                      {"query", scene},
                                                      {"query", scene, "--json"}}) {
        const Result run = run_program(arguments, "/dev/full");
        EXPECT_EQ(run.status, 3) << arguments[0];
        EXPECT_TRUE(is_one_line(said_but_progress(run))) << run.err;
    }
}

/// Of a program whose standard output nobody reads any more.
Result run_without_reader(const std::vector<std::string>& arguments) {
    return run_program(arguments, "/dev/null", "/dev/null", [] {
        std::array<int, 2> ends{};
        if (::pipe(ends.data()) != 0) ::_exit(127);
        ::dup2(ends[1], STDOUT_FILENO);
        ::close(ends[0]);
        ::close(ends[1]);
    });
}

TEST(Program, AReaderThatGoesAwayEndsACommandQuietly) {
    const std::string scene = kCrossing;
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"--help"},
          {"fit", "--help"},
          {"info", scene},
          {"info", scene, "--json"},
          {"fit", scene},
          {"fit", scene, "--csv"},
          {"query", scene, "--trace"},
          {"query", scene, "--json"},
          {"query", scene, "--compare", "moving"},
          {"conflicts", scene},
          {"conflicts", scene, "--json"},
          {"map", scene, "--over", "dx=-1:1,dy=-1:1", "--cells", "4x4", "--json"},
          {"sweep", scene, "--over", "leaf=5,10", "--queries", "50"},
          {"render", "--list-backends"}}) {
        const Result run = run_without_reader(arguments);
        EXPECT_EQ(run.status, 128 + SIGPIPE) << arguments[0];
        EXPECT_EQ(said_but_progress(run), "") << arguments[0];
    }
}

TEST(Program, WithoutReaderLinesOfJsonEndQuietlyWithTheirStatus) {
    const TempFolder folder;
    folder.write("scene.json", R"({"clips": {"c": {"dt": 1, "samples": [[0, 0, 1]]}}, "agents": [
        {"name": "A", "clip": "c"}, {"name": "B", "clip": "c", "translate": [3, 0]}]})");
    folder.write("a.case.json", R"({"mobbscope_case": 1, "scene": "scene.json", "hold": ["answers"]})");
    const Result run = run_without_reader({"test", folder.path(), "--json-lines"});
    EXPECT_EQ(run.status, 3);
    EXPECT_EQ(run.err, "");
}

/// As on a machine without a display, until it goes.
class NoDisplay {
  public:
    NoDisplay() {
        for (auto& [name, value] : kept_) {
            if (const char* present = std::getenv(name)) value = present;
            ::unsetenv(name);
        }
    }
    ~NoDisplay() {
        for (const auto& [name, value] : kept_) {
            if (value) ::setenv(name, value->c_str(), 1);
        }
    }
    NoDisplay(const NoDisplay&) = delete;
    NoDisplay& operator=(const NoDisplay&) = delete;

  private:
    std::array<std::pair<const char*, std::optional<std::string>>, 2> kept_{
        {{"DISPLAY", std::nullopt}, {"WAYLAND_DISPLAY", std::nullopt}}};
};

TEST(Program, WithoutADisplayTheWindowSaysWhatWorks) {
    const NoDisplay no_display;
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{}, {kCrossing}, {"--size", "800x600", "--ui-scale", "2"}}) {
        const Result run = run_program(arguments);
        expect_refused(run, 3, "no display");
        EXPECT_NE(run.err.find("mobbscope render"), std::string::npos) << run.err;
        EXPECT_NE(run.err.find("--headless"), std::string::npos) << run.err;
    }
    EXPECT_NE(run_program({"fti"}).err.find("did you mean 'fit'?"), std::string::npos);
}

TEST(Program, OptionsOfTheWindowAreChecked) {
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--ui-scale", "0.4"},
                                                      {"--ui-scale", "4.1"},
                                                      {"--ui-scale", "big"},
                                                      {"--ui-scale", "0"},
                                                      {"--ui-scale", "nan"},
                                                      {"--size", "0x0"},
                                                      {"--size", "-1x100"},
                                                      {"--size", "999999x999999"},
                                                      {"--size", "10x10"},
                                                      {"--size", "1280"},
                                                      {"--size", "800x600", "query", kCrossing}}) {
        const Result run = run_program(arguments);
        EXPECT_EQ(run.status, 2) << arguments[1];
        EXPECT_TRUE(is_one_line(run.err)) << run.err;
        EXPECT_EQ(run.out, "");
    }
}

TEST(Program, WhatDoesNotApplyIsSaidButStopsNothing) {
    const TempFolder folder;
    const std::string csv = folder.write("a.csv", "t,x,y,r\n0,0,0,0.3\n1,1,0,0.3\n");
    const Result run = run_program({"fit", csv, "--fps", "10"});
    EXPECT_EQ(run.status, 0);
    EXPECT_NE(run.err.find("warning: "), std::string::npos);
    EXPECT_NE(run.err.find("fps does not apply"), std::string::npos);
    EXPECT_NE(run.out, "");
    const Result other = run_program({"fit", csv, "--up", "z", "--root", "Hips", "--animation", "0", "--unit", "auto"});
    EXPECT_EQ(other.status, 0) << other.err;
    for (const char* option : {"up", "root", "animation", "unit auto"}) {
        EXPECT_NE(other.err.find(std::string(option) + " does not apply to .csv files"), std::string::npos)
            << other.err;
    }
    const std::string scene =
        folder.write("a.json", R"({"mobbscope": 1, "clips": {"a": {"dt": 1, "samples": [[0, 0, 0.3], [1, 0, 0.3]]}}})");
    EXPECT_NE(run_program({"fit", scene, "--fps", "10"}).err.find("import options do not apply"), std::string::npos);
}

}  // namespace
}  // namespace mobbscope
