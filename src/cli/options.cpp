#include <cli/messages.h>
#include <cli/options.h>
#include <import/text.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mobbscope::cli {

namespace {

/// What is wrong with an option, as a usage error that names the option.
[[noreturn]] void refuse(const std::string& option, const std::string& message) {
    throw CLI::ValidationError(option, message);
}

// CLI11's own reading of numbers takes "" for 0 and "010" for 8, so every number comes as text.
double number(const std::string& option, const std::string& text) {
    if (const std::optional<double> value = parse_double(text)) return *value;
    refuse(option, in_quotes(text) + " is no finite number; write it like 0.25");
}

int whole_number(const std::string& option, const std::string& text) {
    if (const std::optional<int> value = parse_int(text)) return *value;
    refuse(option, in_quotes(text) + " is no whole number up to " + std::to_string(std::numeric_limits<int>::max()) +
                       "; write it like 10");
}

/// Turns a complaint of `check` into a usage error.
template <class Options>
void check_as(const std::string& option, const Options& options) {
    try {
        check(options);
    } catch (const std::invalid_argument& error) {
        refuse(option, error.what());
    }
}

mobb::ClipPtr with_radius(const mobb::Clip& clip, double radius) {
    std::vector<mobb::Disk> samples(clip.samples().begin(), clip.samples().end());
    for (mobb::Disk& disk : samples) disk.r = radius;
    return std::make_shared<const mobb::Clip>(clip.dt(), std::move(samples));
}

/// One warning a text, whatever the number of clips it holds for.
void print_warnings(const Scene& scene) {
    std::set<std::string> said;
    for (const SceneClip& clip : scene.clips) {
        for (const std::string& warning : clip.facts.warnings) {
            if (said.insert(warning).second)
                warn(scene.file.string() + ": clip " + in_quotes(clip.name) + ": " + warning);
        }
    }
}

}  // namespace

mobb::FitOptions FitArguments::over(mobb::FitOptions fit) const {
    fit.tree = tree.value_or(fit.tree);
    fit.leaf = leaf.value_or(fit.leaf);
    fit.levels = levels.value_or(fit.levels);
    fit.axes = axes.value_or(fit.axes);
    fit.time_scale = time_scale.value_or(fit.time_scale);
    return fit;
}

void add_fit_options(CLI::App& command, FitArguments& arguments, Brute brute) {
    const bool takes_brute = brute == Brute::allowed;
    const std::string trees = listed(mobb::tree_kind_names()) + (takes_brute ? ", brute" : "");
    const std::string axes = listed(mobb::axes_names());
    const auto checked = [&arguments](const std::string& option) { check_as(option, arguments.over({})); };
    const auto set_tree = [&arguments, takes_brute, trees](const std::string& text) {
        arguments.tree = mobb::tree_kind_from_name(text);
        arguments.brute = takes_brute && text == "brute";
        if (!arguments.tree && !arguments.brute) refuse("--tree", in_quotes(text) + " is none of " + trees);
    };
    const auto set_axes = [&arguments, axes](const std::string& text) {
        arguments.axes = mobb::axes_from_name(text);
        if (!arguments.axes) refuse("--axes", in_quotes(text) + " is none of " + axes);
    };
    const auto set_leaf = [&arguments, checked](const std::string& text) {
        arguments.leaf = whole_number("--leaf", text);
        checked("--leaf");
    };
    const auto set_levels = [&arguments, checked](const std::string& text) {
        arguments.levels = whole_number("--levels", text);
        checked("--levels");
    };
    const auto set_time_scale = [&arguments, checked](const std::string& text) {
        arguments.time_scale = number("--time-scale", text);
        checked("--time-scale");
    };
    constexpr const char* kGroup = "Fit (over the scene's)";
    command.add_option_function<std::string>("--tree", set_tree, trees)->group(kGroup)->type_name("K");
    command.add_option_function<std::string>("--leaf", set_leaf, "Most samples in a leaf (10)")
        ->group(kGroup)
        ->type_name("N");
    command.add_option_function<std::string>("--levels", set_levels, "Levels in a tree; 0 is all (0)")
        ->group(kGroup)
        ->type_name("N");
    command.add_option_function<std::string>("--axes", set_axes, axes)->group(kGroup)->type_name("K");
    command
        .add_option_function<std::string>("--time-scale", set_time_scale,
                                          "Metres per second that mix time with space (1)")
        ->group(kGroup)
        ->type_name("W");
}

