#include <app/ui/command_menu.h>
#include <app/viewport/viewport.h>
#include <scene/view_options.h>

#include <vector>

namespace mobbscope::app {

void viewport_toolbar(Ui& ui) {
    std::vector<ToolButton> buttons{{"Iso", "view.iso"},
                                    {"Top", "view.top"},
                                    {"Front", "view.front"},
                                    {"Side", "view.side"},
                                    {nullptr, ""},
                                    {"Frame", "view.frame"},
                                    {"Perspective", "view.perspective"},
                                    {nullptr, ""}};
    for (const ViewOption& option : view_options())
        if (option.at_hand) buttons.push_back({option.title.data(), option.command});
    buttons.insert(buttons.end(), {{nullptr, ""}, {"Moment", "view.moment"}, {"Plan", "view.plan"}});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ui.px(2), ui.px(4)});
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ui.px(6), ui.px(3)});
    ImGui::SetCursorPos({ui.px(6), ui.px(4)});
    tool_row(ui, buttons);
    ImGui::PopStyleVar(2);
}

}  // namespace mobbscope::app
