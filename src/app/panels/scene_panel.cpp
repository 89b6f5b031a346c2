#include <app/commands/command.h>
#include <app/document/agents.h>
#include <app/document/described.h>
#include <app/document/shown_agents.h>
#include <app/panels/panels.h>
#include <app/ui/agent_parts.h>
#include <app/ui/thing_menus.h>
#include <app/ui/widgets.h>
#include <base/text.h>
#include <render/drawlist/palette.h>
#include <scene/answer.h>
#include <scene/arrangement.h>
#include <scene/crowd_run.h>

#include <imgui_stdlib.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

namespace mobbscope::app {

namespace {

constexpr int kMostSceneRows = 9;

/// Of which items the filter of the lists leaves some.
template <class NameOf>
std::vector<int> filtered(const Workspace& workspace, int count, const NameOf& name_of) {
    const std::string wanted = lower(workspace.filter);
    std::vector<int> out;
    for (int i = 0; i < count; ++i) {
        if (wanted.empty() || lower(name_of(i)).find(wanted) != std::string::npos) out.push_back(i);
    }
    return out;
}

std::string count_text(std::size_t shown, std::size_t all) {
    return shown == all ? std::to_string(all) : std::to_string(shown) + " of " + std::to_string(all);
}

void filter_field(Ui& ui) {
    const std::size_t longest = std::max(agent_count(ui.workspace), ui.workspace.scene().clips.size());
    if (longest <= static_cast<std::size_t>(kMostSceneRows) && ui.workspace.filter.empty()) return;
    ImGui::Dummy({0, ui.px(2)});
    ImGui::SetNextItemWidth(-1);
    ImGui::InputTextWithHint("##filter", "Filter the lists by name", &ui.workspace.filter);
    ui.mark("scene.filter");
}

/// The right-click menu of a row, which is selected by it.
void row_menu(Ui& ui, const Selection& self) {
    context_menu(ui, [&] {
        ui.workspace.select(self);
        return selection_menu(ui.session);
    });
}

/// Of a row that is selected by a click: arrows through the list select too, so that keys are about what has the ring.
void row_keys(Ui& ui, const Selection& self) {
    if (ui.focus.arrived_at_last()) ui.workspace.select(self);
    row_menu(ui, self);
}

/// What stands beside an agent: how long its clip is; of a run which move it plays.
std::string clip_remark(const Workspace& workspace, const SceneClip& clip) {
    return workspace.crowd() ? clip.name : formatted("%.1f s", clip.clip->duration());
}

/// A row with the buttons of its agents; `about` draws what belongs to the row itself, which is the last item then.
bool agents_row(Ui& ui, Row shown, const ListedAgents& listed, const std::function<void()>& about) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 end{corner.x + ImGui::GetContentRegionAvail().x, corner.y + ImGui::GetFrameHeight()};
    const bool lit = ImGui::IsWindowHovered() && ImGui::IsMouseHoveringRect(corner, end);
    shown.hovered = shown.hovered || lit;
    shown.quiet = shown.quiet || are_hidden(ui.workspace, listed.who);
    if (!listed.who.empty()) {
        shown.buttons = agent_buttons_width(ui);
        shown.right = lit ? shown.buttons : shown_buttons_width(ui, listed);
        if (lit) shown.remark.clear();
    }
    const std::string mark = shown.mark;
    const bool clicked = row(ui, shown);
    about();
    if (!listed.who.empty()) agent_buttons(ui, mark, listed, lit);
    return clicked;
}

/// One of what is seen: an agent, or in a scene without agents a clip where it is.
void path_row(Ui& ui, const FittedScene& fitted, int index, const NameList& names) {
    const PlacedAgent& who = fitted.placed_agents()[static_cast<std::size_t>(index)];
    const Selection self{Selection::Kind::path, {index, -1, 0}, -1};
    const auto on_it = [&](const Selection& s) { return s.on_path() && s.path == self.path; };
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const SceneClip& clip = fitted.scene().clips[static_cast<std::size_t>(who.clip)];
    const ListedAgents listed{text_of_agent(who.name), {who.name}};
    const bool hidden = are_hidden(ui.workspace, listed.who);
    const auto about = [&] {
        row_keys(ui, self);
        const float side = ui.px(10);
        const ImVec2 low{corner.x + ui.px(7), corner.y + 0.5f * (ImGui::GetFrameHeight() - side)};
        const ImVec2 high{low.x + side, low.y + side};
        const ImU32 color = to_im(agent_color(fitted.scene(), who, index));
        // Who is not in the picture has an empty square.
        if (hidden) {
            ImGui::GetWindowDrawList()->AddRect(low, high, color, ui.px(2));
        } else {
            ImGui::GetWindowDrawList()->AddRectFilled(low, high, color, ui.px(2));
        }
        if (!ImGui::IsItemHovered()) return;
        ui.hovered = self;
        if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) ui.invoke("view.frame");
    };
    const bool clicked = agents_row(ui,
                                    {.mark = "agent." + std::to_string(index),
                                     .name = who.name,
                                     .remark = clip_remark(ui.workspace, clip),
                                     .selected = on_it(ui.workspace.selection),
                                     .hovered = on_it(ui.workspace.hovered),
                                     .indent = ui.px(18),
                                     .fitted = [&](float room) { return fitted_name(who.name, room, names); }},
                                    listed, about);
    if (clicked) ui.workspace.select(self);
}

