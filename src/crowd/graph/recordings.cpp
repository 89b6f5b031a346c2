#include <base/file.h>
#include <crowd/graph/recordings.h>
#include <import/import.h>
#include <scene/load_files.h>
#include <scene/scene_edits.h>

#include <algorithm>
#include <string>
#include <system_error>
#include <utility>

namespace mobbscope {

namespace {

bool is_clip(const std::filesystem::path& file) {
    const std::optional<Contents> contents = contents_by_name(file);
    return contents && contents != Contents::trajectories;
}

std::vector<std::filesystem::path> clips_below(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> out;
    std::error_code error;
    // Stepped by hand: the loop's own ++ would throw.
    for (std::filesystem::recursive_directory_iterator at(folder, error), end; !error && at != end;
         at.increment(error)) {
        std::error_code ignored;
        if (is_clip(at->path()) && at->is_regular_file(ignored)) out.push_back(at->path());
    }
    if (error) throw InputError(folder.string(), "", "the folder cannot be read: " + error.message());
    if (out.empty()) {
        throw InputError(folder.string(), "",
                         "there are no clips in this folder (" + listed_clip_extensions(", ") + ")");
    }
    std::sort(out.begin(), out.end());
    return out;
}

}  // namespace

std::vector<std::filesystem::path> clip_files(const std::vector<std::filesystem::path>& places) {
    std::vector<std::filesystem::path> out;
    for (const std::filesystem::path& place : places) {
        std::error_code ignored;
        if (std::filesystem::is_directory(place, ignored)) {
            for (std::filesystem::path& file : clips_below(place)) out.push_back(std::move(file));
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
