// Cases that see hardly anything, and what is said of a case file that a report brings.
#include <cases/weak_cases.h>
#include <render/image/png.h>
#include <support/input_error.h>

#include "cases/case_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace mobbscope::picture_tests {
namespace {

std::vector<std::string> weaknesses_of(const CaseFile& file) { return weaknesses(file, read_terms(file)); }

/// A picture whose first pixels are white, the others black.
Image white_pixels(int count) {
    Image out(100, 100);
    for (int i = 0; i < 10'000; ++i) {
        std::uint8_t* const pixel = out.at(i % 100, i / 100);
        std::fill(pixel, pixel + 3, i < count ? std::uint8_t{255} : std::uint8_t{0});
        pixel[3] = 255;
    }
    return out;
}

TEST(WeakCases, AreThoseThatSeeHardlyAnything) {
    const CaseFolder cases;
    const std::pair<const char*, const char*> weak[] = {
        {R"("allowed": "100%")", R"("allowed" lets 100 % of its pixels differ)"},
        {R"("allowed": "0.5")", R"("allowed" lets 50 % of its pixels differ)"},
        {R"("allowed": "9999px")", R"("allowed" lets 100 % of its pixels differ)"},
        {R"("allowed": "2000px")", R"("allowed" lets 20 % of its pixels differ)"},
        {R"("threshold": 255)", R"("threshold" lets a channel be off by 255 of 255)"},
        {R"("threshold": "40%")", R"("threshold" lets a channel be off by 102 of 255)"},
        {R"("mask": "small.png")", R"("mask" leaves 0.2 % of its pixels)"},
        {R"("mask": "wide.png", "allowed": "80px")", R"("allowed" lets 16 % of its pixels differ)"},
        {R"("skip": "never")", "it is skipped: never"},
    };
    write_png(cases.path() / "a.png", Image(100, 100));
    write_png(cases.path() / "small.png", white_pixels(20));
    write_png(cases.path() / "wide.png", white_pixels(500));
    for (const auto& [key, says] : weak) {
        const std::vector<std::string> found = weaknesses_of(cases.add("a", key));
        EXPECT_EQ(found, std::vector<std::string>{says}) << key;
    }
    for (const char* key : {R"("time_limit": 5)", R"("tolerance": "loose")", R"("allowed": "100px")",
                            R"("threshold": 8)", R"("mask": "wide.png")", R"("state": false)", R"("mask": "none.png")"})
        EXPECT_EQ(weaknesses_of(cases.add("a", key)), std::vector<std::string>{}) << key;
}

/// A result that brings the case with these keys in place of those that it has.
CaseResult bringing(const CaseFile& file, const std::string& keys) {
    CaseResult out;
    out.file = file;
    out.fresh = {{file.file, R"({"mobbscope_case": 1, "scene": "scene.json", )" + keys + "}", golden_bytes(file.file)}};
    return out;
}

TEST(WeakCases, ACaseThatAReportBringsIsSaidToBeOne) {
    const CaseFolder cases;
    const CaseFile file = cases.write(
        "a", R"({"mobbscope_case": 1, "scene": "scene.json", "hold": ["picture", "answers"], "threshold": 4})");
    const auto words = [&](const std::string& keys) {
        const std::vector<std::string> lines = words_on_brought_case(bringing(file, keys));
        EXPECT_NE(lines.front().find("a.case.json is the case itself, no golden: "), std::string::npos);
        std::string out;
        for (const std::string& line : lines) out += line + '\n';
        return out;
    };
    const std::string same = R"("hold": ["picture", "answers"], "threshold": 4)";
    const std::pair<std::string, const char*> weaker[] = {
        {same + R"(, "skip": "never")", R"(other "skip")"},
        {same + R"(, "skip": "never")", "a.case.json is weaker: it is skipped: never"},
        {R"("hold": ["picture", "answers"], "threshold": 40)", "weaker: \"threshold\" grows from 4 to 40"},
        {same + R"(, "allowed": "12%")", "weaker: the share of pixels in \"allowed\" grows from 2e-05 to 0.12"},
        {same + R"(, "allowed": "500px")", "weaker: the number of pixels in \"allowed\" grows from 4 to 500"},
        {same + R"(, "mask": "m.png")", "weaker: only what the mask 'm.png' leaves is compared"},
        {same + R"(, "state": false)", "weaker: \"state\" is held no longer"},
        {R"("hold": ["answers"])", "weaker: it no longer holds \"picture\""},
        {R"("hold": ["picture"], "threshold": 4)", "weaker: it no longer holds \"answers\""},
        {R"("hold": ["picture", "answers"], "tolerance": "loose", "threshold": 4)",
         "weaker: how far aside a pixel may lie grows from 0 to 1"},
    };
    for (const auto& [keys, says] : weaker) EXPECT_NE(words(keys).find(says), std::string::npos) << words(keys);
    EXPECT_EQ(words(same + R"(, "time_limit": 5)").find("weaker"), std::string::npos);
    EXPECT_NE(words(R"("hold": ["picture", "answers"], "threshold": 3)").find("other \"threshold\"\n"),
              std::string::npos);

    CaseResult bare;
    bare.file = file;
    EXPECT_FALSE(brings_case(bare));
    EXPECT_TRUE(brings_case(bringing(file, R"("skip": "never")")));
    CaseResult known = bringing(file, same);
    known.fresh[0].bytes = golden_bytes(file.file);
    EXPECT_FALSE(brings_case(known)) << "it is there already";
    const CaseFile added = case_named(cases.path(), "new");
    EXPECT_NE(words_on_brought_case(bringing(added, R"("allowed": "100%")"))[1].find("lets 100 %"), std::string::npos);
    CaseResult gone = known;
    gone.fresh[0].bytes.reset();
    EXPECT_NE(input_error([&] { words_on_brought_case(gone); }).find("would remove the case itself"),
              std::string::npos);
    EXPECT_NE(input_error([&] { words_on_brought_case(bringing(file, R"("hold": [])")); }).find("nothing is held"),
              std::string::npos);
}

}  // namespace
}  // namespace mobbscope::picture_tests
