// What an agent plays as BVH or GLB, and what is refused: as a user does it.
#include "run_program.h"

#include <base/text.h>
#include <scene/crowd_run.h>
#include <scene/motion_graph.h>
#include <scene/scene.h>
#include <support/folders.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

/// A run of the project's own clips, made once.
class ConvertAgent : public ::testing::Test {
  protected:
    static void SetUpTestSuite() {
        runs_ = std::make_unique<TempFolder>();
        ASSERT_EQ(run_program({"graph", "build", kClips, "-o", path("graph.json")}).status, 0);
        ASSERT_EQ(
            run_program({"simulate", path("graph.json"), "--agents", "17", "--seconds", "10", "-o", run()}).status, 0);
    }
    static void TearDownTestSuite() { runs_.reset(); }

    static std::string path(const std::string& name) { return runs_->path() / name; }
    static std::string run() { return path("run.json"); }

    /// A refusal in one line with these words, and an output that stays as it was.
    void expect_refused(std::vector<std::string> arguments, const std::string& words, const std::string& out) const {
        const std::string file = folder.write(out, "precious");
        arguments.insert(arguments.begin(), "convert");
        arguments.insert(arguments.end(), {"-o", file});
        const Result result = run_program(arguments);
        testing::expect_refused(result, 2, words);
        EXPECT_EQ(slurp(file), "precious");
    }

    TempFolder folder;

  private:
    static std::unique_ptr<TempFolder> runs_;
};

std::unique_ptr<TempFolder> ConvertAgent::runs_;

TEST_F(ConvertAgent, WritesWhatItPlayedAndSaysWhenItBegins) {
    const Scene scene = load_scene(run());
    const CrowdAgent& agent = scene.crowd->agents[16];
    ASSERT_EQ(agent.name, "17");
    for (const std::string name : {"agent.bvh", "agent.glb"}) {
        const std::string out = folder.path() / name;
        const Result result = run_program({"convert", run(), "--agent", "17", "-o", out});
        ASSERT_EQ(result.status, 0) << result.err;
        EXPECT_EQ(result.err, "");
        const Scene again = load_scene(out);
        const mobb::Clip& clip = *again.clips.at(0).clip;
        int sample = 0;
        for (const Play& play : agent.plays) {
            const GraphMove& move = scene.graph->moves[static_cast<std::size_t>(play.move)];
            const mobb::PlacedClip part(*scene.clips[static_cast<std::size_t>(move.clip)].clip, play.placement);
            for (int i = 0; i < part.count(); ++i, ++sample) {
                ASSERT_LT(sample, clip.count());
                const mobb::Disk& disk = clip.samples()[static_cast<std::size_t>(sample)];
                EXPECT_NEAR(disk.x, part.disk(i).x, 1e-3) << name;
                EXPECT_NEAR(disk.y, part.disk(i).y, 1e-3) << name;
                EXPECT_NEAR(disk.r, part.disk(i).r, 1e-3) << name;
            }
        }
        EXPECT_EQ(sample, clip.count());
        const std::string begin = "begins at " + brief(agent.plays.front().placement.start) + " s\n";
        EXPECT_TRUE(result.out.starts_with("'17': " + std::to_string(agent.plays.size()) + " clips, ")) << result.out;
        EXPECT_TRUE(result.out.ends_with(begin)) << result.out;
        const Result info = run_program({"info", out});
        EXPECT_EQ(info.status, 0);
        EXPECT_NE(info.out.find("'Hips'"), std::string::npos) << info.out;
    }
}

TEST_F(ConvertAgent, AnAgentOfASceneAndAClipAlone) {
    const std::string scene =
        folder.write("s.json", R"({"clips": {"w": {"source": ")" + kClips.string() + R"(/walk.glb"}},
        "agents": [{"name": "A", "clip": "w"},
                   {"name": "B", "clip": "w", "translate": [5, -2], "rotate_deg": 90, "start": 3}]})");
    const std::string out = folder.path() / "b.bvh";
    ASSERT_EQ(run_program({"convert", scene, "--agent", "B", "-o", out}).status, 0);
    const Scene there = load_scene(scene);
    const mobb::PlacedClip placed(*there.clips[0].clip, there.agents[1].placement);
    const Scene again = load_scene(out);
    ASSERT_EQ(again.clips[0].clip->count(), placed.count());
    EXPECT_NEAR(again.clips[0].clip->samples()[40].x, placed.disk(40).x, 1e-3);
    EXPECT_NEAR(again.clips[0].clip->samples()[40].y, placed.disk(40).y, 1e-3);

    const std::string clip = folder.path() / "walk.BVH";
    const Result alone = run_program({"convert", kClips / "walk.glb", "-o", clip});
    EXPECT_EQ(alone.status, 0) << alone.err;
    EXPECT_EQ(load_scene(clip).clips[0].clip->count(), there.clips[0].clip->count());
}

TEST_F(ConvertAgent, IsRefusedInOneLine) {
    expect_refused({run(), "--agent", "71"}, "there is no agent '71'; the nearest is '1'", "a.bvh");
    expect_refused({run(), "--agent", ""}, "there is no agent ''", "a.bvh");
    expect_refused({run()}, "there are 17; name one with --agent, such as '1'", "a.glb");
    expect_refused({run(), "--agent", "17"}, "--agent writes what one agent plays, as .bvh or .glb", "a.csv");
    expect_refused({run(), "--agent", "17"}, "rename the output", "a.gltf");
    const std::string scenes = MOBBSCOPE_SOURCE_DIR "/assets/scenes/";
    expect_refused({scenes + "walk.csv"}, "has no skeleton", "a.bvh");
    expect_refused({scenes + "walk.csv", "--agent", "walk"}, "has no skeleton", "a.glb");
}

TEST_F(ConvertAgent, ARunWithSamplesInsideHasNoSkeletons) {
    const std::string inside = folder.path() / "inside.json";
    ASSERT_EQ(run_program({"convert", run(), "-o", inside}).status, 0);
    expect_refused({inside, "--agent", "17"}, "which has no skeleton", "a.bvh");
}

TEST_F(ConvertAgent, WhatCannotBeWrittenIsStatusThree) {
    const Result result = run_program({"convert", run(), "--agent", "17", "-o", "/nonexistent/folder/agent.bvh"});
    EXPECT_EQ(result.status, 3);
    EXPECT_TRUE(is_one_line(result.err)) << result.err;
}

TEST_F(ConvertAgent, ARadiusThatWasGivenIsSaidToBeLost) {
    const std::string out = folder.path() / "walk.glb";
    const Result result = run_program({"convert", kClips / "walk.glb", "--radius", "0.9", "-o", out});
    EXPECT_EQ(result.status, 0);
    EXPECT_TRUE(is_one_line(result.err)) << result.err;
    EXPECT_NE(result.err.find("radii differ by up to"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace mobbscope
