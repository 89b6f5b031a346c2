// Real and deliberately broken files of the shared data set, where it is.
#include <base/error.h>
#include <import/import.h>
#include <support/folders.h>

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <set>

namespace mobbscope {
namespace {

#define SKIP_WITHOUT(path) \
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no test data at " << (path)

TEST(CsvData, EveryBrokenFileEndsAsExpected) {
    const auto table = kSharedData / "invalid/EXPECTED.csv";
    SKIP_WITHOUT(table);
    std::ifstream in(table);
    // Files that may be refused or read; this reader takes these, and refuses the others named bad_.
    const std::set<std::string> read_all_the_same{"csv/bad_quoted.csv", "csv/bad_semicolons.csv",
                                                  "csv/bad_decimal_comma.csv", "csv/bad_tabs.csv"};
    int accepted = 0;
    int rejected = 0;
    for (std::string line; std::getline(in, line);) {
        if (!line.starts_with("csv/")) continue;
        const std::size_t comma = line.find(',');
        const std::string name = line.substr(0, comma);
        const std::filesystem::path file = kSharedData / "invalid" / name;
        const std::string expected = line.substr(comma + 1, line.find(',', comma + 1) - comma - 1);
        std::string message;
        try {
            import_clips(file, {});
        } catch (const InputError& error) {
            message = error.what();
            EXPECT_EQ(message.find('\n'), std::string::npos) << message;
            EXPECT_NE(message.find(": line "), std::string::npos) << message;
        }
        if (expected == "accept") {
            EXPECT_EQ(message, "") << file;
        } else if (expected.starts_with("reject")) {
            EXPECT_EQ(message.empty(), read_all_the_same.contains(name)) << file << message;
        }
        ++(message.empty() ? accepted : rejected);
    }
    EXPECT_EQ(accepted, 13);
    EXPECT_EQ(rejected, 17);
}

TEST(CsvData, RealPathsLoadWithTheirSamples) {
    const auto folder = kSharedData / "trajectories/xytr";
    SKIP_WITHOUT(folder);
    const std::map<std::string, int> samples{
        {"cmu_01_06_30hz", 1284}, {"cmu_03_03_30hz", 1141}, {"cmu_07_05_30hz", 130}, {"cmu_09_01_30hz", 35}};
    for (const auto& [name, count] : samples) {
        const auto clips = import_clips(folder / (name + ".csv"), {});
        ASSERT_EQ(clips.size(), 1u);
        EXPECT_EQ(clips[0].clip->count(), count) << name;
        EXPECT_NEAR(clips[0].clip->dt(), 1.0 / 30, 1e-7) << name;
        EXPECT_EQ(clips[0].name, name);
    }
}

}  // namespace
}  // namespace mobbscope
