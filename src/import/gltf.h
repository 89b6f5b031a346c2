/// glTF 2.0, as text or GLB, through tinygltf.
#pragma once

#include <import/motion.h>

namespace mobbscope {

/// Reads and checks nodes, skin 0 and all animations. Meshes, materials and pictures are not looked at: whether they
/// are there does not matter. Buffers may lie in files beside this one or in folders below. Throws InputError.
std::unique_ptr<MotionFile> read_gltf(const std::filesystem::path& file);

}  // namespace mobbscope
