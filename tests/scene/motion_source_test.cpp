// Scenes whose clips come from motion files.
#include <import/gltf_bytes.h>
#include <import/skeleton/motion.h>
#include <scene/scene.h>
#include <support/bvh_text.h>
#include <support/folders.h>
#include <support/input_error.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <set>

namespace mobbscope {
namespace {

TEST(MotionSource, ImportKeysSayHowTheFileBecomesAClip) {
    const TempFolder folder;
    folder.write("walk.bvh", kWalker);
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
    const auto walk = folder.write("walk.bvh", replaced(kWalker, "0 95 30", "0 nan 30"));
    const auto file = folder.write("s.json", "{\"clips\": {\n\"c\": {\"source\": \"walk.bvh\"}}}");
    EXPECT_EQ(input_error([&] { load_scene(file); }),
              file.string() + ": line 2, /clips/c/source: " + walk.string() +
                  ": line 24: 'nan' is not a finite number; write it like 12.5");
}

TEST(MotionSource, AClipFileIsASceneOfItsAnimations) {
    const std::filesystem::path knight = kSharedData / "gltf/KayKit_Knight.glb";
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

/// Two people, who go along x 4 and 3 m in "walk"; in "wave" one of them turns.
std::string two_people() {
    GltfBytes bytes;
    const int times = bytes.add_floats("SCALAR", {0, 2});
    bytes.channel("0", "translation", times, bytes.add_floats("VEC3", {0, 1, 0, 4, 1, 0}));
    bytes.channel("2", "translation", times, bytes.add_floats("VEC3", {0, 1, 3, 3, 1, 3})).animation("walk");
    bytes.channel("2", "rotation", times, bytes.add_floats("VEC4", {0, 0, 0, 1, 0, 1, 0, 0})).animation("wave");
    return bytes.glb(R"([{"name":"A","children":[1]},{"name":"AHand","translation":[1,0,0]},)"
                     R"({"name":"B","children":[3,4]},{"name":"BHand","translation":[0.5,0,0]},{"name":"BHead"}])",
                     R"(,"skins":[{"joints":[0,1]},{"joints":[2,3,4]}])");
}

TEST(MotionSource, SeveralCharactersAreSeveralClipsAndRootChoosesOne) {
    const TempFolder folder;
    const Scene scene = load_scene(folder.write("two.glb", two_people()));
    ASSERT_EQ(scene.clips.size(), 3u);
    EXPECT_EQ(scene.clips[0].name, "walk · A");
    EXPECT_EQ(scene.clips[1].name, "walk · B");
    EXPECT_EQ(scene.clips[2].name, "wave · B");
    EXPECT_EQ(scene.clips[1].options.animation, "walk");
    EXPECT_EQ(scene.clips[1].options.root, "B");
    // Written and read again, each clip is the one that it was.
    const Scene again = load_scene(folder.write("again.json", to_json(scene)));
    for (std::size_t i = 0; i < scene.clips.size(); ++i) {
        EXPECT_EQ(again.clips[i].clip->samples().back().x, scene.clips[i].clip->samples().back().x);
        EXPECT_EQ(again.clips[i].clip->samples().back().y, scene.clips[i].clip->samples().back().y);
        EXPECT_EQ(again.clips[i].name, scene.clips[i].name);
    }
    const auto with = [&](const std::string& keys) {
        return folder.write("s.json", R"({"clips": {"c": {"source": "two.glb")" + keys + "}}}");
    };
    EXPECT_NEAR(load_scene(with(R"(, "animation": "walk", "root": "B")")).clips[0].clip->samples().back().x, 3, 1e-6);
    EXPECT_NEAR(load_scene(with(R"(, "animation": 0, "root": "AHand")")).clips[0].clip->samples().back().x, 5, 1e-6);
    EXPECT_EQ(load_scene(with(R"(, "root": "A")")).clips[0].facts.animation, "walk") << "the only one that moves it";
    const auto refusal = [&](const std::string& keys) { return input_error([&] { load_scene(with(keys)); }); };
    EXPECT_NE(refusal("").find("has 3 clips; name one with animation, such as 'walk', and name one with root, such as"),
              std::string::npos);
    EXPECT_NE(refusal(R"(, "animation": "walk")").find("has 2 characters; name one with root, such as 'A'"),
              std::string::npos);
    EXPECT_NE(refusal(R"(, "root": "B")").find("has 2 animations; name one with animation, such as 'walk'"),
              std::string::npos);
}

}  // namespace
}  // namespace mobbscope
