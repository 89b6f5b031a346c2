/// Commands as items of menus: the menu bar, right-click menus and what a toolbar has no room for.
#pragma once

#include <app/commands/command.h>
#include <app/ui/ui.h>

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope::app {

/// A command in a menu. One without an argument that needs one asks for it, or shows its choices as a submenu.
struct MenuEntry {
    std::string_view id;     ///< empty: a line between groups
    std::string argument{};  ///< what the command is given
    std::string title{};     ///< empty: the command's own
    /// The command whose key does the same now; empty: of one without an argument its own
    std::string_view like{};
};

/// A menu that opens by mouse and keys; ends with ImGui::EndMenu() if it is open. `mark`: its name for scripts.
bool begin_menu(Ui& ui, const std::string& title, const std::string& mark, bool enabled = true);

/// Draws the item; one that cannot be done now says why in its tooltip. Named `mark` for scripts, its choices `mark`
/// with a point and the choice.
void command_item(Ui& ui, const MenuEntry& entry, const std::string& mark);

/// The right-click menu of the last widget. `entries` is called while it is open, the mouse being where it was opened
/// (ImGui::GetMousePosOnOpeningCurrentPopup()). Items are named "context.<id>" for scripts, a second one of the same
/// command "context.<id>.2". `place`: where keys open it, as if the mouse were there; none: below the widget's left
/// end.
void context_menu(Ui& ui, const std::function<std::vector<MenuEntry>()>& entries, std::optional<ImVec2> place = {});
/// The same, opened by ImGui::OpenPopup(name) in the current window.
void context_menu(Ui& ui, const char* name, const std::function<std::vector<MenuEntry>()>& entries);
/// Opens a menu of the current window by keys, as the mouse would at that place.
void open_menu_at(ImGuiID menu, ImVec2 place);

/// A button for a command, with a label shorter than its title.
struct ToolButton {
    const char* label;  ///< null: a gap
    std::string_view id;
};

/// Buttons on one line, named "toolbar.<id>"; those that do not fit are items of a menu behind a last one,
/// "toolbar.more". What has no room of its own is so still in its place, in one menu.
void tool_row(Ui& ui, std::span<const ToolButton> buttons);

}  // namespace mobbscope::app
