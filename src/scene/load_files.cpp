#include <base/error.h>
#include <base/text.h>
#include <import/import.h>
#include <scene/arrangement.h>
#include <scene/load_files.h>
#include <scene/scene_edits.h>

#include <algorithm>
#include <system_error>

namespace mobbscope {

namespace {

/// Adds the clips in a folder; with `unreadable` those below it too.
void add_clips(const std::filesystem::path& folder, std::vector<std::filesystem::path>& clips,
               std::vector<UnreadableFolder>* unreadable) {
    std::error_code error;
    // Stepped by hand: the loop's own ++ would throw.
    for (std::filesystem::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
        std::error_code ignored;
        const std::optional<Contents> contents = contents_by_name(at->path());
        if (contents && contents != Contents::trajectories && at->is_regular_file(ignored)) clips.push_back(at->path());
        // A link could lead to a folder above.
        if (unreadable && at->is_directory(ignored) && !at->is_symlink(ignored))
            add_clips(at->path(), clips, unreadable);
    }
    if (!error) return;
    const InputError why(folder, "the folder cannot be read: " + error.message());
    if (!unreadable) throw why;
    unreadable->push_back({folder, why.what()});
}

}  // namespace

std::vector<std::filesystem::path> clips_in(const std::filesystem::path& folder,
                                            std::vector<UnreadableFolder>* unreadable) {
    std::vector<std::filesystem::path> out;
    add_clips(folder, out, unreadable);
    if (out.empty() && unreadable && !unreadable->empty()) throw InputError(unreadable->front().why);
    if (out.empty()) {
        throw InputError(folder, "there are no clips in this folder (" + listed_clip_extensions(", ") + ")");
    }
    std::sort(out.begin(), out.end());
    return out;
}

std::span<const std::string_view> openable_extensions() {
    static const std::vector<std::string_view> extensions = [] {
        std::vector<std::string_view> out{".json"};
        out.insert(out.end(), clip_extensions().begin(), clip_extensions().end());
        return out;
    }();
    return extensions;
}

std::string openable_files() {
    return "A scene (.json), a clip (" + listed_clip_extensions() + ") or trajectories (" +
           listed_trajectory_extensions() + ")";
}

std::string openable_files_in_short() { return "scenes and captures .json, clips " + listed_clip_extensions(); }

Scene load_files(const std::vector<std::filesystem::path>& files, const ImportOptions& overrides,
                 const Progress& progress, Importer* importer) {
    std::vector<std::filesystem::path> all;
    for (const std::filesystem::path& file : files) {
        std::error_code ignored;
        if (std::filesystem::is_directory(file, ignored)) {
            for (std::filesystem::path& clip : clips_in(file)) all.push_back(std::move(clip));
        } else {
            all.push_back(file);
        }
    }
    // A scene's view and fit are what the others join.
    std::stable_partition(all.begin(), all.end(), is_scene_file);
    Scene scene;
    for (std::size_t i = 0; i < all.size(); ++i) {
        // One scene tells of its clips; of several files the count is of files.
        const Progress of_file = !progress || all.size() == 1
                                     ? progress
                                     : Progress([&](std::size_t, std::size_t) { progress(i, all.size()); });
        merge(scene, load_scene(all[i], overrides, of_file, importer));
    }
    if (std::none_of(all.begin(), all.end(), is_scene_file)) lay_out_clips(scene);
    if (all.size() > 1 && !scene_file_of(files)) {
        // It is named for all of them; sources go on leading from where they did.
        const bool folder = files.size() == 1;
        const std::filesystem::path name =
            folder ? all.front().parent_path().filename() : std::filesystem::path(counted(all.size(), "file", "files"));
        scene.file = scene.file.parent_path() / name;
    }
    return scene;
}

std::optional<std::filesystem::path> scene_file_of(const std::vector<std::filesystem::path>& files) {
    if (std::count_if(files.begin(), files.end(), is_scene_file) != 1) return std::nullopt;
    return *std::find_if(files.begin(), files.end(), is_scene_file);
}

std::filesystem::path demo_scene_file() {
    std::error_code error;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
    const std::filesystem::path name = "scenes/crossing.json";
    std::filesystem::path installed = (program.parent_path() / MOBBSCOPE_ASSETS_FROM_BIN / name).lexically_normal();
    if (!error && std::filesystem::exists(installed, error)) return installed;
    std::filesystem::path as_built = std::filesystem::path(MOBBSCOPE_ASSETS_AS_BUILT) / name;
    if (std::filesystem::exists(as_built, error)) return as_built;
    throw MachineError("the demo scene is neither at " + installed.string() + " nor at " + as_built.string() +
                       "; install the program again");
}

Scene demo_scene() { return load_scene(demo_scene_file()); }

}  // namespace mobbscope
