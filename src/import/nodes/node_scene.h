/// Nodes and their keyframes as glTF and FBX hold them, checked when they were read; and what they make: a MotionFile.
#pragma once

#include <import/skeleton/motion.h>

#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {

/// Files give indices as int.
inline std::size_t as_index(int index) { return static_cast<std::size_t>(index); }

/// x -> linear * x + offset.
struct Affine {
    glm::dmat3 linear{1};
    glm::dvec3 offset{0};

    /// First `other`, then this.
    Affine operator*(const Affine& other) const { return {linear * other.linear, linear * other.offset + offset}; }
};

/// Scale, then rotate, then translate.
struct TranslationRotationScale {
    glm::dvec3 translation{0};
    glm::dquat rotation{1, 0, 0, 0};  ///< of unit length
    glm::dvec3 scale{1};

    Affine affine() const;
};

struct Node {
    std::string name;
    int parent = -1;  ///< index of a node, anywhere in the array; -1: none
    /// The rest transform, relative to the parent: `matrix` where no channel moves the node, else `rest` with what the
    /// channels give in its place.
    TranslationRotationScale rest;
    Affine matrix;
};

enum class Interpolation { step, linear, cubic_spline };
enum class NodeProperty { translation, rotation, scale };

/// Numbers read once and shared by all channels that refer to them.
using Numbers = std::shared_ptr<const std::vector<double>>;

/// How one property of one node moves.
struct Channel {
    int node = 0;
    NodeProperty property = NodeProperty::translation;
    Interpolation interpolation = Interpolation::linear;
    Numbers times;  ///< seconds, at least one, strictly increasing
    /// x y z of every key, or x y z w of a quaternion that is not zero. cubic_spline: in-tangent, value and out-tangent
    /// of every key.
    Numbers values;
};

struct NodeAnimation {
    std::string name;  ///< "#<index>" if the file gives none
    std::vector<Channel> channels;
    bool has_morph_channels = false;  ///< weights of morph targets: they move no node
    MotionTimes times;                ///< over all channels, those of morph targets too
};

/// A file's nodes and animations. Parent links are free of cycles.
struct NodeScene {
    std::string file;  ///< for messages
    std::string format;
    std::optional<double> unit;  ///< metres per file unit
    std::vector<Node> nodes;
    bool has_skin = false;
    std::vector<int> skin_joints;  ///< the nodes of skin 0, in its order
    int skins = 0;
    /// A joint that turns on the spot is the pivot that the body hangs on, so the search for the root ends there. FBX:
    /// unlike a skin, it does not say where the body begins.
    bool has_pivots = false;
    std::vector<NodeAnimation> animations;
};

/// Nodes ordered so that parents come before their children, siblings in the order of their indices.
std::vector<int> parents_first(const std::vector<Node>& nodes);

/// The value of a channel at a time: clamped outside the keys. Three numbers, or a quaternion's four (x y z w) of unit
/// length, into `out`.
void evaluate(const Channel& channel, double seconds, double* out);

/// First and last time and the distinct key times of several lists of keys, each strictly increasing.
MotionTimes key_times(const std::vector<Numbers>& lists);

/// The scene's animations as motions.
MotionFile node_motion_file(NodeScene scene);

/// What the FBX reader's process sends: a scene as bytes, or why there is none.
std::string pack(const NodeScene& scene);
std::string pack_error(std::string_view message);

/// The scene in a packet, in which nothing is trusted; `file` and `format` left empty. Throws std::runtime_error if the
/// packet says that there is none, with its message; std::length_error if the packet is cut off or holds what no scene
/// can.
NodeScene unpack(std::string_view packet);

}  // namespace mobbscope
