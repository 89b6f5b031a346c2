#include <app/panels/dialogs.h>
#include <app/ui/dialog_frame.h>

namespace mobbscope::app {

void about(Ui& ui) {
    begin_dialog(ui, "about", {460, 200});
    dialog_title(ui, "Mobbscope " MOBBSCOPE_VERSION);
    ImGui::TextWrapped(
        "Shows bounding-volume trees in space-time, and every step of the question whether two paths collide.");
    ImGui::Dummy({0, ui.px(4)});
    ImGui::PushStyleColor(ImGuiCol_Text, ui.style.quiet);
    ImGui::TextWrapped(
        "The method is from the paper \"Detecting Collisions in Graph-Driven Motion Synthesis for Crowd Simulation\".");
    ImGui::PopStyleColor();
    ImGui::Dummy({0, ui.px(6)});
    if (marked_button(ui, "Close", "about.close", true) || pressed(ImGuiKey_Enter)) ui.session.close_dialog();
    end_dialog();
}

}  // namespace mobbscope::app
