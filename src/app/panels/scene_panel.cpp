#include <app/commands/command.h>
#include <app/panels/panels.h>
#include <app/ui/widgets.h>
#include <app/viewport/selection_display.h>
#include <base/text.h>
#include <render/drawlist/palette.h>

namespace mobbscope::app {

namespace {

constexpr int kMostSceneRows = 9;

void agent_menu(Ui& ui, const Selection& self) {
    if (!ImGui::BeginPopupContextItem()) return;
    ui.session.select(self);
    for (const char* id : {"view.frame", "crowd.follow", "agent.duplicate", "agent.remove"}) {
        const Command& command = *find_command(id);
        if (command.id.starts_with("crowd.") ? !ui.session.is_crowd()
                                             : command.id.starts_with("agent.") && ui.session.crowd())
            continue;
        const std::string title(command.title);
        const std::string shortcut(first_shortcut(command));
        const bool chosen = ImGui::MenuItem(title.c_str(), shortcut.c_str(), false, command.enabled(ui.session));
        ui.mark(std::string("agent.menu.") + id, OwnKeys::none, title);
        if (chosen) invoke(ui.session, id);
    }
    ImGui::EndPopup();
}

/// What stands beside an agent: how long its clip is; of a run which move it plays.
std::string clip_remark(const Session& session, const SceneClip& clip) {
    return session.crowd() ? fitted_text(clip.name, 90) : formatted("%.1f s", clip.clip->duration());
}

/// One of what is seen: an agent, or in a scene without agents a clip where it is.
void path_row(Ui& ui, const FittedScene& fitted, int index) {
    Session& session = ui.session;
    const PlacedAgent& who = fitted.placed_agents()[static_cast<std::size_t>(index)];
    const Selection self{Selection::Kind::path, {index, -1, 0}, -1};
    const auto on_it = [&](const Selection& s) { return s.on_path() && s.path == self.path; };
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const SceneClip& clip = fitted.scene().clips[static_cast<std::size_t>(who.clip)];
    const bool clicked = row(ui, {"agent." + std::to_string(index), who.name, clip_remark(session, clip),
                                  on_it(session.selection), on_it(session.hovered), ui.px(18), 0});
    agent_menu(ui, self);
    const float side = ui.px(10);
    const float y = corner.y + 0.5f * (ImGui::GetFrameHeight() - side);
    ImGui::GetWindowDrawList()->AddRectFilled({corner.x + ui.px(7), y}, {corner.x + ui.px(7) + side, y + side},
                                              to_im(agent_color(fitted.scene(), who, index)), ui.px(2));
    if (ImGui::IsItemHovered()) session.hovered = self;
    if (clicked) session.select(self);
    if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) invoke(session, "view.frame");
}

void agents(Ui& ui) {
    Session& session = ui.session;
    const FittedScene& fitted = session.fitted();
    const bool has_agents = !fitted.scene().agents.empty();
    // Of a run its people; what they play before and after now is theirs.
    const auto count =
        static_cast<int>(session.crowd() ? session.crowd()->agents.size() : fitted.placed_agents().size());
    heading(ui, has_agents ? "AGENTS" : "CLIPS WHERE THEY ARE", std::to_string(count));
    rows(ui, "##agents", count, kMostSceneRows, [&](int i) { path_row(ui, fitted, i); });
    if (session.crowd()) return;
    if (small_button(ui, "+ agent", "scene.add_agent", "Add an agent that plays one of the clips")) {
        ImGui::OpenPopup("add agent");
    }
    if (ImGui::BeginPopup("add agent")) {
        for (const SceneClip& clip : fitted.scene().clips) {
            ImGui::PushID(&clip);  // names may look alike to ImGui
            if (ImGui::MenuItem(clip.name.c_str())) invoke(session, "agent.add", clip.name);
            ImGui::PopID();
            ui.mark("scene.add_agent." + clip.name, OwnKeys::none, clip.name);
        }
        ImGui::EndPopup();
    }
}

void clips(Ui& ui) {
    Session& session = ui.session;
    const auto& all = session.scene().clips;
    heading(ui, "CLIPS", std::to_string(all.size()));
    rows(ui, "##clips", static_cast<int>(all.size()), kMostSceneRows, [&](int i) {
        const SceneClip& clip = all[static_cast<std::size_t>(i)];
        const Selection self{Selection::Kind::clip, {}, i};
        const bool warned = !clip.facts.warnings.empty();
        if (row(ui, {"clip." + std::to_string(i), clip.name,
                     (warned ? "! " : "") + formatted("%.1f s", clip.clip->duration()), session.selection == self,
                     session.hovered == self, 0, warned ? ui.style.warning : 0})) {
            session.select(self);
        }
        if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left) &&
            find_command("clip.import")->enabled(session)) {
            invoke(session, "clip.import", clip.name);
        }
        if (ImGui::IsItemHovered() && warned) ImGui::SetTooltip("%s", clip.facts.warnings.front().text.c_str());
    });
    if (session.crowd()) return;
    if (small_button(ui, "+ files", "scene.add_files", "Add clips, or the clips and agents of another scene")) {
        invoke(session, "file.add");
    }
}

