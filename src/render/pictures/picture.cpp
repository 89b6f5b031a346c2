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
    find_place();
    return list_;
}

void Picture::find_place() {
    mobbscope::aim(list_, points_, widest_floor(), view_, metrics_, metrics_.pad, glm::vec2(0),
                   [] { return std::vector<Rect>(); });
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

glm::dvec3 middle_of(const ShownPoints& points) {
    if (points.empty()) return glm::dvec3(0);
    const auto along = [&](glm::vec3 way) {
        return 0.5 * (static_cast<double>(points.most(way)) - static_cast<double>(points.most(-way)));
    };
    return {along({1, 0, 0}), along({0, 1, 0}), along({0, 0, 1})};
}

}  // namespace mobbscope
