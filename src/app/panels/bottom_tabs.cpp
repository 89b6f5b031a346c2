#include <app/panels/bottom_tabs.h>
#include <app/ui/widgets.h>

#include <memory>
#include <string>

namespace mobbscope::app {

namespace {

bool has_events(const Ui& ui) {
    const std::shared_ptr<const QueryFindings> findings = ui.session.queries.findings();
    return findings && !findings->recursion.pairs.empty();
}

void tab(Ui& ui, const char* label, const char* mark, BottomTab which, bool on) {
    ImGui::PushStyleColor(ImGuiCol_Text, on ? ui.style.text : ui.style.quiet);
    if (ImGui::Button(label) && !on)
        ui.invoke("bottom.show", std::string(bottom_tab_names()[static_cast<std::size_t>(which)]));
    ImGui::PopStyleColor();
    ui.mark(mark);
    const Rect at = Ui::last_rect();
    if (on) ImGui::GetWindowDrawList()->AddLine({at.min.x, at.max.y}, {at.max.x, at.max.y}, ui.style.accent, ui.px(2));
}

}  // namespace

BottomTab shown_tab(const Ui& ui) {
    const BottomTab tab = ui.session.settings.bottom_tab;
    return tab == BottomTab::events && !has_events(ui) ? BottomTab::recursion : tab;
}

bool is_high(BottomTab tab) { return tab != BottomTab::recursion; }

void bottom_tabs(Ui& ui) {
    const BottomTab shown = shown_tab(ui);
    const bool of_query = ui.workspace.recorded() != nullptr;
    const float gap = ui.px(of_query ? 12 : 6);
    ImGui::PushFont(ui.style.caption);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ui.px(2), ui.px(1)});
    ImGui::PushStyleVar(ImGuiStyleVar_FrameBorderSize, 0);
    ImGui::PushStyleColor(ImGuiCol_Button, IM_COL32_BLACK_TRANS);
    const char* const first = of_query ? "RECURSION" : "PATHS";
    tab(ui, first, of_query ? "timeline.recursion" : "timeline.paths", BottomTab::recursion,
        shown == BottomTab::recursion);
    if (of_query) {
        ImGui::SameLine(0, gap);
        tab(ui, "EVENTS", "timeline.events", BottomTab::events, shown == BottomTab::events);
    }
    ImGui::SameLine(0, gap);
    tab(ui, "NODES", "timeline.nodes", BottomTab::nodes, shown == BottomTab::nodes);
    ImGui::SameLine(0, gap);
    tab(ui, "CURVES", "timeline.curves", BottomTab::curves, shown == BottomTab::curves);
    ImGui::PopStyleColor();
    ImGui::PopStyleVar(2);
    ImGui::PopFont();
}

}  // namespace mobbscope::app
