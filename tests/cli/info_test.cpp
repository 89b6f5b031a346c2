#include "run_program.h"

#include <support/bvh_text.h>
#include <support/folders.h>
#include <support/json_keys.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

namespace mobbscope {
namespace {

TEST(Info, JsonTellsWhatIsInTheFiles) {
    const TempFolder folder;
    const std::string csv = folder.write("a.csv", "t,x,y,r\n5,0,0,20\n5.5,300,0,40\n6,300,400,60\n");
    const std::string scene = folder.write("s.json", R"({"clips": {"c": {"dt": 2, "samples": [[1, 1, 0.5]]}}})");
    const Result run = run_program({"info", csv, scene, "--json", "--unit", "cm"});
    ASSERT_EQ(run.status, 0) << run.err;
    const json clips = json::parse(run.out)["clips"];
    ASSERT_EQ(clips.size(), 2u);
    const json& a = clips[0];
    EXPECT_EQ(keys(a), (std::set<std::string>{"file",
                                              "name",
                                              "format",
                                              "animation",
                                              "root",
                                              "joints",
                                              "unit",
                                              "root_why",
                                              "guessed_from_height",
                                              "class",
                                              "t0",
                                              "start",
                                              "motion",
                                              "file_frames",
                                              "file_dt",
                                              "file_duration",
                                              "samples",
                                              "dt",
                                              "duration",
                                              "path_length",
                                              "mean_speed",
                                              "min_radius",
                                              "mean_radius",
                                              "max_radius",
                                              "up",
                                              "up_why",
                                              "warnings"}));
    EXPECT_EQ(a["motion"], "held");
    EXPECT_EQ(a["file"], csv);
    EXPECT_EQ(a["name"], "a");
    EXPECT_EQ(a["unit"], 0.01);
    EXPECT_EQ(a["file_frames"], 3);
    EXPECT_EQ(a["file_duration"], 1);
    EXPECT_EQ(a["samples"], 3);
    EXPECT_EQ(a["duration"], 1.5);
    EXPECT_DOUBLE_EQ(a["path_length"], 7);
    EXPECT_DOUBLE_EQ(a["mean_speed"], 7);
    EXPECT_DOUBLE_EQ(a["min_radius"], 0.2);
    EXPECT_DOUBLE_EQ(a["mean_radius"], 0.4);
    EXPECT_DOUBLE_EQ(a["max_radius"], 0.6);
    EXPECT_EQ(clips[1]["format"], "scene");
    EXPECT_EQ(clips[1]["mean_speed"], 0);
}

TEST(Info, TellsHowClipsMoveBetweenSamples) {
    const TempFolder folder;
    const std::string csv = folder.write("a.csv", "id,t,x,y,r\n1,0,0,0,0.2\n1,1,0.1,0,0.2\n");
    const auto motion = [](const std::vector<std::string>& arguments) {
        const Result run = run_program(arguments);
        EXPECT_EQ(run.err, "");
        return json::parse(run.out)["clips"][0]["motion"];
    };
    EXPECT_EQ(motion({"info", csv, "--json"}), "linear");
    EXPECT_EQ(motion({"info", csv, "--json", "--motion", "held"}), "held");
    EXPECT_NE(run_program({"info", csv}).out.find(" 1 s in all, linear to the next sample\n"), std::string::npos);
    EXPECT_NE(run_program({"info", csv, "--motion", "held"}).out.find(" 2 s in all, held until the next sample\n"),
              std::string::npos);
    const std::string scene =
        folder.write("s.json", R"({"clips": {"c": {"dt": 1, "samples": [[0, 0, 1], [0.5, 0, 1]]}}})");
    EXPECT_EQ(motion({"info", scene, "--json"}), "held");
    EXPECT_EQ(motion({"info", scene, "--json", "--motion", "linear"}), "linear") << "samples in the scene too";
    const Result none = run_program({"info", csv, "--motion", "fast"});
    EXPECT_EQ(none.status, 2);
    EXPECT_EQ(none.err, "mobbscope: --motion: 'fast' is not one of held, linear; see mobbscope info --help\n");
}

TEST(Info, WarnsOnceOfAHeldClipWhoseStepsAreLongerThanItsRadius) {
    const TempFolder folder;
    const std::string scene = folder.write(
        "s.json", R"({"clips": {"c": {"dt": 1, "samples": [[0,0,0.5],[0.5,0,0.5],[1.25,0,0.5],[3.25,0,0.5]]}}})");
    const json clip = json::parse(run_program({"info", scene, "--json"}).out)["clips"][0];
    ASSERT_EQ(clip["warnings"].size(), 1u);
    EXPECT_EQ(clip["warnings"][0],
              "its disks are held, but it moves 2 m from sample 2 to the next, more than its radius of 0.5 m: what it "
              "meets in between goes unseen; give motion linear (--motion linear, or \"motion\": \"linear\" in the "
              "scene)");
    EXPECT_EQ(json::parse(run_program({"info", scene, "--json", "--motion", "linear"}).out)["clips"][0]["warnings"],
              json::array());
}

TEST(Info, TheMeanRadiusLiesBetweenTheOthers) {
    const TempFolder folder;
    std::string scene = R"({"clips": {"c": {"dt": 1, "samples": [[0,0,0.45])";
    for (int i = 1; i < 1001; ++i) scene += ",[0,0,0.45]";
    const Result run = run_program({"info", folder.write("s.json", scene + "]}}}"), "--json"});
    const json clip = json::parse(run.out)["clips"][0];
    EXPECT_EQ(clip["mean_radius"], 0.45);
}

TEST(Info, NamesDoNotSteerTheTerminal) {
    const TempFolder folder;
    const std::string scene =
        folder.write("s.json", "{\"clips\": {\"a\\u001b[2Jb\\u009b1m\": {\"dt\": 1, \"samples\": [[0,0,1]]}}}");
    for (const char* command : {"info", "fit"}) {
        const std::string out = run_program({command, scene}).out;
        EXPECT_TRUE(out.starts_with(R"(a\u001b[2Jb\u009b1m)")) << command << out;
    }
}

TEST(Info, JsonTellsTheSkeletonThatWasFoundAndTheUnitThatWasGuessed) {
    const TempFolder folder;
    const std::string walk = folder.write("walk.bvh", kWalker);
    const json a = json::parse(run_program({"info", walk, "--json"}).out)["clips"][0];
    EXPECT_EQ(a["format"], "bvh");
    EXPECT_EQ(a["animation"], "#0");
    EXPECT_EQ(a["root"], "Hips");
    EXPECT_EQ(a["joints"], 3);
    EXPECT_EQ(a["unit"], 0.01);
    EXPECT_EQ(a["file_frames"], 2);
    EXPECT_EQ(a["file_dt"], 0.1);
    EXPECT_EQ(a["samples"], 4);
    EXPECT_NEAR(a["max_radius"], 0.7, 1e-9);
    const std::string text = run_program({"info", walk}).out;
    EXPECT_NE(text.find("3 joints, root 'Hips'"), std::string::npos) << text;
    EXPECT_NE(text.find("0.01 m per unit (guessed: a body 1.7 m tall)"), std::string::npos) << text;

    const Result options = run_program({"info", walk, "--json", "--root", "Left Arm", "--unit", "m", "--up", "z",
                                        "--fps", "20", "--trim", "0.02:1", "--radius", "3"});
    ASSERT_EQ(options.status, 0) << options.err;
    const json b = json::parse(options.out)["clips"][0];
    EXPECT_EQ(b["root"], "Left Arm");
    EXPECT_EQ(b["unit"], 1);
    EXPECT_EQ(b["samples"], 2);
    EXPECT_EQ(b["max_radius"], 3);
}

TEST(Info, OneBadFileAmongGoodOnesLeavesNoOutput) {
    const std::string good = kScenes / "walk.csv";
    const Result run = run_program({"info", good, "none.csv"});
    EXPECT_EQ(run.status, 2);
    EXPECT_EQ(run.out, "");
    EXPECT_TRUE(is_one_line(run.err)) << run.err;
    EXPECT_NE(run_program({"info", good}).out.find("120 samples"), std::string::npos);
}

}  // namespace
}  // namespace mobbscope
