#include <base/error.h>
#include <base/file.h>
#include <base/text.h>
#include <import/bvh/bvh.h>
#include <import/clip/held_steps.h>
#include <import/clip/sample_times.h>
#include <import/fbx/fbx.h>
#include <import/foreign_files.h>
#include <import/import.h>
#include <import/nodes/gltf.h>
#include <import/nodes/gltf_file.h>
#include <import/skeleton/motion.h>
#include <import/skeleton/motion_clips.h>
#include <import/tracks/csv.h>
#include <import/tracks/logs.h>
#include <import/tracks/mapf_plan.h>
#include <import/tracks/sumo.h>
#include <import/tracks/tracks.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <memory>
#include <system_error>
#include <type_traits>
#include <utility>
#include <variant>

namespace mobbscope {

namespace {

MotionFile read_bvh(std::string_view text, const std::string& file) { return bvh_motion(parse_bvh(text, file)); }
CsvFile read_csv(std::string text, const std::string& file) { return {std::move(text), file}; }

std::vector<ImportedClip> table_clips(const CsvFile& table, const std::filesystem::path& file,
                                      const ImportOptions& options) {
    return csv_clips(*table.table(options), file, options);
}

ImportOffer table_offer(const CsvFile& table, const std::filesystem::path& file, const ImportOptions& options) {
    return csv_offer(*table.table(options), file, options);
}

/// What `read` makes of a file, and the clips and the offer of that.
template <auto read, auto to_clips, auto to_offer>
ParsedFile parse_once(const std::filesystem::path& file, InputBytes input) {
    using Parsed = decltype(read(std::move(input.bytes), file.string()));
    const auto parsed = std::make_shared<const Parsed>(read(std::move(input.bytes), file.string()));
    // A table keeps its text.
    const auto spent =
        std::make_shared<const Spent>(std::is_same_v<Parsed, CsvFile> ? std::move(input.spent) : Spent());
    const auto checked = [file](const ImportOptions& options) {
        at_place(file.string(), "", [&] { check(options); });
        if (options.columns && !std::is_same_v<Parsed, CsvFile>)
            throw InputError(file.string(), "",
                             "columns are for tables with a header, which this is not; leave it out");
    };
    return {[=](const ImportOptions& options) {
                checked(options);
                static_cast<void>(spent);
                std::vector<ImportedClip> clips = to_clips(*parsed, file, options);
                for (ImportedClip& clip : clips) {
                    warn_of_long_held_step(*clip.clip, clip.facts.warnings);
                    at_place(file.string(), clip.id.empty() ? "" : "track " + in_quotes(clip.id),
                             [&] { mobb::checked({.start = clip.start}, clip.clip->most_start()); });
                    warn_of_coarse_times(*clip.clip, clip.start, clip.facts.warnings);
                }
                return clips;
            },
            [=](const ImportOptions& options) {
                checked(options);
                return to_offer(*parsed, file, options);
            }};
}

/// One kind of file, whatever its name.
struct FileReader {
    ParsedFile (*parse)(const std::filesystem::path&, InputBytes input);
    Contents contents;
    /// Whether bytes are of this kind, by their first kHead of them; null: their name tells.
    bool (*holds)(std::string_view) = nullptr;
};

constexpr std::size_t kHead = std::size_t{1} << 16;  // bytes

bool looks_like_bvh(std::string_view text) { return text.substr(0, text.find_first_of(" \t\r\n")) == "HIERARCHY"; }

constexpr FileReader kBvh{parse_once<read_bvh, motion_clips, motion_offer>, Contents::skeletons, looks_like_bvh};
constexpr FileReader kGltf{parse_once<parse_gltf, motion_clips, motion_offer>, Contents::skeletons, looks_like_gltf};
constexpr FileReader kFbx{parse_once<parse_fbx, motion_clips, motion_offer>, Contents::skeletons, looks_like_fbx};
constexpr FileReader kJupedsim{parse_once<parse_jupedsim, track_clips, track_offer>, Contents::trajectories, is_sqlite};
constexpr FileReader kTrajnetpp{parse_once<parse_trajnetpp, track_clips, track_offer>, Contents::trajectories,
                                looks_like_trajnetpp};
constexpr FileReader kMapfPlan{parse_once<parse_mapf_plan, track_clips, track_offer>, Contents::trajectories,
                               looks_like_mapf_plan};
constexpr FileReader kTextPlan{parse_once<parse_mapf_text_plan, track_clips, track_offer>, Contents::trajectories,
                               looks_like_mapf_text_plan};
constexpr FileReader kRobotRunners{parse_once<parse_robot_runners, track_clips, track_offer>, Contents::trajectories,
                                   looks_like_robot_runners};
constexpr FileReader kCcbsPlan{parse_once<parse_ccbs_plan, track_clips, track_offer>, Contents::trajectories,
                               looks_like_ccbs_plan};
constexpr FileReader kTrackerPlan{parse_once<parse_mapf_tracker, track_clips, track_offer>, Contents::trajectories,
                                  looks_like_mapf_tracker};
constexpr FileReader kSumoXml{parse_once<parse_sumo_xml, track_clips, track_offer>, Contents::trajectories,
                              looks_like_sumo_xml};
constexpr FileReader kSumoTable{parse_once<parse_sumo_table, track_clips, track_offer>, Contents::trajectories,
                                looks_like_sumo_table};
constexpr FileReader kLog{parse_once<parse_log, track_clips, track_offer>, Contents::trajectories, looks_like_log};
constexpr FileReader kTable{parse_once<read_csv, table_clips, table_offer>, Contents::table, looks_like_table};
constexpr FileReader kTextTracks{parse_once<parse_text_tracks, track_clips, track_offer>, Contents::trajectories,
                                 looks_like_text_tracks};

/// Those that are told by content. The first that holds a file reads it.
constexpr const FileReader* kByContent[] = {&kJupedsim,     &kBvh,         &kFbx,     &kGltf,     &kTrajnetpp,
                                            &kRobotRunners, &kCcbsPlan,    &kSumoXml, &kMapfPlan, &kTextPlan,
                                            &kSumoTable,    &kTrackerPlan, &kLog,     &kTable,    &kTextTracks};

struct Format {
    std::string_view extension;
    const FileReader* reader;  ///< of tables and trajectories what is taken where the content tells nothing
    bool in_help = true;       ///< false of a second spelling
};

/// Every format, in the order of help and messages.
constexpr Format kFormats[] = {
    {".bvh", &kBvh},
    {".gltf", &kGltf},
    {".glb", &kGltf},
    {".vrma", &kGltf, false},
    {".fbx", &kFbx},
    {".csv", &kTable},
    {".tsv", &kTable, false},
    {".txt", &kTextTracks},
    {".ndjson", &kTrajnetpp},
    {".yaml", &kMapfPlan},
    {".yml", &kMapfPlan, false},
    {".xml", &kSumoXml},
    {".sqlite", &kJupedsim},
    {".sqlite3", &kJupedsim, false},
    {".db", &kJupedsim, false},
};

const Format* format_of(const std::filesystem::path& file) {
    const auto found = std::ranges::find(kFormats, unpacked_extension(file), &Format::extension);
    return found == std::end(kFormats) ? nullptr : found;
}

/// Null where no reader holds them, or none of files with skeletons where it has to be one.
const FileReader* reader_of(std::string_view bytes, bool has_skeletons = false) {
    const auto head = bytes.substr(0, kHead);
    const auto at = std::ranges::find_if(kByContent, [&](const FileReader* reader) {
        return (!has_skeletons || reader->contents == Contents::skeletons) && reader->holds(head);
    });
    return at == std::end(kByContent) ? nullptr : *at;
}

/// ".bvh, .gltf and .fbx": `last` stands before the last one.
std::string list_formats(bool trajectories, std::string_view separator, std::string_view last) {
    std::vector<std::string_view> names;
    for (const Format& format : kFormats) {
        if (format.in_help && (format.reader->contents == Contents::trajectories) == trajectories)
            names.push_back(format.extension);
    }
    std::string out;
    for (std::size_t i = 0; i < names.size(); ++i) {
        out += (i == 0 ? "" : std::string(i + 1 == names.size() ? last : separator)) + std::string(names[i]);
    }
    return out;
}

}  // namespace

std::optional<Contents> contents_by_name(const std::filesystem::path& file) {
    const Format* format = format_of(file);
    return format ? std::optional(format->reader->contents) : std::nullopt;
}

std::optional<Contents> contents_of(const std::filesystem::path& file) {
    if (const std::optional<Contents> by_name = contents_by_name(file)) return by_name;
    const FileReader* const reader = reader_of(read_beginning(file, kHead));
    return reader ? std::optional(reader->contents) : std::nullopt;
}

std::span<const std::string_view> clip_extensions() {
    static constexpr auto extensions = [] {
        std::array<std::string_view, std::size(kFormats)> out{};
        std::ranges::transform(kFormats, out.begin(), &Format::extension);
        return out;
    }();
    return extensions;
}

std::string listed_clip_extensions(std::string_view separator) { return list_formats(false, separator, separator); }
std::string listed_trajectory_extensions() { return list_formats(true, " ", " "); }

ParsedFile parse_clip_file(const std::filesystem::path& file) {
    const Format* const format = format_of(file);
    const bool is_motion = format && format->reader->contents == Contents::skeletons;
    std::error_code ignored;
    const bool is_there = is_standard_input(file) || std::filesystem::exists(file, ignored);
    if (!format && !is_there && lower_extension(file).empty())
        throw InputError(file.string(), "", "no such file or folder; check the path");
    const char* what = "no reader for this kind of file";
    if (format || is_there) {
        InputBytes input = read_input(file);
        const std::string& bytes = input.bytes;
        if (bytes.empty() && !format) throw InputError(file.string(), "", "is empty; give a table or tracks");
        const FileReader* reader = reader_of(bytes, is_motion);
        if (!reader && is_motion) reader = format->reader;
        // A name that says what it is says so of text that tells nothing: then its reader knows what is wrong.
        if (!reader) {
            if (const auto kind = foreign_kind(bytes)) throw InputError(file.string(), "", *kind);
            if (format) reader = format->reader;
        }
        if (reader) return reader->parse(file, std::move(input));
        const auto is_control = [](char c) { return c >= 0 && c < ' ' && c != '\t' && c != '\n' && c != '\r'; };
        if (is_utf8(bytes) && std::ranges::none_of(bytes, is_control))
            what = "looks like text, but no table with a header such as id,t,x,y, no rows of numbers and no plan";
    }
    throw InputError(file.string(), "",
                     std::string(what) + "; clips can be " + list_formats(false, ", ", " and ") + ", trajectories " +
                         list_formats(true, ", ", " and ") + ", scenes .json");
}

ImportOptions offer_depends_on(const ImportOptions& options) {
    ImportOptions out;
    out.animation = options.animation;
    out.root = options.root;
    out.up = options.up;
    out.dt = options.dt;
    out.fps = options.fps;
    out.columns = options.columns;
    return out;
}

std::vector<ImportedClip> Importer::clips(const std::filesystem::path& file, const ImportOptions& options) {
    at_place(file.string(), "", [&] { check(options); });
    auto at = known_.find(file);
    if (at == known_.end()) at = known_.emplace(file, Known{parse_clip_file(file)}).first;
    Known& known = at->second;
    if (!options.id) return known.file.clips(options);
    // Who asks for a second track will ask for a thousand, and each alone takes a look at the whole file.
    ImportOptions of_all = options;
    of_all.id.reset();
    if (known.asked_with != of_all) {
        known.asked_with = of_all;
        known.tracks.clear();
        return known.file.clips(options);
    }
    try {
        if (known.tracks.empty()) known.tracks = known.file.clips(of_all);
    } catch (const InputError&) {
        // What is wrong with another track does not matter.
    }
    const auto track = std::ranges::find(known.tracks, *options.id, &ImportedClip::id);
    return track == known.tracks.end() ? known.file.clips(options) : std::vector{*track};
}

std::vector<ImportedClip> import_clips(const std::filesystem::path& file, const ImportOptions& options) {
    return Importer().clips(file, options);
}

std::string does_not_apply(const std::string& key, const std::filesystem::path& file) {
    const std::string extension = unpacked_extension(file);
    // Of the units it is only this one.
    return (key == "unit" ? "unit auto" : key) + " does not apply to " +
           (extension.empty() ? shown_name(file) : extension + " files");
}

ApplicableOptions applicable(const ImportOptions& options, const std::filesystem::path& file) {
    ApplicableOptions out{options, {}};
    const Contents contents = contents_of(file).value_or(Contents::skeletons);
    for (const ImportOption& option : kImportOptions) {
        // Without a body's height there is nothing to guess the unit from.
        const bool guess =
            contents == Contents::table && option.key == std::string_view("unit") && options.unit == "auto";
        if (!option.is_given(options) || (option.means_something_for(contents) && !guess)) continue;
        std::visit([&](auto member) { (out.options.*member).reset(); }, option.member);
        out.left_out.emplace_back(option.key);
    }
    return out;
}

}  // namespace mobbscope
