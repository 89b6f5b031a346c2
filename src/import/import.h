/// Files to clips: one door for every format.
#pragma once

#include <import/clip/imported_clip.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace mobbscope {

/// Reads clips from files, each file once however many of its clips are asked for.
class Importer {
  public:
    Importer();
    ~Importer();

    /// Every clip in a file, by its extension (.csv .bvh .gltf .glb .fbx, trajectories .txt .ndjson .yaml .yml), in the
    /// file's order: of many tracks each of them, unless options.id names one; likewise of several animations and
    /// options.animation. Throws InputError.
    std::vector<ImportedClip> clips(const std::filesystem::path& file, const ImportOptions& options);

  private:
    struct ParsedFiles;
    std::unique_ptr<ParsedFiles> parsed_;
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

/// The format is told by the file's extension; what is no CSV and no trajectory file has a skeleton.
ApplicableOptions applicable(const ImportOptions& options, const std::filesystem::path& file);

}  // namespace mobbscope
