#include <app/ui/overlay.h>
#include <app/ui/swatch.h>

namespace mobbscope::app {

void draw_overlay(Ui& ui, const DrawnOverlay& overlay, ImVec2 corner) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const auto at = [&](glm::vec2 pixel) { return ImVec2(corner.x + pixel.x, corner.y + pixel.y); };
    const auto rectangle = [&](const OverlayPanel& panel) {
        const ImVec2 min = at(panel.rect.min), max = at(panel.rect.max);
        list.AddRectFilled(min, max, to_im(panel.fill), panel.radius);
        if (panel.border_width > 0) list.AddRect(min, max, to_im(panel.border), panel.radius, 0, panel.border_width);
    };
    for (const OverlayPanel& each : overlay.panels) rectangle(each);
    for (const OverlayLine& line : overlay.overlay_lines) {
        if (line.dash == kSolid) {
            list.AddLine(at(line.from), at(line.to), to_im(line.color), line.width);
        } else {
            dashed_line(list, at(line.from), at(line.to), to_im(line.color), line.width, line.dash.x);
        }
    }
    for (const OverlayPanel& mark : overlay.marks) rectangle(mark);
    for (const TextRun& text : overlay.texts) {
        const ImFont* font = text.face == FontFace::mono ? ui.style.mono : ui.style.caption;
        list.AddText(font, text.size, at(text.box.min), to_im(text.color), text.text.c_str());
    }
}

}  // namespace mobbscope::app
