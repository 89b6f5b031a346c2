#include <app/command.h>
#include <app/panels/command_button.h>

namespace mobbscope::app {

void command_button(Ui& ui, const char* label, const char* id, const std::string& mark) {
    const Command& command = *find_command(id);
    ImGui::BeginDisabled(!command.enabled(ui.session));
    ImGui::PushID(mark.c_str());  // labels may be alike
    const bool pressed = ImGui::Button(label);
    ImGui::PopID();
    ImGui::EndDisabled();
    ui.mark(mark);
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) {
        const std::string_view key = first_shortcut(command);
        ImGui::PushStyleColor(ImGuiCol_Text, ui.look.text);  // whatever the button's
        ImGui::SetTooltip("%s%s", std::string(command.doc).c_str(),
                          key.empty() ? "" : ("  (" + std::string(key) + ")").c_str());
        ImGui::PopStyleColor();
    }
    if (pressed) invoke(ui.session, id);
}

float button_width(const char* label) {
    return ImGui::CalcTextSize(label, nullptr, true).x + 2 * ImGui::GetStyle().FramePadding.x;
}

}  // namespace mobbscope::app
