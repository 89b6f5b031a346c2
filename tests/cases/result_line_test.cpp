// Results as lines for other programs, and goldens that are written together.
#include <cases/golden_change.h>
#include <cases/result_line.h>
#include <render/image/png.h>
#include <support/input_error.h>

#include "cases/case_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

namespace mobbscope::picture_tests {
namespace {

TEST(ResultLine, IsReadAsItIsWritten) {
    const CaseFolder cases;
    const CaseFile file = cases.add("a");
    CaseResult result;
    result.file = file;
    result.outcome = CaseOutcome::different;
    result.message = "two\tthings";
    result.tolerance = Tolerance::loose;
    result.seconds = 1.5;
    Image actual(2, 1);
    actual.at(1, 0)[3] = 200;
    result.actual = png_bytes(actual);
    result.golden = png_bytes(Image(2, 1));
    result.image = diff(actual, Image(2, 1));
    result.image->tile_mean = 0.5;
    result.image->tile = PixelRect{0, 0, 2, 1};
    result.drawn_by = {"osmesa", "llvmpipe (LLVM 15.0.6, 256 bits)"};
    result.findings = {{file.golden(), "pixels", {}}, {file.state(), "numbers", {"box of A", "and 1 more"}}};
    result.fresh = {{file.golden(), "new", "old"}, {file.state(), "{}", {}}};
    std::ostringstream line;
    write_result_line(line, result);
    ASSERT_EQ(line.str().find('\n'), line.str().size() - 1) << "one line";

    const CaseResult read = read_result_line(line.str(), {file});
    EXPECT_EQ(read.file.name, "a");
    EXPECT_EQ(read.file.file, file.file);
    EXPECT_EQ(read.outcome, CaseOutcome::different);
    EXPECT_EQ(read.message, result.message);
    EXPECT_EQ(read.seconds, 1.5);
    EXPECT_EQ(read.tolerance, Tolerance::loose);
    EXPECT_EQ(read.drawn_by.backend, "osmesa");
    EXPECT_EQ(read.drawn_by.renderer, result.drawn_by.renderer);
    EXPECT_EQ(read.actual, result.actual);
    EXPECT_EQ(read.golden, result.golden);
    ASSERT_TRUE(read.image);
    std::ostringstream before, after;
    JsonWriter written(before), written_again(after);
    write_diff(written, *result.image);
    write_diff(written_again, *read.image);
    EXPECT_EQ(after.str(), before.str()) << "all that reports tell of the pixels";
    ASSERT_EQ(read.findings.size(), 2u);
    EXPECT_EQ(read.findings[1].golden, file.state());
    EXPECT_EQ(read.findings[1].words, result.findings[1].words);
    ASSERT_EQ(read.fresh.size(), 2u);
    EXPECT_EQ(read.fresh[0].file, file.golden());
    EXPECT_EQ(read.fresh[0].bytes, "new");
    EXPECT_EQ(read.fresh[0].replaces, "old");
    EXPECT_FALSE(read.fresh[1].replaces);
    EXPECT_NE(input_error([&] { read_result_line("{}", {file}); }), "");
    std::string half = line.str();
    half.replace(half.find("\"pixels\": 2"), 11, "\"pixels\": 2.5");
    EXPECT_NE(input_error([&] { read_result_line(half, {file}); }).find("/diff/pixels: 2.5 is out of range"),
              std::string::npos);
    EXPECT_NE(input_error([&] { read_result_line(line.str(), {}); }), "");
}

/// As a report from elsewhere could have it.
std::string line_with(const CaseFile& file, const std::string& golden, const std::string& other, const char* bytes) {
    std::ostringstream line;
    CaseResult result;
    result.file = file;
    result.outcome = CaseOutcome::different;
    result.fresh = {{file.beside(golden), bytes, {}}, {file.beside(other), "{}", {}}};
    write_result_line(line, result);
    return line.str();
}

TEST(ResultLine, NamesNoFileButGoldensOfItsCase) {
    const CaseFolder cases;
    const CaseFile file = cases.add("a");
    for (const char* golden : {".png", ".answers.json", ".case.json"}) {
        EXPECT_EQ(read_result_line(line_with(file, golden, ".state.json", "new"), {file}).fresh[0].file,
                  file.beside(golden));
    }
    for (const char* other : {".script", ".sh", ".PNG", "b.png", ""}) {
        EXPECT_NE(input_error([&] {
                      read_result_line(line_with(file, other, ".png", "new"), {file});
                  }).find("is not a golden of a case"),
                  std::string::npos)
            << other;
    }
    std::string line = line_with(file, ".png", ".state.json", "new");
    const std::string there = R"("golden": ".png")";
    ASSERT_NE(line.find(there), std::string::npos);
    line.replace(line.find(there), there.size(), R"("golden": "/../../b.png")");
    EXPECT_NE(input_error([&] { read_result_line(line, {file}); }).find("'/../../b.png' is not a golden of a case"),
              std::string::npos);
    EXPECT_NE(input_error([&] { read_result_line(line_with(file, ".png", ".png", "new"), {file}); }).find("twice"),
              std::string::npos);
}

TEST(RequestLine, IsReadAsItIsWritten) {
    for (const FreshGoldens fresh : {FreshGoldens::of_failed, FreshGoldens::missing, FreshGoldens::of_all}) {
        const std::string line = request_line({"two\nlines", {fresh}});
        EXPECT_EQ(line.find('\n'), line.size() - 1) << "one line";
        const CaseRequest read = read_request_line(line);
        EXPECT_EQ(read.name, "two\nlines");
        EXPECT_EQ(read.options.fresh, fresh);
    }
    const CaseRequest asked = read_request_line(request_line({"a", {.asked = "{\n}"}}));
    EXPECT_EQ(asked.options.asked, "{\n}");
    EXPECT_NE(input_error([] { read_request_line(R"({"name": "a"})"); }), "");
    EXPECT_NE(input_error([] { read_request_line(R"({"name": "a", "fresh": "x"})"); }), "");
}

TEST(ResultLine, HasItsMaskRelativeToTheCase) {
    const CaseFolder there, here;
    CaseResult result;
    result.file = there.add("sub/a");
    result.mask = there.path() / "sub/masks/a.png";
    std::ostringstream line;
    write_result_line(line, result);
    EXPECT_EQ(read_result_line(line.str(), {here.add("sub/a")}).mask, here.path() / "sub/masks/a.png");
}

TEST(GoldenChange, IsTakenBackToTheByteAndRefusedWhereAnotherWas) {
    const CaseFolder cases;
    const CaseFile file = cases.add("a");
    const std::vector<GoldenChange> changes{{file.golden(), "new", {}}};
    write_goldens(changes);
    EXPECT_EQ(slurp(file.golden()), "new");
    EXPECT_NE(input_error([&] { write_goldens(changes); }).find("has changed on the disk"), std::string::npos);
    write_goldens(taken_back(changes));
    EXPECT_FALSE(std::filesystem::exists(file.golden()));
}

TEST(GoldenChange, IsRefusedThroughALinkOutOfTheFolder) {
    const CaseFolder cases;
    const TempFolder elsewhere;
    const auto victim = elsewhere.write("victim.txt", "precious");
    const CaseFile a = cases.add("a"), b = cases.add("b");
    std::filesystem::create_symlink(victim, b.golden());
    const std::vector<GoldenChange> changes{{a.golden(), "new", {}}, {b.golden(), "new", "precious"}};
    EXPECT_NE(input_error([&] { write_goldens(changes); }).find("b.png: is a link that leads out of its folder"),
              std::string::npos);
    EXPECT_EQ(slurp(victim), "precious");
    EXPECT_FALSE(std::filesystem::exists(a.golden()));
}

}  // namespace
}  // namespace mobbscope::picture_tests
