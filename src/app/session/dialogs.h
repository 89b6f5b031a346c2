/// What is asked or shown over the panels, one at a time, and what was put into it so far.
#pragma once

#include <app/document/file_browser.h>
#include <app/document/file_preview.h>
#include <app/document/picture_export.h>

#include <array>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mobbscope::app {

enum class Dialog {
    none,
    open,
    add,
    save_as,
    export_picture,
    unsaved,
    palette,
    help,
    about,
    messages,
    dropped,
    import_clip,
    history,
    folder,       ///< that a screen looks into, see Dialogs::ask_for_folder
    export_file,  ///< where Dialog::export_picture writes to
    save_proof,
    build_graph,
    simulate
};

/// A file or a folder that is asked for.
struct FileQuestion {
    const char* title;
    const char* button;
    const char* prefix;   ///< of the marks
    const char* command;  ///< that is done with the path
    std::span<const std::string_view> (*extensions)() = scene_extensions;
    const char* extension = nullptr;  ///< that a name without one gets; null: none, as the file must be there
    bool of_folder = false;

    bool writes() const { return extension; }

    static std::span<const std::string_view> scene_extensions();
};

/// What Escape leaves before the dialog.
enum class BeforeEscape { nothing, popup, popup_or_text };

/// What differs between dialogs.
struct DialogRow {
    std::string_view name;                   ///< for scripts
    bool has_field = false;                  ///< that waits for the keys
    const FileQuestion* question = nullptr;  ///< of one that asks for files
    bool about_scene = false;                ///< of the one that is open: over with it
    BeforeEscape before_escape = BeforeEscape::nothing;
    Dialog over = Dialog::none;                      ///< it lies over that one, and closes to it
    std::array<std::string_view, 2> lets_through{};  ///< commands that keys call while it is open
};
const DialogRow& row_of(Dialog dialog);

/// What was put into the open dialog so far; the dialog says what it means by it.
struct DialogInput {
    std::string text;
    std::string command{};                       ///< the palette asks for the argument of this one; empty: it lists all
    std::vector<std::filesystem::path> files{};  ///< that were dropped
    int picked = 0;                              ///< of a list
    bool confirming = false;                     ///< asks whether to overwrite
    int generation = 0;                          ///< the field shows another text from without: see set_text
    int opening = 0;        ///< counts dialogs: the undo of a field must not reach the text of an earlier one
    bool fresh = true;      ///< the field waits for the keyboard
    bool selected = false;  ///< its text is selected then, so that typing replaces it

    void set_text(std::string to) {
        text = std::move(to);
        picked = 0;
        confirming = false;
        ++generation;
        fresh = true;
    }
};

class Dialogs {
  public:
    Dialog now = Dialog::none;  ///< the open one
    DialogInput input;          ///< ... and what was put into it
    ExportDialog exporting;     ///< what Dialog::export_picture holds
    FileBrowser browser;        ///< what a dialog for files looks at
    FilePreview preview;        ///< ... and into

    void open(Dialog which, DialogInput with = {});
    /// Shows the help, over the open dialog if there is one: closing it leads back there.
    void open_help();
    /// Asks for a folder; `question` outlives the dialog.
    void ask_for_folder(const FileQuestion& question);
    /// What a dialog asks for; null: no file.
    const FileQuestion* question(Dialog which) const {
        return which == Dialog::folder ? folder_ : row_of(which).question;
    }
    /// Of the open one, for scripts.
    std::string_view name() const { return now == Dialog::folder ? folder_->prefix : row_of(now).name; }
    /// What the help lies over.
    Dialog behind_help() const { return behind_help_.first; }
    /// Nothing comes of it: what waited for its answer is forgotten.
    void close();
    /// What asks about the scene that was open is over.
    void close_those_about_scene();
    /// Asks what becomes of unsaved changes; `then` waits for the answer.
    void ask_about_unsaved(std::function<void()> then);
    /// Asks for a file to save in; what waits for the changes to be saved goes on waiting.
    void ask_where_to_save();
    /// The answer is there: what waited for it; empty if nothing did.
    std::function<void()> take_waiting();

  private:
    void ask_anew(DialogInput with);

    std::pair<Dialog, DialogInput> behind_help_{Dialog::none, {}};
    const FileQuestion* folder_ = nullptr;  ///< of Dialog::folder
    std::function<void()> waiting_;         ///< for the answer about unsaved changes
};

}  // namespace mobbscope::app
