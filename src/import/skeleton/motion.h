/// Joints that move in time, as files hold them: what readers of skeletons give, and motion_clips.h samples.
#pragma once

#include <mobb/clip.h>

#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace mobbscope {

struct Joint {
    std::string name;
    int parent = -1;        ///< index into the joints, less than its own; -1: none above it
    bool end_site = false;  ///< BVH: the tip of a bone. It widens the disk, but is no joint that could be the root
};

/// When a motion is defined, in seconds as in the file.
struct MotionTimes {
    double first = 0;          ///< of the earliest key; BVH: 0
    double last = 0;           ///< of the last key, >= first
    int frames = 1;            ///< stored frames: BVH rows, distinct key times of glTF and FBX
    std::optional<double> dt;  ///< seconds between stored frames, where they are uniform
    /// True (BVH): poses exist at first + i*dt alone, and disks between them are interpolated; dt is then given, > 0.
    /// False (glTF, FBX): any time has its pose.
    bool frames_only = false;
    std::shared_ptr<const std::vector<double>> keys{};  ///< glTF, FBX: the distinct key times, ascending; null: none
    std::string doubt{};  ///< why these times are hardly meant, and what to do; else empty
};

/// One animation of one skeleton. Const calls are safe from any number of threads.
class Motion {
  public:
    virtual ~Motion() = default;

    /// At least one, parents before their children. Every one counts towards the disk (glTF with skins: the joints of
    /// one character's skins, each below its nearest ancestor among them; without: all nodes below the topmost animated
    /// one).
    virtual std::span<const Joint> joints() const = 0;
    /// Which of MotionFile::joints a joint is.
    virtual std::size_t in_file(int joint) const { return static_cast<std::size_t>(joint); }
    /// The topmost joint of the contract, where the search for the root begins.
    virtual int topmost() const = 0;
    /// True if the search for the root, which goes down from joints that stand still, ends at this joint at the latest.
    virtual bool is_pivot(int /*joint*/) const { return false; }
    virtual const MotionTimes& times() const = 0;
    /// What one pose takes, in joints: these, the nodes above them, and the layers of curves that move them.
    virtual std::size_t posed() const { return joints().size(); }
    /// Where all joints are at a time in file seconds, in file units and axes, with everything above them applied.
    /// Times outside the keys are clamped; with frames_only the nearest stored frame is taken. `positions` has room for
    /// all joints. What comes out may be absurd or not finite: the caller checks. `rotations`, where it has room for
    /// all joints too, takes what turns each joint's own axes to those of the file: always unit quaternions.
    virtual void pose(double seconds, std::span<glm::dvec3> positions, std::span<glm::dquat> rotations = {}) const = 0;
    /// The same rotations where nothing is animated, for all joints: BVH, all angles 0; else the nodes as they stand.
    virtual std::vector<glm::dquat> rest() const { return std::vector<glm::dquat>(joints().size(), {1, 0, 0, 0}); }
    /// What was ignored, one sentence each.
    virtual std::vector<std::string> warnings() const { return {}; }
};

/// A joint of a file as a user may name it.
struct NamedJoint {
    std::string name;  ///< no other has it: "Hips", the second of that name "Hips #2"; "": an End Site, never the root
    int character = -1;  ///< whose it is; -1: nobody's
};

/// A motion and the joint of it that is to be the root, none for the default one.
struct RootedMotion {
    std::shared_ptr<const Motion> motion;
    std::optional<int> root{};  ///< index into its joints
};

/// Whom an animation moves.
struct MovedCharacters {
    std::vector<std::size_t> characters;  ///< ascending; of a file with one character that one, though it stands still
    std::string nothing;  ///< why it moves nothing at all, where it does not: "moves morph targets only"
};

/// What leads the axes of a file with y up to those of a clip: x and y on the floor, z up.
inline const glm::dmat3 kYUp{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}};
inline const glm::dmat3 kZUp{1};

/// Each character is a clip of every animation that moves it; more of them are a crowd, and no file of skeletons.
inline constexpr std::size_t kMostCharacters = 1000;

/// Throws InputError for more than that, naming the file.
void check_character_count(std::size_t count, const std::string& file);

/// A file of one or more animations of one or more characters, checked as a whole when it was read.
struct MotionFile {
    std::string format;  ///< "bvh", "gltf", "fbx"
    /// Metres per file unit as the format or the header says; none: to be guessed from the body's height.
    std::optional<double> unit;
    std::string unit_doubt;  ///< why what the header says is no unit; else empty
    /// What leads the file's axes to the clip's as the format or the header says, of BVH as the body stands: a
    /// permutation with signs, which may mirror; none: the file does not say, and y is up.
    std::optional<glm::dmat3> ground;
    std::string up_why = "as the file says";  ///< of `ground`; BVH: how it was guessed
    std::string up_doubt;                     ///< why another axis may be up, and what to do; else empty
    std::vector<std::string> animations;      ///< at least one name; an unnamed one is "#<index>"
    std::vector<std::string> characters;      ///< at least one: the name of each one's topmost joint, as in `joints`
    std::vector<NamedJoint> joints;           ///< all that can be root; those of characters first

    // What follows takes indices into these. It keeps alive what it needs, so it may outlive the file.

    std::function<MovedCharacters(std::size_t animation)> moved;
    /// One animation of one character, prepared only now: a file may hold many. Throws InputError where the animation
    /// moves nothing.
    std::function<std::shared_ptr<const Motion>(std::size_t animation, std::size_t character)> motion;
    /// The same with a joint as root: of its character; of a joint that is nobody's, it and the joints of skins below
    /// it, or where there are none, all below it.
    std::function<RootedMotion(std::size_t animation, std::size_t joint)> rooted;
};

/// Names of which none is another: the second "Hips" becomes "Hips #2". Empty ones stay.
std::vector<std::string> distinct_names(std::vector<std::string> names);

/// Joint positions and rotations at every sample of a clip.
struct Skeleton {
    std::vector<Joint> joints;  ///< parents before children; those outside the root's subtree too
    int root = 0;               ///< the joint in the centre of the disks
    /// Sample after sample, one for each joint, metres: x and y from the centre of the sample's disk, in the clip's
    /// axes; z the height as in the file. So a placement that turns the disks turns these too.
    std::vector<glm::vec3> positions;
    /// Beside the positions: what turns each joint's own axes to those of the clip (x and y on the floor, z up).
    std::vector<glm::quat> rotations;
    std::vector<glm::quat> rest;  ///< the same of each joint where nothing is animated

    std::span<const glm::vec3> at(int sample) const {
        return std::span(positions).subspan(static_cast<std::size_t>(sample) * joints.size(), joints.size());
    }
    std::span<const glm::quat> rotations_at(int sample) const {
        return std::span(rotations).subspan(static_cast<std::size_t>(sample) * joints.size(), joints.size());
    }
};

/// A joint of a sample in the world: x, y and the height in metres. The skeleton is the clip's.
glm::dvec3 joint_place(const Skeleton& skeleton, const mobb::PlacedClip& clip, int sample, int joint);

/// A rotation of the floor as one of space: about z.
glm::dquat about_up(const mobb::Rotation& rotation);

}  // namespace mobbscope
