#include <app/commands/command.h>
#include <app/panels/query_parts.h>
#include <app/ui/swatch.h>
#include <app/ui/thing_menus.h>
#include <app/ui/widgets.h>
#include <base/text.h>
#include <explain/query_sentence.h>
#include <explain/reasons.h>

#include <optional>
#include <string>
#include <vector>

namespace mobbscope::app {

namespace {

constexpr int kMostReasonRows = 12;

/// A pair in a list of this query: it lights up where the mouse is, and a click goes to its last test.
void pair_row(Ui& ui, QueryInspector& queries, const QueryFindings& findings, int index, const std::string& mark) {
    const RecursionPair& pair = findings.recursion.pairs[static_cast<std::size_t>(index)];
    const mobb::Trace& trace = ui.workspace.recorded()->trace;
    const mobb::Trace::Event event = trace[pair.last];
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const int hovered = ui.workspace.hovered_event;
    if (row(ui, {.mark = mark,
                 .name = node_name(findings.sides[0], pair.a) + " / " + node_name(findings.sides[1], pair.b),
                 .remark = event.outcome == mobb::Outcome::separated ? with_unit(event.gap, "m")
                                                                     : short_outcome(findings.sides, event),
                 .selected = ui.workspace.step() >= pair.first && ui.workspace.step() <= pair.last,
                 .hovered = hovered >= pair.first && hovered <= pair.last,
                 .indent = ui.px(14),
                 .remark_color = mark_text(ui.style, mark_of(event.test, event.outcome))})) {
        ui.invoke("step.to", std::to_string(pair.last));
    }
    context_menu(ui, [&] { return test_menu(ui.workspace, queries, pair.last); });
    const float side = ui.px(9);
    const ImVec2 low{corner.x + ui.px(6), corner.y + 0.5f * (ImGui::GetFrameHeight() - side)};
    outcome_cell(*ImGui::GetWindowDrawList(), ui.style, low, {low.x + side, low.y + side},
                 mark_of(event.test, event.outcome), 1);
    if (!ImGui::IsItemHovered()) return;
    ui.hovered_event = pair.last;
    const std::string ended = how_it_ended(findings.recursion, index);
    ImGui::SetTooltip("%s%s%s", step_sentence(findings.sides, trace, pair.last).c_str(), ended.empty() ? "" : "\n",
                      ended.c_str());
}

}  // namespace

void reasons(Ui& ui, QueryInspector& queries, const QueryFindings& findings) {
    const std::optional<PlaceReasons> asked = queries.reasons();
    if (!section(ui, "REASONS", asked ? asked->of : "")) return;
    if (!asked) {
        words(ui.style.quiet,
              "Click a moment on the timeline or the clearance, a point of the recursion, or a sample.");
        return;
    }
    const std::vector<int>& pairs = asked->pairs;
    const bool of_sample = ui.workspace.look.sample.has_value();
    const bool stopped = ui.workspace.recorded()->trace.stopped();
    if (pairs.empty()) {
        words(ui.style.quiet, !of_sample ? "A and B are not both present at that time."
                              : stopped  ? "No recorded test reached it."
                                         : "No test reached it.");
    }
    rows(ui, "##reasons", static_cast<int>(pairs.size()), kMostReasonRows, [&](int i) {
        pair_row(ui, queries, findings, pairs[static_cast<std::size_t>(i)], "reason." + std::to_string(i));
    });
    if (!pairs.empty() && !of_sample && !stopped &&
        findings.recursion.pairs[static_cast<std::size_t>(pairs.back())].has_children()) {
        words(ui.style.quiet, "The search ended with a hit before this moment.");
    }
    recording_note(ui, "reasons");
    query_button(ui, "clear", "reasons.none");
}

}  // namespace mobbscope::app
