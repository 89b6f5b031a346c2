#include <app/document/described.h>
#include <app/ui/command_menu.h>
#include <app/viewport/viewport.h>
#include <scene/view_options.h>

#include <optional>
#include <string>
#include <vector>

namespace mobbscope::app {

namespace {

/// "A 2.3 alone \u00D7"; empty: all nodes are drawn.
std::string part_alone(const Workspace& workspace) {
    const std::optional<DrawnNode>& part = workspace.view().subtree;
    if (!part || workspace.view().query) return "";
    return describe(workspace, {Selection::Kind::node, {part->agent, -1, 0}, part->node}).name + " alone \u00D7";
}

}  // namespace

void viewport_toolbar(Ui& ui) {
    const std::string alone = part_alone(ui.workspace);
    std::vector<ToolButton> buttons;
    if (!alone.empty()) buttons.insert(buttons.end(), {{alone.c_str(), "node.show_all"}, {nullptr, ""}});
    buttons.insert(buttons.end(), {{"Iso", "view.iso"},
                                   {"Top", "view.top"},
                                   {"Front", "view.front"},
                                   {"Side", "view.side"},
                                   {nullptr, ""},
                                   {"Frame", "view.frame"},
                                   {"Perspective", "view.perspective"},
                                   {nullptr, ""}});
    for (const ViewOption& option : view_options())
        if (option.at_hand) buttons.push_back({option.title.data(), option.command});
    buttons.insert(buttons.end(), {{nullptr, ""}, {"Moment", "view.moment"}, {"Plan", "view.plan"}});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ui.px(2), ui.px(4)});
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ui.px(5), ui.px(3)});
    ImGui::SetCursorPos({ui.px(6), ui.px(4)});
    tool_row(ui, buttons);
    ImGui::PopStyleVar(2);
}

}  // namespace mobbscope::app
