#include <app/panels/panels.h>
#include <app/ui/widgets.h>
#include <app/viewport/viewport_overlay.h>

namespace mobbscope::app {

void selection_panel(Ui& ui) {
    const Session& session = ui.session;
    if (session.empty()) return;
    heading(ui, "SELECTION");
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
