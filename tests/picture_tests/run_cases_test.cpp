// What becomes of a case: every outcome, told apart.
#include <base/file.h>
#include <picture_tests/run_cases.h>
#include <render/image/png.h>
#include <support/png_file.h>

#include "cases/case_folder.h"
#include "render/backends.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace mobbscope::picture_tests {
namespace {

class RunCaseTest : public ::testing::Test {
  protected:
    void SetUp() override {
        if (mobbscope::testing::open_or_skip(Backend::automatic))
            maker_ = std::make_unique<PictureMaker>(Backend::automatic);
    }

    CaseResult run(const CaseFile& file) { return run_case(file, maker_.get(), ""); }
    /// Runs a case and takes its picture.
    Image golden_of(const CaseFile& file) {
        CaseResult result = run(file);
        EXPECT_EQ(result.outcome, CaseOutcome::missing_golden) << result.message;
        take(result);
        return read_png_bytes(result.actual);
    }

    const CaseFolder cases;
    std::unique_ptr<PictureMaker> maker_;
};

TEST_F(RunCaseTest, WithoutAGoldenSaysSoAndHasThePicture) {
    const CaseResult result = run(cases.add("a"));
    EXPECT_EQ(result.outcome, CaseOutcome::missing_golden);
    EXPECT_NE(result.message.find("a.png"), std::string::npos) << result.message;
    EXPECT_EQ(read_png_bytes(result.actual).width, 160);
    EXPECT_TRUE(result.golden.empty());
    EXPECT_FALSE(result.image);
}

TEST_F(RunCaseTest, PassesAgainstItsOwnPicture) {
    const CaseFile file = cases.add("a");
    golden_of(file);
    const CaseResult result = run(file);
    EXPECT_EQ(result.outcome, CaseOutcome::passed);
    EXPECT_EQ(result.message, "");
    EXPECT_EQ(result.image->largest, 0);
    EXPECT_GT(result.seconds, 0);
}

TEST_F(RunCaseTest, IsDifferentWhenTheViewIsNotTheGoldens) {
    golden_of(cases.add("a"));
    const CaseResult result = run(cases.add("a", R"("view": {"levels": 0})"));
    EXPECT_EQ(result.outcome, CaseOutcome::different);
    EXPECT_NE(result.message.find(" of 19200 pixels"), std::string::npos) << result.message;
    EXPECT_FALSE(
        compared_again(result, read_png_bytes(result.actual), read_png_bytes(result.golden)).heat.rgba.empty());
}

TEST_F(RunCaseTest, IsDifferentWhenTheGoldenHasAnotherSize) {
    golden_of(cases.add("a"));
    const CaseFile larger = cases.write("a", R"({"mobbscope_case": 1, "scene": "scene.json", "size": "200x120"})");
    const CaseResult result = run(larger);
    EXPECT_EQ(result.outcome, CaseOutcome::different);
    EXPECT_EQ(result.message, "the sizes are 200x120 and 160x120");
    // What its header says is all that is read of it: there may be any number of pixels behind.
    cases.folder().write("a.png",
                         testing::png_header({.width = 1, .height = 134'217'728}) + testing::png_chunk("IDAT", ""));
    const CaseResult huge = run(larger);
    EXPECT_EQ(huge.message, "the sizes are 200x120 and 1x134217728");
    EXPECT_TRUE(huge.golden.empty());
}

TEST_F(RunCaseTest, IsDifferentFromAGoldenThatIsNoPicture) {
    const CaseFile file = cases.add("a");
    cases.folder().write("a.png", "no picture");
    const CaseResult result = run(file);
    EXPECT_EQ(result.outcome, CaseOutcome::different);
    EXPECT_NE(result.message.find("the golden cannot be read"), std::string::npos) << result.message;
}

TEST_F(RunCaseTest, FailsWithTheReadersWords) {
    const CaseResult unread = run(cases.add("a", R"("veiw": {})"));
    EXPECT_EQ(unread.outcome, CaseOutcome::failed);
    EXPECT_NE(unread.message.find("a.case.json: line 1, /veiw: unknown key"), std::string::npos) << unread.message;
    EXPECT_TRUE(unread.actual.empty());
}

TEST_F(RunCaseTest, FailsWhenTheViewCannotBeDrawn) {
    const CaseResult result = run(cases.add("a", R"("view": {"query": 7})"));
    EXPECT_EQ(result.outcome, CaseOutcome::failed);
    EXPECT_NE(result.message.find("scene.json: "), std::string::npos) << result.message;
}

TEST_F(RunCaseTest, FailsWhenTheScriptOfItsWindowExpectsSomethingElse) {
    cases.folder().write("s.script", "expect /view/theme \"light\"\n");
    const CaseResult result =
        run(cases.write("a", R"({"mobbscope_case": 1, "scene": "scene.json", "window": {"script": "s.script"}})"));
    EXPECT_EQ(result.outcome, CaseOutcome::failed);
    EXPECT_NE(result.message.find("s.script: line 1"), std::string::npos) << result.message;
}

TEST_F(RunCaseTest, IsSkippedForTheReasonThatItGives) {
    const CaseResult result = run(cases.add("a", R"("skip": "waits for the crowd")"));
    EXPECT_EQ(result.outcome, CaseOutcome::skipped);
    EXPECT_EQ(result.message, "waits for the crowd");
}

TEST_F(RunCaseTest, FailsWhenOpenGLReportsAnError) {
    maker_->renderer().context().complain("no such texture");
    const CaseResult result = run(cases.add("a"));
    EXPECT_EQ(result.outcome, CaseOutcome::failed);
    EXPECT_NE(result.message.find("no such texture"), std::string::npos) << result.message;
}

TEST_F(RunCaseTest, FailsWhenTheShaderCompilerWarns) {
    maker_->renderer().context().warn("a varying is never read");
    const CaseResult result = run(cases.add("a"));
    EXPECT_EQ(result.outcome, CaseOutcome::failed);
    EXPECT_NE(result.message.find("a varying is never read"), std::string::npos) << result.message;
}

TEST_F(RunCaseTest, IsDifferentWhereTheStateDiffersAndPixelsAgree) {
    const CaseFile two = cases.write("b", R"({"mobbscope_case": 1, "scene": "scene.json", "size": "320x120",
        "panels": [{"view": {"levels": 0}}, {}]})");
    golden_of(two);
    cases.folder().write("b.state.json", "[]");
    CaseResult result = run(two);
    EXPECT_EQ(result.outcome, CaseOutcome::different);
    EXPECT_EQ(result.message.find("the golden cannot be read: "), 0u) << result.message;
    EXPECT_TRUE(result.image->same);
    take(result);
    EXPECT_EQ(run(two).outcome, CaseOutcome::passed);

