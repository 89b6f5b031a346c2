// Damaged BVH files give clips or an InputError, nothing else, and soon.
#include <base/error.h>
#include <import/bvh/bvh.h>
#include <import/skeleton/motion_clips.h>
#include <support/bvh_text.h>
#include <support/mutate.h>

#include <gtest/gtest.h>

namespace mobbscope {
namespace {

/// Two bodies with legs and arms; the second one is a copy of the first. z is up.
std::string two_bodies() {
    const std::string body = R"(ROOT Hips
{
OFFSET 0 0 0
CHANNELS 4 Xposition Yposition Zposition Zrotation
JOINT Chest { OFFSET 0 0 50
JOINT Arm { OFFSET 30 0 -5 End Site { OFFSET 5 0 -40 } }
JOINT Arm { OFFSET -30 0 -5 End Site { OFFSET -5 0 -40 } } }
JOINT Leg { OFFSET 10 0 -5 End Site { OFFSET 0 5 -90 } }
JOINT Leg { OFFSET -10 0 -5 End Site { OFFSET 0 5 -90 } }
}
)";
    return "HIERARCHY\n" + body + body +
           "MOTION\nFrames: 3\nFrame Time: 0.05\n0 0 95 0 0 90 95 0\n5 0 95 9 0 99 95 0\n9 0 96 0 0 99 96 0\n";
}

TEST(BvhFuzz, DamagedFilesAreReadOrRefused) {
    std::mt19937 random(20250301);
    int read = 0;
    int refused = 0;
    for (int round = 0; round < 60'000; ++round) {
        const std::string text = mutated(round % 2 == 0 ? kWalker : two_bodies(), random);
        ImportOptions options;
        if (round % 3 == 0) options.unit = "cm";
        if (round % 5 == 0) options.trim = {0.02, 0.4};
        if (round % 7 == 0) options.origin = Origin::start_heading;
        if (round % 11 == 0) options.root = "Left Arm";
        try {
            const auto clips = motion_clips(bvh_motion(parse_bvh(text, "fuzz.bvh")), "fuzz.bvh", options);
            ASSERT_GE(clips.size(), 1u);
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
