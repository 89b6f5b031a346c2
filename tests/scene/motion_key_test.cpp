// The key "motion" of a scene's clips: read, written, refused, overruled.
#include <scene/clip_import.h>
#include <scene/scene.h>
#include <support/input_error.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <string>

namespace mobbscope {
namespace {

Scene scene_of(const std::string& clips, const std::filesystem::path& folder = "", const ImportOptions& over = {}) {
    return parse_scene("{\"clips\": {" + clips + "}}", "s.json", folder, over);
}

ImportOptions over_with(mobb::Motion motion) {
    ImportOptions out;
    out.motion = motion;
    return out;
}

constexpr const char* kInline = R"("a": {"dt": 1, "samples": [[0,0,1],[1,0,1]]},
    "b": {"dt": 1, "motion": "held", "samples": [[0,0,1],[1,0,1]]},
    "c": {"motion": "linear", "dt": 1, "samples": [[0,0,1],[1,0,1]]})";

TEST(MotionKey, OfSamplesInTheSceneIsReadAndWritten) {
    const Scene scene = scene_of(kInline);
    for (const Scene& each : {scene, parse_scene(to_json(scene), "s.json", "")}) {
        EXPECT_EQ(each.clips[0].clip->motion(), mobb::Motion::held);
        EXPECT_EQ(each.clips[1].clip->motion(), mobb::Motion::held);
        EXPECT_EQ(each.clips[2].clip->motion(), mobb::Motion::linear);
    }
}

TEST(MotionKey, OfASourceIsReadAndWritten) {
    const TempFolder folder;
    folder.write("ids.csv", "id,t,x,y,r\n1,0,0,0,1\n1,1,0,0,1\n");
    folder.write("one.csv", "t,x,y,r\n0,0,0,1\n1,0,0,1\n");
    const Scene scene = scene_of(R"("a": {"source": "ids.csv"}, "b": {"source": "ids.csv", "motion": "held"},
        "c": {"source": "one.csv"}, "d": {"source": "one.csv", "motion": "linear"})",
                                 folder.path());
    const mobb::Motion expected[] = {mobb::Motion::linear, mobb::Motion::held, mobb::Motion::held,
                                     mobb::Motion::linear};
    const Scene again = parse_scene(to_json(scene), "s.json", folder.path());
    const Scene inlined = parse_scene(to_json(scene, true), "s.json", "");
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(scene.clips[i].clip->motion(), expected[i]) << i;
        EXPECT_EQ(again.clips[i].clip->motion(), expected[i]) << i;
        EXPECT_EQ(again.clips[i].options, scene.clips[i].options) << i;
        EXPECT_EQ(inlined.clips[i].clip->motion(), expected[i]) << "without the files, " << i;
    }
}

TEST(MotionKey, AnUnknownOneIsRefusedAtItsPlace) {
    const auto complaint = [](const std::string& clip) {
        return input_error([&] { scene_of("\n\"c\": {" + clip + "}"); });
    };
    EXPECT_EQ(complaint(R"("dt": 1, "motion": "fast", "samples": [[0,0,1]])"),
              "s.json: line 2, /clips/c/motion: 'fast' is not a motion; give held or linear");
    EXPECT_EQ(complaint(R"("source": "a.csv", "motion": "fast")"),
              "s.json: line 2, /clips/c/motion: 'fast' is not a motion; give held or linear");
    EXPECT_EQ(complaint(R"("dt": 1, "motion": 1, "samples": [[0,0,1]])"),
              "s.json: line 2, /clips/c/motion: expected a string, found a number");
    EXPECT_NE(complaint(R"("dt": 1, "motoin": "held", "samples": [[0,0,1]])").find("the nearest known key is 'motion'"),
              std::string::npos);
}

TEST(MotionKey, TheOptionOverrulesThatOfEveryClip) {
    for (const mobb::Motion motion : {mobb::Motion::held, mobb::Motion::linear}) {
        const Scene scene = scene_of(kInline, "", over_with(motion));
        for (const SceneClip& clip : scene.clips) EXPECT_EQ(clip.clip->motion(), motion) << clip.name;
    }
}

TEST(MotionKey, LongHeldStepsOfSamplesInTheSceneAreWarnedOf) {
    const std::string clip = R"("c": {"dt": 1, "samples": [[0,0,0.5],[1,0,0.5]]})";
    ASSERT_EQ(scene_of(clip).clips[0].facts.warnings.size(), 1u);
    EXPECT_EQ(scene_of(clip).clips[0].facts.warnings[0].option, "motion");
    EXPECT_TRUE(scene_of(clip, "", over_with(mobb::Motion::linear)).clips[0].facts.warnings.empty());
    EXPECT_TRUE(scene_of(kInline).clips[0].facts.warnings.empty()) << "as long as the radius is not too long";
}

TEST(MotionKey, SamplesInTheSceneCanGetAnother) {
    Scene scene = scene_of(R"("c": {"dt": 1, "samples": [[0,0,0.5],[1,0,0.5]]})");
    replace_clips(scene, {with_motion(scene, 0, mobb::Motion::linear)});
    EXPECT_EQ(scene.clips[0].clip->motion(), mobb::Motion::linear);
    EXPECT_EQ(scene.clips[0].clip->samples()[1].x, 1);
    EXPECT_TRUE(scene.clips[0].facts.warnings.empty());
    replace_clips(scene, {with_motion(scene, 0, mobb::Motion::held)});
    EXPECT_EQ(scene.clips[0].facts.warnings.size(), 1u);
}

}  // namespace
}  // namespace mobbscope
