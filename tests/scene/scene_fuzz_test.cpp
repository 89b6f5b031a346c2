// Damaged scene files give a scene or an InputError, nothing else, and soon.
#include <scene/fitted_scene.h>
#include <scene/scene.h>
#include <support/mutate.h>

#include <gtest/gtest.h>

namespace mobbscope {
namespace {

constexpr const char* kScene = R"({"$schema": "x", "mobbscope": 1,
 "clips": {"walk": {"dt": 0.5, "samples": [[0, 0, 0.4], [1, 0, 0.5], [2, 0.5, 0.4]]}, "b": {"dt": 1, "samples": [[0, 0, 0.3]]}},
 "graph": {"hubs": [{"name": "h"}, {"name": "g"}], "bounds": {"pose_distance": 0.1, "root_speed": null},
   "rigs": [{"joints": ["hips", "knee"]}],
   "moves": [{"clip": "walk", "from": 0, "to": 1, "entry": [0, 0, 0], "exit": [3, 0.5, 12], "rig": 0}, {"clip": "b", "from": 1, "to": 0, "entry": [0, 0, 0], "exit": [0, 0, 0]}]},
 "agents": [{"name": "A", "clip": "walk", "translate": [1, 2], "rotate_deg": 30, "start": 0.25, "color": "#E69F00"},
            {"name": "B", "clip": "b"}],
 "fit": {"tree": "umobb", "leaf": 1, "levels": 0, "axes": "endpoints", "time_scale": 1.0},
 "queries": [{"a": "A", "b": {"clip": "b", "translate": [0, 0], "rotate_deg": 0, "start": 0},
   "expect": {"collides": true, "contact": {"time": 0, "a_sample": 1, "b_sample": 0, "distance": 0.1, "radii": 0.9}},
   "trace": [{"step": 0, "parent": -1, "depth": 0, "a": 0, "b": 0, "test": "time", "outcome": "overlap", "axis": null},
             {"step": 1, "parent": 0, "depth": 1, "a": 1, "b": 0, "test": "obb3d", "outcome": "separated", "axis": 3, "gap": 1},
             {"step": 2, "parent": 1, "depth": 2, "a": 1, "b": 0, "test": "samples", "outcome": "hit", "pairs": [[0, 0, 0.5]]}]}],
 "view": {"camera": {"preset": "free", "yaw_deg": 10, "target": [0, 0, 1], "distance": 5}, "levels": "1:3", "step": "40%"}}
)";

constexpr const char* kCrowd = R"({"clips": {"walk": {"dt": 0.5, "samples": [[0, 0, 0.4], [1, 0, 0.5]]}},
 "graph": {"hubs": [{"name": "h"}],
   "moves": [{"clip": "walk", "from": 0, "to": 0, "entry": [0, 0, 0], "exit": [2, 0, 0]}]},
 "crowd": {"area": [30, 40], "seconds": 2, "seed": 3, "ahead": 0.5, "grace": 1, "agents": [
   {"name": "1", "plays": [{"move": 0, "translate": [1, 2], "rotate_deg": 0, "start": -0.5},
     {"move": 0, "translate": [3, 2], "rotate_deg": 0, "start": 0.5, "chosen_at": 0},
     {"move": 0, "translate": [5, 2], "rotate_deg": 30, "start": 1.5, "chosen_at": 1, "kind": "pivoted"}]},
   {"name": "2", "plays": [{"move": 0, "translate": [-1, 2], "rotate_deg": 0, "start": 0}]}]}}
)";

void read_damaged(const char* scene_text, unsigned seed) {
    std::mt19937 random(seed);
    int read = 0;
    int refused = 0;
    for (int round = 0; round < 30'000; ++round) {
        const std::string text = mutated(scene_text, random);
        try {
            const Scene scene = parse_scene(text, "fuzz.json", "");
            // What was let in must be fit for use.
            const FittedScene fitted(scene, scene.fit);
            for (std::size_t i = 0; i < fitted.queries().size(); ++i) record(fitted, fitted.queries()[i]);
            ASSERT_NO_THROW(parse_scene(to_json(scene), "again.json", "")) << text;
            ++read;
        } catch (const InputError& error) {
            ASSERT_LT(std::string_view(error.what()).size(), 600u) << error.what();
            ++refused;
        }
    }
    EXPECT_GT(read, 1000);
    EXPECT_GT(refused, 1000);
}

TEST(SceneFuzz, DamagedScenesAreReadOrRefused) { read_damaged(kScene, 20240608); }

TEST(SceneFuzz, DamagedRunsAreReadOrRefused) { read_damaged(kCrowd, 20240609); }

}  // namespace
}  // namespace mobbscope
