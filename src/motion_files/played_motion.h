/// What one agent plays, from its first clip to its last: its skeleton in the world, ready to be written.
#pragma once

#include <import/skeleton/motion.h>
#include <mobb/clip.h>
#include <scene/scene.h>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace mobbscope {

/// A joint of a pose in the axes of motion files, metres: the ground point (x, y) at height z is (x, z, -y).
struct JointPose {
    glm::dvec3 position;
    glm::dquat rotation;  ///< from the joint's own axes
};

/// How a joint hangs on the one above it.
struct Bone {
    glm::dvec3 offset{0};  ///< metres, in the axes of the joint above; of the first joint 0
    bool varies = false;   ///< it does not stay within kBoneTolerance, so frames have offsets of their own
};

/// Metres along each axis.
inline constexpr double kBoneTolerance = 1e-5;

/// The plays of an agent back to back, frame after frame, dt apart. Holds what it needs of the scene.
class PlayedMotion {
  public:
    /// The agent of a run or of a scene with that name; of a scene without agents the clip. Without a name the only one
    /// there is. Throws InputError if there is no such agent, or if what it plays has no skeleton, more than one, or
    /// more than one dt.
    PlayedMotion(const Scene& scene, const std::optional<std::string>& name);

    const std::string& name() const { return name_; }
    double dt() const { return dt_; }
    double begin() const { return links_.front().placement.start; }  ///< global seconds of the first frame
    double lead() const { return lead_; }  ///< seconds from when the first of all agents begins until this one does
    std::size_t plays() const { return links_.size(); }
    int frames() const;

    /// The disks' root and all below it, depth first. Indices of `parent` are into these; the first has -1.
    const std::vector<Joint>& joints() const { return joints_; }
    /// JointPose::rotation of each joint where nothing is animated.
    const std::vector<glm::dquat>& rest() const { return rest_; }
    /// How each joint hangs on the one above it over all frames.
    std::vector<Bone> bones() const;
    /// Visits every frame, in order, with a pose of each joint.
    void each_frame(const std::function<void(std::span<const JointPose>)>& visit) const;
    /// The disk of each frame, in the world.
    std::vector<mobb::Disk> disks() const;

  private:
    struct Link {
        mobb::ClipPtr clip;
        std::shared_ptr<const Skeleton> skeleton;
        mobb::Placement placement;
    };

    void take_links(const Scene& scene, const std::optional<std::string>& name);
    void add_link(const SceneClip& clip, const mobb::Placement& placement);
    void check_links(const Scene& scene) const;
    void take_joints();

    std::string name_;
    double dt_ = 0;
    double lead_ = 0;
    std::vector<Link> links_;
    std::vector<std::string> clip_names_;  ///< of the links
    std::vector<int> order_;               ///< of joints_, their indices in the skeletons
    std::vector<Joint> joints_;
    std::vector<glm::dquat> rest_;
};

/// A joint's offset from the one above it, in the axes of that one.
glm::dvec3 bone_offset(const JointPose& above, const JointPose& joint);

}  // namespace mobbscope
