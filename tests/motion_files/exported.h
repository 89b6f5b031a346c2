/// Motion that is written and read again.
#pragma once

#include <import/skeleton/motion_clips.h>
#include <motion_files/formats.h>
#include <motion_files/played_motion.h>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace mobbscope {
inline namespace testing {

inline MotionFile written_and_read(const PlayedMotion& motion, const MotionFormat& format) {
    return format.read(format.write(motion), "agent");
}

inline ImportedClip imported_again(const PlayedMotion& motion, const MotionFormat& format) {
    ImportOptions options;
    options.fps = 1 / motion.dt();
    return motion_clips(written_and_read(motion, format), "agent", options).at(0);
}

/// The farthest that a joint or a disk of the file is from where it was played, metres.
inline double farthest_off(const PlayedMotion& motion, const MotionFormat& format) {
    const ImportedClip clip = imported_again(motion, format);
    const std::vector<mobb::Disk> played = motion.disks();
    EXPECT_EQ(clip.clip->samples().size(), played.size());
    if (clip.clip->samples().size() != played.size() || !clip.skeleton) return 1e9;
    const std::vector<Joint>& joints = clip.skeleton->joints;
    const mobb::PlacedClip in_place(*clip.clip, {});
    double most = 0;
    int frame = 0;
    motion.each_frame([&](std::span<const JointPose> pose) {
        const mobb::Disk& disk = played[static_cast<std::size_t>(frame)];
        const mobb::Disk& again = clip.clip->samples()[static_cast<std::size_t>(frame)];
        most = std::max({most, std::hypot(again.x - disk.x, again.y - disk.y), std::abs(again.r - disk.r)});
        for (std::size_t j = 0; j < pose.size(); ++j) {
            // A file may order siblings anew: a tip is told by the joint that it hangs on.
            const Joint& joint = motion.joints()[j];
            if (joint.end_site) continue;
            const auto at = std::ranges::find(joints, joint.name, &Joint::name);
            if (at == joints.end()) continue;
            const glm::dvec3 p = joint_place(*clip.skeleton, in_place, frame, static_cast<int>(at - joints.begin()));
            most = std::max(most, glm::distance(p, {pose[j].position.x, -pose[j].position.z, pose[j].position.y}));
        }
        ++frame;
    });
    return most;
}

}  // namespace testing
}  // namespace mobbscope
