/// The reader of glTF files.
#pragma once

#include <import/skeleton/motion.h>

#include <filesystem>
#include <string_view>

namespace mobbscope {

/// glTF 2.0, as text or GLB, through tinygltf: nodes, skins and all animations. Meshes, materials and pictures are not
/// looked at: whether they are there does not matter. `file` is where the bytes are from: buffers may lie in files
/// beside it or in folders below. Throws InputError.
MotionFile parse_gltf(std::string_view bytes, const std::filesystem::path& file);

}  // namespace mobbscope
