// What becomes of a case: every outcome, told apart.
#include <base/file.h>
#include <picture_tests/reference.h>
#include <picture_tests/run_cases.h>
#include <render/image/png.h>

#include "picture_tests/case_folder.h"
#include "render/backends.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace mobbscope::picture_tests {
namespace {

using mobbscope::testing::CaseFolder;

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
        return result.actual;
    }

    const CaseFolder cases;
    std::unique_ptr<PictureMaker> maker_;
};

TEST_F(RunCaseTest, WithoutAGoldenSaysSoAndHasThePicture) {
    const CaseResult result = run(cases.add("a"));
    EXPECT_EQ(result.outcome, CaseOutcome::missing_golden);
    EXPECT_NE(result.message.find("a.png"), std::string::npos) << result.message;
    EXPECT_EQ(result.actual.width, 160);
    EXPECT_TRUE(result.golden.rgba.empty());
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
    EXPECT_FALSE(result.image->heat.rgba.empty());
}

TEST_F(RunCaseTest, IsDifferentWhenTheGoldenHasAnotherSize) {
    golden_of(cases.add("a"));
    const CaseFile larger = cases.write("a", R"({"mobbscope_case": 1, "scene": "scene.json", "size": "200x120"})");
    const CaseResult result = run(larger);
    EXPECT_EQ(result.outcome, CaseOutcome::different);
    EXPECT_EQ(result.message, "the sizes are 200x120 and 160x120");
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
    EXPECT_TRUE(unread.actual.rgba.empty());
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

TEST_F(RunCaseTest, HoldsWhatIsDrawnAgainstItsDrawList) {
    const CaseFile two = cases.write("b", R"({"mobbscope_case": 1, "scene": "scene.json", "size": "320x120",
        "panels": [{"view": {"levels": 0}}, {}]})");
    golden_of(two);
    cases.folder().write("b.draw.json", "[]");
    CaseResult result = run(two);
    EXPECT_EQ(result.outcome, CaseOutcome::different);
    EXPECT_EQ(result.message, "b.draw.json: picture 1 is not in the golden; and 1 more");
    EXPECT_TRUE(result.image->same);
    take(result);
    EXPECT_EQ(run(two).outcome, CaseOutcome::passed);

    // The same picture within the tolerance, but not the same boxes.
    std::string text = mobbscope::testing::slurp(two.draw());
    const std::size_t radius = text.find("\"radius\": 0.4");
    ASSERT_NE(radius, std::string::npos) << text.substr(0, 2000);
    text.replace(radius, 13, "\"radius\": 0.41");
    cases.folder().write("b.draw.json", text);
    const CaseResult off = run(two);
    EXPECT_EQ(off.outcome, CaseOutcome::different);
    EXPECT_NE(off.message.find("disk of A, sample 0, radius: 0.4 instead of 0.41"), std::string::npos) << off.message;
}

TEST_F(RunCaseTest, AWindowHasNoDrawList) {
    cases.folder().write("w.draw.json", "");
    const CaseResult result =
        run(cases.write("w", R"({"mobbscope_case": 1, "scene": "scene.json", "size": "640x400", "window": {}})"));
    EXPECT_EQ(result.outcome, CaseOutcome::failed);
    EXPECT_NE(result.message.find("draw list"), std::string::npos) << result.message;
    EXPECT_TRUE(result.actual.rgba.empty()) << "what failed has no picture to be taken";
}

