#include <render/vector/vector_canvas.h>

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

}  // namespace mobbscope
