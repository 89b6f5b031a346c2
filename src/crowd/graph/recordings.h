/// Files of motion to be cut: whole clips with their skeletons.
#pragma once

#include <scene/scene.h>

#include <filesystem>
#include <vector>

namespace mobbscope {

/// The clip files (no trajectories) among files and in folders and their subfolders; those of a folder by
/// name. Throws InputError for a folder that cannot be read or holds none, and for a scene file.
std::vector<std::filesystem::path> clip_files(const std::vector<std::filesystem::path>& places);

/// All clips of the files as one scene, with sources relative to `scene_file`, which need not exist. `progress` is told
/// before each file. Throws InputError.
Scene load_recordings(const std::vector<std::filesystem::path>& files, const std::filesystem::path& scene_file,
                      const ImportOptions& options, const Progress& progress = {});

}  // namespace mobbscope
