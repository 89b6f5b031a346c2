#include <app/commands/command.h>
#include <app/panels/panels.h>
#include <app/ui/thing_menus.h>
#include <app/ui/widgets.h>
#include <base/text.h>
#include <render/pictures/candidates.h>
#include <scene/crowd_run.h>
#include <scene/motion_graph.h>

#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::app {

namespace {

constexpr int kMostCandidateRows = 9;
using Column = CandidateList::Column;
using Which = CandidateList::Which;

/// The line that the picture draws it with.
void fate_line(Ui& ui, ImVec2 corner, CandidateOutcome outcome) {
    const LineStyle style = outcome_style_of(outcome, ui.style.palette);
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const float y = corner.y + 0.5f * ImGui::GetFrameHeight();
    const float end = corner.x + ui.px(26);
    float x = corner.x + ui.px(6);
    const bool solid = style.dash == kSolid;
    for (bool on = true; x < end; on = !on) {
        const float length = solid ? end - x : ui.px(0.7f * (on ? style.dash.x : style.dash.y));
        const float to = std::min(x + length, end);
        if (on) draw.AddLine({x, y}, {to, y}, to_im(style.color), ui.px(std::max(style.width, 1.5f)));
        x = to;
    }
}

/// "turn_left, 45": the move's name, and how far it was turned for.
std::string move_name(const Workspace& workspace, const Candidate& candidate) {
    const GraphMove& move = workspace.scene().graph->moves[static_cast<std::size_t>(candidate.move)];
    std::string name = workspace.scene().clips[static_cast<std::size_t>(move.clip)].name;
    if (candidate.turn_deg == 0) return name;
    return name + formatted(", %+.0f\u00B0", candidate.turn_deg);
}

std::string remark_of(const Workspace& workspace, const Choice& choice, std::size_t index) {
    const Candidate& candidate = choice.candidates[index];
    const CandidateOutcome outcome = outcome_of(choice, index);
    if (outcome == CandidateOutcome::leaves_floor) return "off floor";
    if (outcome != CandidateOutcome::ruled_out) return std::string(outcome_words(outcome));
    const std::string& other = workspace.crowd()->agents[static_cast<std::size_t>(candidate.blocker->agent)].name;
    return cleaned(other) + (candidate.blocker->planned > 0 ? "'s plan" : "") +
           formatted(" at %.2f s", candidate.blocker->contact.time);
}

/// What a row says and is ordered by.
struct ListedCandidate {
    std::size_t index = 0;  ///< in the choice
    std::string name;
    std::string remark;
    CandidateOutcome outcome = CandidateOutcome::free;
    double contact = std::numeric_limits<double>::infinity();  ///< seconds; of one that meets nobody never
};

bool has_text(const ListedCandidate& candidate, const std::string& text) {
    return lower(candidate.name + ' ' + candidate.remark).find(lower(text)) != std::string::npos;
}

/// What was taken first, then why the others were not.
int rank_of(CandidateOutcome outcome) {
    constexpr std::array<int, 6> kRanks{0, 2, 3, 4, 5, 1};
    return kRanks[static_cast<std::size_t>(outcome)];
}

/// Those that the list shows, in its order; candidates that are equal in it stay as they were asked.
std::vector<ListedCandidate> listed_candidates(const CrowdInspector& crowds, const Workspace& workspace,
                                               const Choice& choice) {
    const CandidateList& list = crowds.list;
    std::vector<ListedCandidate> out;
    for (const std::size_t index : shown_candidates(choice)) {
        const Candidate& candidate = choice.candidates[index];
        const bool is_free = candidate.is_free() && outcome_of(choice, index) != CandidateOutcome::no_way_on;
        if (list.which != Which::all && is_free != (list.which == Which::free)) continue;
        ListedCandidate row{index, move_name(workspace, candidate), remark_of(workspace, choice, index),
                            outcome_of(choice, index)};
        if (candidate.blocker) row.contact = candidate.blocker->contact.time;
        if (has_text(row, list.text)) out.push_back(std::move(row));
    }
    const auto before = [&](const ListedCandidate& a, const ListedCandidate& b) {
        switch (list.by) {
            case Column::outcome:
                return rank_of(a.outcome) < rank_of(b.outcome);
            case Column::clip:
                return a.name < b.name;
            case Column::reason:
                return a.remark < b.remark;
            case Column::contact:
                return a.contact < b.contact;
        }
        return false;
    };
    std::ranges::stable_sort(
        out, [&](const auto& a, const auto& b) { return list.descending ? before(b, a) : before(a, b); });
    return out;
}

/// A small button that is lit while it is what is now.
void choice_button(Ui& ui, const std::string& label, const char* id, const std::string& argument, bool on) {
    flow(button_width(label.c_str()));
    ImGui::PushStyleColor(ImGuiCol_Text, on ? ui.style.text : ui.style.quiet);
    ImGui::PushStyleColor(ImGuiCol_Button, on ? ui.style.raised : IM_COL32_BLACK_TRANS);
    if (small_button(ui, label.c_str(), id + ('.' + argument))) ui.invoke(id, argument);
    ImGui::PopStyleColor(2);
}

/// The text to look for, which of them, and the order.
void list_head(Ui& ui, CrowdInspector& crowds) {
    CandidateList& list = crowds.list;
    ImGui::SetNextItemWidth(-1);
    ImGui::InputTextWithHint("##filter", "Filter", &list.text);
    ui.mark("candidates.filter");
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ui.px(2), ui.px(3)});
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ui.px(6), 0});
    const auto line = [&](const char* label, const char* id, const auto& down) {
        const Command& command = command_named(id);
        text_line(ui.style.quiet, label);
        for (const std::string& choice : command.choices(ui.session)) {
            const bool on = command.chosen(ui.session, choice);
            choice_button(ui, choice + (on ? down : ""), id, choice, on);
        }
    };
    line("show", "crowd.list_candidates", "");
    line("by", "crowd.sort_candidates", list.descending ? " \u2193" : " \u2191");
    ImGui::PopStyleVar(2);
}

