/// Clips of a scene read anew with other import options.
#pragma once

#include <import/import.h>
#include <scene/scene.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace mobbscope {

/// A file that clips come from, as it was read: changing an option does not read it anew.
struct SourceFile {
    std::filesystem::path path;
    std::filesystem::file_time_type written{};
    std::uintmax_t size = 0;
    ParsedFile parsed;
};

/// The file as it is now: `known` (null: nothing) if that is it and it has not changed since, else read. Throws
/// InputError.
std::shared_ptr<const SourceFile> source_file(const std::filesystem::path& path,
                                              const std::shared_ptr<const SourceFile>& known);

/// A file of radii among the clip's options becomes the clip's own radius, so that a scene needs no such file.
void name_own_radius(SceneClip& clip);

/// Where a clip's source is. Requires one.
std::filesystem::path source_path(const Scene& scene, const SceneClip& clip);

/// The clips that come from the same file as one with a source, itself included: indices into Scene::clips.
std::vector<int> clips_of_same_source(const Scene& scene, int clip);

/// Makes clips of one file.
using ImportFile = std::function<std::vector<ImportedClip>(const ImportOptions&)>;

/// The clips of a file, or the one that is warped: then a part of a motion by `trim`, behind which the file goes on for
/// a frame at least, whose root is where the file has it. Throws InputError, and std::invalid_argument for a warp that
/// does not suit the file.
std::vector<ImportedClip> import_warped(const ImportFile& import, const ImportOptions& options, const ClipWarp* warp);

/// A clip as it is with other options.
struct ReimportedClip {
    int clip = 0;  ///< index into Scene::clips
    SceneClip is{};
};

/// Clips of one file with those options, each by its index. Throws InputError, as load_scene would.
std::vector<ReimportedClip> reimport(const Scene& scene, const SourceFile& file,
                                     const std::vector<std::pair<int, ImportOptions>>& wanted);

/// A clip with inline samples, between which it moves otherwise.
ReimportedClip with_motion(const Scene& scene, int clip, mobb::Motion motion);

/// Puts them into the scene; those that are no longer there, or are of another source now, are ignored. What was
/// recorded of them is dropped: traces, and of expected answers the contact. Agents that started when their track did
/// go on doing so. Throws std::invalid_argument where somebody would start too far from 0 for the clip's dt.
void replace_clips(Scene& scene, const std::vector<ReimportedClip>& clips);

}  // namespace mobbscope
