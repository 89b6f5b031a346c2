#include <base/error.h>
#include <base/file.h>
#include <cli/command_line.h>
#include <cli/options.h>
#include <cli/program.h>
#include <import/clip/held_steps.h>
#include <render/drawlist/picture_options.h>
#include <scene/crowd_run.h>
#include <scene/load_files.h>
#include <scene/scene_json.h>
#include <scene/step_link.h>

#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <limits>
#include <memory>
#include <system_error>
#include <unordered_map>
#include <utility>
#include <vector>

namespace mobbscope::cli {

namespace {

// CLI11's own reading of numbers takes "" for 0 and "010" for 8, so every number comes as text.
double parse_number(const std::string& text) {
    if (const std::optional<double> value = parse_double(text)) return *value;
    throw std::invalid_argument(in_quotes(text) + " is not a finite number; write it like 0.25");
}

int parse_whole_number(const std::string& text) {
    if (const std::optional<int> value = parse_int(text)) return *value;
    throw std::invalid_argument(in_quotes(text) + " is not a whole number up to " +
                                std::to_string(std::numeric_limits<int>::max()) + "; write it like 10");
}

std::pair<double, double> parse_trim(const std::string& text) {
    if (const auto range = parse_range(text)) return *range;
    throw std::invalid_argument(in_quotes(text) + " is not a range; give two times in seconds, such as 0.5:3.2");
}

void print_warnings(const Scene& scene, const std::string& name) {
    ClipWarnings warnings;
    for (const SceneClip& clip : scene.clips) warnings.add(clip);
    warnings.print(name);
}

}  // namespace

void ClipWarnings::add(const SceneClip& clip) {
    ++clips_;
    if (const std::optional<HeldStep> step = longest_held_step(*clip.clip)) {
        const double by = step->length - step->radius;
        if (held_.clips++ == 0 || by > most_) {
            most_ = by;
            std::vector<ImportWarning> warnings;
            warn_of_long_held_step(*clip.clip, warnings);
            held_ = {warnings.front(), clip.name, held_.clips};
        }
    }
    for (const ImportWarning& warning : clip.facts.warnings) {
        // Its figures differ from clip to clip.
        if (warning.option == "motion") continue;
        const auto [at, is_new] = by_text_.try_emplace(warning.text, all_.size());
        if (is_new) all_.push_back({warning, clip.name, 0});
        Told& known = all_[at->second];
        if (known.clips++ > 0) known.warning.samples += warning.samples;
    }
}

void ClipWarnings::print(const std::string& file) const {
    if (held_.clips > 0) {
        const std::string others =
            held_.clips > 1 ? " (and " + counted(held_.clips - 1, "more clip", "more clips") + ")" : "";
        warn(file + ": clip " + in_quotes(held_.first) + others + ": " + held_.warning.text);
    }
    for (const Told& each : all_) {
        std::string whose = "clip " + in_quotes(each.first) + ": ";
        if (each.clips > 1) {
            whose = each.clips == clips_ ? ""
                                         : "of " + std::to_string(clips_) + " clips " + std::to_string(each.clips) +
                                               ", such as " + in_quotes(each.first) + ": ";
        }
        std::string line = file;
        line.append(": ").append(whose).append(said(each.warning));
        warn(line);
    }
}

mobb::FitOptions FitArguments::over(mobb::FitOptions fit) const {
    fit.tree = tree.value_or(fit.tree);
    fit.leaf = leaf.value_or(fit.leaf);
    fit.levels = levels.value_or(fit.levels);
    fit.axes = axes.value_or(fit.axes);
    fit.time_scale = time_scale.value_or(fit.time_scale);
    return fit;
}

void add_fit_options(Command& command, FitArguments& arguments, Brute brute) {
    const bool takes_brute = brute == Brute::allowed;
    const std::string trees = listed(mobb::tree_kind_names()) + (takes_brute ? ", brute" : "");
    const std::string axes = listed(mobb::axes_names());
    const auto set_tree = [&arguments, takes_brute, trees](const std::string& text) {
        arguments.tree = find_tree_kind(text);
        arguments.brute = takes_brute && text == "brute";
        if (!arguments.tree && !arguments.brute)
            throw std::invalid_argument(in_quotes(text) + " is not one of " + trees);
    };
    const auto set_axes = [&arguments, axes](const std::string& text) {
        arguments.axes = mobb::axes_from_name(text);
        if (!arguments.axes) throw std::invalid_argument(in_quotes(text) + " is not one of " + axes);
    };
    const auto checked = [&arguments](auto FitArguments::*field, auto parse) {
        return [&arguments, field, parse](const std::string& text) {
            arguments.*field = parse(text);
            check(arguments.over({}));
        };
    };
    const auto add = [&command](const char* name, auto set, const std::string& help, const char* placeholder) {
        command.add_option(name, set, help, placeholder).group("Fit (over the scene's)");
    };
    add("--tree", set_tree, trees, "K");
    add("--leaf", checked(&FitArguments::leaf, parse_whole_number), "Most samples in a leaf (10)", "N");
    add("--levels", checked(&FitArguments::levels, parse_whole_number), "Levels in a tree; 0 is all (0)", "N");
    add("--axes", set_axes, axes, "K");
    add("--time-scale", checked(&FitArguments::time_scale, parse_number),
        "Metres per second that mix time with space (1)", "W");
}

void add_import_options(Command& command, ImportOptions& options) {
    const auto as_it_is = [](const std::string& text) { return text; };
    const auto add = [&](const char* name, auto ImportOptions::*field, auto parse, const char* help,
                         const char* placeholder) {
        const auto set = [&options, field, parse](const std::string& text) {
            options.*field = parse(text);
            check(options);
        };
        command.add_option(name, set, help, placeholder)
            .group("Import (over the scene's; of inline samples --motion, --radius alone)");
    };
    add("--fps", &ImportOptions::fps, parse_number,
        "Samples per second (30; trajectories: as stored); frames per second of a table with frame numbers", "F");
    add("--unit", &ImportOptions::unit, as_it_is, "m, cm, in, auto or metres per file unit", "U");
    add("--up", &ImportOptions::up, as_it_is, "y, z or auto (as the file says; BVH: as the body stands)", "AXIS");
    add("--root", &ImportOptions::root, as_it_is, "The joint whose path is taken", "JOINT");
    add("--trim", &ImportOptions::trim, parse_trim,
        "Only this part, in seconds from the first key, of tracks from the earliest row", "A:B");
    add("--dt", &ImportOptions::dt, parse_number,
        "Seconds between the rows of a table without times, or from one frame number to the next", "S");
    add("--radius", &ImportOptions::radius, radius_from_text,
        "Radius in metres of every sample, the column of a CSV that holds it, or a file (.csv) of ids or classes and "
        "radii",
        "R");
    add("--columns", &ImportOptions::columns, as_it_is,
        "Which columns of a table are id, t, frame, x, y, r, class and others, or how they are worked out: "
        "id=trackId,t=frame/25",
        "C");
    add("--motion", &ImportOptions::motion, one_of(mobb::motion_from_name, "held, linear"),
        "What a disk does until the next sample: held, linear (tracks of people: linear; else held); inline samples "
        "too",
        "M");
    command
        .add_flag(
            "--keep-jumps", [&options](bool keep) { options.keep_jumps = keep; },
            "Tracks stay whole where they jump, or pause, as nobody does")
        .group("Import (over the scene's; of inline samples --motion, --radius alone)");
    add("--id", &ImportOptions::id, as_it_is, "The track to take, of a file with several", "ID");
    add("--animation", &ImportOptions::animation, as_it_is, "Index or name of the animation", "A");
}

Option add_fitted_options(Command& command, FittedArguments& arguments, const std::string& json_help, Brute brute) {
    add_scene_file(command, arguments.file);
    const Option json = command.add_flag("--json", arguments.json, json_help);
    add_fit_options(command, arguments.fit, brute);
    add_import_options(command, arguments.import_options);
    return json;
}

FittedScene fitted(Scene scene, const FitArguments& arguments) {
    const mobb::FitOptions options = arguments.over(scene.fit);
    return {std::move(scene), options, nullptr, tell("fitted", "clips")};
}

void check_asks(const FittedScene& scene, const std::filesystem::path& file) {
    if (!scene.queries().empty()) return;
    if (scene.scene().crowd)
        throw InputError(file, "a run has no queries; mobbscope conflicts finds who collides in it");
    throw InputError(file, scene.scene().agents.size() > 1
                               ? "there are no queries: all agents are on different floors, which are not asked"
                               : "there are no queries; add some, or at least two agents");
}

std::filesystem::path parse_file_name(const std::string& text) {
    if (text.empty()) throw std::invalid_argument("the name of a file is empty; give one");
    return text;
}

std::filesystem::path parse_output_name(const std::string& text) {
    if (text == "-") throw std::invalid_argument("'-' is standard output, which is for the results; name a file");
    return parse_file_name(text);
}

void add_scene_file(Command& command, std::filesystem::path& file) {
    command.add_option("FILE", file, openable_files()).required();
}

std::function<int(const std::string&)> whole_number_within(int least, int most) {
    return [least, most](const std::string& text) {
        const std::optional<int> number = parse_int(text);
        if (number && *number >= least && *number <= most) return *number;
        throw std::invalid_argument(in_quotes(text) + " is not a whole number from " + std::to_string(least) + " to " +
                                    std::to_string(most));
    };
}

std::function<double(const std::string&)> number_within(double low, double high) {
    return [low, high](const std::string& text) { return parse_number_within(text, low, high); };
}

std::uint64_t parse_seed(const std::string& text) {
    std::uint64_t seed = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, seed);
    if (error != std::errc{} || stop != end || seed > kMaxSeed) {
        throw std::invalid_argument(in_quotes(text) + " is not a whole number from 0 to " + std::to_string(kMaxSeed));
    }
    return seed;
}

