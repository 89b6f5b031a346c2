#include <base/error.h>
#include <base/file.h>
#include <base/text.h>
#include <import/import.h>
#include <import/skeleton/motion.h>
#include <import/skeleton/motion_clips.h>
#include <import/tracks/csv.h>
#include <import/tracks/track_clips.h>
#include <import/tracks/tracks.h>

#include <array>
#include <map>
#include <stdexcept>

namespace mobbscope {

struct Importer::ParsedFiles {
    std::map<std::filesystem::path, CsvTable> tables;
    std::map<std::filesystem::path, TrackFile> tracks;
    std::map<std::filesystem::path, std::unique_ptr<MotionFile>> motions;
};

Importer::Importer() : parsed_(std::make_unique<ParsedFiles>()) {}
Importer::~Importer() = default;

std::vector<ImportedClip> Importer::clips(const std::filesystem::path& file, const ImportOptions& options) {
    try {
        check(options);
    } catch (const std::invalid_argument& error) {
        throw InputError(file.string(), "", error.what());
    }
    // The one place that knows which reader takes which extension.
    const std::string extension = lower_extension(file);
    if (extension == ".csv") {
        auto table = parsed_->tables.find(file);
        if (table == parsed_->tables.end()) {
            table = parsed_->tables.emplace(file, parse_csv(read_file(file), file.string())).first;
        }
        return csv_clips(table->second, file, options);
    }
    if (is_motion_extension(extension)) {
        std::unique_ptr<MotionFile>& motion = parsed_->motions[file];
        if (!motion) motion = read_motion(file);
        return motion_clips(*motion, file, options);
    }
    if (is_track_extension(extension)) {
        auto tracks = parsed_->tracks.find(file);
        if (tracks == parsed_->tracks.end()) tracks = parsed_->tracks.emplace(file, read_tracks(file)).first;
        return track_clips(tracks->second, file, options);
    }
    std::error_code ignored;
    if (extension.empty() && !std::filesystem::exists(file, ignored)) {
        throw InputError(file.string(), "", "no such file or folder; check the path");
    }
    throw InputError(
        file.string(), "",
        "no reader for this kind of file; clips can be .bvh, .gltf, .glb, .fbx and .csv, trajectories .txt, "
        ".ndjson and .yaml, scenes .json");
}

std::vector<ImportedClip> import_clips(const std::filesystem::path& file, const ImportOptions& options) {
    return Importer().clips(file, options);
}

}  // namespace mobbscope
