/// The disk that bounds a skeleton over the ground, at any time.
#pragma once

#include <import/skeleton/motion.h>
#include <mobb/clip.h>

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace mobbscope {

/// Poses with x and y on the ground and z up, checked. Refers to the motion, which must outlive it. `ground` leads from
/// the file's axes there, see MotionFile::ground.
class GroundedMotion {
  public:
    GroundedMotion(const Motion& motion, const glm::dmat3& ground) : motion_(motion), ground_(ground) {}

    const Motion& motion() const { return motion_; }
    std::span<const Joint> joints() const { return motion_.joints(); }
    const MotionTimes& times() const { return motion_.times(); }

    /// Where all joints are at a time in file seconds, and if asked for how they are turned. Throws
    /// std::invalid_argument, naming time and joint, if one is at no finite place.
    void pose(double seconds, std::vector<glm::dvec3>& positions, std::vector<glm::dquat>* rotations = nullptr) const;

    /// Motion::rest, on the ground plane.
    std::vector<glm::dquat> rest() const;

    /// Times at which to look when all of the motion counts: the stored frames, or 30 a second where any time has its
    /// pose; then 10,000 at most.
    std::vector<double> survey() const;

  private:
    void turn(std::vector<glm::dquat>& rotations) const;

    const Motion& motion_;
    glm::dmat3 ground_;
};

/// A disk and the pose that it bounds, file units.
struct PosedDisk {
    mobb::Disk disk;
    std::vector<glm::dvec3> positions;  ///< of all joints, on the ground plane; z up
    std::vector<glm::dquat> rotations;  ///< of all joints: from their own axes to those of the ground plane
};

/// Disks of one motion about one root: the radius reaches the farthest joint of the root's subtree. Refers to the
/// motion, which must outlive it. Meant for times that go forward.
class DiskSampler {
  public:
    /// `step`: seconds between the times that are asked for.
    DiskSampler(const GroundedMotion& motion, int root, double step);

    /// At a time in file seconds. A time within kFrameTolerance of a stored frame takes that frame, a frame being as
    /// long as the gap between two stored ones or the step, the shorter; between stored frames x, y, r and the pose are
    /// interpolated where the motion is frames_only, else the pose is evaluated.
    /// Throws std::invalid_argument as GroundedMotion::pose.
    void sample(double t, PosedDisk& out);

  private:
    struct Slot {
        std::optional<std::size_t> frame;
        PosedDisk posed;
    };

    void take(double t, PosedDisk& out) const;
    /// The key that a time is so near to, else the time.
    double on_key(double t) const;
    /// A stored frame. The last two are kept: a sample lies between two frames, and the next one often too.
    const PosedDisk& stored(std::size_t frame);

    const GroundedMotion& motion_;
    std::size_t root_;
    double step_;
    std::vector<bool> inside_;  ///< of each joint, whether it is the root or below it
    std::array<Slot, 2> slots_;
};

/// The largest distance over the ground from the root to a joint that is `inside`.
double ground_reach(std::span<const glm::dvec3> positions, std::size_t root, const std::vector<bool>& inside);

/// The joint that is taken where no option names one, and why, in words.
struct DefaultRoot {
    int joint = 0;
    std::string why;
};

/// The default root of the contract: the topmost joint; if it never moves over the ground and has exactly one child
/// joint, that child, and so on. A pivot (Motion::is_pivot) ends the search.
DefaultRoot default_root(const GroundedMotion& motion);

/// The joint with a name. Throws std::invalid_argument, naming the nearest.
std::size_t root_by_name(std::span<const NamedJoint> joints, const std::string& name);

/// For each joint, whether it is `root` or below it.
std::vector<bool> subtree(std::span<const Joint> joints, int root);

/// The median over the survey of the vertical extent of the root's subtree, file units.
double median_height(const GroundedMotion& motion, int root);

/// How tall the limbs of the root's subtree make a body that stands, whatever its pose, file units: by the longest way
/// from tip to tip, which of people leads from a hand to a foot.
double height_of_limbs(const GroundedMotion& motion, int root);

}  // namespace mobbscope
