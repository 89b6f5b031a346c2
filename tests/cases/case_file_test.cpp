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
    EXPECT_EQ(found[2].state(), cases.path() / "deep" / "c.state.json");
}

TEST(FindCases, AFolderWithoutCasesIsRefused) {
    const CaseFolder cases;
    EXPECT_PRED2(says, input_error([&] { find_cases(cases.path()); }), "holds no case");
    EXPECT_PRED2(says, input_error([&] { find_cases(cases.path() / "none"); }), "none: cannot be searched");
    EXPECT_PRED2(says, input_error([&] { find_cases(cases.path() / "scene.json"); }), "cannot be searched");
}

TEST(Hold, IsThePictureAloneUnlessTheCaseSaysMore) {
    const CaseFolder cases;
    using Hold = std::vector<Held>;
    EXPECT_EQ(read_terms(cases.add("a")).hold, Hold{Held::picture});
    const CaseTerms terms = read_terms(cases.add("a", R"("hold": ["picture", "fit", "answers"])"));
    EXPECT_EQ(terms.hold, (Hold{Held::picture, Held::fit, Held::answers}));
    EXPECT_TRUE(terms.holds(Held::fit));
    EXPECT_FALSE(terms.holds(Held::trace));
    EXPECT_EQ(case_named(cases.path(), "a").golden_of(Held::answers), cases.path() / "a.answers.json");
    const auto refused = [&](const std::string& hold) {
        return input_error([&] { read_terms(cases.add("a", R"("hold": )" + hold)); });
    };
    EXPECT_PRED2(says, refused("[]"), "nothing is held; name one or more of picture, answers, trace, fit");
    EXPECT_PRED2(says, refused(R"(["answer"])"),
                 "'answer' cannot be held; give picture, answers, trace or fit (did you mean 'answers'?)");
    EXPECT_PRED2(says, refused(R"(["fit", "fit"])"), "'fit' is given twice");
    EXPECT_PRED2(says, refused(R"("fit")"), "/hold: give an array: [\"fit\"]");
    EXPECT_PRED2(says, refused(R"(["fit"])"), "/size: the case holds no picture; remove this");
}

TEST(CaseFile, HasAGoldenOfAllThatItHolds) {
    const CaseFile file = case_named("goldens", "deep/er/a");
    EXPECT_EQ(file.golden_of(Held::picture), file.golden());
    EXPECT_EQ(file.golden_of(Held::fit), "goldens/deep/er/a.fit.json");
    EXPECT_EQ(file.folder(), "goldens");
}

TEST(OrphanedGoldens, AreOfWhatTheCaseNoLongerHolds) {
    const CaseFolder cases;
    cases.write("a", R"({"mobbscope_case": 1, "scene": "scene.json", "hold": ["answers"]})");
    for (const char* file : {"a.png", "a.answers.json"}) cases.folder().write(file, "");
    cases.folder().write("a.fit.json", "{\n  \"mobbscope_fit\": 1, \"trees\": []}");
    cases.folder().write("b.trace.json", R"({"mobbscope_trace": 1})");
    // Scenes, and what other commands write.
    cases.folder().write("c.answers.json", R"({"clips": {}})");
    cases.folder().write("c.fit.json", R"({"mobbscope_trace": 1})");
    cases.folder().write("c.trace.json", "");
    const std::filesystem::path& at = cases.path();
    EXPECT_EQ(orphaned_goldens(at, find_cases(at)),
              (std::vector{at / "a.fit.json", at / "a.png", at / "b.trace.json"}));
}

TEST(OrphanedGoldens, AreThoseThatNoCaseHas) {
    const CaseFolder cases;
    cases.add("kept", R"("mask": "mask.png")");
    cases.write("b", R"({"mobbscope_case": 1, "scene": "scene.state.json"})");
    const std::string state = "{\n  \"mobbscope_state\": 1}";
    for (const char* file : {"kept.png", "kept.state.json", "mask.png", "lost.png", "gone.state.json", "notes.txt"})
        cases.folder().write(file, state);
    cases.folder().write("scene.state.json", "{}");
    cases.folder().write("another.state.json", "{}");
    std::filesystem::create_directories(cases.path() / "deeper");
    std::filesystem::create_directories(cases.path() / "report");
    cases.folder().write("deeper/lost.png", "");
    cases.folder().write("report/report.json", "");
    cases.folder().write("report/kept.actual.png", "");
    const std::filesystem::path& at = cases.path();
    EXPECT_EQ(orphaned_goldens(at, find_cases(at)),
              (std::vector{at / "deeper/lost.png", at / "gone.state.json", at / "lost.png"}))
        << "what begins otherwise is not a golden";
}

}  // namespace
}  // namespace mobbscope::picture_tests
