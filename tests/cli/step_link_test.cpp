// FILE#qK@S: the step of a query as it is quoted.
#include "run_program.h"

#include <support/folders.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

Result opened(const TempFolder& folder, const std::string& name, const std::string& expects) {
    return run_program({name, "--headless", "--script", folder.write("look.script", expects)});
}

TEST(StepLink, OpensTheWindowThere) {
    const TempFolder folder;
    const Result run =
        opened(folder, kCrossing + "#q0@4", "expect /query/index 0\nexpect /query/step 4\nexpect /modified false");
    EXPECT_EQ(run.status, 0) << run.err;
}

TEST(StepLink, IsDrawnByRender) {
    const TempFolder folder;
    const std::string linked = folder.path() / "linked.json", said = folder.path() / "said.json";
    ASSERT_EQ(run_program({"render", kCrossing + "#q0@4", "--draw-list", linked}).status, 0);
    ASSERT_EQ(run_program({"render", kCrossing, "--query", "0", "--step", "4", "--draw-list", said}).status, 0);
    EXPECT_EQ(slurp(linked), slurp(said));
}

TEST(StepLink, AFileOfThatNameWins) {
    const TempFolder folder;
    folder.write("walk.csv", "t,x,y,r\n0,0,0,0.3\n1,1,0,0.3\n2,2,0,0.3\n");
    const std::string scene = R"({"clips": {"NAME": {"source": "walk.csv"}},
        "agents": [{"name": "NAME", "clip": "NAME"}, {"name": "B", "clip": "NAME", "translate": [0, 5]}]})";
    const auto named = [&scene](const std::string& clip) {
        return std::regex_replace(scene, std::regex("NAME"), clip);
    };
    folder.write("scene.json", named("other"));
    const std::string name = folder.write("scene.json#q0@4", named("own"));
    const Result info = run_program({"info", name});
    EXPECT_EQ(info.status, 0) << info.err;
    EXPECT_TRUE(info.out.starts_with("own (")) << info.out;
    const Result window = opened(folder, name, "expect /scene/agents/0/name \"own\"\nexpect /modified false");
    EXPECT_EQ(window.status, 0) << window.err;
    const std::string drawn = folder.path() / "drawn.json";
    const Result render = run_program({"render", name, "--draw-list", drawn});
    EXPECT_EQ(render.status, 0) << render.err;
    EXPECT_TRUE(std::filesystem::exists(drawn));
}

TEST(StepLink, IsForTheWindowAndRenderAlone) {
    const TempFolder folder;
    for (const std::string command : {"query", "fit"}) {
        for (const std::string link : {"#q0@4", "#q0"}) {
            const Result run = run_program({command, kCrossing + link});
            EXPECT_EQ(run.status, 2) << command;
            EXPECT_TRUE(is_one_line(run.err)) << run.err;
            EXPECT_NE(run.err.find("no such file; only the window and render take a step behind a file's name"),
                      std::string::npos)
                << run.err;
        }
    }
    const Result info = run_program({"info", kCrossing + "#q0@4"});
    EXPECT_EQ(info.status, 2);
    EXPECT_NE(info.err.find("#q0@4: no such file"), std::string::npos) << info.err;
}

TEST(StepLink, StandsBehindAFile) {
    const TempFolder folder;
    std::filesystem::create_directory(folder.path() / "sc");
    folder.write("sc/walk.csv", "t,x,y,r\n0,0,0,0.3\n1,1,0,0.3\n");
    folder.write("scene.json", "{}");
    for (const std::string name : {"sc#quick/missing.json", "sc#q0@1", "scene.json#q0@1/missing.json"}) {
        const std::string missing = folder.path() / name;
        const Result render = run_program({"render", missing, "-o", folder.path() / "x.png"});
        EXPECT_EQ(render.status, 2) << name;
        EXPECT_NE(render.err.find("no such file"), std::string::npos) << render.err;
        const Result window = opened(folder, missing, "expect /modified false");
        EXPECT_EQ(window.status, 2) << name;
        EXPECT_NE(window.err.find("is neither a command nor a file"), std::string::npos) << window.err;
    }
}

TEST(StepLink, BadNumbersAreRefusedInOneLine) {
    const TempFolder folder;
    for (const auto& [link, why] :
         std::vector<std::pair<std::string, std::string>>{{"#q0@x", "write it like #q3@412"},
                                                          {"#q0", "write it like #q3@412"},
                                                          {"#q-1@0", "write it like #q3@412"},
                                                          {"#q0@4294967296", "write it like #q3@412"},
                                                          {"#q7@0", "there is no query 7: they go from 0 to 0"},
                                                          {"#q0@99999", "there is no step 99999"}}) {
        const Result window = opened(folder, kCrossing + link, "expect /modified false");
        EXPECT_EQ(window.status, 2) << link;
        EXPECT_TRUE(is_one_line(window.err)) << window.err;
        EXPECT_NE(window.err.find(why), std::string::npos) << window.err;
        const Result render = run_program({"render", kCrossing + link, "-o", folder.path() / "x.png"});
        EXPECT_EQ(render.status, 2) << link;
        EXPECT_TRUE(is_one_line(render.err)) << render.err;
        EXPECT_FALSE(std::filesystem::exists(folder.path() / "x.png"));
    }
    const Result two = run_program({kCrossing + "#q0@4", kCrossing, "--headless", "--script", "none"});
    EXPECT_EQ(two.status, 2);
    EXPECT_NE(two.err.find("name no other file"), std::string::npos) << two.err;
    EXPECT_EQ(run_program({"render", "none.json#q0@4", "-o", folder.path() / "x.png"}).status, 2);
}

}  // namespace
}  // namespace mobbscope
