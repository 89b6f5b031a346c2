// Clips of a scene read anew with other options.
#include <scene/clip_import.h>
#include <support/input_error.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace mobbscope {
namespace {

struct TracksFolder {
    TempFolder folder;
    Scene scene;
    TracksFolder() {
        folder.write("two.csv", "id,t,x,y,r\na,0,0,0,1\nb,1,5,0,1\na,1,1,0,1\nb,2,6,0,1\n");
        folder.write("walk.csv", "t,x,y,r\n0,0,0,1\n1,1,0,1\n2,2,0,1\n");
        scene = load_scene(folder.write("s.json", R"({
            "clips": {"a": {"source": "two.csv", "id": "a"}, "b": {"source": "two.csv", "id": "b"},
                      "walk": {"source": "walk.csv"}, "bare": {"dt": 1, "samples": [[0, 0, 1]]}},
            "agents": [{"name": "A", "clip": "a"}, {"name": "W", "clip": "walk"}],
            "queries": [{"a": "A", "b": "W", "expect": {"collides": true, "contact":
                {"time": 0, "a_sample": 1, "b_sample": 0, "distance": 0, "radii": 2}, "tests": {"time": 1}}},
                {"a": "A", "b": "W", "expect": {"tests": {"time": 1}}}]})"));
    }
    std::shared_ptr<const SourceFile> file(int clip, const std::shared_ptr<const SourceFile>& known = nullptr) const {
        return source_file(source_path(scene, scene.clips[static_cast<std::size_t>(clip)]), known);
    }
    ImportOptions options(int clip, const char* key, const char* text) const {
        ImportOptions out = scene.clips[static_cast<std::size_t>(clip)].options;
        set_option(out, *import_option(key), text);
        return out;
    }
};

TEST(ClipImport, IsWhatTheSceneWouldReadWithThoseOptions) {
    TracksFolder of;
    EXPECT_EQ(clips_of_same_source(of.scene, 0), (std::vector<int>{0, 1}));
    replace_clips(of.scene, reimport(of.scene, *of.file(0),
                                     {{0, of.options(0, "unit", "cm")}, {1, of.options(1, "unit", "cm")}}));
    EXPECT_EQ(of.scene.clips[0].clip->samples()[1].x, 0.01);
    EXPECT_EQ(of.scene.clips[1].clip->samples()[1].x, 0.06);
    EXPECT_EQ(of.scene.clips[1].start, 1);
    const Scene again = parse_scene(to_json(of.scene), "s.json", of.folder.path());
    for (std::size_t i = 0; i < of.scene.clips.size(); ++i) {
        EXPECT_EQ(again.clips[i].options, of.scene.clips[i].options) << i;
        EXPECT_TRUE(std::ranges::equal(
            again.clips[i].clip->samples(), of.scene.clips[i].clip->samples(),
            [](const mobb::Disk& a, const mobb::Disk& b) { return a.x == b.x && a.y == b.y && a.r == b.r; }))
            << i;
    }
}

TEST(ClipImport, WhatWasRecordedOfOtherSamplesIsDropped) {
    TracksFolder of;
    ASSERT_TRUE(of.scene.queries[0].expect->contact);
    replace_clips(of.scene, reimport(of.scene, *of.file(1), {{1, of.options(1, "radius", "2")}}));
    EXPECT_TRUE(of.scene.queries[0].expect->contact) << "it is about others";
    replace_clips(of.scene, reimport(of.scene, *of.file(0), {{0, of.options(0, "motion", "held")}}));
    EXPECT_FALSE(of.scene.queries[0].expect->contact) << "it is about another motion";
    EXPECT_EQ(of.scene.queries[0].expect->collides, true) << "what is expected stays";
    EXPECT_EQ(of.scene.queries[0].expect->tests, ExpectedTests()) << "others are made now";
    EXPECT_FALSE(of.scene.queries[1].expect) << "nothing is left of it";
    EXPECT_NO_THROW(parse_scene(to_json(of.scene), "s.json", of.folder.path()));
}

TEST(ClipImport, RefusesAsTheSceneWould) {
    TracksFolder of;
    ImportOptions none = of.options(0, "id", "");
    EXPECT_NE(input_error([&] {
                  reimport(of.scene, *of.file(0), {{0, none}});
              }).find("several tracks: name one"),
              std::string::npos);
    EXPECT_NE(input_error([&] {
                  reimport(of.scene, *of.file(0), {{0, of.options(0, "id", "c")}});
              }).find("'c'"),
              std::string::npos);
    EXPECT_NE(input_error([&] {
                  reimport(of.scene, *of.file(2), {{2, of.options(2, "trim", "7 8")}});
              }).find("trim"),
              std::string::npos);
}

TEST(ClipImport, AFileIsReadAgainOnlyIfItHasChanged) {
    TracksFolder of;
    const auto known = of.file(2);
    EXPECT_EQ(of.file(2, known), known);
    EXPECT_NE(of.file(0, known), known);
    of.folder.write("walk.csv", "t,x,y,r\n0,0,0,1\n1,1,0,1\n");
    EXPECT_NE(of.file(2, known), known);
}

}  // namespace
}  // namespace mobbscope
