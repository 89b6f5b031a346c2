#include "run_program.h"

#include <import/tracks/text_rows.h>
#include <scene/scene.h>
#include <support/folders.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

namespace mobbscope {
namespace {

/// Every sample of both clips, and when it begins.
void expect_same(const mobb::Clip& a, const mobb::Clip& b) {
    ASSERT_EQ(a.count(), b.count());
    EXPECT_NEAR(a.dt(), b.dt(), 1e-15);
    for (std::size_t i = 0; i < a.samples().size(); ++i) {
        EXPECT_EQ(a.samples()[i].x, b.samples()[i].x) << i;
        EXPECT_EQ(a.samples()[i].y, b.samples()[i].y) << i;
        EXPECT_EQ(a.samples()[i].r, b.samples()[i].r) << i;
    }
}

TEST(Convert, OneClipToCsvAndBack) {
    const TempFolder folder;
    const std::string out = folder.path() / "out.csv";
    const Result run = run_program({"convert", kScenes / "circles.json", "-o", out});
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.out + run.err, "");
    EXPECT_TRUE(slurp(out).starts_with("t,x,y,r\n0,"));
    expect_same(*load_scene(out).clips.at(0).clip, *load_scene(kScenes / "circles.json").clips.at(0).clip);
}

TEST(Convert, SeveralClipsToCsvHaveIds) {
    const TempFolder folder;
    const std::string scene =
        folder.write("s.json", R"({"clips": {"a, \"b\"": {"dt": 0.5, "samples": [[1,2,0.25],[4,-7,0.75],[9,5,0.125]]},
        "c": {"dt": 2, "samples": [[5,-3,1.5],[6,0.1,2]]}}})");
    const std::string out = folder.path() / "out.csv";
    ASSERT_EQ(run_program({"convert", scene, "-o", out}).status, 0);
    EXPECT_EQ(slurp(out),
              "id,t,x,y,r\n"
              "\"a, \"\"b\"\"\",0,1,2,0.25\n\"a, \"\"b\"\"\",0.5,4,-7,0.75\n\"a, \"\"b\"\"\",1,9,5,0.125\n"
              "c,0,5,-3,1.5\nc,2,6,0.1,2\n");
    const Scene read = load_scene(out);
    const Scene written = load_scene(scene);
    ASSERT_EQ(read.clips.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(read.clips[i].name, written.clips[i].name);
        expect_same(*read.clips[i].clip, *written.clips[i].clip);
    }
}

TEST(Convert, ToJsonKeepsTheSceneAndNeedsNoOtherFile) {
    const TempFolder folder;
    folder.write("walk.csv", slurp(kScenes / "walk.csv"));
    const std::string scene = folder.write("s.json", R"({"clips": {"w": {"source": "walk.csv", "trim": [1, 2]}},
        "agents": [{"name": "A", "clip": "w"}, {"name": "B", "clip": "w", "start": 5}], "fit": {"leaf": 4},
        "queries": [{"a": "A", "b": "B"}], "view": {"theme": "light"}})");
    const TempFolder elsewhere;
    const std::string out = elsewhere.path() / "out.JSON";
    ASSERT_EQ(run_program({"convert", scene, "-o", out}).status, 0);
    const Scene read = load_scene(out);
    EXPECT_FALSE(read.clips[0].source);
    expect_same(*read.clips[0].clip, *load_scene(scene).clips[0].clip);
    EXPECT_EQ(read.clips[0].clip->count(), 31);
    EXPECT_EQ(read.agents[1].placement.start, 5);
    EXPECT_EQ(read.fit.leaf, 4);
    EXPECT_EQ(read.queries.size(), 1u);
    EXPECT_EQ(read.view.theme, Theme::light);
}

TEST(Convert, ARefusalLeavesWhatWasThere) {
    const TempFolder folder;
    const std::string bad = folder.write("bad.csv", "t,x,y,r\n0,0,0,0\n1,x,0,0\n");
    const std::string out = folder.write("out.csv", "precious");
    EXPECT_EQ(run_program({"convert", bad, "-o", out}).status, 2);
    EXPECT_EQ(slurp(out), "precious");
}

TEST(Convert, WhatCannotBeWrittenIsStatusThree) {
    const Result run = run_program({"convert", kScenes / "walk.csv", "-o", "/nonexistent/folder/out.csv"});
    EXPECT_EQ(run.status, 3);
    EXPECT_TRUE(is_one_line(run.err)) << run.err;
}

TEST(Convert, ASceneKeepsTheMotionBetweenSamples) {
    const TempFolder folder;
    const std::string tracks = folder.write("a.csv", "id,t,x,y,r\n1,0,0,0,1\n1,1,0,0,1\n");
    const std::string out = folder.path() / "out.json";
    ASSERT_EQ(run_program({"convert", tracks, "-o", out}).status, 0);
    EXPECT_NE(slurp(out).find("\"motion\": \"linear\""), std::string::npos);
    EXPECT_EQ(load_scene(out).clips[0].clip->motion(), mobb::Motion::linear);
    ASSERT_EQ(run_program({"convert", tracks, "-o", out, "--motion", "held"}).status, 0);
    EXPECT_NE(slurp(out).find("\"motion\": \"held\""), std::string::npos);
    EXPECT_EQ(load_scene(out).clips[0].clip->motion(), mobb::Motion::held);
}

TEST(Convert, ACsvThatIsReadAsAnotherMotionSaysSo) {
    const TempFolder folder;
    const std::string one = R"("a": {"dt": 1, "samples": [[0,0,1],[0,0,1]]})";
    const std::string two = R"("b": {"dt": 1, "motion": "linear", "samples": [[0,0,1],[0,0,1]]})";
    const std::string three = R"("c": {"dt": 1, "motion": "held", "samples": [[0,0,1],[0,0,1]]})";
    const std::string out = folder.path() / "out.csv";
    const auto said = [&](const std::string& clips) {
        const Result run = run_program({"convert", folder.write("s.json", "{\"clips\": {" + clips + "}}"), "-o", out});
        EXPECT_EQ(run.status, 0);
        const std::string head = "mobbscope: warning: " + out + ": a CSV ";
        EXPECT_TRUE(run.err.empty() || (run.err.starts_with(head) && is_one_line(run.err))) << run.err;
        return run.err.empty() ? "" : run.err.substr(head.size());
    };
    EXPECT_EQ(said(one), "");
    EXPECT_EQ(said(two), "without ids is read as held, but its clip is linear; give --motion linear when reading it\n");
    EXPECT_EQ(run_program({"info", out, "--motion", "linear", "--json"}).status, 0);
    EXPECT_EQ(said(one + ',' + three),
              "with ids is read as linear, but its clips are held; give --motion held when reading it\n");
    EXPECT_EQ(said(one + ',' + two),
              "with ids is read as linear, but 1 clip is held, such as 'a'; give --motion held with --id when reading "
              "one of these, or write a scene (.json)\n");
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
