#include <base/error.h>
#include <base/file.h>
#include <base/text.h>
#include <import/bvh/bvh.h>
#include <import/clip/held_steps.h>
#include <import/import.h>
#include <import/nodes/node_files.h>
#include <import/skeleton/motion.h>
#include <import/skeleton/motion_clips.h>
#include <import/tracks/csv.h>
#include <import/tracks/tracks.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <memory>
#include <type_traits>
#include <variant>

namespace mobbscope {

namespace {

MotionFile read_bvh(const std::filesystem::path& file) { return bvh_motion(parse_bvh(read_file(file), file.string())); }

/// What `read` makes of a file, and the clips and the offer of that.
template <auto read, auto to_clips, auto to_offer>
ParsedFile parse_once(const std::filesystem::path& file) {
    const auto parse = [&] {
        if constexpr (std::is_invocable_v<decltype(read), const std::filesystem::path&>) {
            return read(file);
        } else {
            return read(read_file(file), file.string());
        }
    };
    const auto parsed = std::make_shared<const decltype(parse())>(parse());
    const auto checked = [file](const ImportOptions& options) { at_place(file.string(), "", [&] { check(options); }); };
    return {[=](const ImportOptions& options) {
                checked(options);
                std::vector<ImportedClip> clips = to_clips(*parsed, file, options);
                for (ImportedClip& clip : clips) warn_of_long_held_step(*clip.clip, clip.facts.warnings);
                return clips;
            },
            [=](const ImportOptions& options) {
                checked(options);
                return to_offer(*parsed, file, options);
            }};
}

struct Format {
    std::string_view extension;
    ParsedFile (*parse)(const std::filesystem::path&);
    Contents contents;
    bool in_help = true;  ///< false of a second spelling
};

/// Every format, in the order of help and messages.
constexpr Format kFormats[] = {
    {".bvh", parse_once<read_bvh, motion_clips, motion_offer>, Contents::skeletons},
    {".gltf", parse_once<read_gltf, motion_clips, motion_offer>, Contents::skeletons},
    {".glb", parse_once<read_gltf, motion_clips, motion_offer>, Contents::skeletons},
    {".fbx", parse_once<read_fbx, motion_clips, motion_offer>, Contents::skeletons},
    {".csv", parse_once<parse_csv, csv_clips, csv_offer>, Contents::table},
    {".txt", parse_once<parse_text_tracks, track_clips, track_offer>, Contents::trajectories},
    {".ndjson", parse_once<parse_trajnetpp, track_clips, track_offer>, Contents::trajectories},
    {".yaml", parse_once<parse_mapf_plan, track_clips, track_offer>, Contents::trajectories},
    {".yml", parse_once<parse_mapf_plan, track_clips, track_offer>, Contents::trajectories, false},
};

const Format* format_of(const std::filesystem::path& file) {
    const auto found = std::ranges::find(kFormats, lower_extension(file), &Format::extension);
    return found == std::end(kFormats) ? nullptr : found;
}

/// ".bvh, .gltf and .fbx": `last` stands before the last one.
std::string list_formats(bool trajectories, std::string_view separator, std::string_view last) {
    std::vector<std::string_view> names;
    for (const Format& format : kFormats) {
        if (format.in_help && (format.contents == Contents::trajectories) == trajectories)
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
    return format ? std::optional(format->contents) : std::nullopt;
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
    if (const Format* format = format_of(file)) return format->parse(file);
    std::error_code ignored;
    if (lower_extension(file).empty() && !std::filesystem::exists(file, ignored)) {
        throw InputError(file.string(), "", "no such file or folder; check the path");
    }
    throw InputError(file.string(), "",
                     "no reader for this kind of file; clips can be " + list_formats(false, ", ", " and ") +
                         ", trajectories " + list_formats(true, ", ", " and ") + ", scenes .json");
}

ImportOptions offer_depends_on(const ImportOptions& options) {
    ImportOptions out;
    out.animation = options.animation;
    out.root = options.root;
    out.up = options.up;
    out.dt = options.dt;
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
    // Of the units it is only this one.
    return (key == "unit" ? "unit auto" : key) + " does not apply to " + lower_extension(file) + " files";
}

ApplicableOptions applicable(const ImportOptions& options, const std::filesystem::path& file) {
    ApplicableOptions out{options, {}};
    const Contents contents = contents_by_name(file).value_or(Contents::skeletons);
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
