#include <app/commands/command.h>
#include <app/panels/panels.h>
#include <app/ui/dialog_frame.h>
#include <app/ui/widgets.h>
#include <base/sentences.h>

#include <string>

namespace mobbscope::app {

namespace {

/// "Moving A"; of the oldest state how it began.
std::string name_of_state(const History& history, std::size_t state) {
    const std::string title = history.title(state);
    return title.empty() ? "As it was opened" : as_sentence(title);
}

void state_row(Ui& ui, std::size_t state) {
    const History& history = ui.workspace.history;
    const std::size_t now = history.place();
    const std::string remark = state == now ? "now" : state < now ? "undo to here" : "redo to here";
    if (row(ui, {"history." + std::to_string(state), name_of_state(history, state), remark, state == now})) {
        ui.invoke("edit.go_to", std::to_string(state));
    }
}

}  // namespace

void history_list(Ui& ui) {
    begin_dialog(ui, "history", {420, 440});
    dialog_title(ui, "History");
    words(ui.style.quiet, "A click, Up or Down goes there; what comes later stays until something else is done.");
    const History& history = ui.workspace.history;
    const int count = static_cast<int>(history.count());
    int now = static_cast<int>(history.place());
    const bool moved = move_picked(now, count);
    if (moved) ui.invoke("edit.go_to", std::to_string(now));
    const float height = ImGui::GetFrameHeight();
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ui.px(8), 0});
    ImGui::BeginChild("states", {0, ImGui::GetContentRegionAvail().y - height - ui.px(12)});
    // What is now is in sight.
    if (ImGui::IsWindowAppearing() || moved) {
        ImGui::SetScrollY(static_cast<float>(now) * height - 0.5f * (ImGui::GetWindowHeight() - height));
    }
    ImGuiListClipper clipper;
    clipper.Begin(count, height);
    while (clipper.Step()) {
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) state_row(ui, static_cast<std::size_t>(i));
    }
    ImGui::EndChild();
    ImGui::PopStyleVar();
    ImGui::Dummy({0, ui.px(2)});
    close_button(ui, "history.close");
    end_dialog();
}

}  // namespace mobbscope::app
