#include <render/layout/annotations.h>
#include <render/layout/framing.h>
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
      agents_(drawn_agents(fitted, view)) {
    if (agents_.empty()) throw std::invalid_argument("the scene has nothing to draw: it has no clips");
    list_.size = options.size;
    list_.palette = palette_for(view.theme, options);
    list_.background = options.background;
    for (const DrawnAgent& agent : agents_) list_.agents.push_back(agent.name);
}

const PictureFrame& Picture::aim() {
    list_.camera = framed_camera(view_.camera, framed_, list_.space, list_.size, margin_);
    project(list_, points_);
    return list_;
}

std::vector<LabelRequest> Picture::floor_labels() const {
    return floor_and_axis_labels(list_, floor_extent_, view_.floor, view_.time_axis, metrics_.small);
}

DrawList Picture::draw() {
    aim();
    if (view_.labels) {
        OverlayContents said = words();
        if (!view_.caption) said.caption = {};
        if (!view_.legend) said.legend.clear();
        if (const auto map = add_overlays(list_, said, view_, metrics_)) add_map(*map);
    }
    // Labels stay out of the panels.
    LabelLayout layout(list_);
    const std::vector<LabelRequest> notes = content();
    if (!view_.labels) return std::move(list_);
    add_notes(list_, layout, notes, metrics_.scale);
    for (const LabelRequest& label : floor_labels()) layout.place(label, list_);
    add_names_to(layout);
    return std::move(list_);
}

}  // namespace mobbscope
