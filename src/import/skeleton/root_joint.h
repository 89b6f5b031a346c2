/// The joint in the centre of the disks, and the body below it.
#pragma once

#include <import/skeleton/grounded_motion.h>

#include <span>
#include <string>
#include <vector>

namespace mobbscope {

/// The default root of the contract: the topmost joint; if it never moves over the ground and has exactly one child
/// joint, that child, and so on. A pivot (Motion::is_pivot) ends the search.
int default_root(const GroundedMotion& motion);

/// The joint with a name, the first of several. Throws std::invalid_argument, naming the nearest.
int root_by_name(std::span<const Joint> joints, const std::string& name);

/// For each joint, whether it is `root` or below it.
std::vector<bool> subtree(std::span<const Joint> joints, int root);

/// The median over the survey of the vertical extent of the root's subtree, file units.
double median_height(const GroundedMotion& motion, int root);

}  // namespace mobbscope
