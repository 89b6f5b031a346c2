/// glTF 2.0, as text or GLB, through tinygltf.
#pragma once

#include <import/skeleton/motion.h>

#include <filesystem>
#include <memory>
#include <string_view>

namespace mobbscope {

/// Reads and checks nodes, skin 0 and all animations. Meshes, materials and pictures are not looked at: whether they
/// are there does not matter. Buffers may lie in files beside this one or in folders below. Throws InputError.
std::unique_ptr<MotionFile> read_gltf(const std::filesystem::path& file);

/// The same for the bytes of a file; `file` is where it would lie.
std::unique_ptr<MotionFile> parse_gltf(std::string_view bytes, const std::filesystem::path& file);

}  // namespace mobbscope
