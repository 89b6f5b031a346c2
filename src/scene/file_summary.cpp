#include <base/error.h>
#include <base/text.h>
#include <import/import.h>
#include <mobb/predicate.h>
#include <scene/crowd_run.h>
#include <scene/file_summary.h>
#include <scene/motion_graph.h>
#include <scene/path_figures.h>

#include <algorithm>
#include <new>
#include <system_error>

namespace mobbscope {

namespace {

std::string seconds_text(double seconds) { return formatted("%.1f s", seconds); }

std::string title_of(const Scene& scene, bool is_scene) {
    if (scene.crowd) {
        return "Run of " + counted(scene.crowd->agents.size(), "person", "people") + ", " +
               seconds_text(scene.crowd->seconds);
    }
    if (scene.graph) return "Motion graph with " + counted(scene.graph->moves.size(), "move", "moves");
    const std::string clips = counted(scene.clips.size(), "clip", "clips");
    if (!is_scene) return scene.agents.empty() ? clips : counted(scene.agents.size(), "track", "tracks");
    std::string out = "Scene with " + (scene.agents.empty() ? clips : counted(scene.agents.size(), "agent", "agents"));
    // Without queries of its own all pairs are asked.
    if (!scene.queries.empty()) out += ", " + counted(scene.queries.size(), "query", "queries");
    return out;
}

void tell_of_clip(const SceneClip& clip, FileSummary& out) {
    const mobb::Clip& samples = *clip.clip;
    const PathFigures figures = figures_of(samples);
    out.facts.emplace_back("Duration", seconds_text(samples.duration()));
    out.facts.emplace_back("Samples", formatted("%d, %.4g a second", samples.count(), 1 / samples.dt()));
    const SourceFacts& facts = clip.facts;
    if (facts.joints > 0) out.facts.emplace_back("Joints", std::to_string(facts.joints) + ", root " + facts.root);
    if (clip.source) {
        out.facts.emplace_back("Unit", brief(facts.unit) + " m");
        if (facts.guessed_from_height) {
            out.facts.emplace_back("", formatted("guessed: a body %.2f m tall", *facts.guessed_from_height));
        }
        if (!facts.up.empty()) out.facts.emplace_back("Up axis", facts.up);
        if (!facts.up_why.empty()) out.facts.emplace_back("", facts.up_why);
    }
    out.facts.emplace_back("Path", formatted("%.1f m, %.2f m/s", figures.length, figures.mean_speed));
    out.facts.emplace_back("Radius", formatted("%.2f to %.2f m", figures.min_radius, figures.max_radius));
}

FileSummary summary_of_file(const std::filesystem::path& file, const Progress& progress) {
    FileSummary out;
    const bool is_scene = is_scene_file(file);
    const Scene scene = load_scene(file, {}, progress);
    out.title = title_of(scene, is_scene);
    out.clip_count = scene.clips.size();
    if (scene.clips.size() == 1) tell_of_clip(scene.clips.front(), out);
    for (const SceneClip& clip : scene.clips) {
        if (scene.clips.size() > 1 && out.clips.size() < FileSummary::kMostListed) {
            out.clips.emplace_back(clip.name, seconds_text(clip.clip->duration()));
        }
        for (const ImportWarning& warning : clip.facts.warnings) {
            const bool known = std::ranges::find(out.warnings, warning.text) != out.warnings.end();
            if (!known) out.warnings.push_back(warning.text);
        }
    }
    return out;
}

FileSummary summary_of_folder(const std::filesystem::path& folder, const Progress& progress) {
    std::size_t clips = 0, scenes = 0, folders = 0, seen = 0;
    std::error_code error;
    for (std::filesystem::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
        if (progress) progress(0, ++seen + 1);
        std::error_code ignored;
        if (at->is_directory(ignored)) {
            ++folders;
        } else if (is_scene_file(at->path())) {
            ++scenes;
        } else if (contents_by_name(at->path())) {
            ++clips;
        }
    }
    FileSummary out;
    if (error) {
        out.readable = false;
        out.title = "The folder cannot be read: " + error.message();
        return out;
    }
    const auto add = [&](std::size_t count, const char* one, const char* many) {
        if (count > 0) out.title += (out.title.empty() ? "Folder with " : ", ") + counted(count, one, many);
    };
    add(clips, "clip file", "clip files");
    add(scenes, "scene file", "scene files");
    add(folders, "folder", "folders");
    if (out.title.empty()) out.title = "Folder without anything that can be opened";
    return out;
}

/// The file is named beside it already.
std::string without_file(const std::string& message, const std::filesystem::path& file) {
    const std::string head = file.string() + ": ";
    return message.starts_with(head) ? message.substr(head.size()) : message;
}

}  // namespace

FileSummary summary_of(const std::filesystem::path& file, const Progress& progress) {
    std::error_code ignored;
    if (std::filesystem::is_directory(file, ignored)) return summary_of_folder(file, progress);
    FileSummary refused;
    refused.readable = false;
    try {
        return summary_of_file(file, progress);
    } catch (const InputError& error) {
        refused.title = without_file(error.what(), file);
    } catch (const MachineError& error) {
        refused.title = without_file(error.what(), file);
    } catch (const std::bad_alloc&) {
        refused.title = "there is not enough memory for this";
    }
    return refused;
}

}  // namespace mobbscope
