#include <base/error.h>
#include <base/file.h>
#include <base/text.h>
#include <import/bvh/bvh.h>
#include <import/import.h>
#include <import/nodes/fbx.h>
#include <import/nodes/gltf.h>
#include <import/skeleton/motion.h>
#include <import/skeleton/motion_clips.h>
#include <import/tracks/csv.h>
#include <import/tracks/track_clips.h>
#include <import/tracks/tracks.h>

#include <array>
#include <map>
#include <stdexcept>
#include <utility>

namespace mobbscope {

namespace {

std::unique_ptr<MotionFile> read_bvh(const std::filesystem::path& file) {
    return bvh_motion(parse_bvh(read_file(file), file.string()));
}

using MotionReader = std::unique_ptr<MotionFile> (*)(const std::filesystem::path&);
constexpr std::array<std::pair<std::string_view, MotionReader>, 4> kReaders{
    {{".bvh", read_bvh}, {".gltf", read_gltf}, {".glb", read_gltf}, {".fbx", read_fbx}}};

MotionReader reader_for(std::string_view extension) {
    for (const auto& [name, reader] : kReaders) {
        if (name == extension) return reader;
    }
    return nullptr;
}

}  // namespace

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

std::string does_not_apply(const std::string& key, const std::filesystem::path& file) {
    // Of the units it is only this one.
    return (key == "unit" ? "unit auto" : key) + " does not apply to " + lower_extension(file) + " files";
}

ApplicableOptions applicable(const ImportOptions& options, const std::filesystem::path& file) {
    ApplicableOptions out{options, {}};
    const auto leave_out = [&out](auto& option, const char* key) {
        if (!option) return;
        option.reset();
        out.left_out.emplace_back(key);
    };
    const std::string extension = lower_extension(file);
    if (extension == ".csv" || is_track_extension(extension)) {
        leave_out(out.options.animation, "animation");
        leave_out(out.options.root, "root");
        leave_out(out.options.up, "up");
        // Without a body's height there is nothing to guess the unit from.
        if (extension == ".csv" && out.options.unit == "auto") leave_out(out.options.unit, "unit");
    } else {
        leave_out(out.options.id, "id");
        leave_out(out.options.dt, "dt");
    }
    return out;
}

bool is_motion_extension(const std::string& extension) { return reader_for(extension) != nullptr; }

std::unique_ptr<MotionFile> read_motion(const std::filesystem::path& file) {
    const MotionReader reader = reader_for(lower_extension(file));
    if (!reader) throw InputError(file.string(), "", "is no motion file; give .bvh, .gltf, .glb or .fbx");
    return reader(file);
}

}  // namespace mobbscope
