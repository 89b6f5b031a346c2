/// Scenes for measurements of pictures.
#pragma once

#include "walks.h"

#include <crowd/graph/build_graph.h>
#include <crowd/simulation/simulate.h>
#include <scene/crowd_run.h>
#include <scene/fitted_scene.h>
#include <scene/motion_graph.h>

#include <cmath>
#include <memory>
#include <string>

namespace mobbscope::bench {

/// Agents on 30 x 40 m that walk for two seconds (60 samples), each its own way, and begin within eight seconds.
inline Scene crowd(int agents) {
    mobb::test::Random random(7);
    Scene scene;
    for (int i = 0; i < agents; ++i) {
        scene.clips.push_back({"walk" + std::to_string(i), std::nullopt, {}, mobb::bench::walk(random, 2)});
        const mobb::Placement somewhere{.translate = {random.real(0, 30), random.real(0, 40)},
                                        .rotate_deg = random.real(0, 360),
                                        .start = random.real(0, 8)};
        scene.agents.push_back({"agent " + std::to_string(i), i, somewhere, std::nullopt});
    }
    return scene;
}

/// A run of so many agents, 12 m^2 for each, that play walks of two seconds for `seconds`.
inline Scene run(int agents, double seconds) {
    mobb::test::Random random(3);
    Scene scene;
    for (int i = 0; i < 8; ++i) {
        scene.clips.push_back({"walk" + std::to_string(i), std::nullopt, {}, mobb::bench::walk(random, 2)});
    }
    scene.graph = std::make_shared<const MotionGraph>(graph_of_whole_clips(scene));
    const FittedScene fitted(scene, {});
    SimulateOptions options;
    options.agents = agents;
    const double side = std::sqrt(12.0 * agents);
    options.area = {side, side};
    options.seconds = seconds;
    const MoveSet moves(fitted);
    return scene_of_run(moves, simulate(moves, options).run);
}

/// Two agents whose walks cross for so many seconds, with the query between them in the view.
inline Scene pair(double seconds) {
    mobb::test::Random random(11);
    Scene scene;
    for (int i = 0; i < 2; ++i) {
        const std::string name = i == 0 ? "a" : "b";
        scene.clips.push_back({name, std::nullopt, {}, mobb::bench::walk(random, seconds)});
        const mobb::Placement place{.translate = {1.5 * i, 0}, .rotate_deg = 90.0 * i, .start = 0.5 * i};
        scene.agents.push_back({name, i, place, std::nullopt});
    }
    scene.view.query = 0;
    return scene;
}

}  // namespace mobbscope::bench