/// What the picture does not show as the scene has it, and the way back.
void shown_buttons(Ui& ui) {
    const std::size_t hidden = ui.workspace.view().hidden.size();
    if (hidden > 0) {
        const std::string label = "show " + std::to_string(hidden) + " hidden";
        // Of a run it stands there by itself.
        if (!ui.workspace.crowd()) flow(button_width(label.c_str()));
        if (small_button(ui, label.c_str(), "scene.show_all", "Show all hidden agents again  (Shift+V)")) {
            ui.invoke("agent.show_all");
        }
    }
    if (ui.workspace.crowd() || ui.workspace.fitted().placed_agents().size() < 2) return;
    const bool in_grid = ui.workspace.view().arrange == Arrange::grid;
    const char* label = in_grid ? "where they are" : "in a grid";
    flow(button_width(label));
    if (small_button(ui, label, "scene.arrange",
                     in_grid ? "Draw them where they are"
                             : "Draw them apart from one another, with names; queries are asked where they are")) {
        ui.invoke("view.arrange");
    }
    if (in_grid && ui.workspace.view().query) {
        words(ui.style.quiet, "A query is shown where the two are, not in the grid.");
    }
}

void agents(Ui& ui) {
    const FittedScene& fitted = ui.workspace.fitted();
    const bool has_agents = !fitted.scene().agents.empty();
    // Of a run its people; what they play before and after now is theirs.
    const auto count =
        static_cast<int>(ui.workspace.crowd() ? ui.workspace.crowd()->agents.size() : fitted.placed_agents().size());
    const std::vector<int> shown = filtered(ui.workspace, count, [&](int i) -> const std::string& {
        return fitted.placed_agents()[static_cast<std::size_t>(i)].name;
    });
    const NameList names = names_of_agents(fitted);
    const bool in_grid = is_in_grid(fitted.scene(), ui.workspace.view());
    const char* title = has_agents ? "AGENTS" : in_grid ? "CLIPS IN A GRID" : "CLIPS WHERE THEY ARE";
    if (!section(ui, title, count_text(shown.size(), static_cast<std::size_t>(count)))) return;
    const Selection& selection = ui.workspace.selection;
    rows(ui, "##agents", static_cast<int>(shown.size()), kMostSceneRows,
         present_row(shown, [&](int i) { return selection.on_path() && selection.path.agent == i; }),
         [&](int i) { path_row(ui, fitted, shown[static_cast<std::size_t>(i)], names); });
    if (shows_bare_clips(ui.workspace)) {
        if (small_button(ui, "make these agents", "scene.make_agents",
                         "An agent for every clip, where it is: agents can be placed and queried")) {
            ui.invoke("agent.make");
        }
    } else if (!ui.workspace.crowd()) {
        if (small_button(ui, "+ agent", "scene.add_agent", "Add an agent that plays one of the clips")) {
            ImGui::OpenPopup("add agent");
        }
        if (ImGui::BeginPopup("add agent")) {
            for (const SceneClip& clip : fitted.scene().clips) {
                ImGui::PushID(&clip);  // names may look alike to ImGui
                if (ImGui::MenuItem(clip.name.c_str())) ui.invoke("agent.add", clip.name);
                ImGui::PopID();
                ui.mark("scene.add_agent." + clip.name, OwnKeys::none, clip.name);
            }
            ImGui::EndPopup();
        }
    }
    shown_buttons(ui);
}