void add_backend_name(Command& command, std::string& backend, const std::string& help) {
    const auto known = [](const std::string& text) {
        static_cast<void>(one_of(backend_from_name, "auto, osmesa, egl")(text));
        return text;
    };
    add_parsed(command, "--backend", backend, known, help, "NAME");
}

void add_drawing_options(Command& command, DrawingArguments& drawing) {
    const auto parse_drawn_size = [](const std::string& text) {
        const PictureSize size = parse_size(text);
        check(PictureOptions{.size = size});
        return size;
    };
    add_parsed(command, "--size", drawing.size, parse_drawn_size, "In pixels (" + size_word(drawing.size) + ")", "WxH");
    add_parsed(command, "--scale", drawing.scale, number_within(kLeastScale, kMostScale),
               "Of text and lines; by itself it suits the size", "X");
    add_parsed(command, "--theme", drawing.theme, one_of(theme_from_name, "dark, light"), "dark or light", "NAME");
    add_parsed(command, "--backend", drawing.backend, one_of(backend_from_name, "auto, osmesa, egl"),
               "OpenGL without a display: auto, osmesa or egl", "NAME");
}

Progress tell(const std::string& doing, const std::string& things, std::optional<std::chrono::milliseconds> pause) {
    using Clock = std::chrono::steady_clock;
    const auto said = std::make_shared<Clock::time_point>(Clock::now());
    // A script's log stays short, and yet shows that something is done.
    const std::chrono::milliseconds usual(::isatty(STDERR_FILENO) == 1 ? 2000 : 8000);
    return [=](std::size_t done, std::size_t all) {
        if (Clock::now() - *said < pause.value_or(usual)) return;
        *said = Clock::now();
        say(doing + ' ' + std::to_string(done) + " of " + std::to_string(all) + ' ' + things);
    };
}

Scene load(const std::filesystem::path& file, const ImportOptions& options) {
    if (quotes_step(file)) {
        throw InputError(file, "no such file; only the window and render take a step behind a file's name");
    }
    Scene scene = load_scene(file, options, tell("read", "clips"));
    const auto has_source = [](const SceneClip& clip) { return clip.source.has_value(); };
    ImportOptions for_sources = options;
    // These two are for samples in a scene as well.
    for_sources.radius.reset();
    for_sources.motion.reset();
    print_warnings(scene, shown_name(scene.file));
    if (for_sources != ImportOptions{} && std::none_of(scene.clips.begin(), scene.clips.end(), has_source)) {
        warn(shown_name(file) + ": import options do not apply: every clip has its samples in the scene");
    }
    return scene;
}

Scene load_file_or_folder(const std::filesystem::path& path, const ImportOptions& options) {
    std::error_code ignored;
    if (!std::filesystem::is_directory(path, ignored)) return load(path, options);
    Scene scene = load_files({path}, options, tell("read", "files"));
    print_warnings(scene, shown_name(path));
    return scene;
}

}  // namespace mobbscope::cli
