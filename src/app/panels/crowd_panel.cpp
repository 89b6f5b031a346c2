#include <app/commands/command.h>
#include <app/document/agents.h>
#include <app/panels/panels.h>
#include <app/ui/thing_menus.h>
#include <app/ui/widgets.h>
#include <base/text.h>
#include <scene/crowd_run.h>
#include <scene/crowd_scene.h>
#include <scene/motion_graph.h>

namespace mobbscope::app {

namespace {

constexpr int kMostCrowdRows = 9;

std::string at_time(double time) { return formatted("%.2f s", time); }

/// Who is followed, and the way to change that.
void following(Ui& ui) {
    const Session& session = ui.session;
    const std::string& followed = session.workspace.view().follow;
    const std::string who = current_agent(session.workspace);
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

void plays(Ui& ui) {
    Session& session = ui.session;
    const auto run_agent = current_run_agent(session.workspace);
    if (!run_agent) return;
    const CrowdAgent& agent = session.workspace.crowd()->agents[static_cast<std::size_t>(*run_agent)];
    const std::size_t now = play_at(agent, run_time(session.workspace.scene(), session.workspace.view()));
    if (!section(ui, "PLAYS", cleaned(agent.name) + ", " + std::to_string(agent.plays.size()) + " plays")) return;
    rows(ui, "##plays", static_cast<int>(agent.plays.size()), kMostCrowdRows, [&](int i) {
        const Play& play = agent.plays[static_cast<std::size_t>(i)];
        const GraphMove& move = session.workspace.scene().graph->moves[static_cast<std::size_t>(play.move)];
        const char* kind = play.kind == PlayKind::pivoted  ? "pivoted  "
                           : play.kind == PlayKind::forced ? "forced  "
                                                           : "";
        const Palette& palette = ui.style.palette;
        const ImU32 color = play.kind == PlayKind::forced    ? to_im(readable(palette.hit, palette))
                            : play.kind == PlayKind::pivoted ? to_im(readable(palette.overlap, palette))
                                                             : 0;
        if (row(ui,
                {"play." + std::to_string(i), session.workspace.scene().clips[static_cast<std::size_t>(move.clip)].name,
                 kind + at_time(play.placement.start), static_cast<std::size_t>(i) == now, false, 0, color})) {
            invoke(session, "crowd.play", std::to_string(i));
        }
        context_menu(ui, [&] { return play_menu(i); });
    });
}

/// When and how deep two overlap, and what a double click does.
std::string conflict_words(const Workspace& workspace, const SceneConflict& conflict) {
    const auto& worst = conflict.facts.worst();
    std::string text =
        formatted("%.3f m deep, from %.2f to %.2f s", -conflict.facts.deepest.least_clearance, worst.t0, worst.t1);
    if (const std::size_t others = conflict.facts.intervals.size() - 1; others > 0)
        text += "; they meet " + (others == 1 ? "once" : counted(others, "time", "times")) + " more";
    return text + ".\nDouble-click goes to " +
           (workspace.crowd() ? "the forced choice that made it" : "just before it");
}

void conflicts(Ui& ui) {
    Session& session = ui.session;
    const std::vector<SceneConflict>* found = session.crowds.conflicts();
    if (!section(ui, "CONFLICTS", found ? std::to_string(found->size()) : "")) return;
    if (!found) {
        command_button(ui, "find conflicts", "conflicts.find", "conflicts.find");
        return;
    }
    if (found->empty()) {
        words(to_im(readable(ui.style.palette.separated, ui.style.palette)), "Nobody collides with anybody.");
        return;
    }
    words(ui.style.quiet, session.crowds.conflict_summary() + ", the deepest first");
    rows(ui, "##conflicts", static_cast<int>(found->size()), kMostCrowdRows, [&](int i) {
        const SceneConflict& conflict = (*found)[static_cast<std::size_t>(i)];
        if (row(ui,
                {"conflict." + std::to_string(i), conflict.a.name + " and " + conflict.b.name,
                 formatted("%.2f s  %.2f m", conflict.begin(), -conflict.facts.deepest.least_clearance),
                 session.workspace.conflict == i, false, 0, to_im(readable(ui.style.palette.hit, ui.style.palette))})) {
            session.workspace.conflict = i;
        }
        context_menu(ui, [&] { return conflict_menu(i); });
        if (!ImGui::IsItemHovered()) return;
        ImGui::SetTooltip("%s", conflict_words(session.workspace, conflict).c_str());
        if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) invoke(session, "conflicts.go", std::to_string(i));
    });
    ImGui::BeginDisabled(session.workspace.conflict < 0);
    command_button(ui, "open as a scene", "conflicts.open", "conflicts.open");
    ImGui::EndDisabled();
    flow(button_width("next"));
    command_button(ui, "next", "conflicts.next", "conflicts.next");
}

}  // namespace

void crowd_panel(Ui& ui) {
    const Session& session = ui.session;
    if (section(ui, "CROWD", std::to_string(people_in(session.workspace)) + " agents")) {
        if (session.workspace.crowd()) {
            words(ui.style.quiet, formatted("%.2f of %.4g s on %.4g x %.4g m",
                                            run_time(session.workspace.scene(), session.workspace.view()),
                                            session.workspace.crowd()->seconds, session.workspace.crowd()->area.x,
                                            session.workspace.crowd()->area.y));
        }
        following(ui);
    }
    if (session.workspace.crowd()) last_choice(ui);
    if (session.workspace.crowd()) plays(ui);
    conflicts(ui);
}

}  // namespace mobbscope::app
