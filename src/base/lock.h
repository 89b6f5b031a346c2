/// Locks that processes share.
#pragma once

#include <base/descriptor.h>

#include <chrono>
#include <filesystem>

namespace mobbscope {

/// A lock on a folder, until the descriptor is closed or its process ends, waiting so long at most. Not open where
/// another process has it, there is no such folder, or its file system has no locks.
Descriptor lock_folder(const std::filesystem::path& folder, std::chrono::milliseconds longest);

}  // namespace mobbscope
