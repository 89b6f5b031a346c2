#include <base/file.h>
#include <base/json_writer.h>
#include <base/text.h>
#include <cli/command_line.h>
#include <cli/options.h>
#include <cli/program.h>
#include <import/import.h>
#include <scene/path_figures.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>
#include <vector>

namespace mobbscope::cli {

namespace {

struct InfoCommandArguments {
    std::vector<std::filesystem::path> files;
    bool json = false;
    ImportOptions import_options;
};

/// Of a clip with its samples in the scene, the scene is the file.
SourceFacts facts_of(const SceneClip& clip) {
    if (clip.source) return clip.facts;
    const mobb::Clip& samples = *clip.clip;
    return {"scene", 1, samples.count(), samples.dt(), (samples.count() - 1) * samples.dt(), clip.facts.warnings};
}

/// Where a clip was read from: the source that its scene names, or the file itself.
std::string file_of(const Scene& scene, const SceneClip& clip) {
    return shown_name(clip.source ? scene.file.parent_path() / *clip.source : scene.file);
}

void write_clip(JsonWriter& out, const Scene& scene, const SceneClip& clip) {
    const SourceFacts facts = facts_of(clip);
    const PathFigures figures = figures_of(*clip.clip);
    out.begin_object();
    out.members("file", file_of(scene, clip), "name", clip.name, "format", facts.format);
    // Neither a CSV nor a scene has a skeleton: then these are null.
    const auto if_any = [](const std::string& text) { return text.empty() ? std::nullopt : std::optional(text); };
    out.members("animation", if_any(facts.animation), "root", if_any(facts.root), "root_why", if_any(facts.root_why));
    out.members("up", if_any(facts.up), "up_why", if_any(facts.up_why));
    out.member("joints", facts.joints > 0 ? std::optional(facts.joints) : std::nullopt);
    out.members("class", if_any(facts.label), "t0", facts.t0 ? facts.t0 : facts.first_key);
    out.member("start", facts.t0 || facts.first_key ? std::optional(clip.start) : std::nullopt);
    out.members("unit", facts.unit, "guessed_from_height", facts.guessed_from_height);
    out.members("file_frames", facts.frames, "file_dt", facts.dt, "file_duration", facts.duration);
    out.members("samples", clip.clip->count(), "dt", clip.clip->dt(), "duration", clip.clip->duration());
    out.member("motion", mobb::name(clip.clip->motion()));
    out.members("path_length", figures.length, "mean_speed", figures.mean_speed);
    out.members("min_radius", figures.min_radius, "mean_radius", figures.mean_radius, "max_radius", figures.max_radius);
    if (!clip.body.empty())
        out.list("body", clip.body, [&](const mobb::BodyDisk& disk) { out.tuple(disk.forward, disk.left, disk.r); });
    std::vector<std::string> warnings;
    for (const ImportWarning& warning : facts.warnings) warnings.push_back(said(warning));
    out.values("warnings", warnings);
    out.end_object();
}

/// How the unit was found, where it had to be guessed.
std::string guess_of(const SourceFacts& facts) {
    if (!facts.guessed_from_height) return "";
    return " (guessed: a body " + brief(std::round(*facts.guessed_from_height * 100) / 100) + " m tall)";
}

/// Which axis is up, and why: only files with skeletons have one.
std::string up_of(const SourceFacts& facts) {
    if (facts.up.empty()) return "";
    return ", up " + facts.up + (facts.up_why.empty() ? "" : " (" + facts.up_why + ")");
}

using Warnings = std::vector<ImportWarning>;

bool holds(const Warnings& warnings, const ImportWarning& warning) {
    return std::find(warnings.begin(), warnings.end(), warning) != warnings.end();
}

/// What is said of every clip of a scene: of a crowd it is said once.
Warnings common_warnings(const Scene& scene) {
    Warnings common = scene.clips.front().facts.warnings;
    for (const SceneClip& clip : scene.clips)
        std::erase_if(common, [&](const ImportWarning& warning) { return !holds(clip.facts.warnings, warning); });
    return common;
}

void list_warnings(const Warnings& warnings, const Warnings& common) {
    for (const ImportWarning& warning : warnings) {
        if (!holds(common, warning)) std::cout << "  warning      " << cleaned(said(warning)) << '\n';
    }
}

void print_clip(const Scene& scene, const SceneClip& clip, const Warnings& common) {
    const SourceFacts facts = facts_of(clip);
    const PathFigures figures = figures_of(*clip.clip);
    std::cout << cleaned(clip.name) << " (" << cleaned(file_of(scene, clip)) << ", " << facts.format << ")\n";
    if (facts.joints > 0) {
        std::cout << "  skeleton     " << counted(facts.joints, "joint", "joints") << ", root " << in_quotes(facts.root)
                  << (facts.root_why.empty() ? "" : " (" + facts.root_why + ")")
                  << (clip.options.animation ? ", animation " + in_quotes(facts.animation) : "") << '\n';
    }
    if (!facts.label.empty()) std::cout << "  class        " << in_quotes(facts.label) << '\n';
    if (facts.t0) {
        std::cout << "  there        from " << brief(clip.start) << " to " << brief(clip.start + clip.clip->duration())
                  << " s; 0 is " << format_double(*facts.t0) << " s in the file\n";
    }
    if (facts.first_key.value_or(0) != 0)
        std::cout << "  first key    at " << brief(*facts.first_key) << " s of the file, which is 0 s of the clip\n";
    std::cout << "  in the file  " << counted(facts.frames, "frame", "frames") << " over " << brief(facts.duration)
              << " s, " << (facts.dt ? brief(*facts.dt) + " s apart" : "not uniform in time") << ", "
              << brief(facts.unit) << " m per unit" << guess_of(facts) << up_of(facts) << '\n'
              << "  taken        " << counted(clip.clip->count(), "sample", "samples") << " of "
              << brief(clip.clip->dt()) << " s, " << brief(clip.clip->duration()) << " s in all, "
              << mobb::name(clip.clip->motion())
              << (clip.clip->motion() == mobb::Motion::held ? " until the next sample\n" : " to the next sample\n")
              << "  path         " << brief(figures.length) << " m at " << brief(figures.mean_speed) << " m/s\n"
              << "  radius       " << brief(figures.min_radius) << " to " << brief(figures.max_radius) << " m, mean "
              << brief(figures.mean_radius) << " m\n";
    if (!clip.body.empty()) std::cout << "  body         " << body_words(clip) << '\n';
    list_warnings(facts.warnings, common);
}

void print_clips(const Scene& scene) {
    Warnings common;
    if (scene.clips.size() > 1) {
        common = common_warnings(scene);
        if (!common.empty())
            std::cout << cleaned(shown_name(scene.file)) << ": all of its " << scene.clips.size() << " clips\n";
        list_warnings(common, {});
    }
    for (const SceneClip& clip : scene.clips) print_clip(scene, clip, common);
}

void run_info(const InfoCommandArguments& arguments) {
    std::vector<Scene> scenes;
    for (const std::filesystem::path& file : arguments.files)
        scenes.push_back(load_scene(file, arguments.import_options, tell("read", "clips")));
    if (arguments.json) {
        JsonWriter json(std::cout);
        json.begin_object();
        json.begin_array("clips");
        for (const Scene& scene : scenes) {
            for (const SceneClip& clip : scene.clips) write_clip(json, scene, clip);
        }
        json.end_array();
        json.end_object();
    } else {
        for (const Scene& scene : scenes) print_clips(scene);
    }
    flush_results();
}

void add_info_options(Command& command, InfoCommandArguments& arguments) {
    command
        .add_option("FILE", arguments.files,
                    "Scenes (.json), clips (" + listed_clip_extensions() + ") and trajectories (" +
                        listed_trajectory_extensions() + ")")
        .required();
    command.add_flag("--json", arguments.json, "The same as JSON");
    add_import_options(command, arguments.import_options);
}

}  // namespace

void add_info_command(Command& program) {
    program.add_subcommand("info", "What is in each file: its clips, their paths and radii", add_info_options,
                           run_info);
}

}  // namespace mobbscope::cli