    std::string text = mobbscope::testing::slurp(two.state());
    const std::size_t place = text.find("\"translate\": [1, -1]");
    ASSERT_NE(place, std::string::npos) << text.substr(0, 2000);
    text.replace(place, 20, "\"translate\": [1.0, -1.00001]");
    cases.folder().write("b.state.json", text);
    const CaseResult off = run(two);
    EXPECT_EQ(off.outcome, CaseOutcome::different);
    EXPECT_TRUE(off.image->same);
    EXPECT_EQ(off.message, "b.state.json: B moved by (0, 1e-05)");
    EXPECT_EQ(off.findings.back().words.size(), 1u) << "what follows from it is not told";
}

TEST_F(RunCaseTest, WherePixelsAloneDifferTheStateSaysSo) {
    const CaseFile file = cases.add("a");
    Image golden = golden_of(file);
    for (int x = 0; x < 40; ++x) golden.at(x, 1)[0] ^= 0x80;
    write_png(file.golden(), golden);
    const CaseResult result = run(file);
    EXPECT_EQ(result.outcome, CaseOutcome::different);
    EXPECT_EQ(result.findings.size(), 1u);
    ASSERT_EQ(result.remarks.size(), 1u);
    EXPECT_EQ(result.remarks[0].find("a.state.json is the same, only the pixels differ; drawn with OpenGL "), 0u)
        << result.remarks[0];
    EXPECT_NE(words_on(result, "out").find("only the pixels differ"), std::string::npos);
}

