/// Small scenes to draw.
#pragma once

#include <scene/fitted_scene.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace mobbscope {
inline namespace testing {

/// A walk along x at 1 m/s, 30 samples a second, swaying a little.
inline mobb::ClipPtr walk(int samples) {
    std::vector<mobb::Disk> disks;
    for (int i = 0; i < samples; ++i) disks.push_back({i / 30.0, 0.05 * std::sin(0.2 * i), 0.4});
    return std::make_shared<const mobb::Clip>(1 / 30.0, std::move(disks));
}

inline Scene scene_of(std::vector<mobb::Placement> placements, int samples = 60) {
    Scene scene;
    scene.file = "scene.json";
    scene.clips.push_back({"walk", std::nullopt, {}, walk(samples)});
    for (const mobb::Placement& placement : placements) {
        const char letter = static_cast<char>('A' + scene.agents.size());
        scene.agents.push_back({std::string(1, letter), 0, placement, std::nullopt});
    }
    return scene;
}

/// Somebody seen 2.5 times a second who runs straight in between, with a radius that changes fast.
inline mobb::ClipPtr run(int samples, double dt = 0.4) {
    std::vector<mobb::Disk> disks;
    for (int i = 0; i < samples; ++i) {
        disks.push_back({1.4 * dt * i, 0.3 * std::sin(2.5 * dt * i), 0.3 + 0.15 * std::cos(7.5 * dt * i)});
    }
    return std::make_shared<const mobb::Clip>(dt, std::move(disks), mobb::Motion::linear);
}

/// The same with clips that run between samples.
inline Scene running_scene(std::vector<mobb::Placement> placements, int samples = 6, double dt = 0.4) {
    Scene scene = scene_of(std::move(placements));
    scene.clips.front().clip = run(samples, dt);
    return scene;
}

/// Two paths that cross at right angles and hit in the middle.
inline FittedScene hit_scene(mobb::TreeKind kind = mobb::TreeKind::mobb) {
    mobb::FitOptions options;
    options.tree = kind;
    options.leaf = 4;
    return {scene_of({{}, {{1, -1}, 90, 0}}), options};
}

/// Two paths side by side, clear of each other by about 0.2 m.
inline FittedScene miss_scene(mobb::TreeKind kind = mobb::TreeKind::mobb) {
    mobb::FitOptions options;
    options.tree = kind;
    options.leaf = 4;
    return {scene_of({{}, {{0, 1.1}, 0, 0}}), options};
}

}  // namespace testing
}  // namespace mobbscope
