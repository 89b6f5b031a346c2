#include <app/commands/command.h>
#include <app/document/agents.h>
#include <app/panels/curves.h>
#include <app/panels/ruler.h>
#include <app/ui/thing_menus.h>
#include <base/text.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>

namespace mobbscope::app {

namespace {

constexpr std::size_t kMostPaths = 12;
constexpr std::size_t kMostTold = 6;  // values in a tooltip
constexpr float kLeastPlot = 50;      // height, pixels at scale 1
constexpr float kMostPlot = 120;
constexpr float kGutter = 88;    // width of the room at the left that has place for titles and numbers
constexpr float kOther = 0.45f;  // strength of who is not selected, where somebody is

bool is_selected(const Workspace& workspace, const AgentRef& path) {
    return workspace.selection.on_path() && workspace.selection.path == path;
}

std::string value_text(const CurveInfo& curve, double value) {
    const bool joined = curve.unit.starts_with("\u00B0");
    return formatted("%.*f", curve.decimals, value) + (joined ? "" : " ") + std::string(curve.unit);
}

}  // namespace

void CurvePlots::update(Ui& ui, const ChartAxis& time) {
    const Workspace& workspace = ui.workspace;
    const FittedScene& fitted = workspace.fitted();
    std::vector<DrawnAgent> agents = drawn_agents(fitted, workspace.view());
    std::erase_if(agents, [](const DrawnAgent& agent) { return agent.hidden; });
    const auto ref_of = [&](const DrawnAgent& agent) { return agent_in_view(fitted, workspace.view(), agent.index); };
    const auto selected =
        std::ranges::find_if(agents, [&](const DrawnAgent& agent) { return is_selected(workspace, ref_of(agent)); });
    // The first, and who is selected: that one is drawn over all others.
    shown_ = agents.size();
    if (selected != agents.end()) std::rotate(agents.begin(), selected, selected + 1);
    if (agents.size() > kMostPaths) agents.erase(agents.begin() + kMostPaths, agents.end());
    std::ranges::reverse(agents);

    Key key{.fitted = workspace.shown(),
            .refs = {},
            .costs = {},
            .levels = workspace.view().levels,
            .t0 = time.from,
            .t1 = time.to};
    key.columns = std::max(1, static_cast<int>(time.last - time.first));
    for (const DrawnAgent& agent : agents) {
        key.refs.push_back(ref_of(agent));
        const auto who = placed_agent_of(fitted, key.refs.back());
        if (who && !workspace.crowd()) ui.session.fit_costs.find_when_idle(who->clip);
        key.costs.push_back(who ? workspace.cost_of(who->clip) : nullptr);
    }
    if (key_ == key) return;
    key_ = key;
    paths_.clear();
    for (std::size_t i = 0; i < agents.size(); ++i) {
        Path path{.agent = std::move(agents[i]), .ref = key.refs[i]};
        const mobb::Tree& tree = path.agent.placed.tree();
        const std::vector<double> none;
        path.curves = {radius_curve(tree.clip()), speed_curve(tree.clip()), turn_curve(tree.clip()),
                       cost_curve(tree, key.costs[i] ? key.costs[i]->shares : none, key.levels)};
        for (std::size_t k = 0; k < kCurveCount; ++k)
            path.columns[k] = columns_of(path.curves[k], path.agent.clip(), key.t0, key.t1, key.columns);
        paths_.push_back(std::move(path));
    }
}

/// The axis of values: all of them, and some room.
ChartAxis CurvePlots::values_of(const CurveInfo& curve, const Rect& area) const {
    ValueColumn all;
    if (curve.from_zero) all.add(0, 0);
    for (const Path& path : paths_) {
        for (const ValueColumn& column : path.columns[static_cast<std::size_t>(curve.kind)])
            if (column.any) all.add(column.least, column.most);
    }
    const double range = std::max({all.most - all.least, 1e-3, 0.05 * std::abs(all.most)});
    const double below = curve.from_zero && all.least >= 0 ? 0 : 0.1 * range;
    return {all.least - below, all.least + 1.12 * range, area.max.y, area.min.y};
}

/// The middle of each column as a line, and around it all that is in the column.
void CurvePlots::lines(const Ui& ui, const CurveInfo& curve, const Rect& area, const ChartAxis& values) const {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const bool some_stand_out =
        std::ranges::any_of(paths_, [&](const Path& path) { return is_selected(ui.workspace, path.ref); });
    for (const Path& path : paths_) {
        const bool stands_out = !some_stand_out || is_selected(ui.workspace, path.ref);
        const Rgba color = with_alpha(readable(path.agent.color, ui.style.palette), stands_out ? 1 : kOther);
        const std::vector<ValueColumn>& columns = path.columns[static_cast<std::size_t>(curve.kind)];
        std::vector<ImVec2> line;
        const auto finish = [&] {
            if (line.size() == 1) line.push_back({line.front().x + 1, line.front().y});
            draw.AddPolyline(line.data(), static_cast<int>(line.size()), to_im(color), 0,
                             ui.px(some_stand_out && stands_out ? 2.2f : 1.4f));
            line.clear();
        };
        for (std::size_t k = 0; k < columns.size(); ++k) {
            const ValueColumn& column = columns[k];
            if (!column.any) {
                if (!line.empty()) finish();
                continue;
            }
            const float x = area.min.x + static_cast<float>(k);
            const float low = values.pixel(column.least), high = values.pixel(column.most);
            if (low - high > 1.5f)
                draw.AddRectFilled({x, high}, {x + 1, low}, to_im(with_alpha(color, 0.5f * color.a)));
            line.push_back({x + 0.5f, 0.5f * (low + high)});
        }
        if (!line.empty()) finish();
    }
}

std::vector<CurvePlots::Point> CurvePlots::points_at(const CurveInfo& curve, const ChartAxis& values,
                                                     double time) const {
    std::vector<Point> out;
    for (const Path& path : paths_) {
        const auto value = value_at(path.curves[static_cast<std::size_t>(curve.kind)], path.agent.clip(), time);
        if (value) out.push_back({&path, value->first, value->second, values.pixel(value->second)});
    }
    return out;
}

/// Tells what is at the mouse: the nearest curve first.
void CurvePlots::point_at(Ui& ui, const CurveInfo& curve, const ChartAxis& time, const ChartAxis& values) const {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const double at = std::clamp(time.value(mouse.x), time.from, time.to);
    std::vector<Point> points = points_at(curve, values, at);
    std::ranges::stable_sort(points, {}, [&](const Point& point) { return std::abs(point.y - mouse.y); });
    std::string told = formatted("%.3f s", at);
    if (points.empty()) {
        ImGui::SetTooltip("%s: no value", told.c_str());
        return;
    }
    const Point& nearest = points.front();
    ui.hovered = {Selection::Kind::sample, nearest.path->ref, nearest.sample};
    const ImVec2 there{std::clamp(mouse.x, time.first, time.last), nearest.y};
    const float r = ui.px(3.5f);
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddCircleFilled(there, r, to_im(nearest.path->agent.color));
    draw.AddCircle(there, r, ui.style.text, 0, ui.style.scale);
    for (std::size_t i = 0; i < std::min(points.size(), kMostTold); ++i) {
        told.append("\n").append(cleaned(points[i].path->agent.name));
        if (i == 0) told.append(", sample ").append(std::to_string(points[i].sample));
        told.append(": ").append(value_text(curve, points[i].value));
    }
    if (points.size() > kMostTold) told += "\nand " + std::to_string(points.size() - kMostTold) + " more";
    const Rect here{{mouse.x - r, mouse.y - r}, {mouse.x + r, mouse.y + r}};
    if (!copies(ui, here, {.value = nearest.value, .unit = std::string(curve.unit), .with_ctrl = true}))
        ImGui::SetTooltip("%s\nClick to go there, Ctrl and click to copy", told.c_str());
}

/// Beside the time cursor: of who is selected, or else of the first.
void CurvePlots::values_at_cursor(Ui& ui, const CurveInfo& curve, const Rect& area, const ChartAxis& values,
                                  double time, float x) const {
    const std::vector<Point> points = points_at(curve, values, time);
    if (points.empty()) return;
    const auto selected =
        std::ranges::find_if(points, [&](const Point& point) { return is_selected(ui.workspace, point.path->ref); });
    const Point& told = selected == points.end() ? points.front() : *selected;
    const std::string text = value_text(curve, told.value);
    const float width = text_size(*ui.style.caption, text).x, gap = ui.px(4);
    const float left = x + gap + width > area.max.x ? x - gap - width : x + gap;
    text_over(ui, area, {left, area.min.y + 1}, to_im(readable(told.path->agent.color, ui.style.palette)), text);
}

void CurvePlots::plot(Ui& ui, const CurveInfo& curve, const ChartAxis& time, float height) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const Rect area{{time.first, corner.y}, {time.last, corner.y + height}};
    const ChartAxis values = values_of(curve, area);
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const std::string title(curve.title), unit(curve.unit);
    const float room = time.first - corner.x;
    const bool beside = room >= ui.px(kGutter);
    ImGui::SetCursorScreenPos({area.min.x, area.min.y});
    const std::string mark = "curves." + std::string(curve.name);
    ImGui::InvisibleButton(mark.c_str(), {std::max(1.0f, area.size().x), height});
    ui.mark(mark, OwnKeys::left_right);
    const bool hovered = ImGui::IsItemHovered(), active = ImGui::IsItemActive();
    time_keys(ui, mark);
    const double at = std::clamp(time.value(ImGui::GetIO().MousePos.x), time.from, time.to);
    context_menu(
        ui, [&] { return time_menu(ui.session, at); }, ImVec2{area.center().x, area.center().y});

