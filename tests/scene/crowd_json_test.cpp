// The key crowd: what is written is read back, and what does not fit together is refused at its place.
#include "scene_refusal.h"

#include <scene/crowd_run.h>
#include <scene/motion_graph.h>
#include <scene/scene.h>

#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace mobbscope {
namespace {

/// A clip of two seconds along +x and one of a second that turns to the left; hub 0 to hub 1 and back.
const std::string kHead = R"({"clips": {"a": {"dt": 1, "samples": [[0,0,0.5],[1,0,0.5]]},
"b": {"dt": 0.5, "samples": [[0,0,0.5],[1,1,0.5]]}},
"graph": {"hubs": [{"name": "left"}, {"name": "right"}],
"moves": [{"clip": "a", "from": 0, "to": 1, "entry": [0,0,0], "exit": [2,0,0]},
          {"clip": "b", "from": 1, "to": 0, "entry": [0,0,0], "exit": [1,2,90]}]},
)";

std::string crowd(const std::string& agents) {
    return kHead + R"("crowd": {"area": [30, 40], "seconds": 5, "seed": 7, "agents": )" + agents + "}}";
}

std::string plays(const std::string& list) { return crowd("[{\"name\": \"1\", \"plays\": [" + list + "]}]"); }

const std::string kFirst = R"({"move": 0, "translate": [3, 4], "rotate_deg": 90, "start": -0.5})";

TEST(CrowdJson, ARunIsReadWrittenAndReadAgain) {
    const Scene scene = parse_scene(
        kHead +
            R"("crowd": {"area": [30.5, 40], "seconds": 5, "seed": 9007199254740992, "ahead": 0.25, "grace": 2, "plan": 4,
        "agents": [{"name": "1", "plays": [)" +
            kFirst + R"(,
          {"move": 1, "translate": [3, 6], "rotate_deg": 90, "start": 1.5, "chosen_at": 1.25, "plan": [[0, 0], [1, -15]]},
          {"move": 0, "translate": [1, 7], "rotate_deg": 195, "start": 2.5, "chosen_at": 2.25, "kind": "pivoted"},
          {"move": 1, "translate": [-0.93185165257813651, 6.4823619097949585], "rotate_deg": 15, "start": 4.5,
           "kind": "forced"}]},
        {"name": "two", "plays": [{"move": 1, "translate": [0, 0], "rotate_deg": 0, "start": 0}]}]}})",
        "s.json", "");
    const CrowdRun& run = *scene.crowd;
    EXPECT_EQ(run.area, glm::dvec2(30.5, 40));
    EXPECT_EQ(run.seed, kMaxSeed);
    EXPECT_EQ(run.ahead, 0.25);
    EXPECT_EQ(run.grace, 2);
    EXPECT_EQ(run.plan, 4);
    ASSERT_EQ(run.agents.size(), 2u);
    EXPECT_EQ(run.agents[1].name, "two");
    const std::vector<Play> expected{
        {0, {{3, 4}, 90, -0.5}, -0.5, PlayKind::chosen},
        {1, {{3, 6}, 90, 1.5}, 1.25, PlayKind::chosen, {{0, 0}, {1, -15}}},
        {0, {{1, 7}, 195, 2.5}, 2.25, PlayKind::pivoted},
        {1, {{-0.93185165257813651, 6.4823619097949585}, 15, 4.5}, 4.5, PlayKind::forced},
    };
    EXPECT_EQ(run.agents[0].plays, expected);
    const Scene again = parse_scene(to_json(scene), "s.json", "");
    EXPECT_EQ(*again.crowd, run);
    EXPECT_EQ(*again.graph, *scene.graph);
}

TEST(CrowdJson, PlaysFollowEachOther) {
    const std::string end = R"(,
{"move": 1, "translate": [3, 6], "rotate_deg": 90, "start": 1.5)";
    EXPECT_NO_THROW(parse_scene(plays(kFirst + end + "}"), "s.json", ""));
    const auto expect = [&](const std::string& text, const std::string& message) {
        EXPECT_EQ(scene_refusal(plays(kFirst + ",\n" + text)), message);
    };
    expect(R"({"move": 0, "translate": [3, 6], "rotate_deg": 90, "start": 1.5})",
           "s.json: line 7, /crowd/agents/0/plays/1/move: begins in hub 'left', but the move before ends in 'right'");
    expect(R"({"move": 1, "translate": [3, 6], "rotate_deg": 90, "start": 1.50001})",
           "s.json: line 7, /crowd/agents/0/plays/1/start: the play before ends at 1.5 s; begin there");
    expect(R"({"move": 1, "translate": [3, 6.00001], "rotate_deg": 90, "start": 1.5})",
           "s.json: line 7, /crowd/agents/0/plays/1/translate: begins at (3, 6.00001), but the play before ends at "
           "(3, 6)");
    expect(R"({"move": 1, "translate": [3, 6], "rotate_deg": 75, "start": 1.5})",
           "s.json: line 7, /crowd/agents/0/plays/1/rotate_deg: faces -15 degrees off the end of the play before; "
           "only a pivoted one may, in a run without turn_rate");
    expect(R"({"move": 1, "translate": [3, 6], "rotate_deg": 90, "start": 1.5, "chosen_at": -0.75})",
           "s.json: line 7, /crowd/agents/0/plays/1: chosen at -0.75 s, before the play before it, at -0.5 s");
    // A whole turn more is the same heading.
    EXPECT_NO_THROW(parse_scene(
        plays(kFirst + R"(, {"move": 1, "translate": [3, 6], "rotate_deg": -270, "start": 1.5})"), "s.json", ""));
}

