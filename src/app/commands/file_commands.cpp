#include <app/commands/command.h>
#include <app/commands/render_line.h>
#include <base/file.h>

#include <stdexcept>

namespace mobbscope::app {

namespace {

void open_file(Session& session, const std::string& file) {
    if (file.empty()) return session.open_dialog(Dialog::open);
    session.open({file});
}

void add_file(Session& session, const std::string& file) {
    if (file.empty()) return session.open_dialog(Dialog::add);
    session.add({file});
}

std::vector<std::string> recent_names(const Session& session) {
    std::vector<std::string> out;
    for (const auto& file : session.settings.recent) out.push_back(file.string());
    return out;
}

void save_as(Session& session, const std::string& file) {
    if (file.empty()) return session.open_dialog(Dialog::save_as);
    session.save_as(file);
}

void export_picture(Session& session, const std::string& file) {
    if (file.empty()) return session.open_dialog(Dialog::export_picture);
    check_file_name(file);
    session.check_may_write(file);
    if (lower_extension(file) != ".png") {
        throw InputError(file, "", "pictures are written as .png; rename the output");
    }
    if (!session.hooks.export_picture) throw std::invalid_argument("there is no window to take a picture of");
    session.hooks.export_picture(file);
    session.tell(Message::Level::info, "Wrote " + file);
}

void copy_command(Session& session) {
    const std::string line = render_line(session);
    if (session.hooks.set_clipboard) session.hooks.set_clipboard(line);
    session.tell(Message::Level::info, "Copied: " + line);
}

}  // namespace

std::vector<Command> file_commands() {
    const std::vector<Command> rows{
        {.id = "file.open",
         .title = "Open...",
         .shortcut = "Ctrl+O",
         .argument = "[FILE]",
         .doc = "Opens a scene, a capture, a clip, or a folder of clips, in place of what is open.",
         .enabled = always,
         .run = open_file},
        {.id = "file.add",
         .title = "Add files...",
         .argument = "[FILE]",
         .doc = "Adds clips, or the agents and clips of another scene, to what is open.",
         .enabled = always,
         .run = add_file},
        {.id = "file.recent",
         .title = "Open recent",
         .argument = "FILE",
         .doc = "Opens a file that was open before.",
         .enabled = always,
         .run = [](Session& session, const std::string& file) { session.open({file}); },
         .choices = recent_names},
        {.id = "file.demo",
         .title = "Open the demo",
         .doc = "Opens the scene that comes with the program: two walkers whose paths cross, but not in time.",
         .enabled = always,
         .run = &Session::open_demo},
        {.id = "file.reload",
         .title = "Reload",
         .shortcut = "F5",
         .doc = "Reads what is open again from its files, when another program has changed them.",
         .enabled = [](const Session& session) { return !session.opened().empty(); },
         .run = [](Session& session) { session.open(std::vector<std::filesystem::path>(session.opened())); }},
        {.id = "file.save",
         .title = "Save",
         .shortcut = "Ctrl+S",
         .doc = "Writes the scene and how it is seen to its file.",
         .run = &Session::save},
        {.id = "file.save_as",
         .title = "Save as...",
         .shortcut = "Ctrl+Shift+S",
         .argument = "[FILE]",
         .doc = "Writes the scene to another file; its clips are still read from where they are.",
         .run = save_as},
        {.id = "file.export_picture",
         .title = "Export picture...",
         .shortcut = "Ctrl+E",
         .argument = "[FILE.png]",
         .doc = "Writes the picture in the middle of the window to a PNG file.",
         .run = export_picture},
        {.id = "file.copy_command",
         .title = "Copy as command",
         .shortcut = "Ctrl+Shift+C",
         .doc = "Copies the command line that draws this picture again without a window.",
         .run = copy_command},
        {.id = "file.quit",
         .title = "Quit",
         .shortcut = "Ctrl+Q",
         .doc = "Ends the program; asks first if there are unsaved changes.",
         .enabled = always,
         .run = &Session::request_close},
    };
    return in_menu("File", rows);
}

}  // namespace mobbscope::app
