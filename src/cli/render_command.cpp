#include <app/shell.h>
#include <cli/commands.h>
#include <cli/messages.h>
#include <cli/options.h>
#include <guard/window_picture.h>
#include <import/error.h>
#include <import/file.h>
#include <import/text.h>
#include <render/build_draw_list.h>
#include <render/png.h>
#include <render/render.h>

#include <fcntl.h>
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

namespace mobbscope::cli {

namespace {

/// The view options as given; an empty one leaves the scene's view.
struct Arguments {
    std::filesystem::path file;
    std::filesystem::path output;
    PictureSize size{1280, 720};
    double scale = 0;
    Backend backend = Backend::automatic;
    std::optional<CameraPreset> view;
    std::optional<double> yaw, pitch, fov;
    bool orthographic = false;
    std::optional<LevelRange> levels;
    std::optional<int> query;
    std::optional<Step> step;
    std::optional<double> time, time_height;
    std::optional<ColorBy> color_by;
    std::optional<Theme> theme;
    bool ui = false;
    std::optional<double> ui_scale;
    FitArguments fit;
    ImportOptions import_options;
};

template <class T>
T required(std::optional<T> value, const std::string& text, const char* allowed) {
    if (!value) throw std::invalid_argument(in_quotes(text) + " is not one of " + allowed);
    return *value;
}

/// The scene's view with the options given over it.
ViewState over(ViewState view, const Arguments& arguments) {
    if (arguments.view) {
        view.camera.preset = *arguments.view;
        // A preset frames the scene; a target was meant for the camera that it replaces.
        view.camera.target.reset();
        view.camera.shift = {0, 0};
    }
    if (arguments.yaw || arguments.pitch) {
        // The angle that is not given stays what is seen now.
        const Orientation present = orientation(view.camera);
        view.camera.preset = CameraPreset::free;
        view.camera.yaw_deg = arguments.yaw.value_or(present.yaw_deg);
        view.camera.pitch_deg = arguments.pitch.value_or(present.pitch_deg);
        view.camera.perspective = present.perspective;
    }
    if (arguments.fov) view.camera.fov_deg = *arguments.fov;
    if (arguments.orthographic) view.camera.perspective = false;
    if (arguments.levels) {
        view.levels = *arguments.levels;
        view.query.reset();
    }
    if (arguments.query) view.query = *arguments.query;
    if (arguments.step) view.step = *arguments.step;
    if (arguments.time) view.time = *arguments.time;
    if (arguments.time_height) view.time_height = *arguments.time_height;
    if (arguments.color_by) view.color_by = *arguments.color_by;
    if (arguments.theme) view.theme = *arguments.theme;
    return view;
}

/// Throws InputError if the options given cannot all be had.
void check_together(const Arguments& arguments) {
    const auto contradict = [](const std::string& a, const std::string& b, const std::string& why) {
        throw InputError(a + " and " + b + " contradict each other: " + why);
    };
    if (arguments.query && arguments.levels) {
        contradict("--query", "--level", "a picture shows a query or levels; leave one out");
    }
    if (arguments.ui_scale && !arguments.ui) throw InputError("--ui-scale: the picture has panels only with --ui");
    const CameraPreset preset = arguments.view.value_or(CameraPreset::free);
    const std::string view = "--view " + std::string(name(preset));
    const std::string angle = arguments.yaw ? "--yaw" : "--pitch";
    if (preset != CameraPreset::free && (arguments.yaw || arguments.pitch)) {
        contradict(view, angle, "a named view has angles of its own; leave one out, or give --view free");
    }
    if (!arguments.fov) return;
    const std::string parallel = "there is no field of view without perspective; leave one out";
    if (arguments.orthographic) contradict("--ortho", "--fov", parallel);
    Camera camera;
    camera.preset = preset;
    if (!orientation(camera).perspective) contradict(view, "--fov", parallel);
}

/// Throws InputError if the picture's name is none, before anything is read.
void check_output_name(const std::filesystem::path& output) {
    check_file_name(output);
    if (lower_extension(output) != ".png") {
        throw InputError(output.string(), "", "pictures are written as .png; rename the output");
    }
}

/// Throws InputError if the picture would replace the scene or a file that its clips come from.
void check_keeps_sources(const std::filesystem::path& output, const Scene& scene) {
    const auto check_keeps = [&](const std::filesystem::path& source) {
        std::error_code ignored;
        if (!std::filesystem::equivalent(output, source, ignored)) return;
        throw InputError(
            output.string(), "",
            "the picture would replace " + in_quotes(source.string()) + ", which it is made from; give another output");
    };
    check_keeps(scene.file);
    for (const SceneClip& clip : scene.clips) {
        if (clip.source) check_keeps(scene.file.parent_path() / *clip.source);
    }
}

/// Throws MachineError if the picture has nowhere to go: better said before it is drawn.
void check_writable(const std::filesystem::path& output) {
    const auto refuse = [&](const std::string& why) {
        throw MachineError(output.string() + ": cannot be written: " + why);
    };
    std::error_code error;
    if (std::filesystem::is_directory(output, error)) refuse("is a folder");
    // A bare name has no folder of its own until it is made absolute.
    const std::filesystem::path absolute = std::filesystem::absolute(output);
    const std::filesystem::path target = std::filesystem::weakly_canonical(absolute, error);
    const std::filesystem::path folder = (error ? absolute : target).parent_path();
    if (!std::filesystem::is_directory(folder, error)) refuse("there is no folder " + in_quotes(folder.string()));
    const bool there = std::filesystem::exists(target, error);
    if (there && ::faccessat(AT_FDCWD, target.c_str(), W_OK, AT_EACCESS) != 0) refuse("it is write-protected");
    // What is no regular file is written in place.
    if (there && !std::filesystem::is_regular_file(target, error)) return;
    if (::faccessat(AT_FDCWD, folder.c_str(), W_OK | X_OK, AT_EACCESS) != 0) {
        refuse("its folder " + in_quotes(folder.string()) + " is write-protected");
    }
}

/// Names may hold characters that the fonts of pictures lack.
void warn_of_missing_glyphs(const DrawList& list) {
    std::set<char32_t> missing;
    for (const TextRun& run : list.texts) {
        for (const char32_t code : code_points(run.text)) {
            if (!Font::of(run.face).has(code)) missing.insert(code);
        }
    }
    if (missing.empty()) return;
    warn("the fonts of pictures lack " + counted(static_cast<long long>(missing.size()), "character", "characters") +
         " of this scene's names; boxes stand for them");
}

void run(const Arguments& arguments) {
    check_output_name(arguments.output);
    check_together(arguments);
    Scene scene = load(arguments.file, arguments.import_options);
    check_keeps_sources(arguments.output, scene);
    const ViewState view = over(scene.view, arguments);
    if (arguments.fov && !orientation(view.camera).perspective) {
        throw InputError("--fov: this scene is seen without perspective; give a --view with it, such as iso");
    }
    if (arguments.step && !view.query) throw InputError("--step: say with --query which query it is a step of");
    const mobb::FitOptions options = arguments.fit.over(scene.fit);
    const FittedScene fitted(std::move(scene), options);
    const DrawList list = [&] {
        try {
            return build_draw_list(fitted, view, arguments.size, arguments.scale);
        } catch (const std::invalid_argument& error) {
            throw InputError(arguments.file.string(), "", error.what());
        }
    }();
    check_writable(arguments.output);
    warn_of_missing_glyphs(list);
    if (arguments.ui) {
        write_png(arguments.output, guard::window_picture(fitted, view, arguments.file, arguments.backend,
                                                          arguments.size, arguments.ui_scale.value_or(1)));
        return;
    }
    Renderer renderer(arguments.backend);
    write_png(arguments.output, renderer.draw(list));
}

void add_view_options(CLI::App& command, Arguments& arguments) {
    add_parsed(command, "--size", arguments.size, parse_size, "The picture's size in pixels, default 1280x720", "WxH");
    add_parsed(command, "--scale", arguments.scale, number_within(kLeastScale, kMostScale),
               "Of text and lines; 1 suits 1280x720, default: what suits the size", "X");
    const auto parse_view = [](const std::string& text) {
        return required(camera_preset(text), text, "iso, top, front, side, free");
    };
    add_parsed(command, "--view", arguments.view, parse_view, "Camera: iso, top, front, side, or free (--yaw, --pitch)",
               "NAME");
    add_parsed(command, "--yaw", arguments.yaw, number_within(-3600, 3600),
               "Free camera: degrees from +x to the eye, counter-clockwise", "DEG");
    add_parsed(command, "--pitch", arguments.pitch, number_within(-90, 90), "Free camera: degrees above the floor",
               "DEG");
    add_parsed(command, "--fov", arguments.fov, number_within(kLeastFov, kMostFov), "Vertical field of view in degrees",
               "DEG");
    command.add_flag("--ortho", arguments.orthographic, "Without perspective");
    add_parsed(command, "--level", arguments.levels, parse_level_range, "Levels shown: N, A:B or leaves", "LEVELS");
    add_parsed(
        command, "--query", arguments.query,
        [](const std::string& text) {
            const std::optional<int> index = parse_int(text);
            if (!index || *index < 0)
                throw std::invalid_argument(in_quotes(text) + " is no query: give its number, from 0");
            return *index;
        },
        "Show a query instead of levels: its number, from 0", "K");
    add_parsed(command, "--step", arguments.step, parse_step,
               "Step of the query: an event number, a percentage (40%) or end", "STEP");
    add_parsed(command, "--time", arguments.time, number_within(-mobb::kMaxTime, mobb::kMaxTime),
               "Time cursor, global seconds", "T");
    add_parsed(command, "--time-height", arguments.time_height, number_within(1e-6, 1e6),
               "Metres drawn per second; default: as tall as wide", "M");
    add_parsed(
        command, "--color-by", arguments.color_by,
        [](const std::string& text) { return required(color_by_from_name(text), text, "agent, level"); },
        "What the colour of boxes says: agent or level", "WHAT");
    add_parsed(
        command, "--backend", arguments.backend,
        [](const std::string& text) { return required(backend_from_name(text), text, "auto, osmesa, egl"); },
        "OpenGL without a display: auto, osmesa or egl", "NAME");
    add_parsed(
        command, "--theme", arguments.theme,
        [](const std::string& text) { return required(theme_from_name(text), text, "dark, light"); }, "dark or light",
        "NAME");
    command.add_flag("--ui", arguments.ui, "The whole window, panels included");
    add_parsed(command, "--ui-scale", arguments.ui_scale, number_within(app::kLeastScale, app::kMostScale),
               "With --ui: size of text and panels, 0.5 to 4", "X");
}

}  // namespace

void add_render_command(CLI::App& program) {
    CLI::App* command = program.add_subcommand("render", "Draw a scene into a picture, without a display");
    const auto arguments = std::make_shared<Arguments>();
    add_scene_file(*command, arguments->file);
    command->add_option("-o,--output", arguments->output, "The picture, a PNG file")->required()->type_name("OUT.png");
    add_view_options(*command, *arguments);
    add_fit_options(*command, arguments->fit);
    add_import_options(*command, arguments->import_options);
    command->callback([arguments] { run(*arguments); });
}

}  // namespace mobbscope::cli
