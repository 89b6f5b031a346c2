#include <app/commands/command.h>
#include <app/document/agents.h>
#include <app/panels/panels.h>
#include <app/ui/widgets.h>
#include <base/text.h>
#include <render/pictures/candidates.h>
#include <scene/crowd_run.h>
#include <scene/crowd_scene.h>
#include <scene/motion_graph.h>

#include <algorithm>
#include <array>

namespace mobbscope::app {

namespace {

constexpr int kMostCrowdRows = 9;

std::string at_time(double time) { return formatted("%.2f s", time); }

/// Who is followed, and the way to change that.
void following(Ui& ui) {
    const Session& session = ui.session;
    const std::string& followed = session.view().follow;
    const std::string who = current_agent(session);
    if (who.empty()) {
        words(ui.style.quiet, "Click somebody to follow them.");
        return;
    }
    if (!followed.empty()) {
        words(ui.style.text, "Following " + followed);
        ImGui::SameLine();
        command_button(ui, "stop", "crowd.stop", "crowd.stop");
    }
    if (who == followed) return;
    command_button(ui, ("follow " + fitted_text(who, ui.px(120))).c_str(), "crowd.follow", "crowd.follow");
}

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
std::string move_name(const Session& session, const Candidate& candidate) {
    const GraphMove& move = session.scene().graph->moves[static_cast<std::size_t>(candidate.move)];
    std::string name = session.scene().clips[static_cast<std::size_t>(move.clip)].name;
    if (candidate.turn_deg == 0) return name;
    return name + formatted(", %+.0f\u00B0", candidate.turn_deg);
}

std::string remark_of(const Session& session, const Choice& choice, std::size_t index) {
    const Candidate& candidate = choice.candidates[index];
    const CandidateOutcome outcome = outcome_of(choice, index);
    if (outcome == CandidateOutcome::leaves_floor) return "off floor";
    if (outcome != CandidateOutcome::ruled_out) return std::string(outcome_words(outcome));
    const std::string& other = session.crowd()->agents[static_cast<std::size_t>(candidate.blocker->agent)].name;
    return "meets " + fitted_text(other, 60) + ' ' + at_time(candidate.blocker->contact.time);
}

void last_choice_list(Ui& ui) {
    Session& session = ui.session;
    const FollowedChoice* followed = session.choice();
    if (!followed) {
        if (!session.view().follow.empty()) words(ui.style.quiet, "No choice yet at this time.");
        return;
    }
    const Choice& choice = followed->choice;
    heading(ui, "LAST CHOICE", at_time(choice.time));
    words(ui.style.text, choice_sentence(session.scene(), *followed));
    std::vector<std::size_t> shown = shown_candidates(choice);
    // What was taken first, then why the others were not.
    std::stable_sort(shown.begin(), shown.end(), [&](std::size_t a, std::size_t b) {
        const auto rank = [&](std::size_t i) {
            constexpr std::array<int, 5> kRanks{0, 2, 3, 4, 1};
            return kRanks[static_cast<std::size_t>(outcome_of(choice, i))];
        };
        return rank(a) < rank(b);
    });
    rows(ui, "##candidates", static_cast<int>(shown.size()), kMostCrowdRows, [&](int i) {
        const std::size_t index = shown[static_cast<std::size_t>(i)];
        const ImVec2 corner = ImGui::GetCursorScreenPos();
        const CandidateOutcome outcome = outcome_of(choice, index);
        const Rgba color = outcome_style_of(outcome, ui.style.palette).color;
        const bool pointed_out = session.candidate == static_cast<int>(index);
        if (row(ui, {"candidate." + std::to_string(index), move_name(session, choice.candidates[index]),
                     remark_of(session, choice, index), pointed_out, false, ui.px(26),
                     to_im(readable(color, ui.style.palette))})) {
            invoke(session, "crowd.candidate", std::to_string(index));
        }
        fate_line(ui, corner, outcome);
        if (!ImGui::IsItemHovered()) return;
        ImGui::SetTooltip("%s", candidate_sentence(session.scene(), choice, index).c_str());
        if (outcome == CandidateOutcome::ruled_out && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
            invoke(session, "crowd.open_candidate", std::to_string(index));
        }
    });
    const bool opens = session.candidate >= 0 &&
                       static_cast<std::size_t>(session.candidate) < choice.candidates.size() &&
                       choice.candidates[static_cast<std::size_t>(session.candidate)].blocker;
    ImGui::BeginDisabled(!opens);
    command_button(ui, "open as a scene", "crowd.open_candidate", "crowd.open_candidate");
    ImGui::EndDisabled();
}

void plays(Ui& ui) {
    Session& session = ui.session;
    const auto run_agent = current_run_agent(session);
    if (!run_agent) return;
    const CrowdAgent& agent = session.crowd()->agents[static_cast<std::size_t>(*run_agent)];
    const std::size_t now = play_at(agent, run_time(session.scene(), session.view()));
    heading(ui, ("PLAYS OF " + agent.name).c_str(), std::to_string(agent.plays.size()));
    rows(ui, "##plays", static_cast<int>(agent.plays.size()), kMostCrowdRows, [&](int i) {
        const Play& play = agent.plays[static_cast<std::size_t>(i)];
        const GraphMove& move = session.scene().graph->moves[static_cast<std::size_t>(play.move)];
        const char* kind = play.kind == PlayKind::pivoted  ? "pivoted  "
                           : play.kind == PlayKind::forced ? "forced  "
                                                           : "";
        const Palette& palette = ui.style.palette;
        const ImU32 color = play.kind == PlayKind::forced    ? to_im(readable(palette.hit, palette))
                            : play.kind == PlayKind::pivoted ? to_im(readable(palette.overlap, palette))
                                                             : 0;
        if (row(ui, {"play." + std::to_string(i), session.scene().clips[static_cast<std::size_t>(move.clip)].name,
                     kind + at_time(play.placement.start), static_cast<std::size_t>(i) == now, false, 0, color})) {
            invoke(session, "crowd.play", std::to_string(i));
        }
    });
}

void conflicts(Ui& ui) {
    Session& session = ui.session;
    const std::vector<SceneConflict>* found = session.conflicts();
    heading(ui, "CONFLICTS", found ? std::to_string(found->size()) : "");
    if (!found) {
        command_button(ui, "find conflicts", "conflicts.find", "conflicts.find");
        return;
    }
    if (found->empty()) {
        words(to_im(readable(ui.style.palette.separated, ui.style.palette)), "Nobody collides with anybody.");
        return;
    }
    rows(ui, "##conflicts", static_cast<int>(found->size()), kMostCrowdRows, [&](int i) {
        const SceneConflict& conflict = (*found)[static_cast<std::size_t>(i)];
        if (row(ui, {"conflict." + std::to_string(i), conflict.a.name + " and " + conflict.b.name,
                     formatted("%.2f s  %.2f m", conflict.begin(), -conflict.facts.least_clearance),
                     session.conflict == i, false, 0, to_im(readable(ui.style.palette.hit, ui.style.palette))})) {
            session.conflict = i;
        }
        if (!ImGui::IsItemHovered()) return;
        ImGui::SetTooltip("When they first touch, and how deep they overlap. Double-click goes to just before it");
        if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) invoke(session, "conflicts.go", std::to_string(i));
    });
    ImGui::BeginDisabled(session.conflict < 0);
    command_button(ui, "open as a scene", "conflicts.open", "conflicts.open");
    ImGui::EndDisabled();
    flow(button_width("next"));
    command_button(ui, "next", "conflicts.next", "conflicts.next");
}

}  // namespace

void crowd_panel(Ui& ui) {
    const Session& session = ui.session;
    const std::size_t people =
        session.crowd() ? session.crowd()->agents.size() : session.fitted().placed_agents().size();
    heading(ui, "CROWD", std::to_string(people) + " agents");
    if (session.crowd()) {
        words(ui.style.quiet, formatted("%.2f of %.4g s on %.4g x %.4g m", run_time(session.scene(), session.view()),
                                        session.crowd()->seconds, session.crowd()->area.x, session.crowd()->area.y));
    }
    following(ui);
    if (session.crowd()) last_choice_list(ui);
    if (session.crowd()) plays(ui);
    conflicts(ui);
}

}  // namespace mobbscope::app
