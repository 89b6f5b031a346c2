#include <base/error.h>
#include <base/file.h>
#include <base/input.h>
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
#include <import/tracks/mapf_plan.h>
#include <import/tracks/sumo.h>
#include <import/tracks/text_rows.h>
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
TableFile read_table(const Input& text, const std::string& file) { return {text, file}; }

/// ParsedFile::each and ParsedFile::offer of what was read.
void give(const MotionFile& motion, const std::filesystem::path& file, const ImportOptions& options,
          const ClipSink& sink, bool) {
    for (ImportedClip& clip : motion_clips(motion, file, options)) sink(std::move(clip));
}
void give(TrackFile& tracks, const std::filesystem::path& file, const ImportOptions& options, const ClipSink& sink,
          bool last) {
    give_track_clips(tracks, file, options, sink, last);
}
void give(TableFile& table, const std::filesystem::path& file, const ImportOptions& options, const ClipSink& sink,
          bool last) {
    give_track_clips(*table.table(options, last), file, options, sink, last);
}
ImportOffer offer_of(const MotionFile& motion, const std::filesystem::path& file, const ImportOptions& options) {
    return motion_offer(motion, file, options);
}
ImportOffer offer_of(const TrackFile& tracks, const std::filesystem::path& file, const ImportOptions& options) {
    return track_offer(tracks, file, options);
}
ImportOffer offer_of(const TableFile& table, const std::filesystem::path& file, const ImportOptions& options) {
    return track_offer(*table.table(options), file, options);
}

/// What was read, not yet asked.
template <auto read>
auto parsed_by(const Input& input, const std::string& file) {
    // Rows come line by line.
    if constexpr (std::is_invocable_v<decltype(read), const Input&, const std::string&>) {
        return read(input, file);
    } else {
        return read(input.all().bytes, file);
    }
}

template <auto read>
ParsedFile parse_once(const std::filesystem::path& file, const Input& input) {
    using Parsed = decltype(parsed_by<read>(input, file.string()));
    const auto parsed = std::make_shared<Parsed>(parsed_by<read>(input, file.string()));
    if constexpr (std::is_same_v<Parsed, TrackFile>) parsed->is_large = input.is_large();
    const auto checked = [file](const ImportOptions& options) {
        at_place(file.string(), "", [&] { check(options); });
        if (options.columns && !std::is_same_v<Parsed, TableFile>)
            throw InputError(file.string(), "",
                             "columns are for tables with a header, which this is not; leave it out");
    };
    return {[=](const ImportOptions& options, const ClipSink& sink, bool last) {
                checked(options);
                const auto judged = [&](ImportedClip&& clip) {
                    warn_of_long_held_step(*clip.clip, clip.facts.warnings);
                    at_place(file.string(), clip.id.empty() ? "" : "track " + in_quotes(clip.id),
                             [&] { mobb::checked({.start = clip.start}, clip.clip->most_start()); });
                    warn_of_coarse_times(*clip.clip, clip.start, clip.facts.warnings);
                    sink(std::move(clip));
                };
                give(*parsed, file, options, judged, last);
            },
            [=](const ImportOptions& options) {
                checked(options);
                return offer_of(*parsed, file, options);
            }};
}

constexpr std::size_t kHead = std::size_t{1} << 16;  // bytes

bool looks_like_bvh(std::string_view text) { return text.substr(0, text.find_first_of(" \t\r\n")) == "HIERARCHY"; }

constexpr FileReader kBvh{"bvh", parse_once<read_bvh>, Contents::skeletons, looks_like_bvh};
constexpr FileReader kGltf{"gltf", parse_once<parse_gltf>, Contents::skeletons, looks_like_gltf};
constexpr FileReader kFbx{"fbx", parse_once<parse_fbx>, Contents::skeletons, looks_like_fbx};
constexpr FileReader kJupedsim{"jupedsim",
                               parse_once<parse_jupedsim>,
                               Contents::trajectories,
                               is_sqlite,
                               {"JuPedSim (`.sqlite`)", "tables `trajectory_data`, `metadata` (versions 1 to 3)",
                                "metres, `fps` of the metadata, else `--fps`"}};
constexpr FileReader kTrajnetpp{
    "trajnetpp",
    parse_once<parse_trajnetpp>,
    Contents::trajectories,
    looks_like_trajnetpp,
    {"TrajNet++ (`.ndjson`)", "`{\"scene\": {\"fps\"}}`, `{\"track\": {\"f\", \"p\", \"x\", \"y\"}}`",
     "metres, points a second as the scenes' `fps`"}};
constexpr FileReader kMapfPlan{"mapf-plan",
                               parse_once<parse_mapf_plan>,
                               Contents::trajectories,
                               looks_like_mapf_plan,
                               {"path-finding plans (`.yaml`)", "`schedule:`, a list of t, x, y for each agent",
                                "one cell a metre, one step a second"}};
constexpr FileReader kTextPlan{"mapf-text-plan",
                               parse_once<parse_mapf_text_plan>,
                               Contents::trajectories,
                               looks_like_mapf_text_plan,
                               {"plans of LaCAM, PIBT; of EECBS, CBSH2-RTC, MAPF-LNS2 (`.txt`)",
                                "a line a step: `3:(x,y),(x,y),`, below `solution=` or alone; or a line an agent: "
                                "`Agent 0: (row,column)->(row,column)->`",
                                "the same; of a line an agent x is the column, y the row (a warning says so)"}};
