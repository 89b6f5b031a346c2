/// Every action of the window, by name: menus, palette, help sheet, shortcuts, scripts and tests are made from one
/// table.
#pragma once

#include <app/document/session.h>
#include <app/input/key.h>
#include <scene/view_options.h>

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope::app {

struct Command {
    std::string_view id;     ///< "view.top": for scripts
    std::string_view title;  ///< "View from above": for menus and the palette
    /// "File", "Edit", "View", "Tree", "Query", "Go" or "Help", and behind a slash the submenu; empty: not in a menu
    std::string_view menu{};
    std::string_view shortcut{};  ///< "Ctrl+O"; several separated by a blank; empty: none
    bool repeats = false;         ///< while its key is held
    std::string_view argument{};  ///< what it takes: "FILE", "N"; in brackets if it can do without; empty: nothing
    std::string_view doc;         ///< one sentence
    bool (*enabled)(const Session&) = [](const Session&) { return true; };
    /// Why not, where it is not enabled though a scene is open and no job under way.
    std::string_view (*why_not)(const Session&) = [](const Session&) { return std::string_view("not now"); };
    /// Throws InputError, MachineError or std::invalid_argument, in words for the person.
    std::function<void(Session&, const std::string& argument)> run{};
    std::function<bool(const Session&)> checked{};                      ///< of a toggle: whether it is on
    std::function<std::vector<std::string>(const Session&)> choices{};  ///< arguments to choose from
    /// Of a command with choices: whether this one is what is now. Null: no choice is.
    std::function<bool(const Session&, const std::string& choice)> chosen{};

    bool needs_argument() const { return !argument.empty() && !argument.starts_with('['); }
};

/// The rule of commands that need nothing but a scene.
inline bool has_scene(const Session& session) { return !session.empty(); }

/// The table, in the order of the menus.
std::span<const Command> commands();

/// Why a command cannot be done now; empty if it can.
std::string_view why_not(const Session& session, const Command& command);
/// ... of a command that looks for a step of the query in view.
std::string_view why_no_step(const Session& session);

/// Null if there is none.
const Command* find_command(std::string_view id);

/// Runs a command by id at once, as a script does between frames: throws std::invalid_argument if there is none, it is
/// not enabled, or it is given an argument that it does not take or none where it needs one; and what the command
/// throws.
void run_command(Session& session, std::string_view id, const std::string& argument = "");

/// Runs a command for a person once the frame is drawn (Session::enqueue).
void invoke(Session& session, std::string_view id, const std::string& argument = "");

/// The command that a chord calls; null if none.
const Command* command_for(const Chord& chord);

/// The first of a command's shortcuts, as menus show it; empty if it has none.
std::string_view first_shortcut(const Command& command);

/// The command of a toggle or a choice, from its row in the table of view options.
Command option_command(const ViewOption& option);

// The parts of the table, one file each.
std::span<const Command> file_commands();
std::span<const Command> edit_commands();
std::span<const Command> view_commands();
std::span<const Command> tree_commands();
std::span<const Command> query_commands();
std::span<const Command> go_commands();
std::span<const Command> crowd_commands();
std::span<const Command> help_commands();

}  // namespace mobbscope::app
