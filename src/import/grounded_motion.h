/// A motion turned onto the ground plane, still in file units.
#pragma once

#include <import/motion.h>

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

/// For each joint, whether it is `root` or below it.
std::vector<bool> subtree(std::span<const Joint> joints, int root);

/// The default root of the contract: the topmost joint; if it never moves over the ground and has exactly one child
/// joint, that child, and so on.
int default_root(const GroundedMotion& motion);

/// The joint with a name, the first of several. Throws std::invalid_argument, naming the nearest.
int root_by_name(std::span<const Joint> joints, const std::string& name);

/// The median over the survey of the vertical extent of a joint's subtree, file units.
double median_height(const GroundedMotion& motion, int root);

}  // namespace mobbscope
