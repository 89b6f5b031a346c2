// Filters, breakpoints and bookmarks are kept with the scene, and follow its queries.
#include <scene/scene_edits.h>
#include <support/input_error.h>

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace mobbscope {
namespace {

constexpr const char* kDebug = R"({
    "filters": [{"name": "tight", "where": "gap < 0.05"}],
    "breakpoints": [{"where": "outcome = hit"}, {"where": "depth > 3", "on": false}],
    "bookmarks": [{"name": "first", "query": 0, "step": 4}, {"name": "last", "query": 2, "step": 9, "note": "see \"why\""}]})";

Scene debugged(const std::string& debug = kDebug, const std::string& more = "") {
    return parse_scene(R"({"clips": {"walk": {"dt": 0.5, "samples": [[0, 0, 0.4], [1, 0, 0.5]]}},
        "agents": [{"name": "A", "clip": "walk"}, {"name": "B", "clip": "walk"}, {"name": "C", "clip": "walk"}])" +
                           more + R"(, "debug": )" + debug + "}",
                       "s.json", "");
}

/// "first 0, last 2"
std::string marks(const Scene& scene) {
    std::string out;
    for (const Bookmark& each : scene.debug.bookmarks) {
        const SceneQuery query = query_at(scene, static_cast<std::size_t>(each.query));
        out += (out.empty() ? "" : ", ") + each.name + ' ' + query.a.name + query.b.name;
    }
    return out;
}

TEST(DebugState, IsReadAndWritten) {
    const Scene scene = debugged();
    ASSERT_EQ(scene.debug.filters.size(), 1u);
    EXPECT_EQ(scene.debug.filters[0].where, "gap < 0.05");
    ASSERT_EQ(scene.debug.breakpoints.size(), 2u);
    EXPECT_TRUE(scene.debug.breakpoints[0].on);
    EXPECT_FALSE(scene.debug.breakpoints[1].on);
    EXPECT_EQ(marks(scene), "first AB, last BC");
    EXPECT_EQ(scene.debug.bookmarks[1].note, "see \"why\"");
    const Scene again = parse_scene(to_json(scene), "s.json", "");
    EXPECT_EQ(again.debug, scene.debug);
    EXPECT_EQ(to_json(Scene{}).find("debug"), std::string::npos) << "without any nothing is written";
}

TEST(DebugState, IsRefusedWithItsPlace) {
    const auto refusal = [](const std::string& debug) { return input_error([&] { debugged(debug); }); };
    const std::string filter = refusal(R"({"filters": [{"name": "x", "where": "gpa < 1"}]})");
    EXPECT_NE(
        filter.find("/debug/filters/0/where: at character 1 of 'gpa < 1': 'gpa' is not a field (did you mean 'gap'?)"),
        std::string::npos)
        << filter;
    for (const char* debug :
         {R"([])", R"({"filter": []})", R"({"filters": [{"name": "", "where": "step = 1"}]})",
          R"({"filters": [{"where": "step = 1"}]})",
          R"({"filters": [{"name": "x", "where": "step = 1"}, {"name": "x", "where": "step = 2"}]})",
          R"({"breakpoints": [{"where": "step = 1"}, {"where": "step = 1"}]})",
          R"({"breakpoints": [{"where": "step = 1", "on": 1}]})", R"({"bookmarks": [{"query": 3, "step": 0}]})",
          R"({"bookmarks": [{"query": 0}]})", R"({"bookmarks": [{"query": 0, "step": -1}]})",
          R"({"bookmarks": [{"query": 0.5, "step": 1}]})"}) {
        EXPECT_NE(refusal(debug).find("/debug"), std::string::npos) << debug << ": " << refusal(debug);
    }
}

constexpr const char* kViews =
    R"({"views": [{"name": " from behind ", "view": {"camera": {"preset": "front"}, "query": 2}},
    {"name": "B alone", "view": {"hidden": ["A"], "subtree": {"participant": 1, "node": 0}}}]})";

TEST(DebugState, HasNamedViews) {
    const Scene scene = debugged(kViews);
    ASSERT_EQ(scene.debug.views.size(), 2u);
    EXPECT_EQ(scene.debug.views[0].name, "from behind");
    EXPECT_EQ(scene.debug.views[0].view.camera.preset, CameraPreset::front);
    EXPECT_EQ(scene.debug.views[1].view.subtree, (DrawnNode{1, 0}));
    EXPECT_EQ(parse_scene(to_json(scene), "s.json", "").debug, scene.debug);
    for (const auto& [views, why] : {std::pair(R"([{"name": "x"}])", "view"), std::pair(R"([{"view": {}}])", "name"),
                                     std::pair(R"([{"name": " ", "view": {}}])", "/debug/views/0/name"),
                                     std::pair(R"([{"name": "x", "view": {"levls": 1}}])", "/debug/views/0/view"),
                                     std::pair(R"([{"name": "x", "view": {}}, {"name": "x", "view": {}}])",
                                               "/debug/views/1/name: another view is named 'x'"),
                                     std::pair(R"([{"name": " top ", "view": {}}])",
                                               "/debug/views/0/name: 'top' is a camera that every scene has"),
                                     std::pair(R"({})", "/debug/views")}) {
        const std::string text = views;
        const std::string refused = input_error([&] { debugged(R"({"views": )" + text + "}"); });
        EXPECT_NE(refused.find(why), std::string::npos) << views << ": " << refused;
        EXPECT_EQ(refused.find('\n'), std::string::npos);
    }
}

