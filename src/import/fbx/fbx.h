/// The reader of FBX files.
#pragma once

#include <import/skeleton/motion.h>

#include <filesystem>
#include <string_view>

namespace mobbscope {

/// FBX from version 7.1 up, binary or text: skeletons and every animation stack, with the pose evaluated as the file's
/// curves, layers and transform chains say. Meshes and materials are not looked at. `file` stands for the file in
/// messages. Throws InputError.
MotionFile parse_fbx(std::string_view bytes, const std::filesystem::path& file);

}  // namespace mobbscope
