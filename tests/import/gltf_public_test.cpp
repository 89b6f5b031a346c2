// glTF files after public reports, of the shared data set where it is, against their right values.
#include <import/import.h>
#include <support/folders.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

const std::filesystem::path kPublic = kSharedData / "public";

/// From one place on the floor to another in 2 s, 0.6 m wide, by way of a third after 1 s.
void expect_way(const ImportedClip& clip, glm::dvec2 from, glm::dvec2 middle, glm::dvec2 to) {
    const auto samples = clip.clip->samples();
    ASSERT_EQ(samples.size(), 61u);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const double share = static_cast<double>(i) / 30;
        const glm::dvec2 at = share < 1 ? from + share * (middle - from) : middle + (share - 1) * (to - middle);
        EXPECT_NEAR(samples[i].x, at.x, 1e-6) << i;
        EXPECT_NEAR(samples[i].y, at.y, 1e-6) << i;
        EXPECT_LE(samples[i].r, 0.6 + 1e-6) << i;
    }
    EXPECT_NEAR(samples[0].r, 0.6, 1e-6);
    EXPECT_TRUE(clip.facts.warnings.empty()) << clip.facts.warnings.front().text;
}

TEST(GltfPublic, PointersToTheHipsAreRead) {
    for (const char* name : {"gltf_pointer_on_hips.gltf", "gltf_pointer_only.gltf"}) {
        if (!std::filesystem::exists(kPublic / name)) GTEST_SKIP() << "no test data at " << kPublic / name;
        const std::vector<ImportedClip> clips = import_clips(kPublic / name, {});
        ASSERT_EQ(clips.size(), 1u) << name;
        expect_way(clips[0], {0, 0}, {2, 0}, {4, 0});
        EXPECT_EQ(clips[0].facts.root, "Hips");
        EXPECT_EQ(clips[0].facts.up, "y");
    }
}

TEST(GltfPublic, TwoSkinsAreTwoPeople) {
    const auto file = kPublic / "gltf_two_skins_one_clip.gltf";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << "no test data at " << file;
    const std::vector<ImportedClip> clips = import_clips(file, {});
    ASSERT_EQ(clips.size(), 2u);
    EXPECT_EQ(clips[0].name, "both · A_Hips");
    EXPECT_EQ(clips[1].name, "both · B_Hips");
    expect_way(clips[0], {0, 0}, {2, 0}, {4, 0});
    expect_way(clips[1], {0, -3}, {1, -3}, {3, -3});
    ImportOptions options;
    options.root = "B_Hips";
    expect_way(import_clips(file, options).at(0), {0, -3}, {1, -3}, {3, -3});
}

}  // namespace
}  // namespace mobbscope
