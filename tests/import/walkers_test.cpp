// The walking skeletons in assets/clips are what they claim to be.
#include <import/import.h>
#include <support/folders.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

namespace mobbscope {
namespace {

constexpr const char* kNames[] = {"walk", "bend", "turn", "run", "stand", "circle"};

ImportedClip read(const std::string& name) { return import_clips(kClips / (name + ".glb"), {}).at(0); }

double length(const mobb::Clip& clip) {
    double sum = 0;
    for (std::size_t i = 1; i < clip.samples().size(); ++i) {
        sum += std::hypot(clip.samples()[i].x - clip.samples()[i - 1].x, clip.samples()[i].y - clip.samples()[i - 1].y);
    }
    return sum;
}

/// Degrees between the first and the last stride of a path, counter-clockwise; within a stride the hips sway.
double turned(const mobb::Clip& clip) {
    const auto heading = [&](std::size_t from) {
        const mobb::Disk& a = clip.samples()[from];
        const mobb::Disk& b = clip.samples()[from + 31];
        return std::atan2(b.y - a.y, b.x - a.x);
    };
    return (heading(clip.samples().size() - 32) - heading(0)) * 180 / M_PI;
}

TEST(Walkers, AreSkeletonsOfAHumanSize) {
    for (const char* name : kNames) {
        const ImportedClip it = read(name);
        EXPECT_EQ(it.facts.format, "gltf") << name;
        EXPECT_EQ(it.facts.root, "Hips") << name;
        EXPECT_EQ(it.facts.joints, 19) << name;
        EXPECT_EQ(it.facts.animation, name);
        EXPECT_EQ(it.facts.warnings.size(), std::string(name) == "stand" ? 1u : 0u) << name;
        for (const mobb::Disk& disk : it.clip->samples()) {
            EXPECT_GT(disk.r, 0.28) << name;
            EXPECT_LT(disk.r, 0.56) << name;
        }
    }
}

TEST(Walkers, GoAsTheirNamesSay) {
    const auto speed = [](const char* name) {
        const ImportedClip it = read(name);
        return length(*it.clip) / (it.clip->dt() * (it.clip->count() - 1));
    };
    EXPECT_NEAR(speed("walk"), 1.3, 0.05);
    EXPECT_NEAR(speed("bend"), 1.3, 0.05);
    EXPECT_NEAR(speed("turn"), 1.1, 0.05);
    EXPECT_NEAR(speed("run"), 3.0, 0.05);
    EXPECT_LT(speed("stand"), 0.02);
    EXPECT_NEAR(speed("circle"), 1.35, 0.05);
    EXPECT_NEAR(turned(*read("walk").clip), -15, 4);
    EXPECT_NEAR(turned(*read("bend").clip), 35, 4);
    EXPECT_NEAR(turned(*read("turn").clip), 90, 5);
    EXPECT_EQ(read("walk").clip->count(), 150);
    EXPECT_NEAR(read("circle").clip->duration(), 42, 1e-3);
}

TEST(Walkers, TheGeneratorMakesTheFilesThatAreThere) {
    if (std::system("python3 --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "no python3";
    const TempFolder folder;
    const std::string script = "python3 -B '" MOBBSCOPE_SOURCE_DIR "/scripts/make_walkers.py' ";
    ASSERT_EQ(std::system((script + "'" + folder.path().string() + "'").c_str()), 0);
    for (const char* name : kNames) {
        const std::string file = std::string(name) + ".glb";
        EXPECT_TRUE(slurp(folder.path() / file) == slurp(kClips / file)) << file;
    }
    ASSERT_EQ(std::system((script + "--seed 2 '" + folder.path().string() + "'").c_str()), 0);
    EXPECT_FALSE(slurp(folder.path() / "walk.glb") == slurp(kClips / "walk.glb"));
}

}  // namespace
}  // namespace mobbscope
