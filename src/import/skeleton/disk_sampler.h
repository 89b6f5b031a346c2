/// The disk that bounds a skeleton over the ground, at any time.
#pragma once

#include <import/skeleton/grounded_motion.h>
#include <mobb/clip.h>

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace mobbscope {

/// A disk and the pose that it bounds, file units.
struct PosedDisk {
    mobb::Disk disk;
    std::vector<glm::dvec3> positions;  ///< of all joints, on the ground plane; z up
};

/// Disks of one motion about one root: the radius reaches the farthest joint of the root's subtree. Refers to the
/// motion, which must outlive it. Meant for times that go forward.
class DiskSampler {
  public:
    DiskSampler(const GroundedMotion& motion, int root);

    /// At a time in file seconds. A time within kFrameTolerance of a stored frame takes that frame; between stored
    /// frames x, y, r and the positions are interpolated where the motion is frames_only, else the pose is evaluated.
    /// Throws std::invalid_argument as GroundedMotion::pose.
    void sample(double t, PosedDisk& out);

  private:
    struct Slot {
        std::optional<std::size_t> frame;
        PosedDisk posed;
    };

    void take(double t, PosedDisk& out) const;
    /// A stored frame. The last two are kept: a sample lies between two frames, and the next one often too.
    const PosedDisk& stored(std::size_t frame);

    const GroundedMotion& motion_;
    std::size_t root_;
    std::vector<bool> inside_;  ///< of each joint, whether it is the root or below it
    std::array<Slot, 2> slots_;
};

}  // namespace mobbscope
