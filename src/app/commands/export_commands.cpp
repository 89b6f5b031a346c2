#include <app/commands/arguments.h>
#include <app/commands/command.h>
#include <app/commands/film_export.h>
#include <app/commands/picture_order.h>
#include <base/error.h>
#include <base/file.h>
#include <base/text.h>
#include <render/image/picture_names.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::app {

namespace {

/// Another document's picture gets another name.
void name_file(Dialogs& dialogs, Workspace& workspace, Settings& settings) {
    ExportDialog& dialog = dialogs.exporting;
    if (dialog.opening == workspace.document().opening) return;
    dialog.file.clear();
    dialog.file = export_file(workspace, settings, dialogs).string();
    dialog.agreed.clear();
    dialog.opening = workspace.document().opening;
}

void open_export_dialog(Dialogs& dialogs, Workspace& workspace, Settings& settings, bool film) {
    ExportDialog& dialog = dialogs.exporting;
    dialog.film = film;
    name_file(dialogs, workspace, settings);
    const bool is_named_so = is_film_name(export_file(workspace, settings, dialogs)) == film;
    if (!is_named_so)
        dialog.file = std::filesystem::path(dialog.file).replace_extension(film ? ".mp4" : ".png").string();
    dialogs.open(Dialog::export_picture, {.text = dialog.file});
}

/// A film is written beside the window, which tells of it then.
void write_and_tell(Session& session, const PictureOrder& order, const std::filesystem::path& file) {
    if (is_film_name(file)) return start_film(session, ordered_for(file, order, session.settings), file);
    const std::size_t bytes = write_picture(session, order, file);
    session.notifications.tell(MessageLevel::info, "Wrote " + file.string() + " (" + size_text(order.options.size) +
                                                       ", " + bytes_text(bytes) + ")");
}

void copy_picture_of(Session& session, const PictureOrder& order) {
    const std::string png = png_of(session, order);
    session.desktop->set_clipboard_picture(png);
    session.notifications.tell(MessageLevel::info, "Copied the picture (" + size_text(order.options.size) + ")");
}

/// `shown`: the line stands in the dialog.
void copy_line_of(Session& session, const PictureOrder& seen, const std::string& output, bool shown) {
    const PictureOrder order = ordered_for(output, seen, session.settings);
    const bool has_file = render_line(session.workspace, session.files, session.dialogs, order, output).has_value();
    const std::string line = render_line_with_scene(session.workspace, session.files, session.dialogs, order, output);
    session.desktop->set_clipboard(line);
    std::string said = shown ? "Copied the command line" : "Copied: " + line;
    if (!has_file) {
        said += ". The scene has unsaved changes, so a copy was written to " +
                session.dialogs.exporting.temporary->file.string();
    }
    session.notifications.tell(MessageLevel::info, said);
}

const Condition kHasPictureClipboard{[](const Workspace& workspace, Desktop& desktop) {
                                         return has_scene(workspace) && desktop.why_no_clipboard_picture().empty();
                                     },
                                     [](Desktop& desktop) { return desktop.why_no_clipboard_picture(); }};

Command command_of(const ExportOption& option) {
    static std::vector<std::string> ids = [] {
        std::vector<std::string> out;
        for (const ExportOption& each : export_options()) out.push_back("picture." + std::string(each.key));
        return out;
    }();
    const std::string& id = ids[static_cast<std::size_t>(&option - export_options().data())];
    const auto set = [&option](Settings& settings, const std::string& text) {
        option.parse(text, settings.picture_export);
    };
    CommandTraits traits{.menu = kNoMenu, .argument = option.argument};
    if (!option.choices.empty()) {
        traits.choices = [&option](const Session&) { return option.choices; };
        if (!option.choice_titles.empty()) {
            traits.choice_title = [&option](const std::string& choice) {
                const auto at = std::ranges::find(option.choices, choice) - option.choices.begin();
                return option.choice_titles.at(static_cast<std::size_t>(at));
            };
        }
        traits.chosen = [&option](const Settings& settings, const std::string& choice) {
            return option.text(settings.picture_export) == choice;
        };
    }
    return {id, option.title, option.doc, set, std::move(traits)};
}

}  // namespace