TEST_F(RunCaseTest, TheCauseOfAMoveIsTheAgentThatMoved) {
    cases.folder().write("three.json", R"({"clips": {"walk": {"dt": 0.5, "samples": [[0, 0, 0.4], [1, 0, 0.4]]}},
        "agents": [{"name": "A", "clip": "walk"}, {"name": "B", "clip": "walk", "translate": [2, 1]},
                   {"name": "C", "clip": "walk", "translate": [-1, 4]}]})");
    const std::string keys = R"({"mobbscope_case": 1, "scene": "three.json", "size": "160x120"})";
    golden_of(cases.write("a", keys));
    std::string moved = mobbscope::testing::slurp(cases.path() / "three.json");
    moved.replace(moved.find("[-1, 4]"), 7, "[-0.9, 4]");
    cases.folder().write("three.json", moved);
    const CaseResult result = run(cases.write("a", keys));
    EXPECT_EQ(result.outcome, CaseOutcome::different);
    ASSERT_FALSE(result.findings.empty());
    const Finding& state = result.findings.back();
    EXPECT_EQ(state.golden.filename(), "a.state.json");
    EXPECT_EQ(state.words, std::vector<std::string>{"C moved by (0.1, 0)"});
}

TEST_F(RunCaseTest, TheStateIsTakenWithThePictureUnlessTheCaseSaysNo) {
    const CaseFile file = cases.add("a");
    golden_of(file);
    EXPECT_TRUE(std::filesystem::exists(file.state()));
    const CaseFile without = cases.add("b", R"("state": false)");
    golden_of(without);
    EXPECT_FALSE(std::filesystem::exists(without.state()));
    cases.folder().write("b.state.json", "{}");
    CaseResult result = run_case(without, maker_.get(), "", {.fresh = FreshGoldens::of_all});
    EXPECT_EQ(result.outcome, CaseOutcome::passed) << "it is not asked for";
    EXPECT_EQ(take(result), std::vector{without.golden()});
    EXPECT_FALSE(std::filesystem::exists(without.state())) << "nobody reads it";
}

TEST_F(RunCaseTest, AGoldenWithoutAStateLacksIt) {
    const CaseFile file = cases.add("a");
    golden_of(file);
    std::filesystem::remove(file.state());
    const CaseResult result = run(file);
    EXPECT_EQ(result.outcome, CaseOutcome::missing_golden);
    EXPECT_NE(result.message.find("there is no golden"), std::string::npos);
    EXPECT_NE(result.message.find("a.state.json"), std::string::npos) << result.message;
    EXPECT_EQ(result.fresh.size(), 2u);
}

TEST_F(RunCaseTest, OfAWindowItsStateIsHeld) {
    cases.folder().write("w.script", "run query.select 0\nrun view.zoom 1.5\n");
    const CaseFile file = cases.write("w", R"({"mobbscope_case": 1, "scene": "scene.json", "size": "640x400",
        "window": {"script": "w.script"}})");
    Image golden = golden_of(file);
    EXPECT_EQ(run(file).outcome, CaseOutcome::passed);

    // Words of another Dear ImGui are drawn otherwise, and the state decides.
    for (int x = 0; x < 60; ++x) golden.at(x, 1)[0] ^= 0x80;
    write_png(file.golden(), golden);
    EXPECT_EQ(run(file).outcome, CaseOutcome::different);
    std::string state = read_file(file.state());
    const std::size_t version = state.find("\"imgui\": \"") + 10;
    state.replace(version, state.find('"', version) - version, "0.1");
    cases.folder().write("w.state.json", state);
    const CaseResult passed = run(file);
    EXPECT_EQ(passed.outcome, CaseOutcome::passed) << passed.message;
    ASSERT_EQ(passed.remarks.size(), 1u);
    EXPECT_NE(passed.remarks[0].find(" for 0.1, so w.state.json decides"), std::string::npos) << passed.remarks[0];

    // The scene is the same, and what the inspector shows is not.
    cases.folder().write("w.script", "run query.select 0\nrun view.zoom 1.5\nclick agent.0\n");
    const CaseResult other = run(file);
    EXPECT_EQ(other.outcome, CaseOutcome::different);
    const std::vector<std::string>& words = other.findings.back().words;
    EXPECT_NE(std::ranges::find(words, "selection kind path was none"), words.end()) << other.message;
}

