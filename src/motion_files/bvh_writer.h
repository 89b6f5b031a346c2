/// Played motion as a BVH file.
#pragma once

#include <motion_files/played_motion.h>

#include <string>

namespace mobbscope {

/// The text of a BVH: metres, y up, Frame Time the motion's dt, rotations in the order Z X Y. All angles 0 are the pose
/// in which nothing is animated. The root has position channels, and so have bones whose length varies.
std::string to_bvh(const PlayedMotion& motion);

}  // namespace mobbscope
