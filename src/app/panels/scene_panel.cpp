#include <app/commands/command.h>
#include <app/document/described.h>
#include <app/panels/panels.h>
#include <app/ui/thing_menus.h>
#include <app/ui/widgets.h>
#include <base/text.h>
#include <render/drawlist/palette.h>

namespace mobbscope::app {

namespace {

constexpr int kMostSceneRows = 9;

/// The right-click menu of a row, which is selected by it.
void row_menu(Ui& ui, const Selection& self) {
    context_menu(ui, [&] {
        ui.session.select(self);
        return selection_menu(ui.session);
    });
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
    row_menu(ui, self);
    const float side = ui.px(10);
    const float y = corner.y + 0.5f * (ImGui::GetFrameHeight() - side);
    ImGui::GetWindowDrawList()->AddRectFilled({corner.x + ui.px(7), y}, {corner.x + ui.px(7) + side, y + side},
                                              to_im(agent_color(fitted.scene(), who, index)), ui.px(2));
    if (ImGui::IsItemHovered()) ui.hovered = self;
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
    if (!section(ui, has_agents ? "AGENTS" : "CLIPS WHERE THEY ARE", std::to_string(count))) return;
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
        }
        ImGui::EndPopup();
    }
}

void clips(Ui& ui) {
    Session& session = ui.session;
    const auto& all = session.scene().clips;
    if (!section(ui, "CLIPS", std::to_string(all.size()))) return;
    rows(ui, "##clips", static_cast<int>(all.size()), kMostSceneRows, [&](int i) {
        const SceneClip& clip = all[static_cast<std::size_t>(i)];
        const Selection self{Selection::Kind::clip, {}, i};
        const bool warned = !clip.facts.warnings.empty();
        if (row(ui, {"clip." + std::to_string(i), clip.name,
                     (warned ? "! " : "") + formatted("%.1f s", clip.clip->duration()), session.selection == self,
                     session.hovered == self, 0, warned ? ui.style.warning : 0})) {
            session.select(self);
        }
        row_menu(ui, self);
        if (ImGui::IsItemHovered()) ui.hovered = self;
        if (ImGui::IsItemHovered() && warned) ImGui::SetTooltip("%s", clip.facts.warnings.front().c_str());
    });
    if (session.crowd()) return;
    if (small_button(ui, "+ files", "scene.add_files", "Add clips, or the clips and agents of another scene")) {
        invoke(session, "file.add");
    }
}

void queries(Ui& ui) {
    Session& session = ui.session;
    const auto count = static_cast<int>(session.fitted().queries().size());
    const bool all_pairs = session.scene().queries.empty() && count > 1;
    if (!section(ui, "QUERIES", (all_pairs ? "all pairs, " : "") + std::to_string(count))) return;
    rows(ui, "##queries", count, kMostSceneRows, [&](int i) {
        const SceneQuery query = session.fitted().queries()[static_cast<std::size_t>(i)];
        const Answer& answer = session.answer_of(static_cast<std::size_t>(i));
        const Selection self{Selection::Kind::query, {}, i};
        const bool hit = answer.contact.has_value();
        const bool unexpected = query.expect && query.expect->collides != hit;
        const Palette& palette = ui.style.palette;
        const std::string found = hit ? formatted("hit %.2f s", answer.contact->time) : "miss";
        if (row(ui, {"query." + std::to_string(i), query.a.name + " against " + query.b.name,
                     (unexpected ? "! " : "") + found, session.view().query == i, session.hovered == self, 0,
                     to_im(readable(hit ? palette.hit : palette.separated, palette))})) {
            invoke(session, session.view().query == i ? "query.none" : "query.select",
                   session.view().query == i ? "" : std::to_string(i));
        }
        row_menu(ui, self);
        if (!ImGui::IsItemHovered()) return;
        ui.hovered = self;
        ImGui::SetTooltip("%s%s", sentence(query, answer.contact).c_str(),
                          unexpected ? "\nThe scene expects the other answer" : "");
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
    clips(ui);
    // A run is asked for its conflicts.
    if (!ui.session.crowd()) queries(ui);
}

void selection_panel(Ui& ui) {
    const Session& session = ui.session;
    if (session.empty()) return;
    if (!section(ui, "SELECTION")) return;
    if (session.selection.kind == Selection::Kind::none || session.selection.kind == Selection::Kind::query) {
        words(ui.style.quiet,
              "Click a disk, a box or a name; click again for what lies behind.\n\nDrag to turn the view, Shift-drag "
              "to move it, "
              "roll the wheel to zoom. F1 lists all keys.");
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
