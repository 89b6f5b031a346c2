// Scenes whose clips come from motion files.
#include <import/skeleton/motion.h>
#include <scene/scene.h>
#include <support/bvh_text.h>
#include <support/input_error.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <set>

namespace mobbscope {
namespace {

using testing::input_error;
using testing::TempFolder;

TEST(MotionSource, ImportKeysSayHowTheFileBecomesAClip) {
    const TempFolder folder;
    folder.write("walk.bvh", testing::kWalker);
    const auto file = folder.write("s.json", R"({"clips": {"arm": {"source": "walk.bvh", "animation": 0,
        "root": "Left Arm", "fps": 20, "unit": "cm", "up": "y", "trim": [0, 0.06], "origin": "start"}}})");
    const SceneClip clip = load_scene(file).clips.at(0);
    EXPECT_EQ(clip.clip->count(), 2);
    EXPECT_EQ(clip.clip->dt(), 0.05);
    EXPECT_EQ(clip.clip->samples()[0].x, 0);
    EXPECT_NEAR(clip.clip->samples()[0].r, 0.2, 1e-12);
    EXPECT_EQ(clip.facts.root, "Left Arm");
    ASSERT_TRUE(clip.skeleton);
    EXPECT_EQ(clip.skeleton->joints.size(), 4u);
    EXPECT_EQ(clip.skeleton->root, 1);

    ImportOptions over;
    over.root = "Foot";
    EXPECT_EQ(load_scene(file, over).clips.at(0).facts.root, "Foot");
}

TEST(MotionSource, MessagesNameBothFilesAndThePlaceInEach) {
    const TempFolder folder;
    const auto walk = folder.write("walk.bvh", testing::replaced(testing::kWalker, "0 95 30", "0 nan 30"));
    const auto file = folder.write("s.json", "{\"clips\": {\n\"c\": {\"source\": \"walk.bvh\"}}}");
    EXPECT_EQ(input_error([&] { load_scene(file); }), file.string() + ": line 2, /clips/c/source: " + walk.string() +
                                                          ": line 24: 'nan' is no finite number; write it like 12.5");
}

TEST(MotionSource, AClipFileIsASceneOfItsAnimations) {
    const std::filesystem::path knight = std::filesystem::path(MOBBSCOPE_SHARED_DATA) / "gltf/KayKit_Knight.glb";
    if (!std::filesystem::exists(knight)) GTEST_SKIP() << "no test data at " << knight;
    const Scene scene = load_scene(knight);
    ASSERT_EQ(scene.clips.size(), 76u);
    EXPECT_TRUE(scene.agents.empty());
    std::set<std::string> names;
    for (const SceneClip& clip : scene.clips) names.insert(clip.name);
    EXPECT_EQ(names.size(), scene.clips.size());

    // Written and read again, each clip is the animation that it was.
    const TempFolder folder;
    std::filesystem::copy(knight, folder.path() / knight.filename());
    const Scene again = load_scene(folder.write("s.json", to_json(scene)));
    ASSERT_EQ(again.clips.size(), scene.clips.size());
    for (std::size_t i = 0; i < scene.clips.size(); ++i) {
        EXPECT_EQ(again.clips[i].facts.animation, scene.clips[i].facts.animation);
        EXPECT_EQ(again.clips[i].clip->count(), scene.clips[i].clip->count());
    }

    const auto unclear = folder.write("u.json", R"({"clips": {"c": {"source": "KayKit_Knight.glb"}}})");
    EXPECT_NE(input_error([&] { load_scene(unclear); }).find("has 76 animations; name one with animation, such as "),
              std::string::npos);
}

}  // namespace
}  // namespace mobbscope
