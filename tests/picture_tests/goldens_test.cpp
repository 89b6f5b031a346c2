// What a run leaves on the disk.
#include <picture_tests/run_cases.h>
#include <render/image/png.h>

#include "cases/case_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace mobbscope::picture_tests {
namespace {

Image filled(std::uint8_t grey) {
    Image image(8, 4);
    for (std::uint8_t& byte : image.rgba) byte = grey;
    return image;
}

/// As run_case makes it.
CaseResult result_of(const CaseFile& file, CaseOutcome outcome, const Image& actual, const Image& golden) {
    CaseResult result;
    result.file = file;
    result.outcome = outcome;
    result.message = "why";
    if (!actual.rgba.empty()) result.actual = png_bytes(actual);
    if (!golden.rgba.empty()) result.golden = png_bytes(golden);
    if (!golden.rgba.empty()) result.image = diff(actual, golden);
    return result;
}

TEST(KeepPictures, WritesWhatThereIsIntoAFolderThatItMakes) {
    const CaseFolder cases;
    const std::filesystem::path folder = cases.path() / "out";
    const CaseFile file{"deep/a", cases.path() / "deep" / "a.case.json"};
    const std::vector<std::filesystem::path> all =
        keep_pictures(result_of(file, CaseOutcome::different, filled(200), filled(10)), folder);
    const std::filesystem::path deep = folder / "deep";
    EXPECT_EQ(all,
              (std::vector<std::filesystem::path>{deep / "a.actual.png", deep / "a.golden.png", deep / "a.heat.png"}));

    const std::vector<std::filesystem::path> one =
        keep_pictures(result_of(file, CaseOutcome::missing_golden, filled(200), {}), folder);
    EXPECT_EQ(one, std::vector<std::filesystem::path>{deep / "a.actual.png"});
    EXPECT_FALSE(std::filesystem::exists(all[1])) << "of an earlier run";
    EXPECT_FALSE(std::filesystem::exists(all[2])) << "of an earlier run";

    keep_pictures(result_of(file, CaseOutcome::different, filled(200), filled(10)), folder);
    EXPECT_EQ(read_png(all[0]).rgba, filled(200).rgba);
    EXPECT_EQ(read_png(all[1]).rgba, filled(10).rgba);
}

TEST(Take, MakesTheGoldensWhatIsFresh) {
    const CaseFolder cases;
    const CaseFile file = cases.add("a");
    CaseResult result = result_of(file, CaseOutcome::different, filled(200), filled(10));
    result.fresh = {{file.golden(), png_bytes(filled(200))}, {file.state(), "{}"}};
    ASSERT_TRUE(can_be_taken(result));
    EXPECT_EQ(take(result), (std::vector<std::filesystem::path>{file.golden(), file.state()}));
    EXPECT_EQ(read_png(file.golden()).rgba, filled(200).rgba);
    EXPECT_EQ(slurp(file.state()), "{}");
    EXPECT_EQ(result.outcome, CaseOutcome::passed);
    EXPECT_EQ(result.message, "");
    EXPECT_TRUE(take(result).empty()) << "it is taken";
}

TEST(Take, OnlyWhatIsThereAndDiffers) {
    const CaseFolder cases;
    const CaseFile file = cases.add("a");
    EXPECT_TRUE(can_be_taken(result_of(file, CaseOutcome::different, filled(200), filled(10))));
    EXPECT_FALSE(can_be_taken(result_of(file, CaseOutcome::passed, filled(200), filled(200))));
    EXPECT_FALSE(can_be_taken(result_of(file, CaseOutcome::failed, {}, {})));
    EXPECT_FALSE(can_be_taken(result_of(file, CaseOutcome::skipped, {}, {})));
}

}  // namespace
}  // namespace mobbscope::picture_tests