    draw.AddRectFilled({area.min.x, area.min.y}, {area.max.x, area.max.y}, ui.style.raised);
    const auto any = [&](const Path& path) {
        return std::ranges::any_of(path.columns[static_cast<std::size_t>(curve.kind)], &ValueColumn::any);
    };
    if (std::ranges::any_of(paths_, any)) {
        height_lines(ui, area, values, beside ? "" : " " + unit, beside);
        draw.PushClipRect({area.min.x, area.min.y}, {area.max.x, area.max.y}, true);
        lines(ui, curve, area, values);
        draw.PopClipRect();
    } else {
        const char* why = curve.kind == CurveKind::cost ? "not known" : "no values";
        draw_text(draw, *ui.style.caption, {area.min.x + ui.px(6), area.center().y}, ui.style.quiet, why);
    }
    const std::string named = title + ", " + unit;
    if (beside) {
        draw.AddText(corner, ui.style.text, title.c_str());
        const float below = corner.y + ImGui::GetTextLineHeight();
        draw_text(draw, *ui.style.caption, {corner.x, below}, ui.style.quiet, unit);
        if (ImGui::IsWindowHovered() && ImGui::IsMouseHoveringRect(corner, {time.first, area.max.y}))
            ImGui::SetTooltip("%s", std::string(curve.doc).c_str());
    } else {
        const float width = text_size(*ui.style.caption, named).x;
        text_over(ui, area, {area.max.x - width - ui.px(4), area.min.y + 1}, ui.style.text, named);
    }
    if (const auto& now = ui.workspace.view().time; now && *now >= time.from && *now <= time.to) {
        const float x = time.pixel(*now);
        draw.AddLine({x, area.min.y}, {x, area.max.y}, ui.style.text, ui.px(1.5f));
        if (!hovered) values_at_cursor(ui, curve, area, values, *now, x);
    }
    if (hovered || active) point_at(ui, curve, time, values);
    if (active && !ImGui::GetIO().KeyCtrl) scrub_to(ui, at);
    ImGui::SetCursorScreenPos({corner.x, area.max.y + ui.px(5)});
}

void CurvePlots::draw(Ui& ui, const ChartAxis& time) {
    update(ui, time);
    if (shown_ > paths_.size()) {
        ImGui::SameLine(0, ui.px(18));
        ImGui::AlignTextToFramePadding();
        fitted_line(ui, ui.style.quiet,
                    std::to_string(paths_.size()) + " of " + std::to_string(shown_) +
                        " paths: the first of the list, and who is selected",
                    ImGui::GetContentRegionAvail().x, ui.style.caption);
        ui.mark_only("curves.left_out");
    }
    const float ruler_height = ui.style.mono->FontSize + ui.px(8);
    const float count = kCurveCount;
    const float room = ImGui::GetContentRegionAvail().y - ruler_height - ui.px(8);
    const float height = std::floor(std::clamp(room / count - ui.px(5), ui.px(kLeastPlot), ui.px(kMostPlot)));
    for (const CurveInfo& curve : curve_infos()) plot(ui, curve, time, height);
    ruler(ui, *ui.style.mono, time, ImGui::GetCursorScreenPos().y - ui.px(4), " s");
    ImGui::Dummy({1, ruler_height - ui.px(4)});
}

}  // namespace mobbscope::app
