#include <base/error.h>
#include <base/file.h>
#include <base/text.h>
#include <cli/command_line.h>
#include <cli/options.h>
#include <cli/program.h>
#include <import/tracks/text_rows.h>
#include <motion_files/formats.h>
#include <motion_files/played_motion.h>

#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

namespace mobbscope::cli {

namespace {

constexpr double kSameDt = 1e-9;  // of itself: what is read back is not the same to the last bit

struct ConvertCommandArguments {
    std::filesystem::path file;
    std::optional<std::string> agent;
    std::filesystem::path out;
    ImportOptions import_options;
};

/// When each clip starts: when its agent does, where no clip has several agents; else 0.
std::vector<double> starts_of(const Scene& scene) {
    std::vector<double> starts(scene.clips.size(), 0);
    std::vector<bool> placed(scene.clips.size(), false);
    for (const Agent& agent : scene.agents) {
        const auto clip = static_cast<std::size_t>(agent.clip);
        if (placed[clip]) return std::vector<double>(scene.clips.size(), 0);
        placed[clip] = true;
        starts[clip] = agent.placement.start;
    }
    return starts;
}

/// A CSV holds clips as they are, not where agents play them.
void warn_of_lost_placements(const Scene& scene, const std::filesystem::path& out) {
    const auto moved = std::ranges::count_if(scene.agents, [](const Agent& agent) {
        return agent.placement.translate != glm::dvec2(0) || agent.placement.rotate_deg != 0;
    });
    if (moved == 0) return;
    warn(out.string() + ": " + counted(moved, "agent is", "agents are") +
         " moved or turned, which a CSV does not hold: the clips are written where they are; write a scene (.json)");
}

/// Nor does it hold bodies or floors.
void warn_of_lost_bodies(const Scene& scene, const std::filesystem::path& out) {
    const auto bodies = std::ranges::count_if(scene.clips, [](const SceneClip& clip) { return !clip.body.empty(); });
    const auto floors = std::ranges::count_if(scene.agents, [](const Agent& agent) { return !agent.floor.empty(); });
    if (bodies > 0)
        warn(out.string() + ": " + counted(bodies, "clip has a body", "clips have bodies") +
             " of disks along the heading, which a CSV does not hold: r is that of the samples; write a scene (.json)");
    if (floors > 0)
        warn(out.string() + ": " + counted(floors, "agent is on a floor", "agents are on floors") +
             ", which a CSV does not hold: those of different floors will meet; write a scene (.json)");
}

/// One row a sample: t,x,y,r, with the clip's name in front where there are several. t is the time of the sample, from
/// when the clip starts.
std::string to_csv(const Scene& scene) {
    const bool several = scene.clips.size() > 1;
    const std::vector<double> starts = starts_of(scene);
    std::string text = several ? "id,t,x,y,r\n" : "t,x,y,r\n";
    for (std::size_t c = 0; c < scene.clips.size(); ++c) {
        const SceneClip& clip = scene.clips[c];
        const std::string id = several ? csv_field(clip.name) + ',' : "";
        const double start = starts[c];
        for (int i = 0; i < clip.clip->count(); ++i) {
            const mobb::Disk& disk = clip.clip->samples()[static_cast<std::size_t>(i)];
            text += id + format_double(start + i * clip.clip->dt()) + ',' + format_double(disk.x) + ',' +
                    format_double(disk.y) + ',' + format_double(disk.r) + '\n';
        }
    }
    return text;
}

/// Names of clips become a column; a line break in one would break the table.
void check_clip_names(const Scene& scene) {
    if (scene.clips.size() < 2) return;
    for (const SceneClip& clip : scene.clips) {
        if (clip.name.find_first_of(std::string("\n\0", 2)) != std::string::npos) {
            throw InputError(scene.file.string(), "clip " + in_quotes(clip.name),
                             "its name has a line break, which a CSV cannot hold; rename it");
        }
    }
}

/// A clip of one sample has no dt in a CSV: it is read with the one that most rows are apart.
void warn_of_lost_dt(const Scene& scene, const std::string& text, const std::filesystem::path& out) {
    const auto is_alone = [](const SceneClip& clip) { return clip.clip->count() == 1; };
    if (std::ranges::none_of(scene.clips, is_alone)) return;
    ImportOptions as_they_stand;
    as_they_stand.unit = "m";
    as_they_stand.keep_jumps = true;
    std::vector<ImportedClip> read;
    try {
        read = track_clips(parse_csv(text, out.string()), out, as_they_stand);
    } catch (const InputError&) {
        // No clip has two samples.
    }
    std::vector<const SceneClip*> lost;
    for (std::size_t i = 0; i < scene.clips.size(); ++i) {
        const double dt = scene.clips[i].clip->dt();
        const bool same = !read.empty() && std::abs(read[i].clip->dt() - dt) <= kSameDt * dt;
        if (is_alone(scene.clips[i]) && !same) lost.push_back(&scene.clips[i]);
    }
    if (lost.empty()) return;
    const std::string others =
        lost.size() > 1 ? " (and " + counted(lost.size() - 1, "more clip", "more clips") + ")" : "";
    warn(shown_name(scene.file) + ": clip " + in_quotes(lost.front()->name) + others +
         " has one sample, so the CSV does not tell its dt (" + format_double(lost.front()->clip->dt()) +
         " s); give --dt when reading it");
}

/// What a CSV of these clips is read as.
mobb::Motion motion_as_csv(const Scene& scene) {
    return scene.clips.size() > 1 ? mobb::Motion::linear : mobb::Motion::held;
}

/// Tracks are judged when they are read, and these may be of anything.
void warn_of_judged_tracks(const Scene& scene, const std::string& text, const std::filesystem::path& out) {
    if (scene.clips.size() < 2) return;
    std::optional<TrackFile> tracks;
    const auto read_with = [&](const ImportOptions& options) -> std::optional<std::size_t> {
        try {
            if (!tracks) tracks = parse_csv(text, out.string());
            std::size_t clips = 0;
            give_track_clips(
                *tracks, out, options, [&](ImportedClip&&) { ++clips; }, false);
            return clips;
        } catch (const InputError&) {
            return std::nullopt;
        }
    };
    ImportOptions in_metres;
    in_metres.unit = "m";
    const std::optional<std::size_t> read = read_with({}), insisted = read ? read : read_with(in_metres);
    if (!insisted) return;  // It needs a dt, which is told.
    std::string give = read ? "" : " --unit m";
    if (*insisted != scene.clips.size()) give += " --keep-jumps";
    if (!give.empty())
        warn(out.string() + ": nobody moves as its tracks do; give" + give + " when reading it, else it is " +
             (read ? "split where they jump" : "refused"));
}

/// A CSV does not hold how its clips move between samples.
void warn_of_lost_motion(const Scene& scene, const std::filesystem::path& out) {
    const mobb::Motion read_as = motion_as_csv(scene);
    std::vector<std::string> others;
    for (const SceneClip& clip : scene.clips) {
        if (clip.clip->motion() != read_as) others.push_back(clip.name);
    }
    if (others.empty()) return;
    const mobb::Motion is = read_as == mobb::Motion::held ? mobb::Motion::linear : mobb::Motion::held;
    const std::string give = "give --motion " + std::string(name(is));
    const std::string reads = out.string() + ": a CSV with" + (scene.clips.size() > 1 ? "" : "out") +
                              " ids is read as " + std::string(name(read_as)) + ", but ";
    if (others.size() == scene.clips.size()) {
        warn(reads + (others.size() > 1 ? "its clips are " : "its clip is ") + std::string(name(is)) + "; " + give +
             " when reading it");
        return;
    }
    warn(reads + counted(others.size(), "clip is ", "clips are ") + std::string(name(is)) + ", such as " +
         in_quotes(others.front()) + "; " + give + " with --id when reading one of these, or write a scene (.json)");
}

void warn_of_other_disks(const std::filesystem::path& out, const DiskDifference& difference) {
    if (difference.root) {
        warn(out.string() + ": give --unit m --root " + shell_word(*difference.root) +
             " when reading it: an import would guess otherwise, as the root stands still or the body is not a "
             "person's");
    }
    if (difference.place > kSameDisk) {
        warn(out.string() + ": when it is read again, disks are up to " + brief(difference.place) +
             " m from where they were played: its numbers are too short for such times or places" +
             (lower_extension(out) == ".glb" ? "; write .bvh" : ""));
    } else if (difference.radius > kSameDisk) {
        warn(out.string() + ": when it is read again, radii differ by up to " + brief(difference.radius) +
             " m: a file's radii reach its joints, whatever radius was given, or was mixed between a BVH's frames");
    }
}

void write_motion(const Scene& scene, const MotionFormat& format, const ConvertCommandArguments& arguments) {
    const PlayedMotion motion(scene, arguments.agent);
    const std::string bytes = format.write(motion);
    const DiskDifference difference = read_back(bytes, format, motion);
    write_file(arguments.out, bytes);
    warn_of_other_disks(arguments.out, difference);
    std::cout << in_quotes(motion.name()) << ": " << counted(motion.plays(), "clip", "clips") << ", "
              << counted(motion.frames(), "frame", "frames") << " of " << brief(motion.dt()) << " s, "
              << counted(motion.joints().size(), "joint", "joints") << "; begins at " << brief(motion.begin())
              << " s\n";
    flush_results();
}

void run_convert(const ConvertCommandArguments& arguments) {
    check_file_name(arguments.out);
    const std::string extension = lower_extension(arguments.out);
    const MotionFormat* const motion = motion_format(arguments.out);
    if (!motion && extension != ".csv" && extension != ".json") {
        throw InputError(arguments.out,
                         "clips can be written as .csv or .json, motion with its skeleton as .bvh or .glb; rename the "
                         "output");
    }
    if (!motion && arguments.agent) {
        throw InputError(arguments.out, "--agent writes what one agent plays, as .bvh or .glb; rename the output");
    }
    const Scene scene = load(arguments.file, arguments.import_options);
    check_output(arguments.out);
    if (motion) {
        write_motion(scene, *motion, arguments);
        return;
    }
    if (extension == ".json") {
        write_file(arguments.out, to_json(scene, true));
        return;
    }
    check_clip_names(scene);
    const std::string text = to_csv(scene);
    write_file(arguments.out, text);
    warn_of_lost_dt(scene, text, arguments.out);
    warn_of_judged_tracks(scene, text, arguments.out);
    warn_of_lost_motion(scene, arguments.out);
    warn_of_lost_placements(scene, arguments.out);
    warn_of_lost_bodies(scene, arguments.out);
}

void add_convert_options(Command& command, ConvertCommandArguments& arguments) {
    add_scene_file(command, arguments.file);
    add_parsed(command, "-o,--output", arguments.out, parse_output_name,
               "Where to: .csv or .json; with the skeleton .bvh or .glb", "OUT")
        .required();
    add_parsed(
        command, "--agent", arguments.agent, [](const std::string& text) { return text; },
        "Of a run or scene, for .bvh and .glb: whose motion (not needed where there is one alone)", "NAME");
    add_import_options(command, arguments.import_options);
}

}  // namespace

void add_convert_command(Command& program) {
    program.add_subcommand(
        "convert", "Write clips as CSV, or as a scene with its samples inside; what an agent plays as BVH or glTF",
        add_convert_options, run_convert);
}

}  // namespace mobbscope::cli
