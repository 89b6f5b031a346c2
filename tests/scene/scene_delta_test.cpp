// A scene said by what differs from another is that scene again.
#include <scene/scene_delta.h>
#include <scene/scene_edits.h>

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

Scene crossing(int agents) {
    std::string text = R"({"clips": {"walk": {"dt": 0.1, "samples": [[0, 0, 0.4], [1, 0, 0.4]]}}, "agents": [)";
    for (int i = 0; i < agents; ++i) {
        text += std::string(i > 0 ? "," : "") + R"({"name": "a )" + std::to_string(i) + R"(", "clip": "walk"})";
    }
    return parse_scene(text + R"(], "queries": [{"a": "a 0", "b": "a 1"}, {"a": "a 1", "b": "a 2"}]})", "t.json", "");
}

TEST(SceneDelta, GivesTheSceneBack) {
    const std::vector<std::function<void(Scene&)>> edits{
        [](Scene&) {},
        [](Scene& scene) { duplicate_agent(scene, 2); },
        [](Scene& scene) { remove_agent(scene, 1); },
        [](Scene& scene) { rename_agent(scene, 0, "somebody else"); },
        [](Scene& scene) {
            place_agent(scene, 1, {{1, 2}, 3, 4});
        },
        [](Scene& scene) { remove_query(scene, 0); },
        [](Scene& scene) { merge(scene, crossing(3)); },
        [](Scene& scene) { scene.agents = std::vector<Agent>(5, scene.agents[0]); },
        [](Scene& scene) { scene.fit.leaf = 3; },
        [](Scene& scene) { scene.file = "/tmp/other.json"; },
        [](Scene& scene) { scene = {}; },
    };
    for (std::size_t i = 0; i < edits.size(); ++i) {
        SCOPED_TRACE(i);
        const Scene before = crossing(4);
        Scene after = before;
        edits[i](after);
        for (const auto& [scene, base] : {std::pair(before, after), std::pair(after, before)}) {
            const Scene again = SceneDelta(scene, base).applied(base);
            EXPECT_EQ(again.file, scene.file);
            EXPECT_TRUE(again.clips == scene.clips);
            EXPECT_TRUE(again.agents == scene.agents);
            EXPECT_TRUE(again.queries == scene.queries);
            EXPECT_EQ(again.fit, scene.fit);
            EXPECT_EQ(to_json(again), to_json(scene));
        }
    }
}

TEST(SceneDelta, TakesNoMemoryForWhatIsTheSame) {
    const auto bytes = [](int agents) {
        const Scene before = crossing(agents);
        Scene after = before;
        place_agent(after, agents / 2, {{1, 2}, 3, 4});
        return SceneDelta(before, after).bytes();
    };
    EXPECT_EQ(bytes(4), bytes(2000));
    EXPECT_GT(SceneDelta(crossing(2000), Scene{}).bytes(), bytes(4) + 1999 * sizeof(Agent));
}

}  // namespace
}  // namespace mobbscope
