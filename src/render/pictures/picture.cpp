#include <base/text.h>
#include <render/drawlist/palette.h>
#include <render/layout/annotations.h>
#include <render/layout/framing.h>
#include <render/parts/paths.h>
#include <render/parts/sections.h>
#include <render/pictures/build_draw_list.h>
#include <render/pictures/picture.h>
#include <scene/arrangement.h>

#include <glm/common.hpp>

#include <algorithm>
#include <ranges>
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
    dim_all_but_pointed_out();
}

/// The rest dims where some are in the foreground. Where so many are there that they are not told apart by name, the
/// followed and the selected one stand out.
void Picture::dim_all_but_pointed_out() {
    // The two of a query are told apart as they are.
    if (view_.query) return;
    const Scene& scene = fitted_.scene();
    const auto dim = [&](DrawnAgent& agent) {
        agent.dimmed = true;
        agent.color = mix_colors(list_.palette.background, agent.color, kDimmed);
    };
    if (!view_.foreground.empty()) {
        const bool rings_followed = scene.crowd || !names_fit(agents_.size());
        for (DrawnAgent& agent : agents_) {
            if (agent.outlined) dim(agent);
            // The followed one is named beside its rings.
            if (rings_followed && name_in_view(scene, agent) == view_.follow) agent.named = false;
        }
        return;
    }
    // In a grid each has its name.
    const std::size_t all = names_in_view(scene).size();
    if (agents_.front().cell || names_fit(all - std::min(all, view_.hidden.size()))) return;
    const auto points_at = [&](const DrawnAgent& agent) {
        const std::string& name = name_in_view(scene, agent);
        return name == view_.follow || name == options_.selected;
    };
    if (std::ranges::none_of(agents_, points_at)) return;
    for (DrawnAgent& agent : agents_) {
        // The followed one is named beside its rings.
        agent.named = points_at(agent) && name_in_view(scene, agent) != view_.follow;
        if (!points_at(agent) && !agent.pinned) dim(agent);
    }
}

/// What is not as the scene has it.
void Picture::mention_view(Caption& caption) const {
    const Scene& scene = fitted_.scene();
    std::vector<std::string> hidden;
    for (const DrawnAgent& agent : agents_) {
        const std::string& name = view_.query ? agent.label : name_in_view(scene, agent);
        if (agent.hidden && std::ranges::find(hidden, name) == hidden.end()) hidden.push_back(name);
    }
    if (!view_.query) mention_foreground(caption, view_.foreground);
    mention_hidden(caption, hidden, view_.query ? agents_.size() : names_in_view(scene).size());
    if (list_.slab) {
        const std::string least = to_thousandth(view_.slab->least), most = to_thousandth(view_.slab->most);
        mention(caption, least == most ? "at " + least + " s" : "from " + least + " to " + most + " s");
    }
    if (is_in_grid(scene, view_)) mention(caption, "in a grid, not where they are");
    // A caption without a headline is not shown.
    if (caption.headlines.empty() && !caption.detail.empty()) caption.headlines = {std::exchange(caption.detail, {})};
}

const OverlayContents& Picture::said() {
    if (said_) return *said_;
    said_ = words();
    mention_view(said_->caption);
    if (!view_.caption) said_->caption = {};
    if (!view_.legend) {
        said_->legend.clear();
        said_->bars.clear();
    }
    if (!view_.inset) said_->map = {};
    return *said_;
}

std::vector<Rect> Picture::panels() {
    if (!view_.labels) return {};
    list_.camera = framed_camera(view_.camera, framed_, list_.space, list_.size, {}, margin_);
    project(list_, points_);
    return overlay_rects(list_.size, said(), view_, metrics_, options_.controls);
}

Framed Picture::framed() { return {view_.camera, list_.space, framed_, panels(), margin_}; }

const PictureFrame& Picture::aim() {
    const std::vector<Rect> beside = view_.camera.target ? std::vector<Rect>() : panels();
    list_.camera = framed_camera(view_.camera, framed_, list_.space, list_.size, beside, margin_);
    project(list_, points_);
    return list_;
}

Camera Picture::film_camera(Played played, std::span<const Rect> panels) {
    if (played == Played::steps) frame_boxes_of_steps();
    if (played == Played::turn) return turning_camera(view_.camera, framed_, list_.space, list_.size, panels);
    return framed_camera(view_.camera, framed_, list_.space, list_.size, panels, margin_);
}

std::vector<LabelRequest> Picture::floor_labels() const {
    // Of a grid distances tell nothing but the size of what is in a cell.
    const bool floor = view_.floor && !is_in_grid(fitted_.scene(), view_);
    std::vector<LabelRequest> out = floor_and_axis_labels(list_, floor_extent_, floor, view_.time_axis, metrics_.small);
    if (list_.slab) {
        const auto times = slab_labels(list_, floor_extent_, *view_.slab, metrics_.small);
        out.insert(out.begin(), times.begin(), times.end());
    }
    return out;
}

DrawList Picture::draw() {
    aim();
    if (view_.labels) {
        if (const auto map = add_overlays(list_, said(), view_, metrics_, options_.controls)) add_map(*map);
    }
    // Labels stay out of the panels.
    LabelLayout layout(list_);
    const std::vector<LabelRequest> notes = content();
    if (!view_.labels) return std::move(list_);
    add_notes(list_, layout, notes, metrics_.scale);
    if (view_.time_axis) {
        for (const LabelRequest& title : time_titles(list_, floor_extent_, metrics_.small)) {
            if (layout.place(title, list_)) break;
        }
    }
    for (const LabelRequest& label : floor_labels()) layout.place(label, list_);
    add_names_to(layout);
    return std::move(list_);
}

}  // namespace mobbscope
