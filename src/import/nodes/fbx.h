/// FBX through Assimp, which runs in a process of its own: whatever a file does to it, this program lives on.
#pragma once

#include <import/skeleton/motion.h>

namespace mobbscope {

/// Throws InputError if the file cannot be read (a crash or a hang of the reader included), MachineError if the reader
/// cannot be started.
std::unique_ptr<MotionFile> read_fbx(const std::filesystem::path& file);

}  // namespace mobbscope
