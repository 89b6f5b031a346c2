/// The animation stacks of an FBX file: layers of curves over the properties of nodes.
#pragma once

#include <import/fbx/curve.h>
#include <import/fbx/objects.h>
#include <import/fbx/transform.h>

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mobbscope {

/// Up to three numbers that move together.
struct FbxTrack {
    std::array<std::optional<double>, 3> fixed{};  ///< of those without a curve
    std::array<std::shared_ptr<const FbxCurve>, 3> curves{};

    /// `otherwise`: of those with neither.
    glm::dvec3 at(double seconds, const glm::dvec3& otherwise) const;
};

/// How a layer goes over those below it.
struct FbxLayer {
    enum class Blend { add, replace, mix };
    bool is_base = false;  ///< the first one of its stack: it gives the values that the others change
    Blend blend = Blend::add;
    double weight = 1;                        ///< 0 to 1
    std::shared_ptr<const FbxCurve> weights;  ///< percent, in its place; null: it does not move
    bool composes_rotations = true;           ///< as rotations; false: angle by angle
    bool multiplies_scales = true;            ///< false: adds them

    double weight_at(double seconds) const;
};

/// One property of one node in the layers of a stack, the lowest first.
struct FbxAnimatedProperty {
    std::size_t node = 0;
    FbxProperty property = FbxProperty::translation;
    struct InLayer {
        std::size_t layer = 0;
        FbxTrack track;
    };
    std::vector<InLayer> layers;
};

struct FbxStack {
    std::string name;  ///< may be empty
    /// The part of time that the file has the stack play, seconds; not after its begin: it does not say.
    double begin = 0;
    double end = 0;
    std::vector<FbxLayer> layers;
    std::vector<FbxAnimatedProperty> properties;  ///< by rising node
    std::vector<std::string> warnings;            ///< what was left out, one sentence each

    /// The value of one of its properties; `rest` is the node where nothing is animated.
    glm::dvec3 value(const FbxAnimatedProperty& property, const FbxTransform& rest, double seconds) const;
};

/// All stacks, in the order of the file; a layer belongs to one of them. Muted layers are left out, beside solo ones
/// all others. `node_of`: the node of a Model's id. Throws InputError.
std::vector<FbxStack> fbx_stacks(FbxDocument& document, const FbxObjects& objects,
                                 const std::map<std::int64_t, std::size_t>& node_of, double ticks_per_second);

}  // namespace mobbscope
