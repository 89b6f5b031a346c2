/// How a glTF file moves its nodes: keys, what lies between them, and the poses that come of it.
#pragma once

#include <import/nodes/gltf_accessor.h>
#include <import/nodes/node_scene.h>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <functional>
#include <memory>
#include <vector>

namespace mobbscope {

/// Where a node stands at rest, relative to its parent: `matrix` where no channel moves it, or its translation alone is
/// moved; else `parts` with what the channels give in its place.
struct GltfRest {
    TranslationRotationScale parts;
    Affine matrix;
};

enum class Interpolation { step, linear, cubic_spline };
enum class NodeProperty { translation, rotation, scale };

/// How one property of one node moves.
struct GltfChannel {
    int node = 0;
    NodeProperty property = NodeProperty::translation;
    Interpolation interpolation = Interpolation::linear;
    Numbers times;  ///< seconds, at least one, strictly increasing
    /// x y z of every key, or x y z w of a quaternion that is not zero. cubic_spline: in-tangent, value and out-tangent
    /// of every key.
    Numbers values;
};

/// NodeAnimation::pose for channels, at most one for each property of a node.
std::function<void(std::optional<double>, std::span<const PosedNode>, std::span<Affine>)> gltf_pose(
    std::shared_ptr<const std::vector<GltfRest>> rest, const std::vector<GltfChannel>& channels);

}  // namespace mobbscope
