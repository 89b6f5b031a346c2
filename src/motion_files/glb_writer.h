/// Played motion as a binary glTF file.
#pragma once

#include <motion_files/played_motion.h>

#include <string>

namespace mobbscope {

/// The bytes of a GLB: a node for each joint below one that stands where the motion begins, a skin of all joints, so
/// that programs show bones, and one animation, whose time 0 is when the first of all agents begins. Joints keep their
/// names and their own axes, so what was skinned to the source fits.
std::string to_glb(const PlayedMotion& motion);

}  // namespace mobbscope
