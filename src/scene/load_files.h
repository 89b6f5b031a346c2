/// Files and folders, as a person gives them, to one scene.
#pragma once

#include <scene/scene.h>

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {

/// The extensions that can be opened, in lower case with their dots; a scene's first.
std::span<const std::string_view> openable_extensions();

/// What can be opened, in words for help, and shorter for the empty window.
std::string openable_files();
std::string openable_files_in_short();

struct UnreadableFolder {
    std::filesystem::path folder;
    std::string why;  ///< in one line, with its name
};

/// The clip files in a folder, by name; with `unreadable` in the folders in it too, but for those that it then names.
/// Scenes and crowds in it are other documents, and not every text is a crowd. Throws InputError if it cannot be read
/// or holds none.
std::vector<std::filesystem::path> clips_in(const std::filesystem::path& folder,
                                            std::vector<UnreadableFolder>* unreadable = nullptr);

/// Scenes and clips merged into one scene; a folder stands for the clips in it, by name. `overrides` go
/// over the import keys of every clip with a source. `progress` is told before each file, or of one scene before each
/// clip. `importer` as in load_scene. Throws InputError.
Scene load_files(const std::vector<std::filesystem::path>& files, const ImportOptions& overrides = {},
                 const Progress& progress = {}, Importer* importer = nullptr);

/// Where the scene of these files would be saved: the scene among them if there is exactly one.
std::optional<std::filesystem::path> scene_file_of(const std::vector<std::filesystem::path>& files);

/// Where it is: beside the installed program, else where it was built. Throws MachineError if it is in neither place.
std::filesystem::path demo_scene_file();

/// Throws MachineError if the program was installed without its scenes.
Scene demo_scene();

}  // namespace mobbscope
