/// How continuous a motion graph is: what changes where one move follows another.
#pragma once

#include <scene/scene.h>

#include <cstddef>
#include <optional>

namespace mobbscope {

/// What was measured at joints.
struct JointSpread {
    std::size_t count = 0;  ///< joints measured
    double median = 0;
    double largest = 0;
    int before = -1;  ///< the moves at the joint with the largest: indices into the graph's moves
    int after = -1;
};

struct JointMeasures {
    std::size_t joints = 0;     ///< pairs of a move and one that may follow it
    JointSpread pose_distance;  ///< metres: joined_distance, as the stances join the bodies
    JointSpread root_speed;     ///< metres per second: change of the root's velocity, over the steps next to the joint
};

/// Measures every joint. Poses come from the clips' sources, a few frames beyond each clip included; joints between
/// clips without a skeleton, or of different ones, have no pose distance. The scene has a graph. `progress` is told
/// before each clip's poses are read. Throws InputError.
JointMeasures measure_joints(const Scene& scene, const Progress& progress = {});

/// Whether what was measured exceeds a bound by more than rounding does.
bool exceeds(const JointSpread& measured, double bound);

}  // namespace mobbscope
