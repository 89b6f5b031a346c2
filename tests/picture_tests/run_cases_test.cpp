// What becomes of a case: every outcome, told apart.
#include <base/file.h>
#include <picture_tests/reference.h>
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

TEST_F(RunCaseTest, HoldsWhatIsDrawnAgainstItsDrawList) {
    const CaseFile two = cases.write("b", R"({"mobbscope_case": 1, "scene": "scene.json", "size": "320x120",
        "panels": [{"view": {"levels": 0}}, {}]})");
    golden_of(two);
    cases.folder().write("b.draw.json", "[]");
    CaseResult result = run(two);
    EXPECT_EQ(result.outcome, CaseOutcome::different);
    EXPECT_EQ(result.message.find("b.draw.json: "), 0u) << result.message;
    EXPECT_TRUE(result.image->same);
    take(result);
    EXPECT_EQ(run(two).outcome, CaseOutcome::passed);

    // The same picture within the tolerance, but not the same disks.
    std::string text = mobbscope::testing::slurp(two.draw());
    const std::size_t radius = text.find("\"radius\": 0.4");
    ASSERT_NE(radius, std::string::npos) << text.substr(0, 2000);
    text.replace(radius, 13, "\"radius\": 0.41");
    cases.folder().write("b.draw.json", text);
    const CaseResult off = run(two);
    EXPECT_EQ(off.outcome, CaseOutcome::different);
    EXPECT_NE(off.message.find("disk of A, sample 0, radius: 0.4 instead of 0.41"), std::string::npos) << off.message;
}

TEST_F(RunCaseTest, ADrawListIsTakenWithThePictureUnlessTheCaseSaysNo) {
    const CaseFile file = cases.add("a");
    golden_of(file);
    EXPECT_TRUE(std::filesystem::exists(file.draw()));
    const CaseFile without = cases.add("b", R"("draw_list": false)");
    golden_of(without);
    EXPECT_FALSE(std::filesystem::exists(without.draw()));
    cases.folder().write("b.draw.json", "{}");
    EXPECT_EQ(run(without).outcome, CaseOutcome::passed) << "it is not asked for";
}

TEST_F(RunCaseTest, OfAGoldenWithoutADrawListThePixelsAreHeld) {
    const CaseFile file = cases.add("a");
    golden_of(file);
    std::filesystem::remove(file.draw());
    EXPECT_EQ(run(file).outcome, CaseOutcome::passed);
    EXPECT_TRUE(run(file).fresh.empty());
    const auto fresh = [&](FreshGoldens wanted) {
        std::vector<std::filesystem::path> files;
        for (const GoldenChange& change : run_case(file, maker_.get(), "", {.fresh = wanted}).fresh)
            files.push_back(change.file);
        return files;
    };
    EXPECT_EQ(fresh(FreshGoldens::missing), std::vector{file.draw()});
    EXPECT_EQ(fresh(FreshGoldens::of_all), (std::vector{file.golden(), file.draw()}));
}

