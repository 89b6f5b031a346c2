// The keys "poses" and "warp": read, written, refused.
#include <base/file.h>
#include <import/skeleton/warp.h>
#include <scene/clip_import.h>
#include <scene/scene.h>
#include <support/folders.h>
#include <support/input_error.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope {
namespace {

bool same_samples(const mobb::Clip& a, const mobb::Clip& b) {
    return std::ranges::equal(a.samples(), b.samples(), [](const mobb::Disk& p, const mobb::Disk& q) {
        return p.x == q.x && p.y == q.y && p.r == q.r;
    });
}

/// A scene of two parts of walk.glb that are warped to poses of it.
Scene warped_scene() {
    const std::string parts =
        R"({"clips": {"a": {"source": "walk.glb", "trim": [1, 1.98]}, "b": {"source": "walk.glb", "trim": [1.5, 2.78]}}})";
    Scene scene = parse_scene(parts, "s.json", kClips);
    scene.file = kClips / "s.json";
    std::vector<std::shared_ptr<const MovingPose>> poses;
    for (const int frame : {3, 14}) {
        poses.push_back(
            std::make_shared<const MovingPose>(moving_pose(*scene.clips[0].clip, *scene.clips[0].skeleton, frame, 10)));
    }
    scene.clips[0].warp = std::make_shared<const ClipWarp>(ClipWarp{0.3, {"A", poses[0], 20}, {"B", poses[1], 30}});
    scene.clips[1].warp = std::make_shared<const ClipWarp>(ClipWarp{0.2, {"B", poses[1], 0}, {"A", poses[0], -5}});
    return scene;
}

TEST(WarpKey, IsReadAndWritten) {
    const Scene scene = warped_scene();
    const std::string text = to_json(scene);
    const Scene read = parse_scene(text, "s.json", kClips);
    EXPECT_EQ(to_json(read), text);
    for (std::size_t i = 0; i < 2; ++i) {
        ASSERT_TRUE(read.clips[i].warp) << i;
        EXPECT_EQ(*read.clips[i].warp->begin.pose, *scene.clips[i].warp->begin.pose) << i;
        EXPECT_EQ(read.clips[i].warp->end.heading_deg, scene.clips[i].warp->end.heading_deg) << i;
        EXPECT_EQ(read.clips[i].clip->count(), scene.clips[i].clip->count()) << i;
        EXPECT_FALSE(same_samples(*read.clips[i].clip, *scene.clips[i].clip)) << i;
    }
    EXPECT_EQ(read.clips[0].warp->begin.pose, read.clips[1].warp->end.pose) << "poses stand in a file once";
}

TEST(WarpKey, SamplesInTheSceneAreWarpedAlready) {
    const Scene read = parse_scene(to_json(warped_scene()), "s.json", kClips);
    const std::string text = to_json(read, true);
    EXPECT_EQ(text.find("warp"), std::string::npos);
    EXPECT_EQ(text.find("poses"), std::string::npos);
    const Scene alone = parse_scene(text, "s.json", "");
    EXPECT_TRUE(same_samples(*alone.clips[0].clip, *read.clips[0].clip));
}

TEST(WarpKey, PosesOfOneNameInTwoScenesAreToldApart) {
    Scene scene = warped_scene();
    MovingPose other = *scene.clips[0].warp->begin.pose;
    other.height += 0.1;
    ClipWarp warp = *scene.clips[1].warp;
    warp.end = {"A", std::make_shared<const MovingPose>(other), -5};
    scene.clips[1].warp = std::make_shared<const ClipWarp>(warp);
    const Scene read = parse_scene(to_json(scene), "s.json", kClips);
    EXPECT_EQ(*read.clips[1].warp->end.pose, other);
    EXPECT_EQ(*read.clips[0].warp->begin.pose, *scene.clips[0].warp->begin.pose);
}

TEST(WarpKey, AClipIsWarpedAgainWithOtherOptions) {
    const Scene scene = parse_scene(to_json(warped_scene()), (kClips / "s.json").string(), kClips);
    ImportOptions options = scene.clips[0].options;
    options.fps = 60;
    Scene with_file = scene;
    with_file.file = kClips / "s.json";
    const auto file = source_file(kClips / "walk.glb", nullptr);
    const std::vector<ReimportedClip> made = reimport(with_file, *file, {{0, options}, {1, scene.clips[1].options}});
    ASSERT_EQ(made.size(), 2u);
    EXPECT_EQ(made[0].is.clip->dt(), 1.0 / 60);
    EXPECT_EQ(made[0].is.warp, scene.clips[0].warp);
    EXPECT_TRUE(same_samples(*made[1].is.clip, *scene.clips[1].clip));
    options.trim.reset();
    EXPECT_NE(input_error([&] { reimport(with_file, *file, {{0, options}}); }).find("give trim"), std::string::npos);
}

TEST(WarpKey, WhatIsWrongIsSaidAtItsPlace) {
    const std::string good = to_json(warped_scene());
    const auto complaint = [&](const std::string& part, const std::string& instead) {
        std::string text = good;
        const auto at = text.find(part);
        EXPECT_NE(at, std::string::npos) << part;
        text.replace(at, part.size(), instead);
        return input_error([&] { parse_scene(text, "s.json", kClips); });
    };
    const std::pair<std::pair<const char*, const char*>, const char*> cases[] = {
        {{"\"seconds\": 0.3", "\"seconds\": 0"}, "/clips/a/warp/seconds: must be over 0"},
        {{"\"begin\": [\"A\", 20]", "\"begin\": [\"C\", 20]"}, "/clips/a/warp/begin/0: there is no pose 'C'"},
        {{"\"begin\": [\"A\", 20]", "\"begin\": [\"A\"]"}, "/clips/a/warp/begin"},
        {{"\"begin\": [\"A\", 20], ", ""}, "begin"},
        {{"\"trim\": [1, 1.98],", ""}, "/clips/a/warp: a warped clip is a part of its source"},
        {{"\"trim\": [1, 1.98],", "\"trim\": [1, 1000],"},
         "/clips/a/warp: the source has no frame behind the part that is warped"},
        {{"\"height\"", "\"hight\""}, "nearest known key is 'height'"},
    };
    for (const auto& [edit, expected] : cases) {
        const std::string said = complaint(edit.first, edit.second);
        EXPECT_NE(said.find(expected), std::string::npos) << said;
        EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    }
    EXPECT_NE(input_error([] {
                  parse_scene(R"({"clips": {"a": {"dt": 1, "samples": [[0,0,1]], "warp": {}}}})", "s.json", "");
              }).find("/clips/a/warp: samples are as they are"),
              std::string::npos);
    const TempFolder folder;
    folder.write("a.csv", "t,x,y,r\n0,0,0,1\n1,0,0,1\n2,0,0,1\n");
    EXPECT_NE(input_error([&] {
                  parse_scene(R"({"poses": {"A": {"height": 0, "velocity": [0,0,0], "joints": []}},
                      "clips": {"a": {"source": "a.csv", "trim": [0, 1],
                                "warp": {"seconds": 1, "begin": ["A", 0], "end": ["A", 0]}}}})",
                              "s.json", folder.path());
              }).find("/clips/a/warp: only motion of joints can be warped"),
              std::string::npos);
}

}  // namespace
}  // namespace mobbscope
