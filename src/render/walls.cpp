#include <render/walls.h>

namespace mobbscope {

namespace {

constexpr float kGlass = 0.1f;  // opacity

}  // namespace

Stage floor_stage(glm::dvec2 area, double begin, double end) {
    const glm::dvec2 half = 0.5 * area;
    Stage stage = make_stage({-half.x, -half.y, begin}, {half.x, half.y, end});
    // The floor ends at its walls, wherever the grid has a line.
    stage.x0 = -half.x;
    stage.x1 = half.x;
    stage.y0 = -half.y;
    stage.y1 = half.y;
    return stage;
}

void add_walls(DrawList& list, glm::dvec2 area, double bottom, double top, float scale) {
    const glm::dvec2 half = 0.5 * area;
    const glm::dvec2 corners[4] = {{-half.x, -half.y}, {half.x, -half.y}, {half.x, half.y}, {-half.x, half.y}};
    const Rgba color = list.palette.axis;
    const auto add_line = [&](glm::vec3 from, glm::vec3 to, float width, int i) {
        LineInstance line;
        line.from = from;
        line.to = to;
        line.color = color;
        line.width = width * scale;
        line.cap = 0.4f * width * scale;
        line.order = {0, 3, i};
        list.lines.push_back(line);
    };
    for (int i = 0; i < 4; ++i) {
        const glm::dvec2 a = corners[i];
        const glm::dvec2 b = corners[(i + 1) % 4];
        const glm::vec3 a0 = list.space.point(a.x, a.y, bottom);
        const glm::vec3 b0 = list.space.point(b.x, b.y, bottom);
        add_line(a0, b0, 2, 2 * i);
        if (top <= bottom) continue;
        const glm::vec3 a1 = list.space.point(a.x, a.y, top);
        const glm::vec3 b1 = list.space.point(b.x, b.y, top);
        add_line(a1, b1, 1, 2 * i + 1);
        add_line(a0, a1, 1, 8 + i);
        BoxInstance pane;
        pane.center = 0.25f * (a0 + b0 + a1 + b1);
        pane.extents = {0.5f * (b0 - a0), 0.5f * (a1 - a0), glm::vec3(0)};
        pane.state = BoxState::annotation;
        pane.fill = with_alpha(color, kGlass);
        pane.edge = Rgba(0);
        pane.pickable = false;
        pane.order = {0, 3, i};
        list.boxes.push_back(pane);
    }
}

}  // namespace mobbscope
