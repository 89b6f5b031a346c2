#include <scene/scene.h>
#include <support/input_error.h>
#include <support/temp_folder.h>

#include <gtest/gtest.h>

#include <string>

namespace mobbscope {
namespace {

Scene parse_plain(std::string_view text) { return parse_scene(text, "s.json", ""); }

constexpr const char* kTwoClips = R"("clips": {"z": {"dt": 0.5, "samples": [[0, 0, 0.4], [1, 0, 0.5]]},
                                              "a": {"dt": 1, "samples": [[0, 0, 0]]}})";

TEST(Scene, OnlyClipsAreRequired) {
    const Scene scene = parse_plain(std::string("{") + kTwoClips + "}");
    ASSERT_EQ(scene.clips.size(), 2u);
    EXPECT_EQ(scene.clips[0].name, "z");
    EXPECT_EQ(scene.clips[0].clip->samples()[1].r, 0.5);
    EXPECT_EQ(scene.fit, mobb::FitOptions{});
    EXPECT_EQ(scene.view, ViewState{});
    EXPECT_EQ(query_count(scene), 0u);
    ASSERT_EQ(placed_agents(scene).size(), 2u);
    EXPECT_EQ(placed_agents(scene)[1].name, "a");
    EXPECT_EQ(placed_agents(scene)[1].agent, -1);
}

TEST(Scene, EverythingIsRead) {
    const Scene scene = parse_plain(std::string(R"({"$schema": "x", "mobbscope": 1, )") + kTwoClips + R"(,
        "agents": [{"name": "A", "clip": "a", "translate": [1, 2], "rotate_deg": 30, "start": 0.25, "color": "#E69f00"},
                   {"name": "B", "clip": "z"}],
        "fit": {"tree": "umobb", "leaf": 3, "levels": 2, "axes": "minarea", "time_scale": 2.5},
        "queries": [{"a": "B", "b": {"clip": "z", "translate": [3, 4], "rotate_deg": -90, "start": 7}},
                    {"a": "A", "b": "B", "expect": {"collides": false, "contact": null}}],
        "view": {"levels": 3}})");
    EXPECT_EQ(scene.agents[0].clip, 1);
    EXPECT_EQ(scene.agents[0].placement, (mobb::Placement{{1, 2}, 30, 0.25}));
    EXPECT_EQ(scene.agents[0].color, (Color{0xe6, 0x9f, 0x00}));
    EXPECT_FALSE(scene.agents[1].color);
    EXPECT_EQ(scene.fit, (mobb::FitOptions{mobb::TreeKind::umobb, 3, 2, mobb::Axes::minarea, 2.5}));
    EXPECT_EQ(scene.queries[0].a.agent, 1);
    EXPECT_EQ(scene.queries[0].b.agent, -1);
    EXPECT_EQ(scene.queries[0].b.name, "z");
    EXPECT_EQ(scene.queries[0].b.placement, (mobb::Placement{{3, 4}, -90, 7}));
    ASSERT_TRUE(scene.queries[1].expect);
    EXPECT_EQ(scene.queries[1].expect->collides, false);
    EXPECT_EQ(scene.view.levels, (LevelRange{3, 3, false}));
}

TEST(Scene, TestsAreExpectedByTheirKind) {
    const auto expecting = [](const std::string& expect) {
        return std::string("{") + kTwoClips + R"(, "queries": [{"a": {"clip": "a"}, "b": {"clip": "z"}, "expect": )" +
               expect + "}]}";
    };
    const Scene scene = parse_plain(expecting(R"({"tests": {"time": 10, "samples": 0}})"));
    const Expectation& expect = *scene.queries[0].expect;
    EXPECT_FALSE(expect.collides);
    EXPECT_EQ(expect.tests[mobb::TestKind::time.index()], 10);
    EXPECT_EQ(expect.tests[mobb::TestKind::samples.index()], 0);
    EXPECT_FALSE(expect.tests[mobb::TestKind(mobb::BoxKind::obb2d).index()]);
    EXPECT_EQ(parse_plain(to_json(scene)).queries[0].expect, expect);
    const Scene both = parse_plain(expecting(R"({"collides": false, "tests": {"obb2d": 3}})"));
    EXPECT_EQ(both.queries[0].expect->collides, false);
    EXPECT_EQ(parse_plain(to_json(both)).queries[0].expect, both.queries[0].expect);

    const auto refused = [&](const char* expect_text) {
        return input_error([&] { parse_plain(expecting(expect_text)); });
    };
    EXPECT_NE(refused(R"({"tests": {}})").find("no kind of test is named"), std::string::npos);
    EXPECT_NE(refused(R"({"tests": {"obb2": 1}})").find("'obb2' is not a kind of test; give time, obb2d"),
              std::string::npos);
    EXPECT_NE(refused(R"({"tests": {"boxes": 1}})")
                  .find("'boxes' is not a kind of test; give time, obb2d, obb3d, moving, aabb, block or samples"),
              std::string::npos);
    EXPECT_NE(refused(R"({"tests": {"time": -1}})").find("/expect/tests/time"), std::string::npos);
    EXPECT_NE(refused(R"({"tests": {"time": 1.5}})").find("give a whole number from 0"), std::string::npos);
    EXPECT_NE(refused("{}").find("collides"), std::string::npos);
    EXPECT_NE(refused(R"({"contact": null, "tests": {"time": 1}})").find("collides"), std::string::npos);
}

