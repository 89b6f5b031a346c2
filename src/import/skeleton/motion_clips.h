/// Skeletons in motion to clips of disks (contract, section 2).
#pragma once

#include <import/clip/imported_clip.h>
#include <import/skeleton/motion.h>

#include <filesystem>
#include <vector>

namespace mobbscope {

/// A clip of every animation in a file, or of the one that the options name. Throws InputError.
std::vector<ImportedClip> motion_clips(const MotionFile& motions, const std::filesystem::path& file,
                                       const ImportOptions& options);

}  // namespace mobbscope