TEST_F(RunCaseTest, APassWithPixelsThatDifferSaysHowManyAndWhere) {
    const CaseFile file = cases.add("a");
    Image golden = golden_of(file);
    for (int i = 0; i < 4; ++i) golden.at(10 + i, 20)[0] ^= 0x80;
    write_png(file.golden(), golden);
    const CaseResult result = run(file);
    EXPECT_EQ(result.outcome, CaseOutcome::passed) << result.message;
    ASSERT_EQ(result.remarks.size(), 1u);
    EXPECT_EQ(result.remarks[0].find("4 of 19200 pixels"), 0u) << result.remarks[0];
    EXPECT_NE(result.remarks[0].find("within 4x1 at (10, 20)"), std::string::npos) << result.remarks[0];
    golden.at(30, 30)[0] ^= 0x80;
    write_png(file.golden(), golden);
    EXPECT_EQ(run(file).outcome, CaseOutcome::different);
}

TEST_F(RunCaseTest, OnlyWhatTheMaskLetsIsCompared) {
    const CaseFile file = cases.add("a", R"("mask": "a.mask.png")");
    Image mask(160, 120);
    mask.rgba.assign(mask.rgba.size(), 255);
    for (int y = 0; y < 20; ++y) {
        for (int x = 0; x < 160; ++x) std::fill_n(mask.at(x, y), 3, std::uint8_t{0});
    }
    write_png(cases.path() / "a.mask.png", mask);
    Image golden = golden_of(file);
    for (int x = 0; x < 160; ++x) golden.at(x, 10)[1] ^= 0x80;
    write_png(file.golden(), golden);
    const CaseResult masked = run(file);
    EXPECT_EQ(masked.outcome, CaseOutcome::passed) << masked.message;
    EXPECT_EQ(masked.image->pixels, 160 * 100);
    for (int x = 0; x < 160; ++x) golden.at(x, 30)[1] ^= 0x80;
    write_png(file.golden(), golden);
    EXPECT_EQ(run(file).outcome, CaseOutcome::different);
    write_png(cases.path() / "a.mask.png", Image(10, 10));
    const CaseResult other_size = run(file);
    EXPECT_EQ(other_size.outcome, CaseOutcome::failed);
    EXPECT_NE(other_size.message.find("a.mask.png: the mask has 10x10 pixels"), std::string::npos)
        << other_size.message;
}

TEST_F(RunCaseTest, PanelsAreSeenThroughWhereTheirBackgroundIs) {
    const CaseResult result = run(cases.write("a", R"({"mobbscope_case": 1, "scene": "scene.json", "size": "320x160",
        "background": "transparent", "samples": 1, "panels": [{"title": "one"}, {"title": "two"}]})"));
    EXPECT_EQ(result.outcome, CaseOutcome::missing_golden) << result.message;
    const Image actual = read_png_bytes(result.actual);
    EXPECT_EQ(actual.at(0, 0)[3], 0) << "around the panels";
    EXPECT_EQ(actual.at(160, 80)[3], 0) << "between them";
    int opaque = 0;
    for (std::size_t i = 3; i < actual.rgba.size(); i += 4) opaque += actual.rgba[i] == 255 ? 1 : 0;
    EXPECT_GT(opaque, 500);
}