TEST_F(RunCaseTest, PanelsAreSeenThroughWhereTheirBackgroundIs) {
    const CaseResult result = run(cases.write("a", R"({"mobbscope_case": 1, "scene": "scene.json", "size": "320x160",
        "background": "transparent", "samples": 1, "panels": [{"title": "one"}, {"title": "two"}]})"));
    EXPECT_EQ(result.outcome, CaseOutcome::missing_golden) << result.message;
    EXPECT_EQ(result.actual.at(0, 0)[3], 0) << "around the panels";
    EXPECT_EQ(result.actual.at(160, 80)[3], 0) << "between them";
    int opaque = 0;
    for (std::size_t i = 3; i < result.actual.rgba.size(); i += 4) opaque += result.actual.rgba[i] == 255 ? 1 : 0;
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

/// A folder that says where its goldens are from.
class RunCaseWithReferenceTest : public RunCaseTest {
  protected:
    /// Takes all goldens of a case here, and says that they are from here.
    void take_here(const CaseFile& file) {
        CaseResult result = run_case(file, maker_.get(), "", GoldenSource::here);
        EXPECT_EQ(result.outcome, CaseOutcome::missing_golden) << result.message;
        take(result);
        write_reference(cases.path(), reference_of(maker_->renderer()));
    }
    /// From now on the goldens are from where a font is another.
    void move_elsewhere() {
        Reference there = reference_of(maker_->renderer());
        there.fonts.begin()->second = std::string(64, '0');
        write_reference(cases.path(), there);
    }
    /// Nothing is held against a golden that is no picture.
    void spoil(const std::filesystem::path& golden) { cases.folder().write(golden.filename().string(), "spoiled"); }
};

TEST_F(RunCaseWithReferenceTest, HereBothGoldensAreHeld) {
    const CaseFile file = cases.add("a");
    take_here(file);
    const CaseResult both = run(file);
    EXPECT_EQ(both.outcome, CaseOutcome::passed) << both.message;
    EXPECT_EQ(both.other_here, "");
    EXPECT_EQ(both.tolerance, Tolerance::tight);
    EXPECT_NE(read_png(file.golden()).rgba, read_png(file.plain()).rgba) << "there is text";
    EXPECT_EQ(both.actual.rgba, read_png(file.golden()).rgba);

    spoil(file.plain());
    CaseResult plain = run(file);
    EXPECT_EQ(plain.outcome, CaseOutcome::different);
    EXPECT_NE(plain.message.find("without text: the golden cannot be read"), std::string::npos) << plain.message;
    EXPECT_EQ(take(plain), std::vector<std::filesystem::path>{file.plain()});
    EXPECT_EQ(run(file).outcome, CaseOutcome::passed);

    spoil(file.golden());
    EXPECT_EQ(run(file).outcome, CaseOutcome::different);
}

TEST_F(RunCaseWithReferenceTest, ElsewhereThatWithoutTextAlone) {
    const CaseFile file = cases.add("a");
    take_here(file);
    move_elsewhere();
    spoil(file.golden());
    const CaseResult result = run(file);
    EXPECT_EQ(result.outcome, CaseOutcome::passed) << result.message;
    EXPECT_NE(result.other_here.find(" for 00000000"), std::string::npos) << result.other_here;
    EXPECT_EQ(result.tolerance, Tolerance::loose);
    EXPECT_EQ(result.image->largest, 0);
    EXPECT_NE(result.actual.rgba, read_png(file.plain()).rgba) << "the picture with text is drawn all the same";
}

TEST_F(RunCaseWithReferenceTest, ElsewhereAWrongBoxIsFound) {
    const CaseFile file = cases.write("a", R"({"mobbscope_case": 1, "scene": "scene.json", "size": "640x360"})");
    take_here(file);
    move_elsewhere();
    // One disk, and so the boxes around it, 5 cm wider.
    std::string scene = mobbscope::testing::kSmallScene;
    scene.replace(scene.find("0.45]"), 4, "0.50");
    cases.folder().write("scene.json", scene);
    const CaseResult result = run(file);
    EXPECT_EQ(result.outcome, CaseOutcome::different);
    EXPECT_EQ(result.message.find("without text: "), 0u) << result.message;
    EXPECT_FALSE(result.image->heat.rgba.empty());
}

TEST_F(RunCaseWithReferenceTest, AGoldenWithoutTextThatIsNotThereIsMissing) {
    const CaseFile file = cases.add("a");
    golden_of(file);
    write_reference(cases.path(), reference_of(maker_->renderer()));
    for (int elsewhere = 0; elsewhere < 2; ++elsewhere) {
        const CaseResult result = run(file);
        EXPECT_EQ(result.outcome, CaseOutcome::missing_golden);
        EXPECT_NE(result.message.find("a.plain.png"), std::string::npos) << result.message;
        move_elsewhere();
    }
}

TEST_F(RunCaseWithReferenceTest, WithoutAReferenceNothingIsDrawnWithoutText) {
    const CaseFile file = cases.add("a");
    cases.folder().write("a.plain.png", "no golden of this case");
    golden_of(file);
    const CaseResult result = run(file);
    EXPECT_EQ(result.outcome, CaseOutcome::passed) << result.message;
    EXPECT_EQ(result.other_here, "");
    EXPECT_EQ(read_file(file.plain()), "no golden of this case");
}

TEST_F(RunCaseWithReferenceTest, WhatIsDrawnIsHeldWithoutText) {
    const CaseFile file = cases.add("a");
    cases.folder().write("a.draw.json", "");
    CaseResult result = run_case(file, maker_.get(), "", GoldenSource::here);
    take(result);
    move_elsewhere();
    spoil(file.draw());
    EXPECT_EQ(run(file).outcome, CaseOutcome::passed);

    std::string list = read_file(file.plain_draw());
    EXPECT_NE(list.find("\"texts\": []"), std::string::npos) << list;
    EXPECT_NE(list.find("\"legend\": []"), std::string::npos) << list;
    list.replace(list.find("\"radius\": 0.4"), 13, "\"radius\": 0.41");
    cases.folder().write("a.plain.draw.json", list);
    const CaseResult off = run(file);
    EXPECT_EQ(off.outcome, CaseOutcome::different);
    EXPECT_NE(off.message.find("disk of A, sample 0, radius: 0.4 instead of 0.41"), std::string::npos) << off.message;

    std::filesystem::remove(file.plain_draw());
    EXPECT_EQ(run(file).outcome, CaseOutcome::missing_golden);
}

TEST_F(RunCaseWithReferenceTest, OfAWindowItsStateIsHeld) {
    cases.folder().write("w.script", "run query.select 0\nrun view.zoom 1.5\n");
    const CaseFile file = cases.write("w", R"({"mobbscope_case": 1, "scene": "scene.json", "size": "640x400",
        "window": {"script": "w.script"}})");
    take_here(file);
    EXPECT_EQ(read_png(file.plain()).width, 80);
    EXPECT_EQ(run(file).outcome, CaseOutcome::passed);
    move_elsewhere();
    spoil(file.golden());
    EXPECT_EQ(run(file).outcome, CaseOutcome::passed);

    // The picture is the same, and what the inspector shows is not.
    cases.folder().write("w.script", "run query.select 0\nrun view.zoom 1.5\nclick agent.0\n");
    const CaseResult other = run(file);
    EXPECT_EQ(other.outcome, CaseOutcome::different);
    EXPECT_NE(other.message.find("w.plain.state.json: /selection"), std::string::npos) << other.message;
    EXPECT_TRUE(other.image->same) << other.message;

    std::filesystem::remove(file.plain_state());
    EXPECT_EQ(run(file).outcome, CaseOutcome::missing_golden);
}

