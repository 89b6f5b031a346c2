// FILE#qK@S: the step of a query as it is quoted.
#include "run_program.h"

#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

using testing::is_one_line;
using testing::Result;
using testing::run_program;
using testing::TempFolder;

const std::string kLinkedScene = MOBBSCOPE_SOURCE_DIR "/assets/scenes/crossing.json";

Result opened(const TempFolder& folder, const std::string& name, const std::string& expects) {
    return run_program({name, "--headless", "--script", folder.write("look.script", expects)});
}

TEST(StepLink, OpensTheWindowThere) {
    const TempFolder folder;
    const Result run =
        opened(folder, kLinkedScene + "#q0@4", "expect /query/index 0\nexpect /query/step 4\nexpect /modified false");
    EXPECT_EQ(run.status, 0) << run.err;
}

TEST(StepLink, IsDrawnByRender) {
    const TempFolder folder;
    const std::string linked = folder.path() / "linked.json", said = folder.path() / "said.json";
    ASSERT_EQ(run_program({"render", kLinkedScene + "#q0@4", "--draw-list", linked}).status, 0);
    ASSERT_EQ(run_program({"render", kLinkedScene, "--query", "0", "--step", "4", "--draw-list", said}).status, 0);
    EXPECT_EQ(testing::slurp(linked), testing::slurp(said));
}

TEST(StepLink, AFileOfThatNameWins) {
    const TempFolder folder;
    const std::string name = folder.path() / "scene.json#q0@4";
    std::filesystem::copy_file(kLinkedScene, name);
    std::filesystem::copy_file(kLinkedScene, folder.path() / "scene.json");
    const Result run = run_program({"info", name});
    EXPECT_EQ(run.status, 2) << "it is read as it is, and its name does not end as that of a scene";
    EXPECT_NE(run.err.find("scene.json#q0@4: looks like JSON"), std::string::npos) << run.err;
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
        const Result window = opened(folder, kLinkedScene + link, "expect /modified false");
        EXPECT_EQ(window.status, 2) << link;
        EXPECT_TRUE(is_one_line(window.err)) << window.err;
        EXPECT_NE(window.err.find(why), std::string::npos) << window.err;
        const Result render = run_program({"render", kLinkedScene + link, "-o", folder.path() / "x.png"});
        EXPECT_EQ(render.status, 2) << link;
        EXPECT_TRUE(is_one_line(render.err)) << render.err;
        EXPECT_FALSE(std::filesystem::exists(folder.path() / "x.png"));
    }
    const Result two = run_program({kLinkedScene + "#q0@4", kLinkedScene, "--headless", "--script", "none"});
    EXPECT_EQ(two.status, 2);
    EXPECT_NE(two.err.find("name no other file"), std::string::npos) << two.err;
    EXPECT_EQ(run_program({"render", "none.json#q0@4", "-o", folder.path() / "x.png"}).status, 2);
}

}  // namespace
}  // namespace mobbscope