constexpr FileReader kRobotRunners{"robot-runners",
                                   parse_once<parse_robot_runners>,
                                   Contents::trajectories,
                                   looks_like_robot_runners,
                                   {"plans of Robot Runners (`.json`)",
                                    "`start`: [row, column, heading] of each robot; `actualPaths`, else "
                                    "`plannerPaths`: its actions, `F,R,C,W` or `R,D,L,U,W`",
                                    "one cell a metre, one step a second; x is the column, y the row"}};
constexpr FileReader kTrackerPlan{
    "mapf-tracker",
    parse_once<parse_mapf_tracker>,
    Contents::trajectories,
    looks_like_mapf_tracker,
    {"plans of the MAPF tracker (`.csv`)",
     "one row, whose `solution_plan` or `path` has a line of moves `u`, `d`, `l`, `r`, `w` for each agent; the "
     "scenario with their starts lies beside it, `MAP-TYPE-ID.scen`",
     "the same"}};
constexpr FileReader kCcbsPlan{"ccbs",
                               parse_once<parse_ccbs_plan>,
                               Contents::trajectories,
                               looks_like_ccbs_plan,
                               {"logs of Continuous-CBS (`.xml`)",
                                "sections of each agent's path, with their durations", "the same; time is continuous"}};
constexpr FileReader kSumo{
    "sumo",
    parse_once<parse_sumo>,
    Contents::trajectories,
    looks_like_sumo,
    {"SUMO's floating car data (`.xml`, `.csv`)",
     "vehicles, persons and containers of each timestep; who rides in a vehicle is left out",
     "metres; x and y are the middle of the front; `length` and `width` where they are written"}};
constexpr FileReader kTable{"csv",
                            parse_once<read_table>,
                            Contents::table,
                            looks_like_table,
                            {"PedPy, inD, highD, NGSIM and others (`.csv`)",
                             "[a table with ids](scenes_and_formats.md#csv)", "metres, or as names of columns say"}};
/// What tables of some programs are.
constexpr FormatNote kTableNotes[] = {
    {"EuRoC, exports of ROS bags (`.csv`)",
     "`p_RS_R_x [m]`; `pose.position.x`, of several robots by what is ahead of it",
     "metres; without ids a track a robot"},
    {"VISSIM, Viswalk (`.fzp`, `.pp`)",
     "`$VEHICLE:` or `$PEDESTRIAN:` with SIMSEC, NO and CoordFront, or CoordCentX and CoordCentY", "metres"},
};
constexpr FileReader kTextTracks{"text-tracks", parse_once<parse_text_tracks>, Contents::trajectories,
                                 looks_like_text_tracks};

/// Those that are told by content. The first that holds a file reads it.
constexpr const FileReader* kByContent[] = {&kJupedsim,     &kBvh,      &kFbx,       &kGltf,        &kTrajnetpp,
                                            &kRobotRunners, &kMapfPlan, &kTextPlan,  &kTrackerPlan, &kCcbsPlan,
                                            &kSumo,         &kTable,    &kTextTracks};

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
    {".xml", &kSumo},
    {".sqlite", &kJupedsim},
    {".sqlite3", &kJupedsim, false},
    {".db", &kJupedsim, false},
};

const Format* format_of(const std::filesystem::path& file) {
    const auto found = std::ranges::find(kFormats, unpacked_extension(file), &Format::extension);
    return found == std::end(kFormats) ? nullptr : found;
}

// ---- which reader

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

std::span<const FileReader* const> file_readers() { return kByContent; }

std::string documented_track_formats() {
    std::string out;
    const auto add = [&out](const FormatNote& note) {
        if (!note.who.empty())
            out.append("| ")
                .append(note.who)
                .append(" | ")
                .append(note.columns)
                .append(" | ")
                .append(note.assumed)
                .append(" |\n");
    };
    for (const RowFormat& format : row_formats()) add(format.note);
    for (const FileReader* reader : kByContent) add(reader->note);
    for (const FormatNote& note : kTableNotes) add(note);
    return out;
}

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
        const Input input = Input::open(file);
        std::string bytes = input.beginning(kHead);
        if (bytes.empty() && !format) throw InputError(file.string(), "", "is empty; give a table or tracks");
        const FileReader* reader = reader_of(bytes, is_motion);
        if (!reader && is_motion) reader = format->reader;
        // A name that says what it is says so of text that tells nothing: then its reader knows what is wrong.
        if (!reader) {
            if (const auto kind = foreign_kind(bytes)) throw InputError(file.string(), "", *kind);
            if (format) reader = format->reader;
        }
        if (reader) return reader->parse(file, input);
        const std::string name = file.string();
        const TextLines judged(bytes, name);  // refuses UTF-16 as for those that readers take
        while (!bytes.empty() && (bytes.back() & 0x80) != 0) bytes.pop_back();  // a letter may be cut
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

std::vector<ImportedClip> ParsedFile::clips(const ImportOptions& options) const {
    std::vector<ImportedClip> out;
    each(
        options, [&](ImportedClip&& clip) { out.push_back(std::move(clip)); }, false);
    return out;
}

void import_each(const std::filesystem::path& file, const ImportOptions& options, const ClipSink& sink) {
    at_place(file.string(), "", [&] { check(options); });
    parse_clip_file(file).each(options, sink, true);
}

std::vector<ImportedClip> import_clips(const std::filesystem::path& file, const ImportOptions& options) {
    std::vector<ImportedClip> out;
    import_each(file, options, [&](ImportedClip&& clip) { out.push_back(std::move(clip)); });
    return out;
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
