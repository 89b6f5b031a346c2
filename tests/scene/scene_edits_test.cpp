// Edits keep queries and agents of a scene together.
#include <scene/scene_edits.h>

#include <gtest/gtest.h>

#include <ctime>
#include <stdexcept>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

Scene parse(const std::string& rest = "") {
    return parse_scene(R"({"clips": {"walk": {"dt": 0.5, "samples": [[0, 0, 0.4], [1, 0, 0.5]]},
                                     "stand": {"dt": 1, "samples": [[0, 0, 0.3]]}})" +
                           rest + "}",
                       "s.json", "");
}

const std::string kAgents = R"(, "agents": [{"name": "A", "clip": "walk"}, {"name": "B", "clip": "walk", "start": 1},
                                             {"name": "C", "clip": "stand"}])";
const std::string kQueries = R"(, "queries": [{"a": "A", "b": "B", "expect": {"collides": true, "contact": null}},
                                               {"a": "C", "b": {"clip": "stand", "translate": [1, 0]}},
                                               {"a": "B", "b": "C"}])";

/// With a trace on the first query.
Scene traced() {
    Scene scene = parse(kAgents + kQueries);
    scene.queries[0].trace = std::make_shared<const mobb::Trace>();
    scene.queries[2].trace = std::make_shared<const mobb::Trace>();
    return scene;
}

std::string asked(const Scene& scene) {
    std::string out;
    for (std::size_t i = 0; i < query_count(scene); ++i) {
        const SceneQuery query = query_at(scene, i);
        out += query.a.name + '-' + query.b.name + ' ';
        // Copies of agents agree with them.
        for (const PlacedAgent& side : {query.a, query.b}) {
            if (side.agent < 0) continue;
            const Agent& agent = scene.agents.at(static_cast<std::size_t>(side.agent));
            EXPECT_EQ(side.name, agent.name);
            EXPECT_EQ(side.clip, agent.clip);
            EXPECT_EQ(side.placement, agent.placement);
        }
    }
    return out;
}

TEST(SceneEdits, PlacingAnAgentMovesItsQueriesAndDropsTheirTraces) {
    Scene scene = traced();
    place_agent(scene, 0, {{3, 4}, 90, 2});
    EXPECT_EQ(scene.queries[0].a.placement.translate, glm::dvec2(3, 4));
    EXPECT_FALSE(scene.queries[0].trace);
    EXPECT_TRUE(scene.queries[0].expect) << "the expectation stays: it is what is to be held against";
    EXPECT_TRUE(scene.queries[2].trace) << "it is not about A";
    EXPECT_EQ(asked(scene), "A-B C-stand B-C ");
    EXPECT_THROW(place_agent(scene, 0, {{1e300, 0}, 0, 0}), std::invalid_argument);
    EXPECT_THROW(place_agent(scene, 7, {}), std::out_of_range);
}

TEST(SceneEdits, RenamingGoesIntoTheQueries) {
    Scene scene = traced();
    rename_agent(scene, 2, "late one");
    EXPECT_EQ(asked(scene), "A-B late one-stand B-late one ");
    rename_agent(scene, 2, "late one");
    EXPECT_THROW(rename_agent(scene, 2, "A"), std::invalid_argument);
    EXPECT_THROW(rename_agent(scene, 2, "  "), std::invalid_argument);
}

TEST(SceneEdits, RemovingAnAgentRemovesItsQueries) {
    Scene scene = traced();
    remove_agent(scene, 0);
    EXPECT_EQ(asked(scene), "C-stand B-C ");
    EXPECT_EQ(scene.queries[1].a.agent, 0);
    EXPECT_EQ(scene.queries[1].b.agent, 1);
    remove_agent(scene, 1);
    EXPECT_EQ(asked(scene), "") << "one agent alone is asked against nobody";
    EXPECT_THROW(remove_agent(scene, 0), std::invalid_argument);
}

/// What the query in view asks; empty if none is.
std::string in_view(const Scene& scene) {
    if (!scene.view.query) return "";
    const SceneQuery query = query_at(scene, static_cast<std::size_t>(*scene.view.query));
    return query.a.name + '-' + query.b.name;
}

