#include <import/csv.h>
#include <import/error.h>
#include <import/file.h>
#include <import/import.h>
#include <import/motion.h>
#include <import/motion_clips.h>
#include <import/text.h>
#include <import/track_clips.h>
#include <import/tracks.h>

#include <array>
#include <map>
#include <stdexcept>

namespace mobbscope {

namespace {

constexpr double kMaxFps = 1e6;
constexpr double kMaxUnit = 1e6;
constexpr std::array<std::pair<std::string_view, Origin>, 3> kOrigins{
    {{"keep", Origin::keep}, {"start", Origin::start}, {"start_heading", Origin::start_heading}}};

void require(bool in_range, const std::string& message) {
    if (!in_range) throw std::invalid_argument(message);
}

bool is_unit(const std::string& text) {
    const std::optional<double> scale = metres_per_unit(text);
    return text == "auto" || (scale && *scale > 0 && *scale <= kMaxUnit);
}

}  // namespace

void check(const ImportOptions& options) {
    // Written so that NaN fails each of them.
    require(!options.fps || (*options.fps > 0 && *options.fps <= kMaxFps), "fps must be over 0 and at most 1000000");
    require(!options.unit || is_unit(*options.unit),
            "unit must be m, cm, in, auto or metres per file unit (over 0, at most 1000000)");
    require(!options.up || *options.up == "y" || *options.up == "z", "up must be y or z");
    require(!options.trim || (options.trim->first >= 0 && options.trim->first < options.trim->second &&
                              options.trim->second <= mobb::kMaxTime),
            "trim must be two times A and B in seconds, 0 <= A < B <= " + short_double(mobb::kMaxTime));
    require(!options.radius || (*options.radius >= 0 && *options.radius <= mobb::kMaxLength),
            "radius must be from 0 to " + short_double(mobb::kMaxLength) + " metres");
    require(!options.dt || (*options.dt >= mobb::kLeastDt && *options.dt <= mobb::kMaxTime),
            "dt must be from " + short_double(mobb::kLeastDt) + " to " + short_double(mobb::kMaxTime) + " seconds");
}

std::optional<double> metres_per_unit(const std::string& unit) {
    if (unit == "m") return 1;
    if (unit == "cm") return 0.01;
    if (unit == "in") return 0.0254;
    return parse_double(unit);
}

std::string_view name(Origin origin) {
    for (const auto& [text, value] : kOrigins) {
        if (value == origin) return text;
    }
    return "";
}

std::optional<Origin> origin_from_name(std::string_view name) {
    for (const auto& [text, value] : kOrigins) {
        if (text == name) return value;
    }
    return std::nullopt;
}

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
