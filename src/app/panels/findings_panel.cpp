#include <app/panels/panels.h>
#include <app/ui/widgets.h>

#include <string>

namespace mobbscope::app {

namespace {

void finding(Ui& ui, const FitFinding& found, const mobb::FitOptions& fit, int index) {
    const std::string mark = "finding." + std::to_string(index);
    const std::string number = std::to_string(index);
    // What there is stands out from what it comes from.
    const std::size_t colon = found.text.find(": ");
    words(ui.style.warning, found.text.substr(0, colon == std::string::npos ? colon : colon + 1));
    if (colon != std::string::npos) words(ui.style.text, found.text.substr(colon + 2));
    if (small_button(ui, "See", mark + ".see", "Shows where, as large as it fits"))
        ui.invoke("tree.see_finding", number);
    if (!found.mend) return;
    const std::string mend = "Mend: " + mend_words(*found.mend, fit);
    flow(button_width(mend.c_str()));
    if (small_button(ui, mend.c_str(), mark + ".mend", "Fits the trees so; undo takes it back"))
        ui.invoke("tree.mend", number);
}

}  // namespace

void findings_panel(Ui& ui, FitNotices& notices, int clip) {
    notices.look(clip);
    const FitNotices::Noticed* const noticed = notices.of(clip);
    if (!noticed || noticed->findings.empty()) return;
    if (!section(ui, "NOTICED", std::to_string(noticed->findings.size()))) return;
    int index = 0;
    for (const FitFinding& found : noticed->findings) {
        ImGui::PushID(index);
        finding(ui, found, noticed->tree->options(), index++);
        ImGui::PopID();
    }
}

}  // namespace mobbscope::app
