/// How an FBX node stands in the one above it.
#pragma once

#include <import/nodes/node_scene.h>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace mobbscope {

/// The properties of a node that place it, all of them three numbers: file units, degrees, factors.
enum class FbxProperty {
    translation,
    rotation,
    scaling,
    rotation_offset,
    rotation_pivot,
    scaling_offset,
    scaling_pivot,
    pre_rotation,
    post_rotation
};
inline constexpr std::size_t kFbxProperties = 9;

/// That of the name in files ("Lcl Translation"); none if it places no node.
std::optional<FbxProperty> fbx_property(std::string_view name);

/// Which scale of the nodes above a node takes on.
enum class FbxInherit {
    along_axes,      ///< RrSs: the parent's, along the node's own axes
    with_shear,      ///< RSrs: as the parent's matrix has it
    without_parent,  ///< Rrs: as along_axes, but not that of the parent itself
};

/// Rotation orders of three axes; the one after them is spheric.
inline constexpr int kFbxRotationOrders = 6;

/// Three Euler angles in degrees; `order` is RotationOrder of the FBX SDK: 0 XYZ (x is first), 1 XZY, 2 YZX, 3 YXZ,
/// 4 ZXY, 5 ZYX; anything else is XYZ.
glm::dquat fbx_rotation(const glm::dvec3& degrees, int order);
/// The angles of a rotation in that order, within 180 degrees.
glm::dvec3 fbx_angles(const glm::dquat& rotation, int order);

struct FbxTransform {
    std::array<glm::dvec3, kFbxProperties> properties{};  ///< by FbxProperty
    int rotation_order = 0;
    bool has_rotation_space = true;  ///< order, PreRotation and PostRotation count (RotationActive)
    FbxInherit inherit = FbxInherit::with_shear;

    FbxTransform() { (*this)[FbxProperty::scaling] = glm::dvec3(1); }
    glm::dvec3& operator[](FbxProperty property) { return properties[static_cast<std::size_t>(property)]; }
    const glm::dvec3& operator[](FbxProperty property) const { return properties[static_cast<std::size_t>(property)]; }

    /// Scale, then rotate, then translate (FBX SDK, "Computing transformation matrices"): T Roff Rp Rpre R Rpost^-1
    /// Rp^-1 Soff Sp S Sp^-1. Geometric transforms move what hangs on a node, not the nodes below it, so they are not
    /// here.
    TranslationRotationScale local() const;
};

/// A node in the file's axes, with what those below it take on of its scale.
struct FbxGlobal {
    Affine node;                     ///< from the node's own axes
    Affine unscaled;                 ///< the same without its own scale, and what along_axes takes on
    glm::dvec3 scale{1};             ///< which along_axes hands on
    glm::dvec3 scale_from_above{1};  ///< of that, what came from above: without_parent hands it on
};

/// A node below `parent`, or at the top.
FbxGlobal fbx_global(const FbxTransform& transform, const FbxGlobal* parent);

}  // namespace mobbscope
