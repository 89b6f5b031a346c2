#include <base/error.h>
#include <base/file.h>
#include <crowd/graph/recordings.h>
#include <scene/load_files.h>
#include <scene/scene_edits.h>

#include <string>
#include <system_error>
#include <utility>

namespace mobbscope {

std::vector<std::filesystem::path> clip_files(const std::vector<std::filesystem::path>& places) {
    std::vector<std::filesystem::path> out;
    for (const std::filesystem::path& place : places) {
        std::error_code ignored;
        if (std::filesystem::is_directory(place, ignored)) {
            for (std::filesystem::path& file : clips_in(place, true)) out.push_back(std::move(file));
        } else if (lower_extension(place) == ".json") {
            throw InputError(place.string(), "", "a graph is built from clip files; name those of the scene");
        } else {
            out.push_back(place);
        }
    }
    return out;
}

Scene load_recordings(const std::vector<std::filesystem::path>& files, const std::filesystem::path& scene_file,
                      const ImportOptions& options, const Progress& progress) {
    Scene scene = load_files(files, options, progress);
    move_to_file(scene, scene_file);
    return scene;
}

}  // namespace mobbscope
