#include <app/commands/arguments.h>
#include <app/commands/command.h>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace mobbscope::app {

namespace {

void open_file(Dialogs& dialogs, Files& files, const std::string& file) {
    if (file.empty()) return dialogs.open(Dialog::open);
    files.open(paths_in(file));
}

void add_file(Dialogs& dialogs, Files& files, const std::string& file) {
    if (file.empty()) return dialogs.open(Dialog::add);
    files.add(paths_in(file));
}

std::vector<std::string> recent_names(const Settings& settings) {
    std::vector<std::string> out;
    for (const auto& file : settings.recent) out.push_back(file.string());
    return out;
}

/// Of a command for what windows that are gone have left.
CommandTraits left_behind() {
    CommandTraits traits{.argument = "WORK", .where = Where::everywhere};
    traits.enabled = {&Recovery::has_left, []() -> std::string_view { return "there is none"; }};
    traits.choices = [](const Recovery& recovery) {
        std::vector<std::string> out;
        for (const Recovery::Left& left : recovery.left()) out.push_back(left.name);
        return out;
    };
    return traits;
}

void build_graph(Dialogs& dialogs, CrowdMaker& maker, const std::string& options) {
    if (options.empty()) return dialogs.open(Dialog::build_graph);
    maker.build_graph(parse_graph_options(options));
}

void simulate(Dialogs& dialogs, CrowdMaker& maker, const std::string& options) {
    if (options.empty()) return dialogs.open(Dialog::simulate);
    maker.simulate(parse_crowd_order(options));
}

void save_as(Dialogs& dialogs, Files& files, const std::string& file) {
    if (file.empty()) return dialogs.open(Dialog::save_as);
    files.save_as(file);
}

}  // namespace

std::vector<Command> file_commands() {
    const std::vector<Command> rows{
        Command(
            "file.open", "Open...",
            "Opens a scene, a capture, clips, or a folder of clips, in place of what is open. Several files stand in "
            "quotes.",
            open_file,
            {.shortcut = "Ctrl+O",
             .argument = "[FILE]",
             .enabled = always,
             .where = Where::everywhere,
             .also = "import load browse"}),
        Command("file.add", "Add files...", "Adds clips, or the agents and clips of another scene, to what is open.",
                add_file, {.argument = "[FILE]", .enabled = always, .also = "import append merge load"}),
        Command("file.recent", "Open recent", "Opens a file that was open before.",
                [](Files& files, const std::string& file) { files.open({file}); },
                {.argument = "FILE",
                 .enabled = always,
                 .where = Where::everywhere,
                 .choices = recent_names,
                 .also = "history"}),
        Command("file.reopen_last", "Reopen last session",
                "Opens what was open when the window was last closed, with the same view.", &Files::reopen_last,
                {.enabled = {&Files::has_last,
                             []() -> std::string_view { return "there is no last session, or its files are gone"; }},
                 .where = Where::everywhere,
                 .title_end = [](const Files& files) { return files.has_last() ? ": " + files.last_title() : ""; }}),
        Command(
            "file.recover", "Restore unsaved work",
            "Opens the unsaved work of a window that was killed; it stays unsaved.",
            [](Recovery& recovery, const std::string& name) { recovery.restore(name); }, left_behind()),
        Command(
            "file.discard_unsaved", "Discard unsaved work", "Removes the unsaved work of a window that was killed.",
            [](Recovery& recovery, const std::string& name) { recovery.discard(name); }, left_behind()),
        Command("file.demo", "Open the demo",
                "Opens the scene that comes with the program: two walkers whose paths cross, but not in time.",
                &Files::open_demo, {.enabled = always, .where = Where::everywhere}),
        Command("file.reload", "Reload", "Reads the open files again, when another program has changed them.",
                [](Files& files, Workspace& workspace) {
                    files.open(std::vector<std::filesystem::path>(workspace.opened));
                },
                {.shortcut = "F5",
                 .enabled = [](const Workspace& workspace) { return !workspace.opened.empty(); },
                 .also = "refresh reimport"}),
        Command("crowd.build_graph", "Build a motion graph...",
                "Cuts a motion graph out of the open clips; options as hubs=4 seconds=1:3 build it without a dialog.",
                build_graph,
                {.argument = "[OPTION=VALUE...]",
                 .enabled = {[](const CrowdMaker& maker) { return maker.why_no_graph().empty(); },
                             &CrowdMaker::why_no_graph},
                 .also = "crowd cut recordings"}),
        Command("crowd.simulate", "Simulate a crowd...",
                "Lets a crowd play the open motion graph; options as agents=50 area=20x20 begin without a dialog.",
                simulate,
                {.argument = "[OPTION=VALUE...]",
                 .enabled = {[](const CrowdMaker& maker) { return maker.why_no_crowd().empty(); },
                             &CrowdMaker::why_no_crowd},
                 .also = "simulation agents run people"}),
        Command("file.save", "Save", "Writes the scene and its view to its file.", &Files::save,
                {.shortcut = "Ctrl+S", .also = "write store"}),
        Command("file.save_as", "Save as...",
                "Writes the scene to another file; its clips are still read from where they are.", save_as,
                {.shortcut = "Ctrl+Shift+S", .argument = "[FILE]"}),
    };
    const std::vector<Command> end{
        Command("file.quit", "Quit", "Ends the program; asks first if there are unsaved changes.",
                &Files::request_close,
                {.shortcut = "Ctrl+Q", .enabled = always, .where = Where::everywhere, .also = "exit close"}),
    };
    return in_menu("File", joined({rows, export_commands(), end}));
}

}  // namespace mobbscope::app
