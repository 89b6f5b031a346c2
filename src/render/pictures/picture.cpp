#include <render/drawlist/palette.h>
#include <render/layout/annotations.h>
#include <render/layout/framing.h>
#include <render/layout/legend.h>
#include <render/pictures/picture.h>
#include <scene/arrangement.h>

#include <glm/common.hpp>

#include <algorithm>
#include <ranges>
#include <stdexcept>
#include <utility>

namespace mobbscope {

namespace {

constexpr float kDimmed = 0.3f;  // of its colour that an agent keeps where another stands out

}  // namespace

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
    let_stand_out();
}

/// Of so many that they are not told apart by name, the followed and the selected one stand out: the rest dims.
void Picture::let_stand_out() {
    const Scene& scene = fitted_.scene();
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
        if (points_at(agent) || agent.pinned) continue;
        agent.dimmed = true;
        agent.color = mix_colors(list_.palette.background, agent.color, kDimmed);
    }
}

/// What is not as the scene has it.
void Picture::say_what_view_does(Caption& caption) const {
    const Scene& scene = fitted_.scene();
    std::vector<std::string> hidden;
    for (const DrawnAgent& agent : agents_) {
        const std::string& name = view_.query ? agent.label : name_in_view(scene, agent);
        if (agent.hidden && std::ranges::find(hidden, name) == hidden.end()) hidden.push_back(name);
    }
    mention_hidden(caption, hidden, view_.query ? agents_.size() : names_in_view(scene).size());
    if (is_in_grid(scene, view_)) mention(caption, "in a grid, not where they are");
}

const PictureFrame& Picture::aim() {
    float top = metrics_.pad;
    glm::vec2 map(0);
    if (view_.labels) {
        Words said = words();
        say_what_view_does(said.caption);
        if (!view_.caption) said.caption = {};
        said.caption.panel = scene_may_lie_behind(view_, options_);
        if (!view_.legend) said.legend.clear();
        TextBudget kept = fit_to_budget(said.caption, std::move(said.legend), said.map, list_.size, metrics_);
        list_.legend = std::move(kept.legend);
        map = kept.map;
        top = add_caption(list_, said.caption, kept.caption, metrics_.pad, metrics_.scale);
    }
    layout_ = LabelLayout(list_);
    blocks_ = find_places(top, map);
    return list_;
}

Blocks Picture::find_places(float top, glm::vec2 map) {
    return mobbscope::aim(list_, points_, widest_floor(), view_, metrics_, top, map, [&] { return busy(); });
}

std::vector<LabelRequest> Picture::floor_labels() const {
    // Of a grid distances tell nothing but the size of what is in a cell.
    const bool floor = view_.floor && !is_in_grid(fitted_.scene(), view_);
    return floor_and_axis_labels(list_, floor_extent_, floor, view_.time_axis, metrics_.small);
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

glm::dvec3 middle_of(const ShownPoints& points) {
    if (points.empty()) return glm::dvec3(0);
    const auto along = [&](glm::vec3 way) {
        return 0.5 * (static_cast<double>(points.most(way)) - static_cast<double>(points.most(-way)));
    };
    return {along({1, 0, 0}), along({0, 1, 0}), along({0, 0, 1})};
}

}  // namespace mobbscope