void clip_row(Ui& ui, int index, float indent, const NameList& names) {
    const SceneClip& clip = ui.workspace.scene().clips[static_cast<std::size_t>(index)];
    const Selection self{Selection::Kind::clip, {}, index};
    const bool warned = !clip.facts.warnings.empty();
    const ListedAgents listed{kOfClip + clip.name, agents_of_clip(ui.workspace, index)};
    const auto about = [&] {
        row_keys(ui, self);
        if (ImGui::IsItemHovered()) ui.hovered = self;
        if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left) &&
            find_command("clip.import")->enabled(ui.session)) {
            ui.invoke("clip.import", clip.name);
        }
        if (ImGui::IsItemHovered() && warned) {
            std::string all = clip.name;
            for (const ImportWarning& warning : clip.facts.warnings) all += '\n' + said(warning);
            ImGui::SetTooltip("%s", all.c_str());
        }
    };
    const bool clicked = agents_row(ui,
                                    {.mark = "clip." + std::to_string(index),
                                     .name = clip.name,
                                     .remark = (warned ? "! " : "") + formatted("%.1f s", clip.clip->duration()),
                                     .selected = ui.workspace.selection == self,
                                     .hovered = ui.workspace.hovered == self,
                                     .indent = indent,
                                     .remark_color = warned ? ui.style.warning : 0,
                                     .fitted = [&](float room) { return fitted_name(clip.name, room, names); }},
                                    listed, about);
    if (clicked) ui.workspace.select(self);
}

/// A line of the list of clips: a clip, or the heading of a group.
struct ClipLine {
    int group = -1;
    int clip = -1;
};

/// The lines that the filter leaves; a group that is folded has its heading alone.
std::vector<ClipLine> clip_lines(const Workspace& workspace, const std::vector<int>& shown) {
    const std::vector<ClipGroup>& groups = clip_groups(workspace);
    std::vector<ClipLine> out;
    if (groups.empty()) {
        for (const int clip : shown) out.push_back({-1, clip});
        return out;
    }
    for (int g = 0; g < static_cast<int>(groups.size()); ++g) {
        const ClipGroup& group = groups[static_cast<std::size_t>(g)];
        std::vector<int> in_group;
        std::ranges::set_intersection(group.clips, shown, std::back_inserter(in_group));
        if (in_group.empty()) continue;
        out.push_back({g, -1});
        if (workspace.folded_groups.contains(group.title)) continue;
        for (const int clip : in_group) out.push_back({g, clip});
    }
    return out;
}

void group_row(Ui& ui, int index) {
    const ClipGroup& group = clip_groups(ui.workspace)[static_cast<std::size_t>(index)];
    const ListedAgents listed{kOfGroup + group.title, agents_of_group(ui.workspace, group)};
    const bool folded = ui.workspace.folded_groups.contains(group.title);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const auto about = [&] {
        if (!listed.who.empty()) context_menu(ui, [&] { return shown_menu(ui.workspace, listed); });
        if (ImGui::IsItemHovered())
            ImGui::SetTooltip("%s\nClick to %s", group.title.c_str(), folded ? "unfold" : "fold");
        const float side = ui.px(3.5f);
        const ImVec2 at{corner.x + ui.px(8), corner.y + 0.5f * ImGui::GetFrameHeight()};
        ImDrawList& draw = *ImGui::GetWindowDrawList();
        if (folded) {
            draw.AddTriangleFilled({at.x - side, at.y - side}, {at.x + side, at.y}, {at.x - side, at.y + side},
                                   ui.style.quiet);
        } else {
            draw.AddTriangleFilled({at.x - side, at.y - side}, {at.x + side, at.y - side}, {at.x, at.y + side},
                                   ui.style.quiet);
        }
    };
    const bool clicked = agents_row(ui,
                                    {.mark = "group." + std::to_string(index),
                                     .name = group.title,
                                     .remark = std::to_string(group.clips.size()),
                                     .indent = ui.px(12)},
                                    listed, about);
    if (!clicked) return;
    ui.later([title = group.title](Workspace& workspace) {
        if (workspace.folded_groups.erase(title) == 0) workspace.folded_groups.insert(title);
    });
}

