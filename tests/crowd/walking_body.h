/// A body of three joints whose motion a test makes up.
#pragma once

#include <import/skeleton/motion.h>
#include <mobb/clip.h>
#include <scene/motion_graph.h>
#include <scene/scene.h>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope {
inline namespace testing {

inline constexpr double kBodyDt = 1.0 / 30;

inline double radians(double degrees) { return degrees * 3.14159265358979 / 180; }

/// The body in one frame, in its clip. The hips are bent forward, so their turn is not about one of their own axes.
struct BodyFrame {
    glm::dvec3 hips{0, 0, 1};
    double heading_deg = 0;
    glm::dvec3 hand{0, 0, 1.2};  ///< seen from the hips' place on the floor, turned by the heading
    glm::dvec3 foot{0, 0, 0};    ///< the same
};

inline SceneClip body_clip(const std::string& name, int frames, const std::function<BodyFrame(int)>& at,
                           double dt = kBodyDt) {
    std::vector<mobb::Disk> disks;
    auto skeleton = std::make_shared<Skeleton>();
    skeleton->joints = {{"Hips"}, {"Hand", 0}, {"Foot", 0}};
    for (int i = 0; i < frames; ++i) {
        const BodyFrame frame = at(i);
        disks.push_back({frame.hips.x, frame.hips.y, 0.4});
        const glm::dquat turn = glm::angleAxis(radians(frame.heading_deg), glm::dvec3(0, 0, 1));
        skeleton->positions.emplace_back(0, 0, frame.hips.z);
        skeleton->positions.emplace_back(turn * frame.hand);
        skeleton->positions.emplace_back(turn * frame.foot);
        const glm::dquat bent = glm::angleAxis(radians(40), glm::dvec3(0, 1, 0));
        for (int joint = 0; joint < 3; ++joint) skeleton->rotations.emplace_back(turn * bent);
    }
    skeleton->rest.assign(3, glm::quat(1, 0, 0, 0));
    return {name, {}, {}, std::make_shared<mobb::Clip>(dt, disks), {}, std::move(skeleton)};
}

/// A graph of one hub, with a move for each clip in their order.
inline Scene body_scene(std::vector<SceneClip> clips, const std::vector<std::pair<Stance, Stance>>& stances) {
    Scene scene;
    scene.clips = std::move(clips);
    MotionGraph graph;
    graph.hubs = {{"A"}};
    for (std::size_t i = 0; i < stances.size(); ++i)
        graph.moves.push_back({static_cast<int>(i), 0, 0, stances[i].first, stances[i].second});
    scene.graph = std::make_shared<const MotionGraph>(std::move(graph));
    return scene;
}

}  // namespace testing
}  // namespace mobbscope
