/// Which of a glTF file's skins are one body.
#pragma once

#include <import/nodes/gltf_animation.h>
#include <import/nodes/node_scene.h>

#include <vector>

namespace mobbscope {

struct GltfSkin {
    std::vector<int> joints;  ///< nodes, at least one
    int skeleton = -1;        ///< the node that the file names as above all of them; -1: none
};

/// The joints of each character, in the order of the skins, no node twice. Skins are one character that share joints,
/// that have joints below another's, or that hang on one moving node of which all but one at most keep their place. The
/// joints of one that begins in several places have the node that these hang on in front, such as hips without weight,
/// unless it stands still while they move away: then it only holds them. `channels`: those of all animations. Throws
/// InputError.
std::vector<std::vector<int>> gltf_characters(const NodeScene& scene, const std::vector<GltfSkin>& skins,
                                              const std::vector<GltfChannel>& channels);

}  // namespace mobbscope