TEST(CrowdJson, ValuesAreChecked) {
    const std::pair<std::string, const char*> cases[] = {
        {plays(R"({"move": 2, "translate": [0, 0], "rotate_deg": 0, "start": 0})"), "plays/0/move: 2 is out of range"},
        {plays(R"({"move": -1, "translate": [0, 0], "rotate_deg": 0, "start": 0})"), "plays/0/move: -1 is out of"},
        {plays(R"({"move": 0, "translate": [0], "rotate_deg": 0, "start": 0})"), "give [x, y] in metres"},
        {plays(R"({"move": 0, "translate": [0, 0], "start": 0})"), "the key 'rotate_deg' is missing"},
        {plays(R"({"move": 0, "translate": [0, 0], "rotate_deg": 0})"), "the key 'start' is missing"},
        {plays(R"({"move": 0, "translate": [0, 0], "rotate_deg": 0, "start": 0, "chosen_at": 1})"), "chosen_at: 1 is"},
        {plays(R"({"move": 0, "translate": [0, 0], "rotate_deg": 0, "start": 0, "kind": "forsed"})"),
         "plays/0/kind: 'forsed' is not a kind of play; give chosen, pivoted, forced"},
        {plays(R"({"move": 0, "translate": [0, 0], "rotate_deg": 0, "start": 0, "clip": "a"})"), "unknown key 'clip'"},
        {plays(R"({"move": 0, "translate": [0, 0], "rotate_deg": 0, "start": 0, "plan": [[1, 0], [1, 0]]})"),
         "plays/0/plan/1: begins in hub 'right', but the move before ends in 'left'"},
        {plays(R"({"move": 0, "translate": [0, 0], "rotate_deg": 0, "start": 0, "plan": [[2, 0]]})"), "plan/0/0: 2 is"},
        {plays(R"({"move": 0, "translate": [0, 0], "rotate_deg": 0, "start": 0, "plan": [[1, 181]]})"),
         "plan/0/1: 181 is"},
        {plays(R"({"move": 0, "translate": [0, 0], "rotate_deg": 0, "start": 0, "plan": [[1]]})"),
         "give [move, turn in degrees]"},
        {plays(R"({"move": 0, "translate": [999999999, 0], "rotate_deg": 0, "start": 0, "plan": [[1, 0]]})"),
         "plan/0: leads beyond what can be placed"},
        {kHead + R"("crowd": {"area": [1, 1], "seconds": 1, "seed": 1, "plan": -1, "agents": []}})", "/plan: -1 is"},
        {plays(""), "/crowd/agents/0/plays: an agent plays one move at least; add one"},
        {crowd("[]"), "/crowd/agents: there is no agent; add one"},
        {crowd(R"([{"name": "", "plays": []}])"), "an agent needs a name"},
        {crowd("[{\"name\": \"1\", \"plays\": [" + kFirst + "]}, {\"name\": \"1\", \"plays\": [" + kFirst + "]}]"),
         "/crowd/agents/1/name: another agent is named '1'; rename one"},
        {kHead + R"("crowd": {"area": [0, 1], "seconds": 1, "seed": 1, "agents": []}})", "/area/0: must be over 0"},
        {kHead + R"("crowd": {"area": [1], "seconds": 1, "seed": 1, "agents": []}})", "give [width, depth] in metres"},
        {kHead + R"("crowd": {"area": [1, 1], "seconds": 0, "seed": 1, "agents": []}})", "/seconds: must be over 0"},
        {kHead + R"("crowd": {"area": [1, 1], "seconds": 1, "seed": 1.5, "agents": []}})", "/seed: 1.5 is not a seed"},
        {kHead + R"("crowd": {"area": [1, 1], "seconds": 1, "seed": -1, "agents": []}})", "/seed: -1 is out of"},
        {kHead + R"("crowd": {"area": [1, 1], "seconds": 1, "seed": 1, "ahead": -1, "agents": []}})", "/ahead: -1 is"},
        {kHead + R"("crowd": {"area": [1, 1], "seconds": 1, "seed": 1, "grace": -1, "agents": []}})", "/grace: -1 is"},
        {kHead + R"("crowd": {"area": [1, 1], "second": 1, "seed": 1, "agents": []}})", "unknown key 'second'"},
        {R"({"clips": {"a": {"dt": 1, "samples": [[0,0,1]]}}, "crowd": {}})", "/crowd: a crowd plays the moves of a"},
        {kHead + R"("agents": [{"name": "A", "clip": "a"}], "crowd": {}})",
         "/crowd: a scene has a crowd, or agents and queries, not both; remove one"},
        {kHead + R"("queries": [{"a": {"clip": "a"}, "b": {"clip": "a"}}], "crowd": {}})", "not both; remove one"},
    };
    for (const auto& [text, message] : cases) {
        EXPECT_NE(scene_refusal(text).find(message), std::string::npos) << message << "\ngave " << scene_refusal(text);
    }
}

}  // namespace
}  // namespace mobbscope
