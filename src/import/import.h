/// Files to clips, whatever their format.
#pragma once

#include <base/input.h>
#include <import/clip/import_options.h>
#include <import/clip/imported_clip.h>
#include <import/tracks/tracks.h>

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {

/// What the extension of a file tells, whether or not it exists, that of "a.csv.gz" as that of "a.csv"; nothing for
/// what no reader takes.
std::optional<Contents> contents_by_name(const std::filesystem::path& file);

/// The same by the content where the extension tells nothing; nothing too if there is no such file.
std::optional<Contents> contents_of(const std::filesystem::path& file);

/// All extensions that a reader takes, in lower case with their dots.
std::span<const std::string_view> clip_extensions();

/// For messages and help: the extensions of clips, ".bvh .gltf", or those of trajectories.
std::string listed_clip_extensions(std::string_view separator = " ");
std::string listed_trajectory_extensions();

/// A file that has been read: makes clips of it, however often. Safe from any number of threads.
struct ParsedFile {
    /// Gives every clip in the file, in its order: of many tracks each of them, unless options.id names one; likewise
    /// of several animations and options.animation. `last`: the file is not asked again, and gives up its memory as the
    /// clips are made. Throws InputError.
    std::function<void(const ImportOptions&, const ClipSink&, bool last)> each;
    /// What the file has for each option; depends on a part of `options` alone (offer_depends_on). Throws InputError.
    std::function<ImportOffer(const ImportOptions&)> offer;

    /// All of `each`.
    std::vector<ImportedClip> clips(const ImportOptions& options) const;
};

/// One kind of file, whatever its name: a row of the table of formats.
struct FileReader {
    std::string_view name;  ///< of its fuzz target
    ParsedFile (*parse)(const std::filesystem::path&, const Input& input);
    Contents contents;
    bool (*holds)(std::string_view);  ///< whether bytes are of this kind, by the first 64 KiB of them
    FormatNote note{};                ///< of tracks
};

/// All readers. The first that holds a file reads it.
std::span<const FileReader* const> file_readers();

/// The rows of the table in docs/trajectories.md.
std::string documented_track_formats();

/// Reads a file, which may be standard input ("-") and packed by gzip. What it is its content tells; where that tells
/// nothing, its extension. Throws InputError.
ParsedFile parse_clip_file(const std::filesystem::path& file);

/// Of the options those that an offer depends on.
ImportOptions offer_depends_on(const ImportOptions& options);

/// Reads clips from files, each file once however many of its clips are asked for.
class Importer {
  public:
    /// ParsedFile::clips of a file.
    std::vector<ImportedClip> clips(const std::filesystem::path& file, const ImportOptions& options);

  private:
    struct Known {
        ParsedFile file;
        std::optional<ImportOptions> asked_with{};  ///< when one track was asked for last: without its id
        std::vector<ImportedClip> tracks{};         ///< all, once two were asked for with the same options
    };
    std::map<std::filesystem::path, Known> known_;
};

/// Gives every clip of one file (ParsedFile::each), and holds no more than that takes. Throws InputError.
void import_each(const std::filesystem::path& file, const ImportOptions& options, const ClipSink& sink);
/// The same, all at once.
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
