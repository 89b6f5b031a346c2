#include <app/ui/ui.h>

namespace mobbscope::app {

void Ui::mark(const std::string& name) const {
    const ImVec2 min = ImGui::GetItemRectMin();
    const ImVec2 max = ImGui::GetItemRectMax();
    marks.add(name, {{min.x, min.y}, {max.x, max.y}});
}

}  // namespace mobbscope::app
