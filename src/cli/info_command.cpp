#include <cli/commands.h>
#include <cli/messages.h>
#include <cli/options.h>
#include <import/text.h>
#include <scene/json_writer.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::cli {

namespace {

struct Arguments {
    std::vector<std::filesystem::path> files;
    bool json = false;
    ImportOptions import_options;
};

/// What the samples of a clip add up to. Metres, metres per second.
struct ClipFigures {
    double path_length = 0;
    double mean_speed = 0;  ///< 0 for one sample
    double min_radius = 0, mean_radius = 0, max_radius = 0;
};

ClipFigures figures(const mobb::Clip& clip) {
    const std::span<const mobb::Disk> samples = clip.samples();
    ClipFigures out;
    out.min_radius = out.max_radius = samples[0].r;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        out.min_radius = std::min(out.min_radius, samples[i].r);
        out.max_radius = std::max(out.max_radius, samples[i].r);
        out.mean_radius += samples[i].r / static_cast<double>(samples.size());
        if (i > 0) out.path_length += std::hypot(samples[i].x - samples[i - 1].x, samples[i].y - samples[i - 1].y);
    }
    if (samples.size() > 1) out.mean_speed = out.path_length / (clip.dt() * static_cast<double>(samples.size() - 1));
    return out;
}

/// A clip whose samples stand in the scene is its own source.
SourceFacts facts_of(const SceneClip& clip) {
    if (clip.source) return clip.facts;
    SourceFacts facts;
    facts.format = "json";
    facts.frames = clip.clip->count();
    facts.dt = clip.clip->dt();
    facts.duration = clip.clip->dt() * (clip.clip->count() - 1);
    return facts;
}

void write_optional(JsonWriter& out, const char* key, const std::string& text) {
    out.key(key);
    text.empty() ? out.null() : out.value(text);
}

void write_clip(JsonWriter& out, const std::string& file, const SceneClip& clip) {
    const SourceFacts facts = facts_of(clip);
    const ClipFigures of = figures(*clip.clip);
    out.begin_object();
    out.member("file", file);
    out.member("name", clip.name);
    out.member("format", facts.format);
    write_optional(out, "animation", facts.animation);
    write_optional(out, "root", facts.root);
    out.key("joints");
    facts.joints > 0 ? out.value(facts.joints) : out.null();
    out.member("unit", facts.unit);
    out.member("file_frames", facts.frames);
    out.key("file_dt");
    facts.dt ? out.value(*facts.dt) : out.null();
    out.member("file_duration", facts.duration);
    out.member("samples", clip.clip->count());
    out.member("dt", clip.clip->dt());
    out.member("duration", clip.clip->duration());
    out.member("path_length", of.path_length);
    out.member("mean_speed", of.mean_speed);
    out.member("min_radius", of.min_radius);
    out.member("mean_radius", of.mean_radius);
    out.member("max_radius", of.max_radius);
    out.key("warnings");
    out.begin_array();
    for (const std::string& warning : facts.warnings) out.value(warning);
    out.end_array();
    out.end_object();
}

/// "1 unit = 0.01 m", and how that is known.
std::string described_unit(const SourceFacts& facts) {
    const std::string unit = "1 unit = " + brief(facts.unit) + " m";
    if (!facts.guessed_from_height) return unit;
    return unit + " (guessed: a body " + brief(std::round(*facts.guessed_from_height * 100) / 100) + " m tall)";
}

/// Three decimals are millimetres and milliseconds.
std::string rounded(double value) { return brief(std::round(value * 1000) / 1000); }

void print_clip(std::ostream& out, const std::string& file, const SceneClip& clip) {
    const SourceFacts facts = facts_of(clip);
    const ClipFigures of = figures(*clip.clip);
    const std::string spacing = facts.dt ? " every " + brief(*facts.dt) + " s" : " at uneven times";
    out << file << ": " << in_quotes(clip.name) << '\n';
    out << "  source   " << facts.format;
    if (clip.options.animation) out << ", animation " << in_quotes(facts.animation);
    out << ", " << counted(facts.frames, "frame", "frames") << (facts.frames > 1 ? spacing : "") << ", "
        << rounded(facts.duration) << " s; " << described_unit(facts) << '\n';
    if (!facts.root.empty()) {
        out << "  root     " << in_quotes(facts.root) << ", " << counted(facts.joints, "joint", "joints") << '\n';
    }
    out << "  samples  " << clip.clip->count() << " every " << brief(clip.clip->dt()) << " s, "
        << rounded(clip.clip->duration()) << " s\n";
    out << "  path     " << rounded(of.path_length) << " m, mean speed " << rounded(of.mean_speed) << " m/s\n";
    out << "  radius   " << rounded(of.min_radius) << " to " << rounded(of.max_radius) << " m, mean "
        << rounded(of.mean_radius) << " m\n";
    for (const std::string& warning : facts.warnings) out << "  warning  " << warning << '\n';
}

void run(const Arguments& arguments) {
    // All files are read before anything is said, so that a bad one leaves no partial output.
    std::vector<Scene> scenes;
    for (const std::filesystem::path& file : arguments.files) {
        scenes.push_back(load_scene(file, arguments.import_options));
    }
    if (!arguments.json) {
        for (const Scene& scene : scenes) {
            for (const SceneClip& clip : scene.clips) print_clip(std::cout, scene.file.string(), clip);
        }
    } else {
        JsonWriter out(std::cout);
        out.begin_object();
        out.key("clips");
        out.begin_array();
        for (const Scene& scene : scenes) {
            for (const SceneClip& clip : scene.clips) write_clip(out, scene.file.string(), clip);
        }
        out.end_array();
        out.end_object();
        std::cout << '\n';
    }
    flush_results();
}

}  // namespace

void add_info_command(CLI::App& program) {
    CLI::App* command = program.add_subcommand("info", "What is in each file: clips, joints, units, warnings");
    const auto arguments = std::make_shared<Arguments>();
    command->add_option("FILE", arguments->files, "Scenes, captures or clips")->required();
    command->add_flag("--json", arguments->json, "As JSON");
    add_import_options(*command, arguments->import_options);
    command->callback([arguments] { run(*arguments); });
}

}  // namespace mobbscope::cli
