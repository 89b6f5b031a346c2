#include <render/vector/vector_canvas.h>

#include <algorithm>

namespace mobbscope {

void add_line(std::vector<VectorStroke>& strokes, glm::vec2 from, glm::vec2 to, const LineStyle& style,
              float dash_start) {
    if (!strokes.empty()) {
        VectorStroke& last = strokes.back();
        const bool alike = last.color == style.color && last.width == style.width && last.dash == style.dash &&
                           last.dash_start == dash_start;
        const bool goes_on = style.dash == kSolid && last.runs.back().back() == from;
        if (alike && goes_on) return last.runs.back().push_back(to);
        if (alike && style.color.a >= 1) return last.runs.push_back({from, to});
    }
    strokes.push_back({{{from, to}}, style.color, style.width, style.dash, dash_start});
}

void draw_panel(VectorCanvas& canvas, const OverlayPanel& panel) {
    const auto part = [&](float inset, Rgba fill, Rgba line, float width) {
        canvas.rectangle(panel.rect.grown(-inset), std::max(0.0F, panel.radius - inset), fill, line, width);
    };
    const float border = panel.border_width;
    if (border <= 0) return part(0, panel.fill, Rgba(0), 0);
    if (panel.border.a >= 1) return part(0.5F * border, panel.fill, panel.border, border);
    // The fill does not shine through the border.
    part(border, panel.fill, Rgba(0), 0);
    part(0.5F * border, Rgba(0), panel.border, border);
}

}  // namespace mobbscope
