#include <app/commands/command.h>
#include <app/panels/panels.h>
#include <app/panels/query_parts.h>
#include <app/ui/swatch.h>
#include <app/ui/widgets.h>

namespace mobbscope::app {

namespace {

/// Which of the queries is in view, and the ways to the others.
void query_header(Ui& ui) {
    const std::size_t count = ui.session.fitted().queries().size();
    const std::string which = std::to_string(*ui.session.view().query + 1) + " / " + std::to_string(count);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ui.px(6), ui.px(1)});
    ImGui::AlignTextToFramePadding();
    ImGui::PushStyleColor(ImGuiCol_Text, ui.style.quiet);
    ImGui::TextUnformatted(count == 1 ? "Query" : ("Query " + which).c_str());
    ImGui::PopStyleColor();
    if (count > 1) {
        flow(button_width("previous"));
        query_button(ui, "previous", "query.previous");
        flow(button_width("next"));
        query_button(ui, "next", "query.next");
    }
    flow(button_width("close"));
    query_button(ui, "close", "query.none");
    if (ui.session.in_excerpt()) {
        flow(button_width("back to the crowd"));
        command_button(ui, "back to the crowd", "crowd.back", "crowd.back");
    }
    ImGui::PopStyleVar();
}

}  // namespace

void query_button(Ui& ui, const char* label, const char* command) {
    const std::string id = command;
    command_button(ui, label, command, "query." + id.substr(id.find('.') + 1));
}

void query_panel(Ui& ui) {
    const std::shared_ptr<const QueryFindings> findings = ui.session.findings();
    if (!findings) {
        query_list(ui);
        return;
    }
    const std::shared_ptr<const FittedScene> kept = ui.session.shown();
    query_header(ui);
    if (ui.session.findings() != findings) return;  // another query, or none: drawn in the next frame
    query_answer(ui, *findings);
    if (ui.session.findings() != findings) return;
    if (!findings->recursion.pairs.empty()) {
        step_transport(ui);
        current_test(ui, *findings);
        why_axes(ui, *findings);
        measured_pairs(ui, *findings);
        query_counters(ui, *findings);
        heading(ui, "RECURSION: TIME OF A BY TIME OF B");
        recursion_square(ui, *findings);
        outcome_legend(ui);
    }
    heading(ui, "CLEARANCE OVER TIME");
    clearance_chart(ui, *findings, ui.px(110));
}

}  // namespace mobbscope::app
