/// Files to clips, whatever their format.
#pragma once

#include <import/clip/imported_clip.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {

/// What the files of a format hold, which decides what options mean something for them.
enum class Contents : std::uint8_t {
    skeletons,     ///< joints that move: clips of one body
    table,         ///< rows of numbers: clips without joints
    trajectories,  ///< a crowd by one clock: every track is a clip, placed in time
};

/// What the extension of a file tells, whether or not it exists; nothing for what no reader takes.
std::optional<Contents> contents_by_name(const std::filesystem::path& file);

/// All extensions that a reader takes, in lower case with their dots.
std::span<const std::string_view> clip_extensions();

/// For messages and help: the extensions of clips, ".bvh .gltf", or those of trajectories.
std::string listed_clip_extensions(std::string_view separator = " ");
std::string listed_trajectory_extensions();

/// Makes clips of a file that has been parsed. Throws InputError.
using ParsedFile = std::function<std::vector<ImportedClip>(const std::filesystem::path&, const ImportOptions&)>;

/// Reads clips from files, each file once however many of its clips are asked for.
class Importer {
  public:
    /// Every clip in a file, by its extension, in the file's order: of many tracks each of them, unless options.id
    /// names one; likewise of several animations and options.animation. Throws InputError.
    std::vector<ImportedClip> clips(const std::filesystem::path& file, const ImportOptions& options);

  private:
    std::map<std::filesystem::path, ParsedFile> parsed_;
};

/// The same for one file.
std::vector<ImportedClip> import_clips(const std::filesystem::path& file, const ImportOptions& options);

/// Options with those left out that mean nothing for a file of one format.
struct ApplicableOptions {
    ImportOptions options;
    std::vector<std::string> left_out;  ///< their keys in a scene: "up", "root", ...
};

/// Why an option was left out: "up does not apply to .csv files".
std::string does_not_apply(const std::string& key, const std::filesystem::path& file);

/// A file that no reader takes counts as one with a skeleton.
ApplicableOptions applicable(const ImportOptions& options, const std::filesystem::path& file);

}  // namespace mobbscope