TEST(SceneEdits, TheQueryInViewStaysWhenAgentsComeAndGo) {
    for (const std::string& queries : {std::string(), kQueries}) {
        Scene scene = parse(kAgents + queries);
        scene.view.query = 2;
        ASSERT_EQ(in_view(scene), "B-C");
        add_agent(scene, 0);
        EXPECT_EQ(in_view(scene), "B-C");
        duplicate_agent(scene, 1);
        EXPECT_EQ(in_view(scene), "B-C");
        merge(scene, parse(kAgents));
        EXPECT_EQ(in_view(scene), "B-C");
        remove_agent(scene, 0);
        EXPECT_EQ(in_view(scene), "B-C");
        remove_agent(scene, 1);
        EXPECT_EQ(in_view(scene), "") << "C is gone";
    }
    Scene scene = parse(kAgents);
    scene.view.query = 0;
    remove_agent(scene, 0);
    EXPECT_EQ(in_view(scene), "") << "not the next pair, which has its number now";
}

TEST(SceneEdits, SourcesOfAFileNamedWithoutItsFolderLeadWhereTheyLed) {
    Scene scene = parse();
    scene.clips[0].source = "clips/walk.csv";
    move_to_file(scene, "deep/copy.json");
    EXPECT_EQ(scene.clips[0].source, "../clips/walk.csv");
    move_to_file(scene, "again.json");
    EXPECT_EQ(scene.clips[0].source, "clips/walk.csv");
}

TEST(SceneEdits, NewAgentsHaveNamesOfTheirOwn) {
    Scene scene = parse(kAgents);
    EXPECT_EQ(scene.agents[static_cast<std::size_t>(add_agent(scene, 1, {}))].name, "stand");
    EXPECT_EQ(scene.agents[static_cast<std::size_t>(add_agent(scene, 1, {}))].name, "stand 2");
    scene.agents[0].color = Color{1, 2, 3};
    const Agent& copy = scene.agents[static_cast<std::size_t>(duplicate_agent(scene, 0))];
    EXPECT_EQ(copy.name, "A 2");
    EXPECT_FALSE(copy.color);
    EXPECT_EQ(query_count(scene), 15u) << "all pairs are asked, with the new ones";
}

TEST(SceneEdits, ACopyOfACopyHasTheNextNumber) {
    Scene scene = parse(kAgents);
    int copy = 0;
    for (const char* name : {"A 2", "A 3", "A 4"}) {
        copy = duplicate_agent(scene, copy);
        EXPECT_EQ(scene.agents[static_cast<std::size_t>(copy)].name, name);
    }
    UnusedNames names;
    for (const char* name : {"walk 7", "7", " 7", "Tom 007", "x 99999999999", "x -3"}) names.take(name);
    EXPECT_EQ(names.take_next("walk 7"), "walk 8");
    EXPECT_EQ(names.take_next("7"), "7 2");
    EXPECT_EQ(names.take_next("Tom 007"), "Tom 8");
    EXPECT_EQ(names.take_next("x 99999999999"), "x 99999999999 2");
    EXPECT_EQ(names.take_next("x -3"), "x -3 2");
}

TEST(SceneEdits, ClipsBecomeAgentsWithTheFirstAgent) {
    Scene scene = parse();
    const int added = add_agent(scene, 0, {{5, 0}, 0, 0});
    ASSERT_EQ(scene.agents.size(), 3u);
    EXPECT_EQ(added, 2);
    EXPECT_EQ(scene.agents[0].name, "walk");
    EXPECT_EQ(scene.agents[1].name, "stand");
    EXPECT_EQ(scene.agents[2].name, "walk 2");
}

TEST(SceneEdits, AskingOnePairMoreKeepsThePairsThatWereAskedAnyway) {
    Scene scene = parse(kAgents);
    EXPECT_EQ(add_query(scene, 2, 0), 3u);
    EXPECT_EQ(asked(scene), "A-B A-C B-C C-A ");
    EXPECT_EQ(scene.queries.size(), 4u);
    EXPECT_THROW(add_query(scene, 1, 1), std::invalid_argument);
}

