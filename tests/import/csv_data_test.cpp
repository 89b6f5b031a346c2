// Real and deliberately broken files of the shared data set, where it is.
#include <import/error.h>
#include <import/import.h>

#include <gtest/gtest.h>

#include <fstream>
#include <map>

namespace mobbscope {
namespace {

const std::filesystem::path kData = MOBBSCOPE_SHARED_DATA;

#define SKIP_WITHOUT(path) \
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no test data at " << (path)

TEST(CsvData, EveryBrokenFileEndsAsExpected) {
    const auto table = kData / "invalid/EXPECTED.csv";
    SKIP_WITHOUT(table);
    std::ifstream in(table);
    int checked = 0;
    for (std::string line; std::getline(in, line);) {
        if (!line.starts_with("csv/")) continue;
        const std::size_t comma = line.find(',');
        const std::filesystem::path file = kData / "invalid" / line.substr(0, comma);
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
        } else if (expected == "reject") {
            EXPECT_NE(message, "") << file;
        }
        ++checked;
    }
    EXPECT_EQ(checked, 30);
}

TEST(CsvData, RealPathsLoadWithTheirSamples) {
    const auto folder = kData / "trajectories/xytr";
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