void clips(Ui& ui) {
    const auto& all = ui.workspace.scene().clips;
    const std::vector<int> shown =
        filtered(ui.workspace, static_cast<int>(all.size()),
                 [&](int i) -> const std::string& { return all[static_cast<std::size_t>(i)].name; });
    if (!section(ui, "CLIPS", count_text(shown.size(), all.size()))) return;
    const std::vector<ClipLine> lines = clip_lines(ui.workspace, shown);
    const NameList names(all.size(), [&](std::size_t i) { return all[i].name; });
    const int present = present_row(lines, [&](const ClipLine& line) {
        return ui.workspace.selection == Selection{Selection::Kind::clip, {}, line.clip};
    });
    rows(ui, "##clips", static_cast<int>(lines.size()), kMostSceneRows, present, [&](int i) {
        const ClipLine& line = lines[static_cast<std::size_t>(i)];
        line.clip < 0 ? group_row(ui, line.group) : clip_row(ui, line.clip, line.group < 0 ? 0 : ui.px(12), names);
    });
    if (ui.workspace.crowd()) return;
    if (small_button(ui, "+ files", "scene.add_files", "Add clips, or the clips and agents of another scene")) {
        ui.invoke("file.add");
    }
}

/// How many hit, as far as it is known, or how the tests are spread; the order is chosen here.
void query_order(Ui& ui, const CostInspector& costs, std::size_t count) {
    const SceneCosts* known = costs.costs();
    if (costs.order == CostInspector::Order::tests && known) {
        const auto at = [&](double share) { return std::to_string(tests_at(*known, share)); };
        words(ui.style.quiet, "tests: p50 " + at(0.5) + ", p95 " + at(0.95) + ", p99 " + at(0.99) + ", max " + at(1));
        if (small_button(ui, "in their order", "queries.number")) ui.invoke("query.sort", "number");
        flow(button_width("show the costliest"));
        if (small_button(ui, "show the costliest", "queries.worst")) ui.invoke("query.worst");
        return;
    }
    if (costs.lists_hits_first()) {
        const QueryAnswers::Known& found = *ui.session.answers.known();
        const bool all = found.asked == count;
        words(ui.style.quiet, std::to_string(found.hits.size()) + " hit" +
                                  (all ? "" : " of the " + std::to_string(found.asked) + " asked so far") +
                                  ", listed first");
        ui.mark_only("queries.hits_known");
        if (small_button(ui, "in their order", "queries.number")) ui.invoke("query.sort", "number");
        flow(button_width("sort by tests"));
    } else if (count > std::size_t{kFewQueries}) {
        if (small_button(ui, "hits first", "queries.hits")) ui.invoke("query.sort", "hits");
        flow(button_width("sort by tests"));
    }
    if (small_button(ui, "sort by tests", "queries.tests", "The costliest first, and how the tests are spread")) {
        ui.invoke("query.sort", "tests");
    }
}

