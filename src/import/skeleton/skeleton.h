/// The skeleton that a clip's disks were made from, kept to be drawn inside its cylinders.
#pragma once

#include <import/skeleton/motion.h>

#include <glm/vec3.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace mobbscope {

/// Joint positions at every sample of a clip.
struct Skeleton {
    std::vector<Joint> joints;  ///< parents before children; those outside the root's subtree too
    int root = 0;               ///< the joint in the centre of the disks
    /// Sample after sample, one for each joint, metres: x and y from the centre of the sample's disk, in the clip's
    /// axes; z the height as in the file. So a placement that turns the disks turns these too.
    std::vector<glm::vec3> positions;

    std::span<const glm::vec3> at(int sample) const {
        return std::span(positions).subspan(static_cast<std::size_t>(sample) * joints.size(), joints.size());
    }
};

}  // namespace mobbscope
