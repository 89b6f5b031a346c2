#include <render/layout/box_colors.h>
#include <render/parts/node_boxes.h>
#include <scene/crowd_run.h>
#include <scene/drawn_agent.h>
#include <scene/motion_graph.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>
#include <utility>

namespace mobbscope {

namespace {

bool shows_levels(const ViewState& view) {
    if (!view.boxes || view.query) return false;
    return view.show == Show::plan || (view.show == Show::space_time && !view.projection);
}

bool has_value(double value) { return !std::isnan(value); }

/// Makes the scale, with the ends that somebody has chosen; none: it is spread over the range.
void set_scale(BoxColors& colors, const ColoredFigure& figure, const std::optional<ValueRange>& chosen) {
    colors.scale = color_scale(figure, chosen ? colors.values : colors.range, chosen);
    colors.scale.known = std::ranges::any_of(colors.values, has_value);
}

std::string why_unknown(const BoxColors& colors, const FittedScene& fitted, NodeField field) {
    if (colors.values.empty()) return "no box is shown";
    if (field != NodeField::tests && field != NodeField::avoidable) return "unknown here";
    return fitted.queries().empty() ? "the scene asks no queries" : "not counted";
}

}  // namespace

std::optional<BoxColors> box_colors(SceneFigures& figures, const std::shared_ptr<const FittedScene>& fitted,
                                    const ViewState& view) {
    const NodeFieldInfo* field = color_figure(view.color_by);
    if (!field || !shows_levels(view)) return std::nullopt;
    BoxColors out;
    int deepest = 1;
    const auto add = [&](int clip, const std::vector<int>& nodes, std::vector<double>& to) {
        const std::span<const double> column = figures.of(fitted, clip, field->field).column(field->field);
        for (const int node : nodes) to.push_back(column[static_cast<std::size_t>(node)]);
        deepest = std::max(deepest, fitted->tree(clip).depth() - 1);
    };
    if (fitted->scene().crowd) {
        std::set<int> clips;
        for (const GraphMove& move : fitted->scene().graph->moves) clips.insert(move.clip);
        for (const int clip : clips) add(clip, shown_nodes(fitted->tree(clip), view.levels), out.values);
    } else {
        for (const DrawnAgent& agent : drawn_agents(*fitted, view)) {
            if (!agent.is_whole()) continue;
            const int clip = fitted->placed_agents()[static_cast<std::size_t>(agent.index)].clip;
            add(clip, shown_nodes(agent, view.levels), out.values);
            // A part that is shown alone keeps the colours that it has among all.
            if (agent.subtree) add(clip, shown_nodes(fitted->tree(clip), view.levels), out.range);
        }
    }
    out.range.insert(out.range.end(), out.values.begin(), out.values.end());
    // A level has one colour in all pictures of trees that are so deep.
    if (field->field == NodeField::level) out.range = {0, static_cast<double>(deepest)};
    out.unknown = why_unknown(out, *fitted, field->field);
    set_scale(out, colored_figure(*field), view.color_range);
    return out;
}

bool are_colored_alike(const ViewState& a, const ViewState& b) {
    const auto matters = [](const ViewState& view) {
        return std::tie(view.color_by, view.color_range, view.levels, view.show, view.boxes, view.query,
                        view.projection, view.subtree, view.hidden, view.pinned, view.foreground);
    };
    return matters(a) == matters(b);
}

void share_scale(const std::vector<BoxColors*>& beside) {
    std::vector<std::pair<BoxColors*, std::vector<double>>> shared;
    for (BoxColors* one : beside) {
        if (!one) continue;
        std::vector<double> range;
        for (const BoxColors* other : beside) {
            if (other && other->scale.figure == one->scale.figure)
                range.insert(range.end(), other->range.begin(), other->range.end());
        }
        shared.emplace_back(one, std::move(range));
    }
    for (auto& [one, range] : shared) {
        one->range = std::move(range);
        if (!one->scale.chosen) set_scale(*one, ColoredFigure(one->scale.figure), std::nullopt);
    }
}

}  // namespace mobbscope
