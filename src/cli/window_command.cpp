#include <cli/exit_status.h>
#include <cli/options.h>
#include <cli/window_command.h>

#include <app/load_files.h>
#include <import/error.h>
#include <import/text.h>
#include <render/render.h>
#include <scene/demo_scene.h>

#include <optional>
#include <string>
#include <system_error>

namespace mobbscope::cli {

namespace {

/// All files as one scene; without any, the demo.
Scene load_all(const CLI::App& program, const std::vector<std::filesystem::path>& files) {
    if (files.empty()) return demo_scene();
    std::vector<std::string> commands;
    for (const CLI::App* command : program.get_subcommands({})) commands.push_back(command->get_name());
    for (const std::filesystem::path& file : files) {
        std::error_code ignored;
        if (!file.empty() && !std::filesystem::exists(file, ignored)) {
            throw InputError(in_quotes(file.string()) + " is neither a command nor a file" +
                             did_you_mean(file.string(), commands));
        }
    }
    app::JobControl control;
    return app::load_files(files, control);
}

}  // namespace

void add_window_options(CLI::App& program, WindowArguments& arguments) {
    program.add_option("FILE", arguments.files, "Scenes, captures or clips to open in the window, as one scene");
    add_parsed(program, "--size", arguments.window.size, parse_size, "The window's size in pixels", "WxH");
    add_parsed(program, "--ui-scale", arguments.window.ui_scale, number_within(app::kLeastScale, app::kMostScale),
               "Size of text and panels, 0.5 to 4; default: the monitor's", "X");
}

void check_not_before_command(const CLI::App& program) {
    const std::vector<const CLI::App*> chosen =
        program.get_subcommands([](const CLI::App* command) { return command->parsed(); });
    if (chosen.empty()) return;
    for (const CLI::Option* option : program.get_options()) {
        if (option->count() == 0) continue;
        const bool named = !option->get_lnames().empty();
        throw InputError((named ? option->get_name() : in_quotes(option->results().front())) +
                         " stands before the command " + chosen.front()->get_name() +
                         "; a command's files and options come after its name");
    }
}

int open_window(const CLI::App& program, const WindowArguments& arguments) {
    const Scene scene = load_all(program, arguments.files);
    const std::filesystem::path settings = app::settings_file();
    app::Session session(true, app::load_settings(settings));
    app::GlfwWindow window(session, arguments.window);
    session.open_scene(scene, app::scene_file_of(arguments.files));
    window.run();
    app::save_settings(settings, session.settings);
    return kDone;
}

}  // namespace mobbscope::cli
