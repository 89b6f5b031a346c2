#include <base/text.h>
#include <import/fbx/transform.h>

#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace mobbscope {

namespace {

constexpr std::string_view kPropertyNames[kFbxProperties] = {"Lcl Translation", "Lcl Rotation",  "Lcl Scaling",
                                                             "RotationOffset",  "RotationPivot", "ScalingOffset",
                                                             "ScalingPivot",    "PreRotation",   "PostRotation"};

/// Which axis is turned about first, second and third.
constexpr std::array<std::array<int, 3>, kFbxRotationOrders> kOrders{
    {{0, 1, 2}, {0, 2, 1}, {1, 2, 0}, {1, 0, 2}, {2, 0, 1}, {2, 1, 0}}};

const std::array<int, 3>& axes_of(int order) {
    return kOrders[order > 0 && order < kFbxRotationOrders ? static_cast<std::size_t>(order) : 0];
}

glm::dquat about_axis(const glm::dvec3& degrees, int axis) {
    glm::dvec3 direction(0);
    direction[axis] = 1;
    return glm::angleAxis(glm::radians(degrees[axis]), direction);
}

Affine scaled(const Affine& affine, const glm::dvec3& scale) {
    return {{affine.linear[0] * scale.x, affine.linear[1] * scale.y, affine.linear[2] * scale.z}, affine.offset};
}

}  // namespace

std::optional<FbxProperty> fbx_property(std::string_view name) {
    return enumerator_named<FbxProperty>(kPropertyNames, name);
}

glm::dquat fbx_rotation(const glm::dvec3& degrees, int order) {
    const auto& [first, second, third] = axes_of(order);
    return about_axis(degrees, third) * about_axis(degrees, second) * about_axis(degrees, first);
}

glm::dvec3 fbx_angles(const glm::dquat& rotation, int order) {
    const auto& [first, second, third] = axes_of(order);
    const glm::dmat3 m = glm::mat3_cast(rotation);               // m[column][row]
    const double sign = (second - first + 3) % 3 == 1 ? 1 : -1;  // whether the axes follow each other as x, y, z
    glm::dvec3 radians(0);
    radians[second] = std::asin(std::clamp(-sign * m[first][third], -1.0, 1.0));
    if (std::abs(m[first][third]) < 1 - 1e-12) {
        radians[first] = std::atan2(sign * m[second][third], m[third][third]);
        radians[third] = std::atan2(sign * m[first][second], m[first][first]);
    } else {  // gimbal lock: only a sum of the two is known
        radians[first] = std::atan2(-sign * m[third][second], m[second][second]);
    }
    return glm::degrees(radians);
}

TranslationRotationScale FbxTransform::local() const {
    using enum FbxProperty;
    TranslationRotationScale out;
    out.scale = (*this)[scaling];
    const glm::dvec3& angles = (*this)[rotation];
    out.rotation = has_rotation_space ? fbx_rotation((*this)[pre_rotation], 0) * fbx_rotation(angles, rotation_order) *
                                            glm::conjugate(fbx_rotation((*this)[post_rotation], 0))
                                      : fbx_rotation(angles, 0);
    const glm::dvec3 scaled_about =
        (*this)[scaling_offset] + (*this)[scaling_pivot] - out.scale * (*this)[scaling_pivot];
    out.translation = (*this)[translation] + (*this)[rotation_offset] + (*this)[rotation_pivot] +
                      out.rotation * (scaled_about - (*this)[rotation_pivot]);
    return out;
}

FbxGlobal fbx_global(const FbxTransform& transform, const FbxGlobal* parent) {
    const TranslationRotationScale local = transform.local();
    Affine unscaled{glm::mat3_cast(local.rotation), local.translation};
    FbxGlobal out;
    if (!parent || transform.inherit == FbxInherit::with_shear) {
        out.unscaled = parent ? parent->node * unscaled : unscaled;
    } else {
        out.scale_from_above = transform.inherit == FbxInherit::along_axes ? parent->scale : parent->scale_from_above;
        unscaled.offset *= parent->scale;
        out.unscaled = parent->unscaled * unscaled;
    }
    out.scale = local.scale * out.scale_from_above;
    out.node = scaled(out.unscaled, out.scale);
    return out;
}

}  // namespace mobbscope
