/// Which axis of a BVH points up: the file does not say, so how its bodies stand has to tell.
#pragma once

#include <import/bvh/bvh_motion.h>

#include <glm/mat3x3.hpp>

#include <memory>
#include <span>
#include <string>

namespace mobbscope {

/// See the members of MotionFile.
struct GuessedUp {
    glm::dmat3 ground{kYUp};
    std::string why;
    std::string doubt;
};

/// y, unless a body clearly stands along z and none along y. Looks at no more than some hundred frames. Needs no unit.
GuessedUp guess_up(std::span<const std::shared_ptr<const BvhMotion>> characters);

}  // namespace mobbscope