TEST_F(RunCaseTest, AScriptOfTheWindowWritesNothing) {
    const std::string before = read_file(cases.path() / "scene.json");
    cases.folder().write("save.script", "run file.save\n");
    cases.folder().write("export.script", "run file.export_picture stray.png\n");
    for (const char* script : {"save.script", "export.script"}) {
        const CaseResult result = run(cases.write("a", R"({"mobbscope_case": 1, "scene": "scene.json",
            "size": "400x300", "window": {"script": ")" + std::string(script) +
                                                           "\"}}"));
        EXPECT_EQ(result.outcome, CaseOutcome::failed) << script;
        EXPECT_NE(result.message.find("nothing is written here"), std::string::npos) << result.message;
    }
    EXPECT_EQ(read_file(cases.path() / "scene.json"), before);
    EXPECT_FALSE(std::filesystem::exists(cases.path() / "stray.png"));
}

TEST(RunCase, IsSkippedWithoutOpenGL) {
    const CaseFolder cases;
    const auto run = [&](const std::string& more) {
        return run_case(cases.add("a", more), nullptr, "no OpenGL (osmesa: none)");
    };
    const CaseResult result = run("");
    EXPECT_EQ(result.outcome, CaseOutcome::skipped);
    EXPECT_EQ(result.message, "no OpenGL (osmesa: none)");
    EXPECT_TRUE(lacks_opengl(result));
    EXPECT_EQ(run(R"("veiw": {})").outcome, CaseOutcome::failed) << "what is wrong is seen without a picture";
    const CaseResult later = run(R"("skip": "until then")");
    EXPECT_EQ(later.message, "until then");
    EXPECT_FALSE(lacks_opengl(later));
    const CaseResult asked =
        run_case(case_named(cases.path(), "new"), nullptr, "no OpenGL",
                 {.fresh = FreshGoldens::of_all, .asked = R"({"mobbscope_case": 1, "scene": "scene.json"})"});
    EXPECT_EQ(asked.outcome, CaseOutcome::skipped) << asked.message;
    EXPECT_TRUE(asked.fresh.empty()) << "no case without a golden";
}

TEST_F(RunCaseTest, PanelsFillTheirPicture) {
    const CaseResult result =
        run(cases.write("a", R"json({"mobbscope_case": 1, "scene": "scene.json", "size": "401x203",
        "panels": [{"title": "(a)", "view": {"levels": 0}}, {"title": "(b)"}, {"title": "(c)"}]})json"));
    EXPECT_EQ(result.outcome, CaseOutcome::missing_golden) << result.message;
    EXPECT_EQ(read_png_bytes(result.actual).width, 401);
    EXPECT_EQ(read_png_bytes(result.actual).height, 203);
}

TEST_F(RunCaseTest, FailsWhenPanelsHaveNoRoom) {
    const CaseResult result = run(cases.add("a", R"("panels": [{}, {}, {}])"));
    EXPECT_EQ(result.outcome, CaseOutcome::failed);
    EXPECT_NE(result.message.find("3 pictures do not fit into 160x120"), std::string::npos) << result.message;
}

TEST(Summary, CountsEveryOutcome) {
    std::vector<CaseResult> results(6);
    results[1].outcome = CaseOutcome::skipped;
    EXPECT_TRUE(summary(results).ok());
    results[2].outcome = CaseOutcome::different;
    results[3].outcome = CaseOutcome::missing_golden;
    results[4].outcome = CaseOutcome::failed;
    const Summary sum = summary(results);
    EXPECT_EQ(sum[CaseOutcome::passed], 2);
    EXPECT_EQ(sum[CaseOutcome::different], 1);
    EXPECT_EQ(sum[CaseOutcome::missing_golden], 1);
    EXPECT_EQ(sum[CaseOutcome::failed], 1);
    EXPECT_EQ(sum[CaseOutcome::skipped], 1);
    EXPECT_FALSE(sum.ok());
}

}  // namespace
}  // namespace mobbscope::picture_tests
