#include <cli/command_line.h>
#include <cli/options.h>
#include <cli/program.h>
#include <cli/window_command.h>

#include <app/script/script.h>
#include <app/window/end_signals.h>
#include <app/window/glfw_window.h>
#include <app/window/headless_window.h>
#include <base/error.h>
#include <base/file.h>
#include <base/text.h>
#include <render/drawlist/picture_options.h>
#include <review/review_screen.h>
#include <scene/load_files.h>
#include <scene/step_link.h>

#include <cstdlib>
#include <iostream>
#include <memory>
#include <optional>
#include <system_error>
#include <variant>

namespace mobbscope::cli {

namespace {

/// Takes the step that is quoted off the name of the file; none: there is none.
std::optional<StepLink> take_link(std::vector<std::filesystem::path>& files) {
    std::optional<StepLink> out;
    for (std::filesystem::path& file : files) {
        const LinkedFile linked = linked_file(file);
        if (linked.link && files.size() > 1)
            throw InputError(file.string(), "a step is quoted of one scene alone; name no other file");
        out = linked.link;
        file = linked.file;
    }
    return out;
}

/// All files as one scene, seen at that step; without any, the demo.
Scene load_all(const Command& program, const std::vector<std::filesystem::path>& files,
               const std::optional<StepLink>& link) {
    if (files.empty()) return demo_scene();
    std::vector<std::string> commands;
    for (const Command& command : program.subcommands()) commands.push_back(command.name());
    for (const std::filesystem::path& file : files) {
        std::error_code ignored;
        if (!file.empty() && !std::filesystem::exists(file, ignored)) {
            throw InputError(in_quotes(file.string()) + " is neither a command nor a file" +
                             did_you_mean(file.string(), commands));
        }
    }
    Scene scene = load_files(files);
    if (link) {
        show_step(scene, *link);
        check_step(scene, *link);
    }
    return scene;
}

/// Those that hold whatever is opened.
void add_common_options(Command& program, WindowArguments& arguments) {
    add_parsed(program, "--size", arguments.size, parse_size, "The window's size in pixels", "WxH");
    add_parsed(program, "--ui-scale", arguments.ui_scale, number_within(app::kLeastUiScale, app::kMostUiScale),
               "Size of text and panels, 0.5 to 4; default: the monitor's", "X");
    program.add_option("--script", arguments.script, "Run commands and input from this file, then end", "SCRIPT");
    program.add_flag("--headless", arguments.headless, "With --script: without a display");
}

/// What the arguments name.
using Named = std::variant<Scene, app::ReviewFolder>;

void show_named(app::Session& session, const Named& named, const WindowArguments& arguments) {
    if (const Scene* scene = std::get_if<Scene>(&named)) return session.files.open_scene(*scene, arguments.files);
    auto& review = session.the<app::ReviewScreen>();
    review.case_drawer.backend = arguments.backend;
    review.open(std::get<app::ReviewFolder>(named));
}

/// The window ends unasked. Whether a copy of unsaved work is kept.
bool leave(app::Session& session) {
    session.files.note_session();
    session.settings_file.save(session.settings);
    return session.recovery.keep_now();
}

/// In the midst of anything: what is destroyed at an ordinary end would ask the display again.
[[noreturn]] void end_without_display(app::Session& session) {
    const bool kept = leave(session);
    std::cout.flush();
    complain(std::string("the display of the window has gone away") +
             (kept ? "; the next window offers the work that was not saved" : ""));
    std::_Exit(kNoMachine);
}

/// Scripts find the same everywhere: they neither read nor write a person's settings.
int run_script(const Named& named, const WindowArguments& arguments) {
    const app::Script script = app::Script::parse(read_file(arguments.script), arguments.script.string(),
                                                  app::ScriptOutput::allowed, app::commands_with_review());
    app::Session session(false);
    app::add_review(session);
    // One scale everywhere, whatever the monitor's.
    session.settings.ui_scale = arguments.ui_scale.value_or(1);
    const std::unique_ptr<app::ShellHost> host = [&]() -> std::unique_ptr<app::ShellHost> {
        if (!arguments.headless && app::has_display()) {
            return std::make_unique<app::GlfwWindow>(session, arguments.size,
                                                     [&session] { end_without_display(session); });
        }
        if (arguments.size) at_place("--size", "", [&] { check(PictureOptions{.size = *arguments.size}); });
        return std::make_unique<app::HeadlessWindow>(GlContext::open(Backend::automatic), session,
                                                     arguments.size.value_or(app::kDefaultSize), 1);
    }();
    show_named(session, named, arguments);
    try {
        script.run(session, *host, std::cout);
    } catch (const app::ExpectationError& error) {
        flush_results();
        complain(error.what());
        return kFailed;
    }
    flush_results();
    return kDone;
}

/// Until it is closed.
void show_window(const Named& named, const WindowArguments& arguments) {
    const std::filesystem::path file = app::settings_file();
    const std::string kept = app::keep_unreadable_settings(file);
    app::SettingsFile settings(file);
    app::Session session(true, settings.load());
    app::add_review(session);
    if (arguments.ui_scale) session.settings.ui_scale = *arguments.ui_scale;
    // What the command line asked for holds this once.
    settings.note(session.settings);
    session.settings_file = std::move(settings);
    app::GlfwWindow window(session, arguments.size, [&session] { end_without_display(session); });
    const app::EndSignals signals([&session] { session.desktop->wake(); });
    session.recovery.keep_in(app::unsaved_folder());
    show_named(session, named, arguments);
    if (!kept.empty()) session.notifications.tell_of_window(app::MessageLevel::warning, kept);
    if (arguments.files.empty() && !session.screen && session.files.has_last()) {
        session.notifications.tell(app::MessageLevel::info, "Last time: " + session.files.last_title(),
                                   {{"file.reopen_last", "", "Reopen last session"}});
    }
    session.recovery.look();
    window.run(&app::EndSignals::any);
    if (app::EndSignals::any()) {
        leave(session);
        app::EndSignals::end();
    }
    session.recovery.discard_own();
    session.files.note_session();
    session.settings_file.save(session.settings);
}

/// The exit status.
int show(const Named& named, const WindowArguments& arguments) {
    if (arguments.headless && arguments.script.empty()) {
        throw InputError("--headless: give a --script to run; pictures without a display come from mobbscope render");
    }
    if (!arguments.script.empty()) return run_script(named, arguments);
    show_window(named, arguments);
    // A job that was given up may still be at work, on what an ordinary end destroys.
    if (app::Job::any_left()) {
        flush_results();
        std::quick_exit(kDone);
    }
    return kDone;
}

/// Bad input is told before there is a window.
int review(const WindowArguments& arguments) {
    return show(app::find_review(arguments.cases, arguments.output), arguments);
}

void add_review_options(Command& command, WindowArguments& arguments) {
    command.add_option("DIR", arguments.cases, "The folder of the cases, NAME.case.json").required();
    add_parsed(command, "--output", arguments.output, parse_file_name,
               "Look at what mobbscope test left, the folder of its --output or the page of its --html; without "
               "it, all cases are drawn",
               "REPORT");
    add_backend_name(command, arguments.backend, "OpenGL that draws the cases: auto, osmesa or egl");
    add_common_options(command, arguments);
}

}  // namespace

void add_window_options(Command& program, WindowArguments& arguments) {
    program.add_option("FILE", arguments.files, "Scenes, captures or clips to open in the window, as one scene");
    add_common_options(program, arguments);
}

void add_review_command(Command& program) {
    program.add_subcommand("review", "Look at picture tests in the window: what differs, and take it or not",
                           add_review_options, review);
}

void check_not_before_command(const Command& program) {
    const std::vector<GivenOption> given = program.given();
    if (program.chosen().empty() || given.empty()) return;
    const GivenOption& first = given.front();
    throw InputError((first.name.starts_with('-') ? first.name : in_quotes(first.value)) +
                     " stands before the command " + program.chosen() +
                     "; a command's files and options come after its name");
}

int open_window(const Command& program, const WindowArguments& given) {
    WindowArguments arguments = given;
    const std::optional<StepLink> link = take_link(arguments.files);
    return show(load_all(program, arguments.files, link), arguments);
}

}  // namespace mobbscope::cli
