/// A part of a motion bent at both ends so that it begins and ends in given poses: displacement maps that fade away
/// (Witkin and Popovic 1995), as Snap-Together Motion has them (Gleicher et al. 2003, section 4.2).
#pragma once

#include <import/skeleton/motion.h>
#include <mobb/clip.h>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace mobbscope {

/// How a joint hangs on the one above it, and turns. Below the root the joint above is the parent; what is not below
/// the root hangs on the root. The root itself hangs on the floor under it, with +x the heading.
struct HangingJoint {
    glm::dquat rotation{1, 0, 0, 0};  ///< of its own axes to those of the joint above
    glm::dvec3 spin{0};               ///< angular velocity, radians per second, in the axes of the joint above
    glm::dvec3 offset{0};             ///< metres, in the axes of the joint above; of the root 0
    friend bool operator==(const HangingJoint&, const HangingJoint&) = default;
};

/// A pose and how it changes, wherever on the floor and whichever way it faces.
struct MovingPose {
    double height = 0;                 ///< of the root, metres
    glm::dvec3 velocity{0};            ///< of the root, metres per second: x along the heading, y to the left, z up
    std::vector<HangingJoint> joints;  ///< one for each joint of the skeleton
    friend bool operator==(const MovingPose&, const MovingPose&) = default;
};

/// Frame `frame` of a skeleton, seen along a heading in degrees; velocities from the frame before to the one after,
/// which exist. `clip` is what the skeleton belongs to.
MovingPose moving_pose(const mobb::Clip& clip, const Skeleton& skeleton, int frame, double heading_deg);

/// Joint by joint; at least one pose, all of as many joints.
MovingPose mean(std::span<const MovingPose> poses);

/// What a motion is warped to at one end.
struct WarpEnd {
    std::string name;  ///< of the pose, as in files
    std::shared_ptr<const MovingPose> pose;
    double heading_deg = 0;  ///< of the pose in the clip
};

/// How a clip is warped.
struct ClipWarp {
    double seconds = 0;  ///< at either end, over 0; never more than half of the clip
    WarpEnd begin;       ///< at the first sample
    WarpEnd end;         ///< one dt after the last
};

struct WarpedClip {
    mobb::ClipPtr clip;
    std::shared_ptr<const Skeleton> skeleton;
};

/// A clip whose last sample is one beyond what is to be played, and its skeleton, warped; the last sample is left out.
/// At both ends pose and velocities are those that it is warped to, and the root goes on evenly for two frames; it
/// keeps its places on the floor there. Within `seconds` of an end, rotations, height and way are displaced by quintics
/// that end in nothing. Radii reach the farthest joint, unless `keep_radii`. Requires 2 samples; throws
/// std::invalid_argument if a pose has another number of joints or another root.
WarpedClip warped(const mobb::Clip& clip, const Skeleton& skeleton, const ClipWarp& warp, bool keep_radii);

}  // namespace mobbscope