TEST(Scene, WithoutQueriesAllPairsOfAgentsAreAsked) {
    const Scene scene = parse_plain(std::string("{") + kTwoClips + R"(, "queries": [],
        "agents": [{"name": "A", "clip": "a"}, {"name": "B", "clip": "z"}, {"name": "C", "clip": "z"}]})");
    ASSERT_EQ(query_count(scene), 3u);
    EXPECT_EQ(query_at(scene, 0).a.name + query_at(scene, 0).b.name, "AB");
    EXPECT_EQ(query_at(scene, 1).a.name + query_at(scene, 1).b.name, "AC");
    EXPECT_EQ(query_at(scene, 2).a.name + query_at(scene, 2).b.name, "BC");
    EXPECT_EQ(query_at(scene, 2).b.agent, 2);
    EXPECT_EQ(placed_agents(scene)[2].agent, 2);
}

TEST(Scene, SourcesAreRelativeToTheSceneAndOverridesWin) {
    const TempFolder folder;
    std::filesystem::create_directory(folder.path() / "tracks");
    folder.write("tracks/two.csv", "id,x,y,r\n1,0,0,0.4\n2,5,0,0.4\n1,1,0,0.4\n");
    const auto file = folder.write("s.json", R"({"clips": {
        "first": {"source": "tracks/two.csv", "id": 1, "dt": 0.5},
        "second": {"source": "tracks/two.csv", "id": "2", "dt": 0.5, "radius": 0.2},
        "own": {"dt": 1, "samples": [[0, 0, 0.1]]}}})");
    const Scene scene = load_scene(file);
    EXPECT_EQ(scene.file, file);
    EXPECT_EQ(scene.clips[0].clip->count(), 2);
    EXPECT_EQ(scene.clips[1].clip->samples()[0].x, 5);
    EXPECT_EQ(scene.clips[1].clip->samples()[0].r, 0.2);
    ImportOptions overrides;
    overrides.radius = 0.7;
    const Scene changed = load_scene(file, overrides);
    EXPECT_EQ(changed.clips[0].clip->samples()[0].r, 0.7);
    EXPECT_EQ(changed.clips[1].clip->samples()[0].r, 0.7);
    EXPECT_EQ(changed.clips[2].clip->samples()[0].r, 0.7) << "that of samples in the scene too";
    EXPECT_EQ(changed.clips[1].options.radius, Radius(0.2)) << "the file's own option stays what it is";
}

TEST(Scene, AClipFileIsASceneWithItsClips) {
    const TempFolder folder;
    const Scene one = load_scene(folder.write("walk.csv", "t,x,y,r\n0,0,0,0.4\n1,1,0,0.4\n"));
    ASSERT_EQ(one.clips.size(), 1u);
    EXPECT_EQ(one.clips[0].name, "walk");
    EXPECT_TRUE(one.agents.empty());
    const Scene many = load_scene(folder.write("many.csv", "id,t,x,y,r\n8,0,0,0,0\n9,0,0,0,0\n8,1,0,0,0\n9,2,0,0,0\n"));
    ASSERT_EQ(many.clips.size(), 2u);
    EXPECT_EQ(many.clips[1].name, "9");
    EXPECT_EQ(many.clips[1].clip->dt(), 2);
}

}  // namespace
}  // namespace mobbscope