TEST(DebugState, NamedViewsFollowAgentsAndQueries) {
    Scene scene = debugged(kViews);
    scene.view.subtree = DrawnNode{0, 3};
    const std::vector<NamedView>& views = scene.debug.views;
    duplicate_agent(scene, 0);
    EXPECT_EQ(views[0].view.query, 3) << "AB AC AA BC BA CA";
    rename_agent(scene, 0, "first");
    EXPECT_EQ(views[1].view.hidden, std::vector<std::string>{"first"});
    remove_agent(scene, 0);
    EXPECT_EQ(views[0].view.query, 0);
    EXPECT_EQ(views[1].view.subtree, (DrawnNode{0, 0})) << "B is the first now";
    EXPECT_EQ(scene.view.subtree, std::nullopt) << "it was of the one that is gone";
    remove_agent(scene, 0);
    EXPECT_EQ(views[0].view.query, std::nullopt);
    EXPECT_EQ(views[1].view.subtree, std::nullopt);
    Scene both = debugged(kViews);
    merge(both, debugged(kViews));
    ASSERT_EQ(both.debug.views.size(), 4u);
    EXPECT_EQ(both.debug.views[3].name, "B alone 2");
    EXPECT_EQ(both.debug.views[3].view.subtree, (DrawnNode{4, 0}));
    EXPECT_EQ(query_at(both, static_cast<std::size_t>(*both.debug.views[2].view.query)).a.name, "B 2");
}

TEST(DebugState, BookmarksFollowImpliedQueries) {
    Scene scene = debugged();
    scene.view.query = 2;
    duplicate_agent(scene, 0);
    EXPECT_EQ(marks(scene), "first AB, last BC");
    EXPECT_EQ(scene.view.query, 3) << "AB AC AA BC BA CA";
    remove_agent(scene, 0);
    EXPECT_EQ(marks(scene), "last BC");
    EXPECT_EQ(scene.view.query, 0);
    remove_agent(scene, 1);
    EXPECT_EQ(marks(scene), "");
    EXPECT_EQ(scene.view.query, std::nullopt);
}

TEST(DebugState, BookmarksFollowQueriesThatAreListed) {
    Scene scene =
        debugged(kDebug, R"(, "queries": [{"a": "A", "b": "B"}, {"a": "A", "b": "C"}, {"a": "B", "b": "C"}])");
    scene.view.query = 1;
    Scene other = scene;
    remove_query(scene, 0);
    EXPECT_EQ(marks(scene), "last BC");
    EXPECT_EQ(scene.view.query, 0);
    remove_query(scene, 0);
    EXPECT_EQ(marks(scene), "last BC");
    EXPECT_EQ(scene.view.query, std::nullopt);
    remove_agent(other, 1);
    EXPECT_EQ(marks(other), "") << "both bookmarks are about B";
    EXPECT_EQ(other.view.query, 0);
}

TEST(DebugState, OfTwoScenesIsPutTogether) {
    const std::string queries = R"(, "queries": [{"a": "A", "b": "B"}, {"a": "A", "b": "C"}, {"a": "B", "b": "C"}])";
    Scene scene = debugged(kDebug, queries);
    merge(scene, debugged(R"({"filters": [{"name": "tight", "where": "gap < 0.01"}],
        "breakpoints": [{"where": "outcome = hit"}, {"where": "step = 7"}], "bookmarks": [{"name": "b", "query": 1, "step": 0}]})",
                          queries));
    ASSERT_EQ(scene.debug.filters.size(), 2u);
    EXPECT_EQ(scene.debug.filters[1].name, "tight 2");
    ASSERT_EQ(scene.debug.breakpoints.size(), 3u);
    EXPECT_EQ(scene.debug.breakpoints[2].where, "step = 7");
    EXPECT_EQ(scene.debug.bookmarks.back().query, 4);
    EXPECT_EQ(parse_scene(to_json(scene), "s.json", "").debug, scene.debug);
}

TEST(DebugState, BookmarksOfTwoScenesKeepTheirPairs) {
    const std::string listed = R"(, "queries": [{"a": "B", "b": "C"}, {"a": "A", "b": "B"}, {"a": "A", "b": "C"}])";
    const auto merged = [&](const std::string& first, const std::string& second) {
        Scene scene = debugged(kDebug, first);
        merge(scene, debugged(kDebug, second));
        EXPECT_EQ(parse_scene(to_json(scene), "s.json", "").debug, scene.debug);
        return marks(scene);
    };
    EXPECT_EQ(merged("", ""), "first AB, last BC, first A 2B 2, last B 2C 2");
    EXPECT_EQ(merged(listed, listed), "first BC, last AC, first B 2C 2, last A 2C 2");
    EXPECT_EQ(merged("", listed), "first AB, last BC, first B 2C 2, last A 2C 2");
    EXPECT_EQ(merged(listed, ""), "first BC, last AC") << "the other's pairs are not asked any more";
}

TEST(DebugState, BookmarksAreToldApart) {
    const Scene scene = debugged(R"({"bookmarks": [{"query": 0, "step": 1}, {"query": 0, "step": 1},
        {"name": "#q0@1", "query": 0, "step": 2}, {"name": "x", "query": 1, "step": 0}, {"name": "x", "query": 2, "step": 0}]})");
    EXPECT_EQ(names_of_bookmarks(scene.debug), (std::vector<std::string>{"#q0@1", "#q0@1 2", "#q0@1 3", "x", "x 2"}));
}

}  // namespace
}  // namespace mobbscope
