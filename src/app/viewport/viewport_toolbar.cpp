#include <app/ui/command_menu.h>
#include <app/viewport/viewport.h>

#include <array>

namespace mobbscope::app {

void viewport_toolbar(Ui& ui) {
    constexpr std::array<ToolButton, 15> kButtons{{{"Iso", "view.iso"},
                                                   {"Top", "view.top"},
                                                   {"Front", "view.front"},
                                                   {"Side", "view.side"},
                                                   {nullptr, ""},
                                                   {"Frame", "view.frame"},
                                                   {"Perspective", "view.perspective"},
                                                   {nullptr, ""},
                                                   {"Disks", "view.disks"},
                                                   {"Boxes", "view.boxes"},
                                                   {"Floor", "view.floor"},
                                                   {"Labels", "view.labels"},
                                                   {"Legend", "view.legend"},
                                                   {nullptr, ""},
                                                   {"Moment", "view.moment"}}};
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ui.px(2), ui.px(4)});
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ui.px(6), ui.px(3)});
    ImGui::SetCursorPos({ui.px(6), ui.px(4)});
    tool_row(ui, kButtons);
    ImGui::PopStyleVar(2);
}

}  // namespace mobbscope::app
