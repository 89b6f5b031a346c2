/// A motion turned onto the ground plane, still in file units.
#pragma once

#include <import/skeleton/motion.h>

#include <cstddef>
#include <vector>

namespace mobbscope {

enum class UpAxis { y, z };

/// Poses with x and y on the ground and z up, checked. Refers to the motion, which must outlive it.
class GroundedMotion {
  public:
    GroundedMotion(const Motion& motion, UpAxis up) : motion_(motion), up_(up) {}

    const Motion& motion() const { return motion_; }
    std::span<const Joint> joints() const { return motion_.joints(); }
    const MotionTimes& times() const { return motion_.times(); }

    /// Where all joints are at a time in file seconds. Throws std::invalid_argument, naming time and joint, if one is
    /// at no finite place.
    void pose(double seconds, std::vector<glm::dvec3>& positions) const;

    /// Times at which to look when all of the motion counts: the stored frames, or 30 a second where any time has its
    /// pose; then 10,000 at most.
    std::vector<double> survey() const;

  private:
    const Motion& motion_;
    UpAxis up_;
};

}  // namespace mobbscope
