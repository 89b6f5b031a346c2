#include <explain/tree_cost.h>
#include <render/layout/annotations.h>
#include <render/parts/node_boxes.h>
#include <render/pictures/kept_paths.h>
#include <scene/crowd_scene.h>

#include <algorithm>
#include <cstddef>

namespace mobbscope {

namespace {

/// Placements of all clips that a caption's mean is counted over: nobody waits for it, and its error is half a per
/// cent.
constexpr std::size_t kMostForCaption = std::size_t{1} << 18;

}  // namespace

KeptPaths& KeptPaths::shown_in(const ViewState& view) {
    if (!is_run(fitted_->scene())) return *this;
    const Moment moment{view.show, view.time, view.time_window};
    if (!at_moment_ || moment_ != moment) {
        at_moment_ =
            std::make_unique<KeptPaths>(std::make_shared<const FittedScene>(fitted_at(*fitted_, view)), figures_);
        moment_ = moment;
    }
    return *at_moment_;
}

const RecordedQuery& KeptPaths::recorded(const ViewState& view) {
    if (!asked_ || asked_->query != *view.query)
        asked_ = Asked{*view.query, fitted_->recorded(static_cast<std::size_t>(*view.query))};
    return *asked_->recorded;
}

const QueryProof& KeptPaths::proof(const ViewState& view) {
    const RecordedQuery& asked = recorded(view);
    if (!asked_->proof) {
        const SceneQuery query = fitted_->queries()[static_cast<std::size_t>(*view.query)];
        const mobb::PlacedTree a = fitted_->placed(query.a), b = fitted_->placed(query.b);
        asked_->proof = std::make_shared<const QueryProof>(
            proof_of(*fitted_, query, asked, clearance_over_time(a.placed_clip(), b.placed_clip())));
    }
    return *asked_->proof;
}

void KeptPaths::adopt_proof(const ViewState& view, std::shared_ptr<const QueryProof> proof) {
    recorded(view);
    asked_->proof = std::move(proof);
}

const Bounds& KeptPaths::bounds(std::span<const DrawnAgent> agents, const ViewState& view) {
    const std::pair of(view.query, view.arrange);
    if (!bounds_ || bounds_->first != of) bounds_.emplace(of, bounds_of(agents));
    return bounds_->second;
}

const FloorLines& KeptPaths::boundary(const ViewState& view) {
    const int query = *view.query;
    if (!boundary_ || boundary_->first != query)
        boundary_.emplace(query, floor_boundary(*fitted_, fitted_->queries()[static_cast<std::size_t>(query)]));
    return boundary_->second;
}

std::optional<double> KeptPaths::box_tests() {
    if (box_tests_) return *box_tests_;
    const auto& trees = fitted_->fits()[fitted_->fit_in_use()]->trees;
    const std::size_t most = std::max(kFirstCounted, kMostForCaption / trees.size());
    double sum = 0;
    for (const auto& tree : trees) {
        const std::shared_ptr<const TreeCost> cost = standard_cost(tree, most);
        if (!cost) return box_tests_.emplace();
        sum += cost->tests.boxes();
    }
    return box_tests_.emplace(sum / static_cast<double>(trees.size()));
}

/// Of one that is drawn without a query.
int KeptPaths::clip_of(const DrawnAgent& agent) const {
    return fitted_->placed_agents()[static_cast<std::size_t>(agent.index)].clip;
}

std::optional<ColorBar> KeptPaths::color_boxes(DrawList& list, std::span<const DrawnAgent> agents,
                                               const ViewState& view) {
    const auto own = box_colors_ ? std::nullopt : box_colors(*figures_, fitted_, view);
    const BoxColors* colors = own ? &*own : box_colors_.get();
    if (!colors) return std::nullopt;
    const NodeField field = color_figure(view.color_by)->field;
    std::vector<std::span<const double>> figures(list.agents.size());
    for (const DrawnAgent& agent : agents) {
        if (!agent.is_whole()) continue;
        figures[static_cast<std::size_t>(agent.index)] = figures_->of(fitted_, clip_of(agent), field).column(field);
    }
    mobbscope::color_boxes(list, figures, colors->scale);
    return ColorBar{"boxes", colors->scale, colors->unknown};
}

void KeptPaths::find_heat(std::span<const DrawnAgent> agents, const Palette& palette, Theme theme) {
    std::set<int> clips;
    for (const DrawnAgent& agent : agents) {
        if (agent.is_whole()) clips.insert(clip_of(agent));
    }
    const NodeField field = figures_->heat_of(fitted_);
    if (heat_ && heat_->theme == theme && heat_->revision == figures_->revision() && heat_->clips == clips) return;
    heat_ = Heat{theme, figures_->revision(), clips};
    std::map<int, std::vector<double>> values;
    std::vector<double> all;
    for (const int clip : clips) {
        const std::vector<double>& of_clip = values.emplace(clip, figures_->heat(fitted_, clip)).first->second;
        all.insert(all.end(), of_clip.begin(), of_clip.end());
    }
    ColoredFigure figure = colored_figure(info(field));
    figure.title =
        field == NodeField::tests ? "tests of boxes that hold them" : "part of all tests of boxes that hold them";
    figure.from_zero = true;
    heat_->scale = color_scale(figure, all);
    for (const auto& [clip, of_clip] : values) {
        auto colors = std::make_shared<std::vector<Rgba>>();
        colors->reserve(of_clip.size());
        for (const double value : of_clip) colors->push_back(heat_->scale.color(value, palette));
        heat_->colors.emplace(clip, std::move(colors));
    }
}

std::optional<ColorBar> KeptPaths::heat_bar() const {
    if (!shows_heat_) return std::nullopt;
    return ColorBar{"disks", heat_->scale, "unknown here"};
}

/// Where everybody is hidden, the picture still has its place.
void KeptPaths::add_places_of_all(const DrawList& list, std::span<const DrawnAgent> agents) {
    DrawList scratch;
    scratch.space = list.space;
    for (const DrawnAgent& agent : agents) {
        add_disks(scratch, agent, {});
    }
    for (const DiskInstance& disk : scratch.disks) {
        for (const glm::vec3& way : rim_directions()) {
            points_.add(disk.base + disk.radius * way);
            points_.add(disk.top + disk.top_radius * way);
        }
    }
}

const ShownPoints& KeptPaths::add_disks_of(DrawList& list, std::span<const DrawnAgent> agents, const ViewState& view,
                                           std::vector<PathFocus> foci) {
    shows_heat_ = view.heat && !view.query && view.disks;
    if (shows_heat_) {
        find_heat(agents, list.palette, view.theme);
        for (std::size_t i = 0; i < agents.size(); ++i) {
            const auto colors = heat_->colors.find(clip_of(agents[i]));
            if (colors != heat_->colors.end()) foci[i].colors = colors->second;
        }
    }
    Shapes shapes{view.query, list.space.origin, list.space.time_height, fitted_->scene().crowd ? view.time_window : 0,
                  {},         view.arrange};
    for (const DrawnAgent& agent : agents) shapes.whole.push_back(agent.is_whole());
    Colors colors{view.theme, foci, {}};
    for (const DrawnAgent& agent : agents) colors.agents.push_back(agent.color);
    if (shapes_ != shapes) {
        for (std::size_t i = 0; i < agents.size(); ++i) {
            if (agents[i].is_whole()) add_disks(list, agents[i], foci[i]);
        }
        disks_ = list.disks;
        points_ = ShownPoints(disks_);
        if (disks_.empty() && std::ranges::none_of(agents, &DrawnAgent::is_whole)) add_places_of_all(list, agents);
        shapes_ = shapes;
    } else if (colors_ != colors) {
        std::size_t first = 0;
        for (std::size_t i = 0; i < agents.size(); ++i) {
            if (agents[i].is_whole()) first = color_disks(disks_.edit(), first, list.palette, agents[i], foci[i]);
        }
        points_ = points_.of_like(disks_);
    }
    colors_ = colors;
    list.disks = disks_;
    return points_;
}

}  // namespace mobbscope
