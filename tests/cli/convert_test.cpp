#include "run_program.h"

#include <import/csv.h>
#include <scene/scene.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

namespace mobbscope {
namespace {

using testing::is_one_line;
using testing::Result;
using testing::run_program;
using testing::slurp;
using testing::TempFolder;

const std::string kScenes = MOBBSCOPE_SOURCE_DIR "/assets/scenes/";

TEST(Convert, OneClipToCsvAndBack) {
    const TempFolder folder;
    const std::string out = folder.path() / "out.csv";
    const Result run = run_program({"convert", kScenes + "circles.json", "-o", out});
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.out + run.err, "");
    EXPECT_TRUE(slurp(out).starts_with("t,x,y,r\n0,"));
    const Scene before = load_scene(kScenes + "circles.json");
    const Scene after = load_scene(out);
    ASSERT_EQ(after.clips[0].clip->count(), before.clips[0].clip->count());
    EXPECT_NEAR(after.clips[0].clip->dt(), before.clips[0].clip->dt(), 1e-15);
    for (int i = 0; i < before.clips[0].clip->count(); ++i) {
        const auto k = static_cast<std::size_t>(i);
        EXPECT_EQ(after.clips[0].clip->samples()[k].x, before.clips[0].clip->samples()[k].x);
        EXPECT_EQ(after.clips[0].clip->samples()[k].r, before.clips[0].clip->samples()[k].r);
    }
}

TEST(Convert, SeveralClipsToCsvHaveIds) {
    const TempFolder folder;
    const std::string scene =
        folder.write("s.json", R"({"clips": {"a, \"b\"": {"dt": 0.5, "samples": [[0,0,1],[1,0,1]]},
        "c": {"dt": 2, "samples": [[5,0,1],[6,0,1]]}}})");
    const std::string out = folder.path() / "out.csv";
    ASSERT_EQ(run_program({"convert", scene, "-o", out}).status, 0);
    EXPECT_TRUE(slurp(out).starts_with("id,t,x,y,r\n\"a, \"\"b\"\"\",0,0,0,1\n"));
    const Scene read = load_scene(out);
    ASSERT_EQ(read.clips.size(), 2u);
    EXPECT_EQ(read.clips[0].name, "a, \"b\"");
    EXPECT_EQ(read.clips[1].clip->dt(), 2);
}

TEST(Convert, ToJsonKeepsTheSceneAndNeedsNoOtherFile) {
    const TempFolder folder;
    folder.write("walk.csv", slurp(kScenes + "walk.csv"));
    const std::string scene = folder.write("s.json", R"({"clips": {"w": {"source": "walk.csv", "trim": [1, 2]}},
        "agents": [{"name": "A", "clip": "w"}, {"name": "B", "clip": "w", "start": 5}], "fit": {"leaf": 4},
        "queries": [{"a": "A", "b": "B"}], "view": {"theme": "light"}})");
    const TempFolder elsewhere;
    const std::string out = elsewhere.path() / "out.JSON";
    ASSERT_EQ(run_program({"convert", scene, "-o", out}).status, 0);
    const Scene read = load_scene(out);
    EXPECT_FALSE(read.clips[0].source);
    EXPECT_EQ(read.clips[0].clip->count(), 31);
    EXPECT_EQ(read.agents[1].placement.start, 5);
    EXPECT_EQ(read.fit.leaf, 4);
    EXPECT_EQ(read.queries.size(), 1u);
    EXPECT_EQ(read.view.theme, Theme::light);
}

TEST(Convert, TheOutputMayBeTheInput) {
    const TempFolder folder;
    const std::string file = folder.write("walk.csv", slurp(kScenes + "walk.csv"));
    ASSERT_EQ(run_program({"convert", file, "-o", file, "--trim", "0:1"}).status, 0);
    EXPECT_EQ(load_scene(file).clips[0].clip->count(), 31);
}

TEST(Convert, ARefusalLeavesWhatWasThere) {
    const TempFolder folder;
    const std::string bad = folder.write("bad.csv", "t,x,y,r\n0,0,0,0\n1,x,0,0\n");
    const std::string out = folder.write("out.csv", "precious");
    EXPECT_EQ(run_program({"convert", bad, "-o", out}).status, 2);
    EXPECT_EQ(slurp(out), "precious");
}

TEST(Convert, WhatCannotBeWrittenIsStatusThree) {
    const Result run = run_program({"convert", kScenes + "walk.csv", "-o", "/nonexistent/folder/out.csv"});
    EXPECT_EQ(run.status, 3);
    EXPECT_TRUE(is_one_line(run.err)) << run.err;
}

TEST(Convert, OneSampleLosesItsDtInACsvAndSaysSo) {
    const TempFolder folder;
    const std::string scene = folder.write("s.json", R"({"clips": {"c": {"dt": 0.25, "samples": [[0,0,1]]}}})");
    const std::string out = folder.path() / "out.csv";
    const Result run = run_program({"convert", scene, "-o", out});
    EXPECT_EQ(run.status, 0);
    EXPECT_NE(run.err.find("does not tell its dt (0.25 s)"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace mobbscope
