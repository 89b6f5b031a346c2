#include <app/commands/command.h>
#include <app/ui/widgets.h>
#include <app/viewport/viewport.h>

#include <array>

namespace mobbscope::app {

namespace {

/// Lit while the command says it is on.
void toolbar_button(Ui& ui, const char* label, const char* id) {
    const Command& command = *find_command(id);
    const bool on = command.checked && command.checked(ui.session);
    ImGui::PushStyleColor(ImGuiCol_Button, on ? ui.style.raised : IM_COL32_BLACK_TRANS);
    // A toggle that is off steps back; what has no state does not.
    ImGui::PushStyleColor(ImGuiCol_Text, on || !command.checked ? ui.style.text : ui.style.quiet);
    command_button(ui, label, id, std::string("toolbar.") + id);
    ImGui::PopStyleColor(2);
}

}  // namespace

void viewport_toolbar(Ui& ui) {
    struct Item {
        const char* label;
        const char* id;  ///< null: a gap
    };
    constexpr std::array<Item, 15> kItems{{{"Iso", "view.iso"},
                                           {"Top", "view.top"},
                                           {"Front", "view.front"},
                                           {"Side", "view.side"},
                                           {nullptr, nullptr},
                                           {"Frame", "view.frame"},
                                           {"Perspective", "view.perspective"},
                                           {nullptr, nullptr},
                                           {"Disks", "view.disks"},
                                           {"Boxes", "view.boxes"},
                                           {"Floor", "view.floor"},
                                           {"Labels", "view.labels"},
                                           {"Legend", "view.legend"},
                                           {nullptr, nullptr},
                                           {"Moment", "view.moment"}}};
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ui.px(2), ui.px(4)});
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ui.px(8), ui.px(3)});
    ImGui::SetCursorPos({ui.px(6), ui.px(4)});
    const float right = ImGui::GetWindowPos().x + ImGui::GetWindowWidth();
    for (const Item& item : kItems) {
        if (!item.label) {
            ImGui::SameLine(0, ui.px(14));
            continue;
        }
        // What has no room is still in the menus.
        if (ImGui::GetCursorScreenPos().x + button_width(item.label) > right) break;
        toolbar_button(ui, item.label, item.id);
        ImGui::SameLine();
    }
    ImGui::NewLine();
    ImGui::PopStyleVar(2);
}

}  // namespace mobbscope::app