void query_list(Ui& ui, QueryInspector& queries, const CostInspector& costs) {
    const auto count = static_cast<int>(ui.workspace.fitted().queries().size());
    const bool all_pairs = ui.workspace.scene().queries.empty() && count > 1;
    if (!section(ui, "QUERIES", (all_pairs ? "all pairs, " : "") + std::to_string(count))) return;
    const NameList names = names_of_agents(ui.workspace.fitted());
    if (costs.lists_hits_first()) ui.session.answers.update();
    const std::vector<int>& listed = costs.listed();
    const bool by_tests = costs.order == CostInspector::Order::tests && costs.costs();
    const int present = present_row(listed, [&](int i) { return ui.workspace.view().query == i; });
    rows(ui, "##queries", count, kMostSceneRows, present, [&](int place) {
        const int i = listed[static_cast<std::size_t>(place)];
        const SceneQuery query = ui.workspace.fitted().queries()[static_cast<std::size_t>(i)];
        const Answer& answer = queries.answer_of(static_cast<std::size_t>(i));
        const Selection self{Selection::Kind::query, {}, i};
        const bool hit = answer.contact.has_value();
        std::optional<std::string> unexpected = disagreement(query, answer);
        if (const std::string* stored = ui.workspace.stored_difference(i); stored && !unexpected) unexpected = *stored;
        const Palette& palette = ui.style.palette;
        const std::string found = by_tests ? counted(costs.costs()->tests[static_cast<std::size_t>(i)], "test", "tests")
                                  : hit    ? formatted("hit %.2f s", answer.contact->time)
                                           : "miss";
        if (row(ui, {.mark = "query." + std::to_string(i),
                     .name = query.a.name + " against " + query.b.name,
                     .remark = (unexpected ? "! " : "") + found,
                     .selected = ui.workspace.view().query == i,
                     .hovered = ui.workspace.hovered == self,
                     .remark_color = to_im(readable(hit ? palette.hit : palette.separated, palette)),
                     .fitted = [&](float room) {
                         return fitted_pair(query.a.name, " against ", query.b.name, room, names);
                     }})) {
            ui.invoke(ui.workspace.view().query == i ? "query.none" : "query.select",
                      ui.workspace.view().query == i ? "" : std::to_string(i));
        }
        row_menu(ui, self);
        if (!ImGui::IsItemHovered()) return;
        ui.hovered = self;
        ImGui::SetTooltip("%s%s", sentence(query, answer.contact).c_str(),
                          unexpected ? ("\nNot as the file has it: " + *unexpected).c_str() : "");
    });
    if (count > 1) query_order(ui, costs, static_cast<std::size_t>(count));
    if (count == 0)
        words(ui.style.quiet, ui.workspace.scene().agents.empty() ? "queries need agents: make agents of these clips"
                                                                  : "needs two agents");
}

}  // namespace

void scene_panel(Ui& ui, QueryInspector& queries) {
    if (ui.workspace.empty()) {
        words(ui.style.quiet, "Nothing is open");
        return;
    }
    filter_field(ui);
    agents(ui);
    clips(ui);
    // A run is asked for its conflicts.
    if (!ui.workspace.crowd()) query_list(ui, queries, ui.session.costs);
}

void selection_panel(Ui& ui) {
    if (ui.workspace.empty()) return;
    if (!section(ui, "SELECTION")) return;
    if (ui.workspace.selection.kind == Selection::Kind::none || ui.workspace.selection.kind == Selection::Kind::query) {
        words(ui.style.quiet,
              "Click a disk, a box or a name; click again for what lies behind.\n\nDrag to turn the view, Shift-drag "
              "to move it, "
              "roll the wheel to zoom. F1 says what can be done.");
        return;
    }
    const Described what = describe(ui.workspace, ui.workspace.selection);
    ImGui::TextWrapped("%s", what.name.c_str());
    node_links(ui);
    for (const auto& [key, value] : what.facts) {
        form_label(ui, key.c_str(), nullptr);
        ImGui::PushFont(ui.style.mono);
        const auto exact = what.exact.find(key);
        words(ui, ui.style.text, value, exact == what.exact.end() ? std::vector<double>() : exact->second);
        ImGui::PopFont();
        ui.mark_only("selection." + key);
    }
    const bool may_count = ui.workspace.selection.kind == Selection::Kind::node && !ui.workspace.blame() &&
                           !ui.workspace.fitted().queries().empty();
    if (may_count) command_button(ui, "sum avoidable overlaps", "query.blame", "query.blame");
}

}  // namespace mobbscope::app
