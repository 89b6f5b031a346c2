// The FBX reader. Figures of real files: motion_data_test.cpp.
#include <base/error.h>
#include <import/fbx/fbx.h>
#include <support/mutate.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <random>
#include <string_view>

namespace mobbscope {
namespace {

TEST(Fbx, DamagedFilesAreReadOrRefused) {
    const std::filesystem::path original = std::filesystem::path(MOBBSCOPE_SHARED_DATA) / "fbx/huesitos.fbx";
    if (!std::filesystem::exists(original)) GTEST_SKIP() << "no test data at " << original;
    const std::string bytes = testing::slurp(original);
    std::mt19937 random(20250305);
    for (int round = 0; round < 40; ++round) {
        try {
            parse_fbx(testing::mutated(bytes, random), "fuzz.fbx");
        } catch (const InputError& error) {
            EXPECT_EQ(std::string_view(error.what()).find('\n'), std::string_view::npos) << error.what();
        }
    }
}

}  // namespace
}  // namespace mobbscope