TEST(SceneEdits, RemovingAQueryKeepsTheOthers) {
    Scene scene = parse(kAgents);
    remove_query(scene, 1);
    EXPECT_EQ(asked(scene), "A-B B-C ");
    remove_query(scene, 0);
    EXPECT_THROW(remove_query(scene, 0), std::invalid_argument);
    EXPECT_EQ(asked(scene), "B-C ");
}

TEST(SceneEdits, TracesAreDroppedFromAll) {
    Scene scene = traced();
    drop_traces(scene);
    for (const SceneQuery& query : scene.queries) EXPECT_FALSE(query.trace);
}

TEST(SceneEdits, MergingGivesNumbersToNamesThatAreTaken) {
    Scene scene = parse(kAgents + kQueries);
    merge(scene, parse(kAgents + kQueries));
    ASSERT_EQ(scene.clips.size(), 4u);
    EXPECT_EQ(scene.clips[2].name, "walk 2");
    ASSERT_EQ(scene.agents.size(), 6u);
    EXPECT_EQ(scene.agents[3].name, "A 2");
    EXPECT_EQ(scene.agents[3].clip, 2);
    EXPECT_EQ(asked(scene), "A-B C-stand B-C A 2-B 2 C 2-stand 2 B 2-C 2 ");
    EXPECT_EQ(scene.queries[4].b.clip, 3);
    // It can be written and read again.
    EXPECT_EQ(asked(parse_scene(to_json(scene, true), "t.json", "")), asked(scene));
}

/// As files of one name from many folders are. Looking through all names for each number took a minute.
TEST(SceneEdits, ThousandsOfNamesThatAreTakenTakeNoTime) {
    const std::vector<Agent> alike(20'000, Agent{"walk", 0, {}, {}});
    const std::clock_t begin = std::clock();
    UnusedNames names;
    std::string last;
    for (const Agent& agent : alike) last = names.take(agent.name);
    EXPECT_EQ(last, "walk 20000");
    EXPECT_EQ(names.take("walk 7"), "walk 7 2") << "it is taken";
    EXPECT_EQ(UnusedNames(alike).take("walk"), "walk 2");
    EXPECT_LT(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, 2);
}

TEST(SceneEdits, MergingBareClipsIntoAgentsMakesThemAgents) {
    Scene scene = parse(kAgents);
    merge(scene, parse());
    ASSERT_EQ(scene.agents.size(), 5u);
    EXPECT_EQ(scene.agents[3].name, "walk");
    Scene bare = parse();
    merge(bare, parse());
    EXPECT_TRUE(bare.agents.empty());
    EXPECT_EQ(bare.clips.size(), 4u);
}

TEST(SceneEdits, MergingQueriesKeepsThePairsThatWereAskedAnyway) {
    Scene scene = parse(kAgents);
    merge(scene, parse(kAgents + kQueries));
    EXPECT_EQ(asked(scene), "A-B A-C B-C A 2-B 2 C 2-stand 2 B 2-C 2 ");
}

TEST(SceneEdits, SourcesLeadWhereTheyLedFromAnotherFolder) {
    Scene scene = parse();
    scene.file = "/data/scenes/s.json";
    scene.clips[0].source = "../clips/walk.bvh";
    scene.clips[1].source = "/elsewhere/stand.csv";
    move_to_file(scene, "/data/t.json");
    EXPECT_EQ(scene.clips[0].source, "clips/walk.bvh");
    EXPECT_EQ(scene.clips[1].source, "/elsewhere/stand.csv") << "an absolute one stays";
    EXPECT_EQ(scene.file, "/data/t.json");
    Scene other = parse();
    other.file = "/data/scenes/more/o.json";
    other.clips[0].source = "w.csv";
    merge(scene, other);
    EXPECT_EQ(scene.clips[2].source, "scenes/more/w.csv");
}

TEST(SceneEdits, ColoursAreReadAndWritten) {
    EXPECT_EQ(color_from_text("#E69f00"), (Color{0xe6, 0x9f, 0x00}));
    EXPECT_EQ(to_string(Color{0xe6, 0x9f, 0x00}), "#E69F00");
    for (const char* text : {"", "E69F00", "#E69F0", "#E69F000", "#E69F0g", "#-69F00"}) {
        EXPECT_FALSE(color_from_text(text)) << text;
    }
}

}  // namespace
}  // namespace mobbscope
