#include <app/commands/command.h>
#include <app/document/agents.h>
#include <app/panels/panels.h>
#include <app/ui/thing_menus.h>
#include <app/ui/widgets.h>
#include <base/text.h>
#include <render/pictures/candidates.h>
#include <scene/crowd_run.h>
#include <scene/crowd_scene.h>
#include <scene/motion_graph.h>

#include <algorithm>

namespace mobbscope::app {

namespace {

constexpr int kMostCrowdRows = 9;
constexpr int kMostSpecialRows = 5;

std::string at_time(double time) { return formatted("%.2f s", time); }

/// Who is followed, and the way to change that.
void following(Ui& ui) {
    const std::string& followed = ui.workspace.view().follow;
    const std::string who = current_agent(ui.workspace);
    if (who.empty()) {
        ImGui::AlignTextToFramePadding();
        text_line(ui.style.quiet, "Click an agent to follow it.");
        return;
    }
    if (!followed.empty()) {
        ImGui::AlignTextToFramePadding();
        text_line(ui.style.text, "Following " + followed);
        ImGui::SameLine();
        command_button(ui, "stop", "crowd.stop", "crowd.stop");
    }
    if (who == followed) return;
    command_button(ui, ("follow " + fitted_name(who, ui.px(120))).c_str(), "crowd.follow", "crowd.follow");
}

void plays(Ui& ui) {
    const auto run_agent = current_run_agent(ui.workspace);
    if (!run_agent) return;
    const CrowdAgent& agent = ui.workspace.crowd()->agents[static_cast<std::size_t>(*run_agent)];
    const std::size_t now = play_at(agent, run_time(ui.workspace.scene(), ui.workspace.view()));
    if (!section(ui, "PLAYS", cleaned(agent.name) + ", " + std::to_string(agent.plays.size()) + " plays")) return;
    const NameList names(ui.workspace.scene().clips.size(),
                         [&](std::size_t i) { return ui.workspace.scene().clips[i].name; });
    rows(ui, "##plays", static_cast<int>(agent.plays.size()), kMostCrowdRows, static_cast<int>(now), [&](int i) {
        const Play& play = agent.plays[static_cast<std::size_t>(i)];
        const GraphMove& move = ui.workspace.scene().graph->moves[static_cast<std::size_t>(play.move)];
        const char* kind = play.kind == PlayKind::pivoted  ? "pivoted  "
                           : play.kind == PlayKind::forced ? "forced  "
                                                           : "";
        const Palette& palette = ui.style.palette;
        const ImU32 color = play.kind == PlayKind::forced    ? to_im(readable(palette.hit, palette))
                            : play.kind == PlayKind::pivoted ? to_im(readable(palette.overlap, palette))
                                                             : 0;
        const std::string& name = ui.workspace.scene().clips[static_cast<std::size_t>(move.clip)].name;
        if (row(ui, {.mark = "play." + std::to_string(i),
                     .name = name,
                     .remark = kind + at_time(play.placement.start),
                     .selected = static_cast<std::size_t>(i) == now,
                     .remark_color = color,
                     .fitted = [&](float room) { return fitted_name(name, room, names); }})) {
            ui.invoke("crowd.play", std::to_string(i));
        }
        context_menu(ui, [&] { return play_menu(i); });
    });
}

void conflicts(Ui& ui, CrowdInspector& crowds) {
    const std::vector<SceneConflict>* found = crowds.conflicts();
    if (!section(ui, "CONFLICTS", found ? std::to_string(found->size()) : "")) return;
    if (!found) {
        command_button(ui, "find conflicts", "conflicts.find", "conflicts.find");
        return;
    }
    for (const std::string& doubt : doubts_in(ui.workspace.scene())) words(ui.style.text, "In doubt: " + doubt);
    if (found->empty()) {
        words(to_im(readable(ui.style.palette.separated, ui.style.palette)), "No two agents collide.");
        return;
    }
    words(ui.style.quiet, crowds.conflict_summary() + ", the deepest first");
    const NameList names = names_of_agents(ui.workspace.fitted());
    const int present = std::max(ui.workspace.conflict, 0);
    rows(ui, "##conflicts", static_cast<int>(found->size()), kMostCrowdRows, present, [&](int i) {
        const SceneConflict& conflict = (*found)[static_cast<std::size_t>(i)];
        const bool has_choice = ui.workspace.crowd() != nullptr;
        const bool unexplained = has_choice && !was_forced(*ui.workspace.crowd(), conflict);
        if (row(ui, {.mark = "conflict." + std::to_string(i),
                     .name = conflict.a.name + " and " + conflict.b.name,
                     .remark = (unexplained ? "! " : "") + at_time(conflict.begin()) + "  " +
                               with_unit(-conflict.facts.deepest.least_clearance, "m"),
                     .selected = ui.workspace.conflict == i,
                     .remark_color = to_im(readable(ui.style.palette.hit, ui.style.palette)),
                     .fitted = [&](float room) {
                         return fitted_pair(conflict.a.name, " and ", conflict.b.name, room, names);
                     }})) {
            const bool twice = ImGui::IsMouseReleased(0) && ImGui::GetIO().MouseClickedLastCount[0] == 2;
            if (twice && has_choice) {
                ui.invoke("conflicts.choice");
            } else {
                ui.invoke("conflicts.go", std::to_string(i));
            }
        }
        context_menu(ui, [&] { return conflict_menu(i); });
        if (!ImGui::IsItemHovered()) return;
        ImGui::SetTooltip("%s%s%s", sentence(conflict).c_str(),
                          unexplained ? ".\n! No play was forced: an answer was wrong, or the run was edited" : "",
                          has_choice ? ".\nDouble-click goes to the choice that made it" : "");
    });
    command_button(ui, "back to all", "agent.all_in_full", "conflicts.back");
    flow(button_width("open as a scene"));
    ImGui::BeginDisabled(ui.workspace.conflict < 0);
    command_button(ui, "open as a scene", "conflicts.open", "conflicts.open");
    ImGui::EndDisabled();
    flow(button_width("next"));
    command_button(ui, "next", "conflicts.next", "conflicts.next");
    if (!ui.workspace.crowd()) return;
    flow(button_width("its choice"));
    command_button(ui, "its choice", "conflicts.choice", "conflicts.choice");
}

/// A small button that sorts the list by a column.
void order_button(Ui& ui, const SpecialPlayList& order, const Command& sort, const std::string& column) {
    const bool on = sort.chosen(ui.session, column);
    const std::string label = column + (!on ? "" : order.descending ? " \u2193" : " \u2191");
    flow(button_width(label.c_str()));
    ImGui::PushStyleColor(ImGuiCol_Text, on ? ui.style.text : ui.style.quiet);
    if (small_button(ui, label.c_str(), "special." + column)) ui.invoke("crowd.sort_plays", column);
    ImGui::PopStyleColor();
}

/// Of everybody what was forced or turned, with what was not free.
void special_plays(Ui& ui, const CrowdInspector& crowds) {
    const std::vector<SpecialPlay>& all = crowds.special_plays();
    const auto forced = static_cast<std::size_t>(std::ranges::count(all, PlayKind::forced, &SpecialPlay::kind));
    const std::string counts = std::to_string(forced) + " forced, " + std::to_string(all.size() - forced) + " turned";
    if (!section(ui, "FORCED AND TURNED", counts)) return;
    if (all.empty()) return words(ui.style.quiet, "Every agent always had a free move without a turn.");
    const Command& sort = command_named("crowd.sort_plays");
    text_line(ui.style.quiet, "by");
    for (const std::string& column : sort.choices(ui.session)) order_button(ui, crowds.play_order, sort, column);
    const double now = run_time(ui.workspace.scene(), ui.workspace.view());
    const auto is_followed = [&](const SpecialPlay& play) {
        const CrowdAgent& agent = ui.workspace.crowd()->agents[static_cast<std::size_t>(play.agent)];
        return ui.workspace.view().follow == agent.name && last_chosen(agent, now) == play.play;
    };
    const int present = present_row(all, is_followed);
    rows(ui, "##special plays", static_cast<int>(all.size()), kMostSpecialRows, present, [&](int i) {
        const SpecialPlay& play = all[static_cast<std::size_t>(i)];
        const Palette& palette = ui.style.palette;
        const bool is_forced = play.kind == PlayKind::forced;
        const CrowdAgent& agent = ui.workspace.crowd()->agents[static_cast<std::size_t>(play.agent)];
        const std::string why = cleaned(agent.name) + ": " + crowds.why(play, outcome_counts);
        if (row(ui, {.mark = "special." + std::to_string(i),
                     .name = why,
                     .remark = (is_forced ? "forced  " : "turned  ") + at_time(play.time),
                     .selected = is_followed(play),
                     .remark_color = to_im(readable(is_forced ? palette.hit : palette.overlap, palette)),
                     .fitted = [&](float room) { return fitted_text(why, room); }})) {
            ui.invoke("crowd.special_play", std::to_string(i));
        }
        if (ImGui::IsItemHovered())
            ImGui::SetTooltip("%s\nchosen at %.2f s", why.c_str(),
                              agent.plays[static_cast<std::size_t>(play.play)].chosen_at);
    });
}

}  // namespace

void crowd_panel(Ui& ui, CrowdInspector& crowds) {
    if (section(ui, "CROWD", std::to_string(people_in(ui.workspace)) + " agents")) {
        if (ui.workspace.crowd()) {
            words(ui.style.quiet,
                  formatted("%.2f of %.4g s on %.4g x %.4g m", run_time(ui.workspace.scene(), ui.workspace.view()),
                            ui.workspace.crowd()->seconds, ui.workspace.crowd()->area.x, ui.workspace.crowd()->area.y));
        }
        following(ui);
    }
    // Lists of the whole crowd stay where they are while one goes from row to row.
    conflicts(ui, crowds);
    if (!ui.workspace.crowd()) return;
    special_plays(ui, crowds);
    last_choice(ui, crowds);
    plays(ui);
}

}  // namespace mobbscope::app