void add_import_options(CLI::App& command, ImportOptions& options) {
    constexpr const char* kGroup = "Import (over the scene's, for clips with a source)";
    const auto quantity = [&](const std::string& option, std::optional<double> ImportOptions::*field, const char* type,
                              const char* help) {
        const auto set = [&options, option, field](const std::string& text) {
            options.*field = number(option, text);
            check_as(option, options);
        };
        command.add_option_function<std::string>(option, set, help)->group(kGroup)->type_name(type);
    };
    const auto word = [&](const std::string& option, std::optional<std::string> ImportOptions::*field, const char* type,
                          const char* help) {
        const auto set = [&options, option, field](const std::string& value) {
            options.*field = value;
            check_as(option, options);
        };
        command.add_option_function<std::string>(option, set, help)->group(kGroup)->type_name(type);
    };
    const auto set_trim = [&options](const std::string& text) {
        options.trim = parse_range(text);
        if (!options.trim)
            refuse("--trim", in_quotes(text) + " is no range; give two times in seconds, such as 0.5:3.2");
        check_as("--trim", options);
    };
    quantity("--fps", &ImportOptions::fps, "F", "Samples per second (30; trajectories: as stored)");
    word("--unit", &ImportOptions::unit, "U", "m, cm, in, auto or metres per file unit");
    word("--up", &ImportOptions::up, "AXIS", "y or z");
    word("--root", &ImportOptions::root, "JOINT", "The joint whose path is taken");
    command.add_option_function<std::string>("--trim", set_trim, "Only this part, in seconds from the first key")
        ->group(kGroup)
        ->type_name("A:B");
    quantity("--dt", &ImportOptions::dt, "S",
             "Seconds between the rows of a CSV without times, or frames of trajectories");
    quantity("--radius", &ImportOptions::radius, "R", "Radius of every sample, in metres");
    word("--id", &ImportOptions::id, "ID", "The track to take, of a file with several");
    word("--animation", &ImportOptions::animation, "A", "Index or name of the animation");
}

std::filesystem::path parse_file_name(const std::string& text) {
    if (text.empty()) throw std::invalid_argument("the name is empty; give a file");
    return text;
}

void add_scene_file(CLI::App& command, std::filesystem::path& file) {
    command
        .add_option("FILE", file,
                    "A scene (.json), a clip (.bvh .gltf .glb .fbx .csv) or trajectories (.txt .ndjson .yaml)")
        ->required();
}

std::function<int(const std::string&)> whole_number_within(int least, int most) {
    return [least, most](const std::string& text) {
        const std::optional<int> number = parse_int(text);
        if (number && *number >= least && *number <= most) return *number;
        throw std::invalid_argument(in_quotes(text) + " is no whole number from " + std::to_string(least) + " to " +
                                    std::to_string(most));
    };
}

std::function<double(const std::string&)> number_within(double low, double high) {
    return [low, high](const std::string& text) {
        const std::optional<double> value = parse_double(text);
        if (!value || !(*value >= low && *value <= high)) {
            throw std::invalid_argument(in_quotes(text) + " is no number from " + brief(low) + " to " + brief(high));
        }
        return *value;
    };
}

Scene load(const std::filesystem::path& file, const ImportOptions& options, RadiusOf radius) {
    Scene scene = load_scene(file, options);
    print_warnings(scene);
    const auto has_source = [](const SceneClip& clip) { return clip.source.has_value(); };
    ImportOptions for_sources = options;
    if (radius == RadiusOf::every_clip && options.radius) {
        for (SceneClip& clip : scene.clips) {
            if (!has_source(clip)) clip.clip = with_radius(*clip.clip, *options.radius);
        }
        for_sources.radius.reset();
    }
    if (for_sources != ImportOptions{} && std::none_of(scene.clips.begin(), scene.clips.end(), has_source)) {
        warn(file.string() + ": import options do not apply: every clip has its samples in the scene");
    }
    return scene;
}

}  // namespace mobbscope::cli