std::vector<Command> export_commands() {
    std::vector<Command> rows{
        Command("file.export_picture", "Export picture...",
                "Writes the picture in the middle of the window to a PNG, SVG or PDF file; without a name a dialog "
                "asks for more.",
                [](Session& session, const std::string& file) {
                    file.empty() ? open_export_dialog(session.dialogs, session.workspace, session.settings, false)
                                 : write_and_tell(session, order_of_viewport(session.workspace, session.views), file);
                },
                {.shortcut = "Ctrl+E",
                 .argument = "[FILE.png]",
                 .also = "screenshot snapshot image png svg pdf vector print figure paper render save"}),
        Command("file.export_film", "Export as film...",
                "Writes a film of the motion, of the query's steps or around the scene to an MP4 or WebM file, while "
                "the window goes on; without a name a dialog asks for more.",
                [](Session& session, const std::string& file) {
                    if (file.empty())
                        return open_export_dialog(session.dialogs, session.workspace, session.settings, true);
                    if (!is_film_name(file))
                        throw InputError(file, "films are written as .mp4 or .webm; rename the output");
                    write_and_tell(session, order_of_viewport(session.workspace, session.views), file);
                },
                {.argument = "[FILE.mp4]",
                 .also = "video movie record recording animation animate mp4 webm gif mpeg turntable screencast render "
                         "save capture"}),
        Command("file.copy_picture", "Copy picture", "Copies the picture in the middle of the window.",
                [](Session& session) { copy_picture_of(session, order_of_viewport(session.workspace, session.views)); },
                {.enabled = kHasPictureClipboard, .also = "screenshot snapshot image clipboard"}),
        Command("file.copy_command", "Copy as command",
                "Copies the command line that draws this picture again without a window; with --play -o FILE.mp4 it "
                "makes a film of the motion or the query's steps.",
                [](Session& session) {
                    copy_line_of(session, order_of_viewport(session.workspace, session.views), "picture.png", false);
                },
                {.shortcut = "Ctrl+Shift+C", .also = "shell terminal script render frames"}),
        Command("picture.file", "Picture file", "Says where the export dialog writes to.",
                [](Dialogs& dialogs, Workspace& workspace, const std::string& file) {
                    check_file_name(file);
                    dialogs.exporting.file = file;
                    dialogs.exporting.opening = workspace.document().opening;
                    if (dialogs.now == Dialog::export_picture) dialogs.input.set_text(file);
                },
                {.menu = kNoMenu, .argument = "FILE.png"}),
        Command("picture.browse", "Browse for the picture file", "Asks for the file of the export dialog.",
                [](Dialogs& dialogs, Workspace& workspace, Settings& settings) {
                    name_file(dialogs, workspace, settings);
                    dialogs.open(Dialog::export_file);
                },
                {.menu = kNoMenu}),
        Command("picture.write", "Write picture as in the dialog",
                "Writes the picture as the export dialog says, to its file or another one.",
                [](Session& session, const std::string& file) {
                    write_and_tell(session, order_to_export(session.settings, session.workspace, session.views),
                                   file.empty() ? export_file(session.workspace, session.settings, session.dialogs)
                                                : std::filesystem::path(file));
                },
                {.menu = kNoMenu, .argument = "[FILE.png]"}),
        Command("picture.copy", "Copy picture as in the dialog", "Copies the picture as the export dialog says.",
                [](Session& session) {
                    copy_picture_of(session, order_to_export(session.settings, session.workspace, session.views));
                },
                {.menu = kNoMenu, .enabled = kHasPictureClipboard}),
        Command("picture.copy_command", "Copy command line of the dialog",
                "Copies the command line that writes the same file as the export dialog; a scene that no file holds is "
                "written to a temporary one.",
                [](Session& session) {
                    copy_line_of(session, order_to_export(session.settings, session.workspace, session.views),
                                 export_file(session.workspace, session.settings, session.dialogs).string(), true);
                },
                {.menu = kNoMenu}),
    };
    for (const ExportOption& option : export_options()) rows.push_back(command_of(option));
    return rows;
}

}  // namespace mobbscope::app
