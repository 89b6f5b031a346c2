/// A small graph of walks that tests play.
#pragma once

#include <crowd/graph/build_graph.h>
#include <crowd/simulation/choice.h>
#include <crowd/simulation/plan_search.h>
#include <crowd/simulation/reservation_table.h>
#include <crowd/simulation/simulate.h>
#include <scene/crowd_run.h>
#include <scene/motion_graph.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope {
inline namespace testing {

/// A walk at `speed` m/s for `samples` samples of `dt` seconds that turns by `turn_deg` on the way.
inline SceneClip walk(const std::string& name, double speed, double turn_deg, int samples, double dt, double radius) {
    std::vector<mobb::Disk> disks;
    double x = 0, y = 0;
    for (int i = 0; i < samples; ++i) {
        disks.push_back({x, y, radius + 0.05 * std::sin(0.5 * i)});
        const double heading = turn_deg * 3.14159265358979 / 180 * i / samples;
        x += speed * dt * std::cos(heading);
        y += speed * dt * std::sin(heading);
    }
    return {name, {}, {}, std::make_shared<mobb::Clip>(dt, disks), {}, {}};
}

/// Seven walks of 0.6 to 2.4 seconds, one of them backwards, each of which may follow each.
inline Scene walker_scene() {
    Scene scene;
    scene.clips = {walk("ahead", 1.4, 0, 45, 1.0 / 30, 0.4),    walk("left", 1.2, 60, 40, 1.0 / 30, 0.42),
                   walk("right", 1.2, -60, 40, 1.0 / 30, 0.42), walk("run", 3.5, 10, 36, 1.0 / 60, 0.5),
                   walk("slow", 0.5, -20, 72, 1.0 / 30, 0.35),  walk("around", 0.9, 150, 60, 1.0 / 25, 0.4),
                   walk("step", 0.8, 30, 18, 1.0 / 30, 0.38)};
    scene.graph = std::make_shared<MotionGraph>(graph_of_whole_clips(scene));
    return scene;
}

/// The same clips, of which every `every`-th runs on linearly.
inline Scene with_linear_clips(Scene scene, std::size_t every = 1) {
    for (std::size_t i = 0; i < scene.clips.size(); i += every) {
        const mobb::Clip& held = *scene.clips[i].clip;
        scene.clips[i].clip = std::make_shared<const mobb::Clip>(
            held.dt(), std::vector<mobb::Disk>(held.samples().begin(), held.samples().end()), mobb::Motion::linear);
    }
    return scene;
}

/// Where `next` lies if it follows `before`, which is placed. Indices into the moves of the scene's graph.
inline mobb::Placement following(const Scene& scene, int before, const mobb::Placement& placed, int next) {
    const GraphMove& from = scene.graph->moves[static_cast<std::size_t>(before)];
    const GraphMove& to = scene.graph->moves[static_cast<std::size_t>(next)];
    const double until_next = scene.clips[static_cast<std::size_t>(from.clip)].clip->until_next();
    return mobbscope::following(placed, from.exit, until_next, to.entry);
}

/// What `agents` do with the scene's graph in 20 s on a floor of `area` metres, as its crowd. Without a plan some are
/// forced where it is narrow.
inline Scene with_run(Scene scene, int agents, glm::dvec2 area, double plan = 0) {
    SimulateOptions options;
    options.agents = agents;
    options.area = area;
    options.seconds = 20;
    options.plan = plan;
    const FittedScene fitted(scene, {});
    const MoveSet moves(fitted);
    return scene_of_run(moves, simulate(moves, options).run);
}

/// One choice by itself.
inline Choice choice_at(const MoveSet& moves, const ReservationTable& reservations, const CrowdRun& run,
                        const ChoicePoint& point) {
    PlanSearch search(moves, reservations, run);
    return choose(moves, reservations, run, point, search);
}

}  // namespace testing
}  // namespace mobbscope
