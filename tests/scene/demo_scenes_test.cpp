// The demo scenes are what they claim to be.
#include <scene/fitted_scene.h>
#include <support/folders.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

namespace mobbscope {
namespace {

/// Metres between the nearest centres of two paths, whenever they are there.
double nearest_on_floor(const FittedScene& fitted, const SceneQuery& query) {
    const auto a = fitted.placed(query.a);
    const auto b = fitted.placed(query.b);
    double nearest = INFINITY;
    for (int i = 0; i < a.placed_clip().count(); ++i) {
        for (int j = 0; j < b.placed_clip().count(); ++j) {
            nearest = std::min(nearest, mobb::squared_distance(a.placed_clip().disk(i), b.placed_clip().disk(j)));
        }
    }
    return std::sqrt(nearest);
}

TEST(DemoScenes, CrossingPathsMeetOnTheFloorButNotInTime) {
    const Scene scene = load_scene(kScenes / "crossing.json");
    const FittedScene fitted(scene, scene.fit);
    ASSERT_EQ(fitted.queries().size(), 1u);
    EXPECT_LT(nearest_on_floor(fitted, fitted.queries()[0]), 0.05);
    EXPECT_FALSE(record(fitted, fitted.queries()[0]).contact);
    for (const SceneClip& clip : scene.clips) EXPECT_NEAR(clip.clip->duration(), 5, 0.01);
}

TEST(DemoScenes, CollisionCollides) {
    const Scene scene = load_scene(kScenes / "collision.json");
    const FittedScene fitted(scene, scene.fit);
    EXPECT_TRUE(record(fitted, fitted.queries()[0]).contact);
}

TEST(DemoScenes, CirclesAreALongWalk) {
    const Scene scene = load_scene(kScenes / "circles.json");
    EXPECT_EQ(scene.clips.at(0).clip->count(), 1260);
    EXPECT_NEAR(scene.clips[0].clip->duration(), 42, 1e-9);
}

TEST(DemoScenes, TheWalkIsHuman) {
    for (const char* file : {"crossing.json", "collision.json", "circles.json", "walk.csv"}) {
        for (const SceneClip& clip : load_scene(kScenes / file).clips) {
            for (int i = 1; i < clip.clip->count(); ++i) {
                const mobb::Disk& a = clip.clip->samples()[static_cast<std::size_t>(i - 1)];
                const mobb::Disk& b = clip.clip->samples()[static_cast<std::size_t>(i)];
                EXPECT_LT(std::sqrt(mobb::squared_distance(a, b)) / clip.clip->dt(), 2) << file << ' ' << i;
                EXPECT_GE(b.r, 0.28);
                EXPECT_LE(b.r, 0.56);
            }
        }
    }
}

TEST(DemoScenes, TheGeneratorMakesTheFilesThatAreThere) {
    if (std::system("python3 --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "no python3";
    const TempFolder folder;
    const std::string command =
        "python3 -B '" MOBBSCOPE_SOURCE_DIR "/scripts/make_scenes.py' '" + folder.path().string() + "'";
    ASSERT_EQ(std::system(command.c_str()), 0);
    for (const char* file : {"crossing.json", "collision.json", "circles.json", "walk.csv"}) {
        EXPECT_EQ(slurp(folder.path() / file), slurp(kScenes / file)) << file;
    }
}

}  // namespace
}  // namespace mobbscope