TEST_F(RunCaseWithReferenceTest, FailsWhereTheReferenceIsNone) {
    const CaseFile file = cases.add("a");
    take_here(file);
    cases.folder().write("reference.json", "{}");
    const CaseResult result = run(file);
    EXPECT_EQ(result.outcome, CaseOutcome::failed);
    EXPECT_NE(result.message.find("reference.json"), std::string::npos) << result.message;
}

TEST_F(RunCaseWithReferenceTest, NoCaseIsCalledAsAGoldenIs) {
    const CaseFile file = cases.add("a.plain");
    EXPECT_EQ(run(file).outcome, CaseOutcome::missing_golden) << "without a reference it may be";
    write_reference(cases.path(), reference_of(maker_->renderer()));
    const CaseResult result = run(file);
    EXPECT_EQ(result.outcome, CaseOutcome::failed);
    EXPECT_NE(result.message.find("rename the case"), std::string::npos) << result.message;
}

TEST(RunCase, IsSkippedWithoutOpenGL) {
    const CaseFolder cases;
    const CaseResult result = run_case(cases.add("a", R"("veiw": {})"), nullptr, "no OpenGL (osmesa: none)");
    EXPECT_EQ(result.outcome, CaseOutcome::skipped);
    EXPECT_EQ(result.message, "no OpenGL (osmesa: none)");
}

TEST_F(RunCaseTest, PanelsFillTheirPicture) {
    const CaseResult result =
        run(cases.write("a", R"json({"mobbscope_case": 1, "scene": "scene.json", "size": "401x203",
        "panels": [{"title": "(a)", "view": {"levels": 0}}, {"title": "(b)"}, {"title": "(c)"}]})json"));
    EXPECT_EQ(result.outcome, CaseOutcome::missing_golden) << result.message;
    EXPECT_EQ(result.actual.width, 401);
    EXPECT_EQ(result.actual.height, 203);
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