void candidate_row(Ui& ui, CrowdInspector& crowds, const Choice& choice, const ListedCandidate& candidate,
                   const NameList& names) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const Rgba color = outcome_style_of(candidate.outcome, ui.style.palette).color;
    const std::string index = std::to_string(candidate.index);
    const bool pointed_out = crowds.candidate() == static_cast<int>(candidate.index);
    if (row(ui, {.mark = "candidate." + index,
                 .name = candidate.name,
                 .remark = candidate.remark,
                 .selected = pointed_out,
                 .indent = ui.px(26),
                 .remark_color = to_im(readable(color, ui.style.palette)),
                 .fitted = [&](float room) { return fitted_name(candidate.name, room, names); }})) {
        ui.invoke("crowd.candidate", index);
    }
    context_menu(ui, [&] { return candidate_menu(crowds, ui.workspace, static_cast<int>(candidate.index)); });
    fate_line(ui, corner, candidate.outcome);
    if (!ImGui::IsItemHovered()) return;
    ImGui::SetTooltip("%s", candidate_sentence(ui.workspace.scene(), choice, candidate.index).c_str());
    if (candidate.outcome == CandidateOutcome::ruled_out && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
        ui.invoke("crowd.open_candidate", index);
    }
}

}  // namespace

void last_choice(Ui& ui, CrowdInspector& crowds) {
    const FollowedChoice* followed = crowds.choice();
    if (!followed) {
        if (!ui.workspace.view().follow.empty()) words(ui.style.quiet, "No choice yet at this time.");
        return;
    }
    const Choice& choice = followed->choice;
    if (!section(ui, "LAST CHOICE", formatted("%.2f s", choice.time))) return;
    if (!followed->comes_out) {
        words(ui.style.warning, "! " + edited_run_warning(ui.workspace.scene(), *followed));
        ui.mark_only("choice.edited");
    }
    words(ui.style.text, choice_sentence(ui.workspace.scene(), *followed));
    list_head(ui, crowds);
    const std::vector<ListedCandidate> all = listed_candidates(crowds, ui.workspace, choice);
    if (all.empty()) words(ui.style.quiet, "No candidate matches.");
    const NameList names(all.size(), [&](std::size_t i) { return all[i].name; });
    const int pointed_out = crowds.candidate();
    rows(ui, "##candidates", static_cast<int>(all.size()), kMostCandidateRows,
         present_row(all, [&](const ListedCandidate& of) { return static_cast<int>(of.index) == pointed_out; }),
         [&](int i) { candidate_row(ui, crowds, choice, all[static_cast<std::size_t>(i)], names); });
    const bool opens = pointed_out >= 0 && choice.candidates[static_cast<std::size_t>(pointed_out)].blocker;
    ImGui::BeginDisabled(!opens);
    command_button(ui, "open as a scene", "crowd.open_candidate", "crowd.open_candidate");
    ImGui::EndDisabled();
}

}  // namespace mobbscope::app
