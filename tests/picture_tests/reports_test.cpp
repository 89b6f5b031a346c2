#include <base/base64.h>
#include <picture_tests/reports.h>
#include <render/image/png.h>

#include "support/temp_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <sstream>

namespace mobbscope::picture_tests {
namespace {

const std::string kHostile = "<b>\"A\" & 'B'</b>\x01\x1b[31m \xff </script> \xef\xbf\xbf";

const RunFacts kFacts{"my pictures", "osmesa", "llvmpipe (LLVM 15.0.6, 256 bits)"};

Image grey(int width, int height, std::uint8_t value) {
    Image image(width, height);
    std::fill(image.rgba.begin(), image.rgba.end(), value);
    for (std::size_t i = 3; i < image.rgba.size(); i += 4) image.rgba[i] = 255;
    return image;
}

CaseResult result(const std::string& name, CaseOutcome outcome, const std::string& message = "") {
    CaseResult out;
    out.file = {name, "my pictures/" + name + ".case.json"};
    out.outcome = outcome;
    out.message = message;
    out.seconds = 0.0001;
    return out;
}

CaseResult with_pictures(CaseResult result, const Image& actual, const Image& golden, const DiffOptions& options = {}) {
    result.actual = png_bytes(actual);
    result.golden = png_bytes(golden);
    result.image = diff(actual, golden, options);
    return result;
}

CaseResult different(const std::string& name) {
    const CaseResult out = result(name, CaseOutcome::different, "50 pixels differ");
    const Image golden = grey(40, 20, 100);
    Image actual = golden;
    for (int x = 5; x < 15; ++x) {
        for (int y = 4; y < 9; ++y) actual.at(x, y)[1] = 200;
    }
    return with_pictures(out, actual, golden);
}

CaseResult passed(const std::string& name) {
    return with_pictures(result(name, CaseOutcome::passed), grey(8, 8, 30), grey(8, 8, 30));
}

CaseResult missing(const std::string& name) {
    CaseResult out = result(name, CaseOutcome::missing_golden, "there is no golden");
    out.actual = png_bytes(grey(8, 8, 30));
    return out;
}

/// One of each outcome, in another order than reports have them.
std::vector<CaseResult> one_of_each() {
    return {passed("fine"), result("skip", CaseOutcome::skipped, "not yet"), missing("levels/new one"),
            different("moved"), result(kHostile, CaseOutcome::failed, "scene.json: line 3: " + kHostile)};
}

using Writer = void (*)(std::ostream&, const RunFacts&, std::span<const CaseResult>);

std::string written(Writer writer, const std::vector<CaseResult>& results, const RunFacts& facts = kFacts) {
    std::ostringstream out;
    writer(out, facts, results);
    return out.str();
}

/// What tests/picture_tests/parse_report.py makes of a report: it fails for what is malformed.
std::string parsed(const std::string& report, const std::string& kind) {
    const testing::TempFolder folder;
    const auto file = folder.write("report", report);
    const std::string command = "python3 '" MOBBSCOPE_SOURCE_DIR "/tests/picture_tests/parse_report.py' " + kind +
                                " '" + file.string() + "' 2>&1";
    std::FILE* pipe = ::popen(command.c_str(), "r");
    std::string out;
    for (int c; (c = std::fgetc(pipe)) != EOF;) out += static_cast<char>(c);
    EXPECT_EQ(::pclose(pipe), 0) << out;
    return out;
}

std::size_t times(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
}

TEST(Markup, Base64IsTheStandards) {
    EXPECT_EQ(base64(""), "");
    EXPECT_EQ(base64("f"), "Zg==");
    EXPECT_EQ(base64("fo"), "Zm8=");
    EXPECT_EQ(base64("foo"), "Zm9v");
    EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
    EXPECT_EQ(base64("\xfb\xff\xfe"), "+//+");
}

TEST(Reports, TextHasALineForEachThatDidNotPass) {
    const std::string text = written(write_text, {passed("fine"), result("skip", CaseOutcome::skipped, "not yet"),
                                                  missing("levels/new one"), different("moved")});
    EXPECT_EQ(text,
              "skipped: skip: not yet\n"
              "missing golden: levels/new one: there is no golden\n"
              "different: moved: 50 pixels differ\n"
              "my pictures: 1 passed, 1 different, 1 without a golden, 1 skipped; drawn by osmesa, llvmpipe (LLVM "
              "15.0.6, 256 bits)\n"
              "Look at the pictures. Those that are right become goldens with\n"
              "  mobbscope test 'my pictures' --update 'levels/new one' moved\n");
    CaseResult lacking = result("a", CaseOutcome::skipped, "no OpenGL");
    lacking.not_drawn = "no OpenGL";
    EXPECT_EQ(written(write_text, {lacking}, {"d", "", ""}),
              "skipped: a: no OpenGL\nd: 1 skipped; drawn by nothing: there is no OpenGL\n");
    EXPECT_EQ(written(write_text, {result("a", CaseOutcome::failed, "crashed")}, {"d", "", ""}),
              "failed: a: crashed\nd: 1 failed; drawn by nothing\n");
}

TEST(Reports, WhatDiffersIsSaidOnceTheMostImportantFirst) {
    CaseResult numbers = result("numbers", CaseOutcome::different, "as long as all findings together");
    numbers.drawn_by.backend = kDrawsNothing;
    numbers.findings = {{{}, "", {"s.json: query 0: expected no collision", "correct it"}},
                        {numbers.file.golden_of(Held::fit), "numbers.fit.json: a; and 1 more", {"a", "b"}},
                        {numbers.file.golden_of(Held::answers), "there is no golden", {}}};
    EXPECT_TRUE(written(write_text, {numbers}, {"d", "", ""})
                    .starts_with("different: numbers: s.json: query 0: expected no collision\n"
                                 "  correct it\n"
                                 "  numbers.fit.json: a\n"
                                 "  numbers.fit.json: b\n"
                                 "  there is no golden\n"
                                 "d: 1 different\n"));
    const auto json = nlohmann::json::parse(written(write_json, {numbers}, {"d", "", ""}));
    EXPECT_EQ(json["backend"], "none");
    EXPECT_TRUE(json["cases"][0]["tolerance"].is_null());
}

TEST(Reports, TextHoldsNoControlCharacters) {
    EXPECT_EQ(written(write_text, one_of_each()).find('\x1b'), std::string::npos);
}

TEST(Reports, JsonHasEveryCaseInOrder) {
    const auto json = nlohmann::json::parse(written(write_json, one_of_each()));
    EXPECT_EQ(json["folder"], "my pictures");
    EXPECT_EQ(json["backend"], "osmesa");
    EXPECT_EQ(json["summary"],
              (nlohmann::json{{"passed", 1}, {"different", 1}, {"missing", 1}, {"failed", 1}, {"skipped", 1}}));
    ASSERT_EQ(json["cases"].size(), 5u);
    const auto& moved = json["cases"][3];
    EXPECT_EQ(moved["name"], "moved");
    EXPECT_EQ(moved["outcome"], "different");
    EXPECT_EQ(moved["tolerance"], "tight");
    EXPECT_EQ(moved["diff"]["failing"], 50);
    EXPECT_EQ(moved["diff"]["maximum"], 100);
    EXPECT_EQ(moved["diff"]["bounds"], (nlohmann::json{{"x", 5}, {"y", 4}, {"width", 10}, {"height", 5}}));
    EXPECT_EQ(moved["diff"]["histogram"].size(), 256u);
    EXPECT_EQ(moved["diff"]["histogram"][100], 50);
    EXPECT_TRUE(json["cases"][2]["diff"].is_null());
}

TEST(Reports, JUnitTellsFailuresFromErrors) {
    EXPECT_EQ(parsed(written(write_junit, one_of_each()), "junit"),
              "suite my pictures: tests 5, failures 2, errors 1, skipped 1\n"
              "fine: passed\n"
              "skip: skipped: not yet\n"
              "levels/new one: failure (missing golden): there is no golden\n"
              "moved: failure (different): 50 pixels differ\n"
              "<b>\"A\" & 'B'</b>\\u0001\\u001b[31m ? </script> ???: error (failed): scene.json: line 3: <b>\"A\" & "
              "'B'</b>\\u0001\\u001b[31m ? </script> ???\n");
}

TEST(Reports, JUnitOfNoCasesIsWellFormed) {
    EXPECT_EQ(parsed(written(write_junit, {}), "junit"),
              "suite my pictures: tests 0, failures 0, errors 0, skipped 0\n");
}

TEST(Reports, ThePageIsWellFormedAndNeedsNothingElse) {
    EXPECT_EQ(parsed(written(write_html, one_of_each()), "html"),
              "title 3 of 5 picture tests did not pass - my pictures\n"
              "case ✕ failed <b>\"A\" & 'B'</b>\\u0001\\u001b[31m ? </script> ???: \n"
              "case ≠ different moved: golden 40x20, actual 40x20, difference 40x20\n"
              "case ∅ no golden levels/new one: actual 8x8\n"
              "folded – skipped 1: \n"
              "folded ✓ passed 1: 8x8\n"
              "command mobbscope test 'my pictures' --update moved 'levels/new one'\n"
              "command mobbscope test 'my pictures' --update moved\n"
              "command mobbscope test 'my pictures' --update 'levels/new one'\n");
}

TEST(Reports, ThePageOfARunThatPassedSaysSo) {
    const std::string page = written(write_html, {passed("a"), passed("b")});
    EXPECT_EQ(parsed(page, "html"),
              "title 2 picture tests passed - my pictures\n"
              "folded ✓ passed 2: 8x8, 8x8\n");
    EXPECT_EQ(times(page, "--update"), 0u);
}

TEST(Reports, ThePageShowsTheNumbersOfADifference) {
    const std::string page = written(write_html, {different("moved")});
    EXPECT_EQ(times(page, "50 of 800, 6.25 %"), 1u);
    EXPECT_EQ(times(page, "100 of 255"), 1u);
    EXPECT_EQ(times(page, "10 x 5 pixels at (5, 4)"), 1u);
    EXPECT_EQ(times(page, "<rect x=\"5\" y=\"4\" width=\"10\" height=\"5\"/>"), 1u);
    EXPECT_EQ(times(page, "<th scope=\"row\">65–128</th>"), 1u);
    EXPECT_EQ(times(page, "<tr class=\"beyond\">"), 6u);
}

TEST(Reports, ThePageSaysWhichMeanDiffers) {
    const CaseResult lighter = with_pictures(result("a", CaseOutcome::different), grey(64, 64, 102), grey(64, 64, 100));
    const std::string page = written(write_html, {lighter, different("moved")});
    EXPECT_EQ(times(page, "<dt>Mean of a tile</dt><dd>up to 2, allowed 0.3 of 255</dd>"), 1u);
    EXPECT_EQ(times(page, "32 x 32 pixels at (0, 0)"), 1u);
    EXPECT_GE(times(page, "the mean of a tile by 2 of 255"), 1u);
}

TEST(Reports, ThePageHasAPartForEachGoldenWithWhatItIsAboutInBold) {
    CaseResult moved = different("moved");
    moved.findings = {{"moved.png", "50 pixels <differ>", {}},
                      {"moved.state.json",
                       "moved.state.json: and 3 more",
                       {"A moved by (1, 0)", "sentence 'A's box: near' was 'B's box'", "boxes of A: other colours",
                        "<nothing> in particular"}},
                      {"moved.trace.json", "moved.trace.json: it is empty", {}},
                      {"moved.new.json", "unheard of", {}}};
    const std::string page = written(write_html, {moved});
    EXPECT_EQ(times(page,
                    "<h3>Picture <small>moved.png</small></h3>\n<p class=\"message\">50 pixels &lt;differ&gt;</p>\n"
                    "<h3>What is drawn <small>moved.state.json</small></h3>\n<ul>\n"
                    "<li><strong>A</strong> moved by (1, 0)</li>\n"
                    "<li><strong>sentence &#39;A&#39;s box: near&#39;</strong> was &#39;B&#39;s box&#39;</li>\n"
                    "<li><strong>boxes of A</strong>: other colours</li>\n"
                    "<li>&lt;nothing&gt; in particular</li>\n</ul>\n"
                    "<h3>Trace <small>moved.trace.json</small></h3>\n"
                    "<p class=\"message\">moved.trace.json: it is empty</p>\n"
                    "<h3>Golden <small>moved.new.json</small></h3>\n"),
              1u)
        << page.substr(page.find("<h3>"), 1500);
    EXPECT_EQ(times(page, "<p class=\"message\">50 pixels differ"), 0u) << "the message repeats what is found";
}

TEST(Reports, ThePageHasEachNameAsAShellTakesItAndWhatStandsAroundNames) {
    RunFacts facts = kFacts;
    facts.page = "it's.html";
    const std::string page =
        written(write_html, {different("it's"), missing("plain"), result("x", CaseOutcome::failed)}, facts);
    EXPECT_EQ(times(page, "data-word=\"&#39;it&#39;\\&#39;&#39;s&#39;\""), 1u);
    EXPECT_EQ(times(page, "data-word=\"plain\""), 1u);
    EXPECT_EQ(times(page, "data-word="), 2u) << "what failed cannot be taken";
    EXPECT_EQ(times(page,
                    "data-before=\"mobbscope test &#39;my pictures&#39;\" data-after=\" --accept "
                    "&#39;it&#39;\\&#39;&#39;s.html&#39;\""),
              1u);
    parsed(page, "html");
}

TEST(Reports, ThePageHasCasesWithoutPicturesToo) {
    CaseResult answers = result("answers", CaseOutcome::different, "answers.answers.json: query 0 collides");
    answers.findings = {{"answers.answers.json", answers.message, {"query 0: collides instead of not"}}};
    const std::string page = written(write_html, {answers, result("also", CaseOutcome::passed)});
    EXPECT_EQ(parsed(page, "html"),
              "title 1 of 2 picture tests did not pass - my pictures\n"
              "case ≠ different answers: \n"
              "folded ✓ passed 1: \n"
              "command mobbscope test 'my pictures' --update answers\n");
    EXPECT_EQ(times(page, "<li><strong>query 0</strong>: collides instead of not</li>"), 1u);
    EXPECT_EQ(times(page, "data-word=\"answers\""), 1u);
}

TEST(Reports, PicturesThatAreTheSameAreShownOnce) {
    CaseResult renamed =
        with_pictures(result("renamed", CaseOutcome::different, "a name"), grey(8, 8, 30), grey(8, 8, 30));
    renamed.findings = {{"renamed.state.json", "a name", {"A is missing"}}};
    const std::string page = written(write_html, {renamed});
    EXPECT_EQ(parsed(page, "html"),
              "title 1 of 1 picture test did not pass - my pictures\n"
              "case ≠ different renamed: actual 8x8\n"
              "command mobbscope test 'my pictures' --update renamed\n");
    EXPECT_EQ(times(page, "<figcaption>Golden and actual: the same pixels"), 1u);
}

TEST(Reports, PicturesOfTwoSizesAreComparedByEye) {
    const CaseResult sizes =
        with_pictures(result("sizes", CaseOutcome::different, "the picture is 8x8, the golden 40x20"), grey(8, 8, 30),
                      grey(40, 20, 100));
    EXPECT_EQ(parsed(written(write_html, {sizes}), "html"),
              "title 1 of 1 picture test did not pass - my pictures\n"
              "case ≠ different sizes: golden 40x20, actual 8x8\n"
              "command mobbscope test 'my pictures' --update sizes\n");
}

TEST(Reports, APassWithPixelsThatDifferIsSaidAndCanBeSorted) {
    Image golden = grey(8, 8, 30);
    golden.at(2, 3)[0] = 200;
    CaseResult some = with_pictures(passed("some"), grey(8, 8, 30), golden, {.pixel_fraction = 0});
    some.remarks = {what_differs(*some.image)};
    const std::vector<CaseResult> results{passed("none"), some};
    EXPECT_EQ(written(write_text, results),
              "passed: some: 1 of 64 pixels (1.6 %) differs by more than 3/255, up to 170/255, within 1x1 at (2, 3); "
              "allowed: 4\n"
              "my pictures: 2 passed; drawn by osmesa, llvmpipe (LLVM 15.0.6, 256 bits)\n"
              "1 of those that passed differs from the golden in some pixels, by up to 170 of 255\n");
    const auto json = nlohmann::json::parse(written(write_json, results));
    EXPECT_EQ(json["cases"][1]["remarks"].size(), 1u);
    EXPECT_EQ(json["cases"][1]["diff"]["same"], false);
    EXPECT_EQ(json["cases"][1]["diff"]["passes"], true);
    const std::string page = written(write_html, results);
    EXPECT_EQ(times(page, "data-name=\"some\" data-outcome=\"passed\" data-pixels=\"1\" data-largest=\"170\""), 1u);
    EXPECT_EQ(times(page, "1 pixel, up to 170 of 255"), 1u);
    EXPECT_EQ(times(written(write_junit, results), "<system-out>1 of 64 pixels"), 1u);
    parsed(page, "html");
    parsed(written(write_junit, results), "junit");
}

TEST(Reports, OrphansAreToldAndFailAStrictRun) {
    RunFacts facts = kFacts;
    facts.orphans = {"my pictures/lost.png"};
    const std::vector<CaseResult> results{passed("a")};
    EXPECT_EQ(times(written(write_text, results, facts), "orphaned golden: my pictures/lost.png: no case has it"), 1u);
    EXPECT_TRUE(is_ok(facts, results));
    EXPECT_EQ(times(written(write_junit, results, facts), "<failure"), 0u);
    facts.strict = true;
    EXPECT_FALSE(is_ok(facts, results));
    const std::string junit = written(write_junit, results, facts);
    EXPECT_EQ(times(junit, "tests=\"2\" failures=\"1\""), 2u);
    parsed(junit, "junit");
    EXPECT_EQ(times(written(write_html, results, facts), "<h1>1 golden has no case</h1>"), 1u);
}

TEST(Reports, AShardSaysSo) {
    RunFacts facts = kFacts;
    facts.shard = "2/3";
    EXPECT_EQ(times(written(write_text, {passed("a")}, facts), "my pictures, shard 2/3: 1 passed"), 1u);
    EXPECT_EQ(nlohmann::json::parse(written(write_json, {passed("a")}, facts))["shard"], "2/3");
    EXPECT_EQ(times(written(write_junit, {passed("a")}, facts), "<property name=\"shard\" value=\"2/3\"/>"), 1u);
    EXPECT_EQ(times(written(write_html, {passed("a")}, facts), "<dt>Shard</dt><dd>2/3</dd>"), 1u);
    for (const Writer writer : {write_text, write_json, write_junit, write_html}) {
        EXPECT_EQ(times(written(writer, {passed("a")}), "shard"), 0u);
    }
}

TEST(Reports, AreTheSameEveryTime) {
    for (const Writer writer : {write_text, write_json, write_junit, write_html}) {
        EXPECT_EQ(written(writer, one_of_each()), written(writer, one_of_each()));
    }
    // The page does not even say how long it took.
    std::vector<CaseResult> slower = one_of_each();
    for (CaseResult& result : slower) result.seconds = 7;
    EXPECT_EQ(written(write_html, slower), written(write_html, one_of_each()));
}

}  // namespace
}  // namespace mobbscope::picture_tests
