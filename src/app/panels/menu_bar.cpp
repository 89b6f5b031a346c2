#include <app/commands/command.h>
#include <app/panels/panels.h>
#include <app/ui/command_menu.h>
#include <app/ui/dialog_frame.h>
#include <app/ui/widgets.h>
#include <base/text.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace mobbscope::app {

namespace {

constexpr float kSearchWidth = 360;       // pixels at scale 1
constexpr float kLeastSearchWidth = 110;  // below, it only costs room

std::string_view group_of(const Command& command) { return command.id.substr(0, command.id.find('.')); }

void items(Ui& ui, const std::string& menu) {
    std::string_view group;
    std::vector<std::string_view> submenus;
    for (const Command& command : commands(ui.session)) {
        if (!belongs_here(ui.session, command)) continue;
        if (command.menu == menu) {
            if (!group.empty() && group != group_of(command)) ImGui::Separator();
            group = group_of(command);
            command_item(ui, {command.id}, "menu." + std::string(command.id));
        } else if (command.menu.starts_with(menu + '/') &&
                   std::find(submenus.begin(), submenus.end(), command.menu) == submenus.end()) {
            submenus.push_back(command.menu);
        }
    }
    if (!submenus.empty()) ImGui::Separator();
    for (const std::string_view submenu : submenus) {
        const std::string name(submenu.substr(menu.size() + 1));
        if (!begin_menu(ui, name, "menu." + lower(menu) + '.' + lower(name))) continue;
        items(ui, std::string(submenu));
        ImGui::EndMenu();
    }
}

/// What looks like a field and opens the palette; it takes what room there is between the menus and the title.
void search(Ui& ui, float left, float right) {
    const float gap = ui.px(16);
    const float room = right - left - 2 * gap;
    if (room < ui.px(kLeastSearchWidth)) return;
    const float width = std::min(room, ui.px(kSearchWidth));
    const float middle = ImGui::GetWindowWidth() / 2;
    // Rounding may leave less room than it takes.
    const float x = std::max(left + gap, std::min(middle - width / 2, right - gap - width));
    const float height = ImGui::GetFrameHeight() - ui.px(4);
    ImGui::SetCursorPos({x, ui.px(2)});
    if (ImGui::InvisibleButton("##search", {width, height})) ui.invoke("go.palette");
    ui.mark_only("menu.search");
    const ImVec2 min = ImGui::GetItemRectMin();
    const ImVec2 max = ImGui::GetItemRectMax();
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled(min, max, ui.style.panel, ui.px(4));
    draw.AddRect(min, max, ImGui::IsItemHovered() ? ui.style.accent : ui.style.border, ui.px(4));
    const float pad = ui.px(10);
    const std::string key(first_shortcut(*find_command("go.palette")));
    const float key_width = text_size(*ui.style.mono, key).x;
    const float y = (min.y + max.y - ui.style.body->FontSize) / 2;
    const char* all = ui.session.screen ? ui.session.screen->words().search : "Search commands, agents, nodes";
    for (const char* text : {all, "Search commands", "Search"}) {
        if (ImGui::CalcTextSize(text).x + key_width + 3 * pad > width) continue;
        draw.AddText({min.x + pad, y}, ui.style.quiet, text);
        break;
    }
    draw_text(draw, *ui.style.mono, {max.x - pad - key_width, y}, ui.style.quiet, key);
}

/// The file's name between two places, at the right, with a dot when it is not saved; returns where it begins.
float file_title(Ui& ui, float left, float right) {
    const std::string title = ui.session.shown_title();
    const float pad = ui.px(12);
    const bool modified = ui.session.shows_unsaved();
    const float dot = modified ? ui.px(14) : 0;
    const float room = right - left - 2 * pad - dot;
    // Where the menus leave less there is no title.
    const float width = room < ui.px(40) ? 1 : std::min(ImGui::CalcTextSize(title.c_str()).x, room);
    const float x = right - pad - width;
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const float middle = ImGui::GetFrameHeight() / 2;
    if (modified) draw.AddCircleFilled({x - dot + ui.px(4), middle}, ui.px(3.5f), ui.style.warning);
    ImGui::SetCursorPos({x - dot, 0});
    ImGui::InvisibleButton("##title", {width + dot, ImGui::GetFrameHeight()});
    ui.mark_only("menu.title");
    if (ImGui::IsItemHovered()) {
        const std::string file = ui.workspace.file && !ui.session.screen ? ui.workspace.file->string() : title;
        ImGui::SetTooltip("%s%s", file.c_str(), modified ? "\nnot saved" : "");
    }
    if (width > 1) {
        draw.AddText({x, middle - ImGui::GetFontSize() / 2}, ui.style.quiet, fitted_name(title, width).c_str());
    }
    return x - dot;
}

}  // namespace

void menu_bar(Ui& ui) {
    if (!ImGui::BeginMainMenuBar()) return;
    std::vector<std::string> menus;
    for (const Command& command : commands(ui.session)) {
        const std::string menu(command.menu.substr(0, command.menu.find('/')));
        if (!belongs_here(ui.session, command)) continue;
        if (!menu.empty() && std::find(menus.begin(), menus.end(), menu) == menus.end()) menus.push_back(menu);
    }
    for (const std::string& menu : menus) {
        if (!begin_menu(ui, menu, "menu." + lower(menu))) continue;
        items(ui, menu);
        ImGui::EndMenu();
    }
    const float left = ImGui::GetCursorPosX();
    const float right = file_title(ui, left, message_bell(ui, ui.session.notifications));
    search(ui, left, right);
    ImGui::EndMainMenuBar();
}

}  // namespace mobbscope::app