TEST_F(RunCaseTest, NumbersOfPixelsInADrawListAreOnlyTold) {
    const CaseFile file = cases.add("a");
    golden_of(file);
    std::string text = read_file(file.draw());
    const std::size_t pixels = text.find("\"pixels\": ", text.find("\"disks\""));
    ASSERT_NE(pixels, std::string::npos);
    text.insert(pixels + 10, "99");
    cases.folder().write("a.draw.json", text);
    const CaseResult result = run(file);
    EXPECT_EQ(result.outcome, CaseOutcome::passed) << result.message;
    ASSERT_EQ(result.remarks.size(), 1u);
    EXPECT_NE(result.remarks[0].find("disk of A, sample 0"), std::string::npos) << result.remarks[0];
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

TEST_F(RunCaseTest, AWindowHasNoDrawList) {
    cases.folder().write("w.draw.json", "");
    const CaseResult result =
        run(cases.write("w", R"({"mobbscope_case": 1, "scene": "scene.json", "size": "640x400", "window": {}})"));
    EXPECT_EQ(result.outcome, CaseOutcome::failed);
    EXPECT_NE(result.message.find("draw list"), std::string::npos) << result.message;
    EXPECT_TRUE(result.actual.empty()) << "what failed has no picture to be taken";
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

TEST_F(RunCaseTest, ThePictureDoesNotDependOnTheCasesName) {
    const std::string own = R"({"mobbscope_case": 1, "size": "640x400", "scene": )" + std::string(kSmallScene);
    for (const char* more : {"}", R"(, "view": {"boxes": false, "hidden": ["B"]}})", R"(, "window": {}})"}) {
        const CaseResult one = run(cases.write("one", own + more)), other = run(cases.write("other.name", own + more));
        ASSERT_FALSE(one.actual.empty()) << one.message;
        EXPECT_EQ(one.actual, other.actual) << more;
    }
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
        CaseResult result = run_case(file, maker_.get(), "", {GoldenSource::here, FreshGoldens::of_all});
        EXPECT_EQ(result.outcome, CaseOutcome::missing_golden) << result.message;
        take(result);
        write_reference(cases.path(), reference_of(maker_->renderer()));
    }
    /// From now on the goldens are from where a font, or only the rasteriser, is another.
    void move_elsewhere() {
        Reference there = reference_of(maker_->renderer());
        there.fonts.begin()->second = std::string(64, '0');
        write_reference(cases.path(), there);
    }
    void change_rasteriser() {
        Reference there = reference_of(maker_->renderer());
        there.opengl = "Mesa 1.0.0, llvmpipe";
        write_reference(cases.path(), there);
    }
    /// Pixels that differ, as another rasteriser's do: a row is a little lighter.
    void lighten(const std::filesystem::path& golden) {
        Image image = read_png(golden);
        for (int x = 0; x < 12; ++x) {
            for (int c = 0; c < 3; ++c) image.at(x, 1)[c] = static_cast<std::uint8_t>(image.at(x, 1)[c] + 6);
        }
        write_png(golden, image);
    }
    /// ... or as something else does: a red block.
    void paint_over(const std::filesystem::path& golden) {
        Image image = read_png(golden);
        for (int y = 0; y < 12; ++y) {
            for (int x = 0; x < 12; ++x) image.at(x, y)[0] = 255;
        }
        write_png(golden, image);
    }
    /// One disk, and so the boxes around it, 5 cm wider.
    void widen() {
        std::string scene = mobbscope::testing::kSmallScene;
        scene.replace(scene.find("0.45]"), 4, "0.50");
        cases.folder().write("scene.json", scene);
    }
    /// Nothing is held against a golden that is no picture.
    void spoil(const std::filesystem::path& golden) { cases.folder().write(golden.filename().string(), "spoiled"); }
};

TEST_F(RunCaseWithReferenceTest, HereThePictureAndTheDrawListAreHeld) {
    const CaseFile file = cases.add("a");
    take_here(file);
    EXPECT_FALSE(std::filesystem::exists(file.plain())) << "the draw list holds the case elsewhere";
    const CaseResult both = run(file);
    EXPECT_EQ(both.outcome, CaseOutcome::passed) << both.message;
    EXPECT_EQ(both.other_here, "");
    EXPECT_EQ(both.actual, read_file(file.golden()));
    widen();
    EXPECT_EQ(run(file).findings.size(), 2u) << "of the picture, and of the draw list";
}

TEST_F(RunCaseWithReferenceTest, HereAlsoThePictureWithoutTextIfThereIsNoDrawList) {
    const CaseFile file = cases.add("a", R"("draw_list": false)");
    take_here(file);
    EXPECT_NE(read_png(file.golden()).rgba, read_png(file.plain()).rgba) << "there is text";
    EXPECT_EQ(run(file).outcome, CaseOutcome::passed);
    spoil(file.plain());
    CaseResult plain = run(file);
    EXPECT_EQ(plain.outcome, CaseOutcome::different);
    EXPECT_NE(plain.message.find("without text: the golden cannot be read"), std::string::npos) << plain.message;
    EXPECT_EQ(plain.shown, file.plain());
    EXPECT_EQ(take(plain), (std::vector{file.golden(), file.plain()}));
    EXPECT_EQ(run(file).outcome, CaseOutcome::passed);
}

TEST_F(RunCaseWithReferenceTest, ElsewherePixelsComeFirst) {
    const CaseFile file = cases.add("a");
    take_here(file);
    for (const bool other_font : {false, true}) {
        other_font ? move_elsewhere() : change_rasteriser();
        const CaseResult result = run(file);
        EXPECT_EQ(result.outcome, CaseOutcome::passed) << result.message;
        EXPECT_EQ(result.decided_by, DecidedBy::pixels);
        EXPECT_NE(result.other_here, "");
    }
    spoil(file.draw());
    EXPECT_EQ(run(file).outcome, CaseOutcome::passed) << "with other fonts words lie elsewhere";
    change_rasteriser();
    EXPECT_EQ(run(file).outcome, CaseOutcome::different) << "with the same ones they do not";
}

TEST_F(RunCaseWithReferenceTest, ElsewhereTheDrawListDecidesWherePixelsDiffer) {
    const CaseFile file = cases.add("a");
    take_here(file);
    change_rasteriser();
    lighten(file.golden());
    const CaseResult passed = run(file);
    EXPECT_EQ(passed.outcome, CaseOutcome::passed) << passed.message;
    EXPECT_EQ(passed.decided_by, DecidedBy::draw_list);
    ASSERT_EQ(passed.remarks.size(), 2u);
    EXPECT_EQ(passed.remarks[0].find("12 of 19200 pixels"), 0u) << passed.remarks[0];
    EXPECT_NE(passed.remarks[1].find("structural similarity"), std::string::npos) << passed.remarks[1];
    EXPECT_TRUE(passed.fresh.empty());

    // What is in no draw list, but hides what is.
    paint_over(file.golden());
    const CaseResult painted = run(file);
    EXPECT_EQ(painted.outcome, CaseOutcome::different);
    EXPECT_EQ(painted.message.find("the largest loss of structural similarity is "), 0u) << painted.message;
    move_elsewhere();
    EXPECT_EQ(run(file).outcome, CaseOutcome::passed) << "words of other fonts lose as much";

    widen();
    const CaseResult wrong = run(file);
    EXPECT_EQ(wrong.outcome, CaseOutcome::different);
    EXPECT_EQ(wrong.message.find("a.draw.json: "), 0u) << wrong.message;
    EXPECT_FALSE(wrong.golden.empty());
    EXPECT_FALSE(can_be_taken(wrong)) << "here it would be drawn with something else";
}

TEST(SimilarityLoss, LooksIntoTheSmallestHoleOfAMask) {
    Image white(80, 60);
    std::ranges::fill(white.rgba, std::uint8_t{255});
    Image mask(80, 60);
    for (int y = 30; y < 38; ++y) std::fill_n(mask.at(40, y), 4 * 8, std::uint8_t{255});
    for (const bool inside : {false, true}) {
        Image dot = white;
        for (int y = 32; y < 36; ++y) std::fill_n(dot.at(inside ? 42 : 20, y), 4 * 4, std::uint8_t{0});
        EXPECT_EQ(similarity_loss(dot, white, &mask) > kMostLoss, inside);
        EXPECT_GT(similarity_loss(dot, white, nullptr), kMostLoss);
    }
}

TEST_F(RunCaseWithReferenceTest, ElsewhereSimilarityDecidesWhereThereIsNoDrawList) {
    const CaseFile file = cases.add("a", R"("draw_list": false)");
    take_here(file);
    change_rasteriser();
    lighten(file.golden());
    const CaseResult passed = run(file);
    EXPECT_EQ(passed.outcome, CaseOutcome::passed) << passed.message;
    EXPECT_EQ(passed.decided_by, DecidedBy::ssim);
    ASSERT_EQ(passed.remarks.size(), 2u);
    EXPECT_NE(passed.remarks[1].find("the largest loss of structural similarity is 0.00"), std::string::npos);
    paint_over(file.golden());
    const CaseResult painted = run(file);
    EXPECT_EQ(painted.outcome, CaseOutcome::different);
    EXPECT_NE(painted.message.find("structural similarity"), std::string::npos) << painted.message;
}

TEST_F(RunCaseWithReferenceTest, WithOtherFontsThePictureWithoutTextIsLookedAt) {
    const CaseFile file = cases.add("a", R"("draw_list": false)");
    take_here(file);
    move_elsewhere();
    paint_over(file.golden());
    const CaseResult passed = run(file);
    EXPECT_EQ(passed.outcome, CaseOutcome::passed) << passed.message;
    EXPECT_EQ(passed.decided_by, DecidedBy::without_text);
    widen();
    const CaseResult wrong = run(file);
    EXPECT_EQ(wrong.outcome, CaseOutcome::different);
    EXPECT_EQ(wrong.message.find("without text: "), 0u) << wrong.message;
    std::filesystem::remove(file.plain());
    EXPECT_EQ(run(file).outcome, CaseOutcome::missing_golden);
}

TEST_F(RunCaseWithReferenceTest, ACaseThatNothingHoldsElsewhereLacksAGolden) {
    const CaseFile file = cases.add("a");
    golden_of(file);
    std::filesystem::remove(file.draw());
    write_reference(cases.path(), reference_of(maker_->renderer()));
    const CaseResult result = run(file);
    EXPECT_EQ(result.outcome, CaseOutcome::missing_golden);
    EXPECT_NE(result.message.find("a.draw.json"), std::string::npos) << result.message;
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

TEST_F(RunCaseWithReferenceTest, TakingRemovesTheGoldensThatNobodyReadsAnyMore) {
    const CaseFile file = cases.add("a");
    golden_of(file);
    write_reference(cases.path(), reference_of(maker_->renderer()));
    cases.folder().write("a.plain.png", "of an earlier version");
    cases.folder().write("a.plain.draw.json", "{}");
    CaseResult result = run_case(file, maker_.get(), "", {.fresh = FreshGoldens::of_all});
    EXPECT_EQ(take(result), (std::vector{file.golden(), file.draw()}));
    EXPECT_FALSE(std::filesystem::exists(file.plain()));
    EXPECT_FALSE(std::filesystem::exists(file.plain_draw()));
}

TEST_F(RunCaseWithReferenceTest, OfAWindowItsStateIsHeld) {
    cases.folder().write("w.script", "run query.select 0\nrun view.zoom 1.5\n");
    const CaseFile file = cases.write("w", R"({"mobbscope_case": 1, "scene": "scene.json", "size": "640x400",
        "window": {"script": "w.script"}})");
    take_here(file);
    EXPECT_EQ(read_png(file.plain()).width, 80);
    EXPECT_EQ(run(file).outcome, CaseOutcome::passed);
    move_elsewhere();
    paint_over(file.golden());
    EXPECT_EQ(run(file).outcome, CaseOutcome::passed);

    // The scene is the same, and what the inspector shows is not.
    cases.folder().write("w.script", "run query.select 0\nrun view.zoom 1.5\nclick agent.0\n");
    const CaseResult other = run(file);
    EXPECT_EQ(other.outcome, CaseOutcome::different);
    EXPECT_NE(other.message.find("w.plain.state.json: /selection"), std::string::npos) << other.message;

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
