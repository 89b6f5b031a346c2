/// Files and folders, as a person gives them, to one scene.
#pragma once

#include <app/job.h>
#include <scene/scene.h>

#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace mobbscope::app {

/// The extensions that can be opened, in lower case with their dots; a scene's first.
std::span<const std::string_view> openable_extensions();

/// Scenes and clips merged into one scene; a folder stands for the clips in it, by name. Throws InputError; Cancelled
/// if the person had enough.
Scene load_files(const std::vector<std::filesystem::path>& files, JobControl& control);

/// Where the scene of these files would be saved: the scene among them if there is exactly one.
std::optional<std::filesystem::path> scene_file_of(const std::vector<std::filesystem::path>& files);

}  // namespace mobbscope::app
