#include <render/layout/annotations.h>
#include <render/layout/framing.h>
#include <render/layout/legend.h>
#include <render/pictures/picture.h>

#include <glm/common.hpp>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace mobbscope {

Picture::Picture(const FittedScene& fitted, const ViewState& view, const PictureOptions& options)
    : fitted_(fitted),
      view_(view),
      options_(options),
      metrics_(metrics_of(options.size, options.scale)),
      agents_(drawn_agents(fitted, view)),
      layout_(options.size) {
    if (agents_.empty()) throw std::invalid_argument("the scene has nothing to draw: it has no clips");
    list_.size = options.size;
    list_.palette = palette_for(view.theme, options);
    list_.background = options.background;
    for (const DrawnAgent& agent : agents_) list_.agents.push_back(agent.name);
}

const PictureFrame& Picture::aim() {
    list_.camera = framed_camera(view_.camera, framed_, list_.space, list_.size, margin_);
    project(list_, points_);
    float top = metrics_.pad;
    glm::vec2 map(0);
    if (view_.labels) {
        Words said = words();
        if (!view_.caption) said.caption = {};
        said.caption.panel = true;
        if (!view_.legend) said.legend.clear();
        TextBudget kept = fit_to_budget(said.caption, std::move(said.legend), said.map, list_.size, metrics_);
        list_.legend = std::move(kept.legend);
        map = kept.map;
        top = add_caption(list_, said.caption, kept.caption, metrics_.pad, metrics_.scale);
    }
    layout_ = LabelLayout(list_);
    const Rect area{{metrics_.pad, top + 0.3f * metrics_.pad},
                    glm::vec2(list_.size.width, list_.size.height) - metrics_.pad};
    blocks_ = place_blocks(area, legend_size(list_.legend, metrics_.small), map, busy());
    return list_;
}

std::vector<LabelRequest> Picture::floor_labels() const {
    return floor_and_axis_labels(list_, floor_extent_, view_.floor, view_.time_axis, metrics_.small);
}

DrawList Picture::draw() {
    aim();
    const std::vector<LabelRequest> notes = content();
    if (!blocks_.legend) list_.legend.clear();
    if (!view_.labels) return std::move(list_);
    if (blocks_.legend) {
        add_legend(list_, blocks_.legend->min, metrics_.small);
        layout_.reserve(*blocks_.legend);
    }
    if (blocks_.map) {
        add_map(blocks_.map->min);
        layout_.reserve(*blocks_.map);
    }
    add_notes(list_, layout_, notes, metrics_.scale);
    for (const LabelRequest& label : floor_labels()) layout_.place(label, list_);
    add_names_to(layout_);
    return std::move(list_);
}

std::vector<Rect> seen_grid(const ViewProjection& projection, glm::vec3 low, glm::vec3 high, glm::ivec3 cells) {
    std::vector<Rect> out;
    for (int i = 0; i <= cells.x; ++i) {
        for (int j = 0; j <= cells.y; ++j) {
            for (int k = 0; k <= cells.z; ++k) {
                const glm::vec3 share = glm::vec3(i, j, k) / glm::vec3(glm::max(cells, 1));
                const auto at = projection.project(low + share * (high - low));
                if (at) out.push_back(Rect{*at, *at}.grown(8));
            }
        }
    }
    return out;
}

}  // namespace mobbscope
