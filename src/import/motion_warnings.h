/// What looks wrong about a clip made from a skeleton: published motion files hold much that was never a motion.
#pragma once

#include <import/import.h>
#include <mobb/clip.h>

namespace mobbscope {

/// Adds to facts.warnings, one sentence each with sample numbers: a first sample in the T-pose, jumps, paths that stay
/// in place, sizes and speeds that no person has. `begin`: seconds from the first key to the first sample.
void add_motion_warnings(const mobb::Clip& clip, double begin, SourceFacts& facts);

}  // namespace mobbscope
