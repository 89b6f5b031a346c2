// Cases read, and what is said of bad ones.
#include <cases/case_scene.h>
#include <picture_tests/test_case.h>
#include <support/input_error.h>

#include "cases/case_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace mobbscope::picture_tests {
namespace {

TEST(ReadCase, TakesTheSceneAsItIsWhereTheCaseSaysNothing) {
    const CaseFolder cases;
    const Case read = read_case(cases.write("a", R"({"mobbscope_case": 1, "scene": "scene.json"})").file);
    EXPECT_EQ(read.terms.tolerance, Tolerance::tight);
    EXPECT_FALSE(read.terms.skip);
    ASSERT_EQ(read.shot.panels.size(), 1u);
    EXPECT_EQ(read.shot.panels[0].view.levels, (LevelRange{1, 1}));
    EXPECT_EQ(read.shot.panels[0].fitted->options().leaf, 2);
    EXPECT_EQ(read.shot.picture.size, (PictureSize{1280, 720}));
    EXPECT_FALSE(read.shot.window);
}

TEST(ReadCase, EachLayerSaysWhatIsOtherThanInTheOneBelow) {
    const CaseFolder cases;
    const Case read =
        read_case(cases
                      .add("a", R"("tolerance": "loose", "scale": 2, "samples": 8, "background": "#ff000080",
        "fit": {"tree": "umobb"}, "view": {"query": 0},
        "panels": [{"title": "one"}, {"title": "two", "fit": {"leaf": 1}, "view": {"query": null, "levels": 0}},
                   {"fit": {"leaf": 1}}], "columns": 2)")
                      .file);
    EXPECT_EQ(read.terms.tolerance, Tolerance::loose);
    EXPECT_EQ(read.shot.picture.scale, 2);
    EXPECT_EQ(read.shot.picture.samples, 8);
    EXPECT_EQ(read.shot.picture.background->r, 1);
    EXPECT_EQ(read.shot.columns, 2);
    const std::vector<PicturePanel>& panels = read.shot.panels;
    ASSERT_EQ(panels.size(), 3u);
    EXPECT_EQ(panels[0].title, "one");
    EXPECT_EQ(panels[0].view.query, 0);
    EXPECT_EQ(panels[0].view.levels, (LevelRange{1, 1})) << "the scene's";
    EXPECT_EQ(panels[0].fitted->options().tree, mobb::TreeKind::umobb);
    EXPECT_EQ(panels[0].fitted->options().leaf, 2) << "the scene's";
    EXPECT_EQ(panels[1].fitted->options().tree, mobb::TreeKind::umobb);
    EXPECT_EQ(panels[1].fitted->options().leaf, 1);
    EXPECT_EQ(panels[1].view.query, std::nullopt);
    EXPECT_EQ(panels[1].view.levels, (LevelRange{0, 0}));
    EXPECT_EQ(panels[2].fitted, panels[1].fitted) << "equal fits are made once";
}

TEST(ReadCase, TheSceneMayStandInTheCase) {
    const CaseFolder cases;
    const std::string own = R"({"mobbscope_case": 1, "scene": )" + std::string(mobbscope::testing::kSmallScene) +
                            R"(, "view": {"levels": 0}})";
    const CaseFile file = cases.write("a", own);
    const Case read = read_case(file.file);
    EXPECT_EQ(read.shot.panels[0].view.levels, (LevelRange{0, 0}));
    EXPECT_EQ(read.shot.panels[0].fitted->options().leaf, 2) << "the scene's";
    EXPECT_EQ(read.shot.scene_file, file.file);
    EXPECT_EQ(scene_of(file).agents.size(), 2u);
    // Its files are relative to the folder of the case.
    cases.folder().write("walk.csv", "t,x,y,r\n0,0,0,0.4\n0.1,1,0,0.4\n");
    const std::string named = R"({"mobbscope_case": 1, "scene": {"clips": {"walk": {"source": "walk.csv"}}}})";
    EXPECT_EQ(read_case(file.file, named).shot.panels[0].fitted->scene().clips.size(), 1u) << "in place of the file's";
    EXPECT_PRED2(says,
                 input_error([&] { read_case(file.file, "{\"mobbscope_case\": 1, \"scene\":\n{\"clip\": {}}}"); }),
                 "a.case.json: line 2, /scene/clip");
}

TEST(ReadCase, WhatMayDifferAndWhereIsTheCasesOwn) {
    const CaseFolder cases;
    const Case plain = read_case(cases.add("plain").file);
    EXPECT_EQ(plain.terms.diff.allowed(640 * 360), 4);
    EXPECT_EQ(plain.terms.diff.channel_tolerance, 3);
    EXPECT_FALSE(plain.terms.mask);
    EXPECT_TRUE(plain.terms.state);
    const Case own = read_case(
        cases.add("own", R"("threshold": "2%", "allowed": "12px", "mask": "own.mask.png", "state": false)").file);
    EXPECT_DOUBLE_EQ(own.terms.diff.channel_tolerance, 5.1);
    EXPECT_EQ(own.terms.diff.allowed(640 * 360), 12);
    EXPECT_EQ(own.terms.mask, cases.path() / "own.mask.png");
    EXPECT_FALSE(own.terms.state);
    const Case loose = read_case(cases.add("loose", R"("tolerance": "loose", "threshold": 4, "allowed": 0.001)").file);
    EXPECT_EQ(loose.terms.diff.shift, 1);
    EXPECT_EQ(loose.terms.diff.channel_tolerance, 4);
    EXPECT_EQ(loose.terms.diff.allowed(10'000), 10);
    for (const char* bad :
         {R"("threshold": 300)", R"("allowed": 12)", R"("allowed": "many")", R"("mask": 1)", R"("state": "no")"}) {
        EXPECT_THROW(read_case(cases.add("bad", bad).file), InputError) << bad;
    }
}

TEST(ReadCase, ThatIsSkippedDoesNotNeedItsScene) {
    const CaseFolder cases;
    const Case read =
        read_case(cases.write("a", R"({"mobbscope_case": 1, "scene": "later.json", "skip": "waits"})").file);
    EXPECT_EQ(read.terms.skip, "waits");
}

TEST(ReadCase, ReadsTheScriptOfAWindow) {
    const CaseFolder cases;
    cases.folder().write("top.script", "run view.top\n");
    const Case read = read_case(cases.add("a", R"("window": {"script": "top.script", "scale": 1.5})").file);
    ASSERT_TRUE(read.shot.window);
    EXPECT_TRUE(read.shot.window->script);
    EXPECT_EQ(read.shot.window->scale, 1.5);
}

struct BadCase {
    const char* text;  ///< line 1 is the version, line 2 this
    std::vector<std::string> says;
};

TEST(ReadCase, SaysWhatIsWrongAndWhere) {
    const CaseFolder cases;
    cases.folder().write("writes.script", "run view.top\npicture out.png\n");
    cases.folder().write("broken.json", "{\"clips\": }");
    const std::vector<BadCase> bad{
        {R"("scene": "scene.json", "vew": {}})", {"line 2, /vew", "unknown key 'vew'", "'view'"}},
        {R"("scene": "scene.json", "view": {"level": 1}})", {"line 2, /view/level", "'levels'"}},
        {R"("scene": "scene.json", "fit": {"tree": "oak"}})", {"line 2, /fit/tree", "'oak' is not a tree"}},
        {R"("scene": "scene.json", "panels": [{"fits": {}}]})", {"line 2, /panels/0/fits", "'fit'"}},
        {R"("scene": "scene.json", "panels": []})", {"/panels", "there are no panels"}},
        {R"("scene": "scene.json", "panels": {}})", {"/panels", "expected an array"}},
        {R"("scene": "scene.json", "columns": 0})", {"/columns", "out of range"}},
        {R"("scene": "scene.json", "size": "640"})", {"/size", "'640' is not a size"}},
        {R"("scene": "scene.json", "size": [640, 360]})", {"/size", "expected a string"}},
        {R"("scene": "scene.json", "scale": 100})", {"/scale", "out of range"}},
        {R"("scene": "scene.json", "samples": 3})", {"/samples", "1, 2, 4 or 8"}},
        {R"("scene": "scene.json", "background": "red"})", {"/background", "'red' is not a background"}},
        {R"("scene": "scene.json", "select": 3})", {"/select", "expected a string"}},
        {R"("scene": "scene.json", "select": "A", "window": {}})", {"/select", "no such key"}},
        {R"("scene": "scene.json", "tolerance": "wide"})", {"/tolerance", "tight or loose"}},
        {R"("scene": "scene.json", "skip": ""})", {"/skip", "say why"}},
        {R"("scene": "scene.json", "skip": true})", {"/skip", "expected a string"}},
        {R"("scene": 3})", {"/scene", "expected a string"}},
        {R"("size": "64x64"})", {"'scene' is missing"}},
        {R"("scene": "none.json"})", {"bad.case.json", "line 2, /scene", "none.json"}},
        {R"("scene": "broken.json"})", {"bad.case.json", "line 2, /scene", "broken.json", "line 1"}},
        {R"("scene": "scene.json", "window": {"script": "none.script"}})",
         {"bad.case.json", "line 2, /window/script", "none.script"}},
        {R"("scene": "scene.json", "window": {"script": "writes.script"}})",
         {"/window/script", "writes.script: line 2", "'picture' has nowhere to write"}},
        {R"("scene": "scene.json", "window": {}, "panels": []})", {"/panels", "no such key"}},
        {R"("scene": "scene.json", "window": {"scale": 9}})", {"/window/scale", "out of range"}},
    };
    for (const BadCase& one : bad) {
        const CaseFile file = cases.write("bad", std::string("{\"mobbscope_case\": 1,\n") + one.text);
        const std::string message = input_error([&] { read_case(file.file); });
        for (const std::string& part : one.says) EXPECT_PRED2(says, message, part) << one.text;
    }
    EXPECT_PRED2(says, input_error([&] { read_case(cases.write("old", R"({"scene": "scene.json"})").file); }),
                 "'mobbscope_case' is missing");
    EXPECT_PRED2(says, input_error([&] { read_case(cases.write("new", R"({"mobbscope_case": 2})").file); }),
                 "this program reads version 1");
    EXPECT_PRED2(says, input_error([&] { read_case(cases.path() / "none.case.json"); }), "none.case.json");
}

}  // namespace
}  // namespace mobbscope::picture_tests
