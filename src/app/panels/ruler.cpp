#include <app/panels/ruler.h>
#include <render/text/labels.h>

#include <algorithm>
#include <string>

namespace mobbscope::app {

void ruler(const Ui& ui, const ImFont& font, const ChartAxis& axis, float y, const char* unit) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const auto width_of = [&](const std::string& label) { return text_size(font, label + unit).x + ui.px(14); };
    const double step = ruler_step(axis.from, axis.to, axis.last - axis.first, width_of);
    // What is outside is clipped: the outermost stand inside.
    const float left = draw.GetClipRectMin().x;
    const float right = draw.GetClipRectMax().x;
    for (const double value : ticks(axis.from, axis.to, step)) {
        const float x = axis.pixel(value);
        draw.AddLine({x, y}, {x, y + ui.px(4)}, ui.style.quiet, ui.px(1));
        const std::string label = tick_text(value, step) + unit;
        const float width = text_size(font, label).x;
        const float at = std::clamp(x - 0.5f * width, left, std::max(left, right - width));
        draw_text(draw, font, {at, y + ui.px(5)}, ui.style.quiet, label);
    }
}

}  // namespace mobbscope::app
