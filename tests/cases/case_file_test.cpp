// Cases found in a folder, and goldens that none has.
#include <cases/case_file.h>
#include <support/input_error.h>

#include "cases/case_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace mobbscope::picture_tests {
namespace {

using mobbscope::testing::CaseFolder;
using mobbscope::testing::input_error;
using mobbscope::testing::says;

TEST(FindCases, AreAllOfTheFolderAndThoseInItByName) {
    const CaseFolder cases;
    cases.add("b");
    cases.add("a");
    std::filesystem::create_directory(cases.path() / "deep");
    cases.add("deep/c");
    cases.folder().write(".case.json", "{}");
    const std::vector<CaseFile> found = find_cases(cases.path());
    ASSERT_EQ(found.size(), 3u);
    EXPECT_EQ(found[0].name, "a");
    EXPECT_EQ(found[1].name, "b");
    EXPECT_EQ(found[2].name, "deep/c");
    EXPECT_EQ(found[2].golden(), cases.path() / "deep" / "c.png");
    EXPECT_EQ(found[2].draw(), cases.path() / "deep" / "c.draw.json");
}

TEST(FindCases, AFolderWithoutCasesIsRefused) {
    const CaseFolder cases;
    EXPECT_PRED2(says, input_error([&] { find_cases(cases.path()); }), "holds no case");
    EXPECT_PRED2(says, input_error([&] { find_cases(cases.path() / "none"); }), "none: cannot be searched");
    EXPECT_PRED2(says, input_error([&] { find_cases(cases.path() / "scene.json"); }), "cannot be searched");
}

TEST(OrphanedGoldens, AreThoseThatNoCaseHas) {
    const CaseFolder cases;
    cases.add("kept", R"("mask": "mask.png")");
    for (const char* file : {"kept.png", "kept.draw.json", "kept.plain.png", "mask.png", "lost.png", "gone.draw.json",
                             "gone.plain.state.json", "notes.txt"}) {
        cases.folder().write(file, "");
    }
    std::filesystem::create_directories(cases.path() / "deeper");
    std::filesystem::create_directories(cases.path() / "report");
    cases.folder().write("deeper/lost.plain.png", "");
    cases.folder().write("report/report.json", "");
    cases.folder().write("report/kept.actual.png", "");
    const std::filesystem::path& at = cases.path();
    EXPECT_EQ(orphaned_goldens(at, find_cases(at)), (std::vector{at / "deeper/lost.plain.png", at / "gone.draw.json",
                                                                 at / "gone.plain.state.json", at / "lost.png"}));
}

}  // namespace
}  // namespace mobbscope::picture_tests