void queries(Ui& ui) {
    Session& session = ui.session;
    const auto count = static_cast<int>(session.fitted().queries().size());
    heading(ui, session.scene().queries.empty() && count > 0 ? "QUERIES (ALL PAIRS)" : "QUERIES",
            std::to_string(count));
    rows(ui, "##queries", count, kMostSceneRows, [&](int i) {
        const SceneQuery query = session.fitted().queries()[static_cast<std::size_t>(i)];
        const Answer& answer = session.answer_of(static_cast<std::size_t>(i));
        const bool hit = answer.contact.has_value();
        const bool unexpected = query.expect && query.expect->collides != hit;
        const Palette& palette = ui.style.palette;
        if (row(ui, {"query." + std::to_string(i), query.a.name + " against " + query.b.name,
                     std::string(unexpected ? "! " : "") + (hit ? "hit" : "miss"), session.view().query == i, false, 0,
                     to_im(readable(hit ? palette.hit : palette.separated, palette))})) {
            invoke(session, session.view().query == i ? "query.none" : "query.select",
                   session.view().query == i ? "" : std::to_string(i));
        }
        if (unexpected && ImGui::IsItemHovered()) ImGui::SetTooltip("The scene expects the other answer");
    });
    if (count == 0)
        words(ui.style.quiet,
              session.scene().agents.empty() ? "agents are asked, bare clips are not" : "needs two agents");
}

}  // namespace

void scene_panel(Ui& ui) {
    if (ui.session.empty()) {
        words(ui.style.quiet, "Nothing is open");
        return;
    }
    agents(ui);
    if (!ui.session.crowd()) placement_panel(ui);
    clips(ui);
    // A run is asked for its conflicts.
    if (!ui.session.crowd()) queries(ui);
}

void selection_panel(Ui& ui) {
    const Session& session = ui.session;
    if (session.empty()) return;
    heading(ui, "SELECTION");
    if (session.selection.kind == Selection::Kind::none || session.selection.kind == Selection::Kind::query) {
        words(ui.style.quiet,
              "Click a disk, a box or a name; click again for what lies behind.\n\nDrag to turn the view, Shift-drag "
              "to move it, "
              "roll the wheel to zoom. F1 says what can be done.");
        return;
    }
    const Described what = describe(session.fitted(), session.selection);
    ImGui::TextWrapped("%s", what.name.c_str());
    for (const auto& [key, value] : what.facts) {
        form_label(ui, key.c_str(), nullptr);
        ImGui::PushFont(ui.style.mono);
        ImGui::TextWrapped("%s", value.c_str());
        ImGui::PopFont();
    }
}

}  // namespace mobbscope::app
