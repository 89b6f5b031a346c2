// Damaged BVH files give clips or an InputError, nothing else, and soon.
#include <base/error.h>
#include <import/bvh/bvh.h>
#include <import/skeleton/motion_clips.h>
#include <support/bvh_text.h>
#include <support/mutate.h>

#include <gtest/gtest.h>

namespace mobbscope {
namespace {

TEST(BvhFuzz, DamagedFilesAreReadOrRefused) {
    std::mt19937 random(20250301);
    int read = 0;
    int refused = 0;
    for (int round = 0; round < 30'000; ++round) {
        const std::string text = testing::mutated(testing::kWalker, random);
        ImportOptions options;
        if (round % 3 == 0) options.unit = "cm";
        if (round % 5 == 0) options.trim = {0.02, 0.4};
        if (round % 7 == 0) options.origin = Origin::start_heading;
        if (round % 11 == 0) options.root = "Left Arm";
        try {
            const auto clips = motion_clips(bvh_motion(parse_bvh(text, "fuzz.bvh")), "fuzz.bvh", options);
            ASSERT_EQ(clips.size(), 1u);
            ++read;
        } catch (const InputError& error) {
            ASSERT_EQ(std::string_view(error.what()).find('\n'), std::string_view::npos) << error.what();
            ++refused;
        }
    }
    EXPECT_GT(read, 1000);
    EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace mobbscope
