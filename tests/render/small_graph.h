/// A motion graph to draw.
#pragma once

#include <scene/motion_graph.h>
#include <scene/scene.h>

#include <glm/vec2.hpp>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace mobbscope {
inline namespace testing {

/// Three hubs that lead to each other and one by itself; moves are arcs of different speeds and turns.
inline Scene small_graph() {
    Scene scene;
    auto graph = std::make_shared<MotionGraph>();
    graph->hubs = {{"A"}, {"B"}, {"C"}, {"D"}};
    graph->bounds = {0.16, 0.6};
    const auto add = [&](int from, int to, double speed, double turn_deg) {
        constexpr int kCount = 60;
        const double per_step = turn_deg / kCount * 3.14159265358979 / 180;
        std::vector<mobb::Disk> samples;
        glm::dvec2 at(3, 4);
        for (int i = 0; i < kCount; ++i) {
            samples.push_back({at.x, at.y, 0.3});
            at += speed / 30 * glm::dvec2(std::cos(i * per_step), std::sin(i * per_step));
        }
        graph->moves.push_back({static_cast<int>(scene.clips.size()), from, to, {{3, 4}, 0}, {at, turn_deg}});
        scene.clips.push_back(
            {std::to_string(scene.clips.size()), {}, {}, std::make_shared<mobb::Clip>(1.0 / 30, samples)});
    };
    for (int i = 0; i < 9; ++i) add(0, i % 3, 0.8 + 0.2 * i, 20.0 * i - 80);
    for (int i = 0; i < 4; ++i) add(1, 2 - i % 3, 1.5, 30.0 * i - 45);
    add(2, 0, 0.4, 0);
    add(3, 3, 1, 90);
    scene.graph = graph;
    return scene;
}

}  // namespace testing
}  // namespace mobbscope
