/// Nodes that move, as glTF and FBX have them, checked when they were read; and what they make: a MotionFile.
#pragma once

#include <import/skeleton/motion.h>

#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
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

/// Of a node in the one above it: scale, then rotate, then translate.
struct TranslationRotationScale {
    glm::dvec3 translation{0};
    glm::dquat rotation{1, 0, 0, 0};  ///< of unit length
    glm::dvec3 scale{1};

    Affine affine() const;
};

struct Node {
    std::string name;
    int parent = -1;  ///< index of a node, anywhere in the array; -1: none
};

/// A node in a list of those that are to be posed, which holds all above each of them too.
struct PosedNode {
    int node = 0;
    int above = -1;  ///< the place of its parent in the list, less than its own; -1: it has none
};

struct NodeAnimation {
    std::string name;        ///< "#<index>" if the file gives none
    MotionTimes times;       ///< over all that it has, morph targets too
    std::vector<int> moved;  ///< the nodes that it moves, ascending
    /// From the first key of each of those to its last, seconds; empty: that is not known.
    std::vector<std::pair<double, double>> keyed{};
    std::vector<int> turned;            ///< those of them that it really turns, ascending; read where has_pivots
    std::vector<std::string> warnings;  ///< one sentence each
    std::string moves_nothing;          ///< why, where `moved` is empty: "moves morph targets only"
    /// What leads from each node's own axes to the file's, into the same place of `out`. No time: where nothing is
    /// animated. Times outside the keys are clamped. Safe from any number of threads.
    std::function<void(std::optional<double> seconds, std::span<const PosedNode> nodes, std::span<Affine> out)> pose;
    /// What such a pose takes beside one step a node, in steps; null: nothing.
    std::function<std::size_t(std::span<const PosedNode> nodes)> more_steps;
};

/// A file's nodes and animations. Parent links are free of cycles.
struct NodeScene {
    std::string file;  ///< for messages
    std::string format;
    std::optional<double> unit;        ///< metres per file unit
    std::string unit_doubt{};          ///< as MotionFile::unit_doubt
    std::optional<glm::dmat3> ground;  ///< as MotionFile::ground
    std::string up_doubt{};            ///< as MotionFile::up_doubt
    std::vector<Node> nodes;
    /// The joints of each character, at least one each, in the file's order; no node twice. None: all nodes from `body`
    /// down are one.
    std::vector<std::vector<int>> characters;
    std::optional<int> body;  ///< none: the topmost animated node
    /// A joint that turns on the spot is the pivot that the body hangs on, so the search for the root ends there. FBX:
    /// unlike a skin, it does not say where the body begins.
    bool has_pivots = false;
    std::vector<NodeAnimation> animations;
};

/// Numbers read once and shared by all channels that refer to them.
using Numbers = std::shared_ptr<const std::vector<double>>;

/// First and last time and the distinct key times of several lists of keys, each strictly increasing.
MotionTimes key_times(const std::vector<Numbers>& lists);

/// By node: whether some animation moves it.
std::vector<bool> moved_nodes(const NodeScene& scene);

/// Nodes ordered so that parents come before their children, siblings in the order of their indices.
std::vector<int> parents_first(const std::vector<Node>& nodes);

/// The nodes that none without a parent leads to: they hang on themselves in a circle.
std::vector<int> nodes_in_circles(const std::vector<Node>& nodes);

/// The scene's animations as motions.
MotionFile node_motion_file(NodeScene scene);

}  // namespace mobbscope
