#include <app/commands/command.h>
#include <app/panels/query_parts.h>
#include <app/panels/ruler.h>
#include <app/ui/swatch.h>
#include <app/ui/widgets.h>
#include <base/text.h>
#include <explain/bodies.h>
#include <explain/query_sentence.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace mobbscope::app {

namespace {

/// What the chart covers, and where.
struct ChartArea {
    ImVec2 min, max;
    mobb::Interval time;
    ChartAxis x;    ///< seconds
    ChartAxis y{};  ///< metres
};

/// The least of each column as a curve, and above it how much more there is in the column.
void draw_curve(ImDrawList& list, const Style& style, const ChartArea& chart, const std::vector<ValueColumn>& columns) {
    std::vector<ImVec2> curve;
    for (std::size_t k = 0; k < columns.size(); ++k) {
        const ValueColumn& column = columns[k];
        if (!column.any) continue;
        const float x = chart.min.x + static_cast<float>(k);
        const float y = chart.y.pixel(column.least);
        if (column.least < 0) {
            list.AddRectFilled({x, chart.y.pixel(0)}, {x + 1, y}, mark_color(style, EventMark::hit, 0.4f));
        }
        const float most = chart.y.pixel(column.most);
        if (y - most > 1) list.AddRectFilled({x, most}, {x + 1, y}, to_im(with_alpha(style.palette.text, 0.35f)));
        curve.push_back({x + 0.5f, y});
    }
    list.AddPolyline(curve.data(), static_cast<int>(curve.size()), style.text, 0, 1.5f * style.scale);
}

/// Of the distance of bones.
ImU32 bones_color(const Style& style) { return mark_color(style, EventMark::overlap); }

void least_mark(ImDrawList& list, const Style& style, const ChartArea& chart, const ClearancePiece& least) {
    const EventMark mark = least.clearance < 0 ? EventMark::hit : EventMark::separated;
    const ImVec2 at{chart.x.pixel(least.approach.is_still() ? 0.5 * (least.t0 + least.t1) : least.least_at),
                    chart.y.pixel(least.clearance)};
    list.AddCircleFilled(at, 3.5f * style.scale, mark_color(style, mark));
    list.AddCircle(at, 3.5f * style.scale, style.text, 0, style.scale);
}

/// The least distance of bones in each step, and when they were measured at all.
void draw_bodies(Ui& ui, const ChartArea& chart, const BodyDistances& bodies) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImU32 color = bones_color(ui.style);
    const auto x_of = [&](double t) { return std::clamp(chart.x.pixel(t), chart.min.x, chart.max.x); };
    for (const BodyStep& step : bodies.steps) {
        const float from = x_of(step.t0), to = std::max(x_of(step.t1), from + 1),
                    y = chart.y.pixel(step.nearest.distance);
        if (step.nearest.distance < 0)
            list.AddRectFilled({from, chart.y.pixel(0)}, {to, y}, mark_color(ui.style, EventMark::hit, 0.6f));
        list.AddLine({from, y}, {to, y}, color, ui.px(2));
    }
}

/// The times in which bones were measured, behind the curves.
void draw_measured_times(Ui& ui, const ChartArea& chart, const BodyDistances& bodies) {
    for (const mobb::Interval& interval : bodies.intervals) {
        const float from = std::clamp(chart.x.pixel(interval.t0), chart.min.x, chart.max.x);
        const float to = std::clamp(chart.x.pixel(interval.t1), from + 1, chart.max.x + 1);
        ImGui::GetWindowDrawList()->AddRectFilled({from, chart.min.y}, {to, chart.max.y},
                                                  to_im(with_alpha(ui.style.palette.text, 0.08f)));
    }
}

/// What the curves are.
void chart_legend(Ui& ui, double bone_radius) {
    const float line = ImGui::GetTextLineHeight();
    ImGui::PushFont(ui.style.caption);
    const auto entry = [&](ImU32 color, float thick, const std::string& text) {
        flow(ui.px(22) + ImGui::CalcTextSize(text.c_str()).x);
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const float y = at.y + 0.5f * line;
        ImGui::GetWindowDrawList()->AddLine({at.x, y}, {at.x + ui.px(14), y}, color, ui.px(thick));
        ImGui::Dummy({ui.px(14), line});
        ImGui::SameLine(0, ui.px(5));
        text_line(ui.style.quiet, text);
    };
    ImGui::Dummy({0, 0});
    entry(ui.style.text, 1.5f, "disks");
    entry(bones_color(ui.style), 2, "nearest bones");
    entry(to_im(with_alpha(ui.style.palette.text, 0.2f)), 9,
          "disks grown by the bones' " + with_unit(bone_radius, "m") + " overlap");
    ImGui::PopFont();
    ui.mark_only("query.clearance_legend");
}

/// The piece that holds at a time; null if none does.
const ClearancePiece* piece_at(const Clearance& clearance, double t) {
    const auto at = std::partition_point(clearance.pieces.begin(), clearance.pieces.end(),
                                         [&](const ClearancePiece& p) { return p.t1 <= t; });
    return at != clearance.pieces.end() && at->t0 <= t ? &*at : nullptr;
}

/// Likewise of bones.
const BodyStep* step_at(const BodyDistances& bodies, double t) {
    const auto at = std::partition_point(bodies.steps.begin(), bodies.steps.end(),
                                         [&](const BodyStep& step) { return step.t1 <= t; });
    return at != bodies.steps.end() && at->t0 <= t ? &*at : nullptr;
}

std::string bones_line(const QueryFindings& findings, const NearestBones& bones) {
    return "\nbones: " + signed_metres(bones.distance) + " m, " + bone_words(*findings.sides[0].skeleton, bones.a) +
           " and " + bone_words(*findings.sides[1].skeleton, bones.b);
}

}  // namespace

void QueryPictures::clearance(Ui& ui, QueryInspector& queries, const QueryFindings& findings, float height) {
    const Clearance& clearance = findings.clearance;
    if (!clearance.least) {
        words(ui.style.quiet, "They share no time, so there is no clearance.");
        return;
    }
    const ClearancePiece& least = clearance.pieces[*clearance.least];
    const std::string when = (least.clearance < 0 ? "deepest at " : "least at ") + with_unit(least.least_at, "s");
    number_row(ui, when.c_str(), signed_metres(least.clearance) + " m", least.clearance, "m");

    const float label = ui.style.caption->FontSize + ui.px(6);
    const int width = static_cast<int>(ImGui::GetContentRegionAvail().x);
    if (width < 8) return;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("clearance", {static_cast<float>(width), height});
    ui.mark_only("query.clearance");
    const bool hovered = ImGui::IsItemHovered();
    const bool active = ImGui::IsItemActive();

    const mobb::Interval time = time_span(ui.workspace);
    const float right = at.x + static_cast<float>(width);
    ChartArea chart{at, {right, at.y + height - label}, time, {time.t0, time.t1, at.x, right}};
    const std::vector<ValueColumn>& columns = clearance_.of(
        queries.findings(), {width, 0}, [&] { return columns_of(clearance, chart.time.t0, chart.time.t1, width); });
    const BodyDistances* measured = bodies.of(queries.findings());
    double most = 0, low = std::min(0.0, least.clearance);
    for (const ValueColumn& column : columns) {
        if (column.any) most = std::max(most, column.most);
    }
    if (measured) {
        for (const BodyStep& step : measured->steps) {
            most = std::max(most, step.nearest.distance);
            low = std::min(low, step.nearest.distance);
        }
    }
    const double range = std::max(most - low, 1e-3);
    chart.y = {low - 0.12 * range, most + 0.08 * range, chart.max.y, chart.min.y};

    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(chart.min, chart.max, ui.style.raised);
    if (measured) draw_measured_times(ui, chart, *measured);
    const float zero = chart.y.pixel(0);
    dashed_line(list, {chart.min.x, zero}, {chart.max.x, zero}, mark_color(ui.style, EventMark::hit), ui.style.scale,
                ui.px(3));
    const Rect area{{chart.min.x, chart.min.y}, {chart.max.x, chart.max.y}};
    height_lines(ui, area, chart.y, " m", false, 0.0);
    draw_curve(list, ui.style, chart, columns);
    if (measured) draw_bodies(ui, chart, *measured);
    text_over(ui, area, {chart.min.x + ui.px(3), zero - label}, mark_text(ui.style, EventMark::hit), "contact");
    least_mark(list, ui.style, chart, least);
    ruler(ui, *ui.style.caption, chart.x, chart.max.y, " s");
    if (const auto& focus = ui.workspace.look.focus.time) {
        list.AddRectFilled({chart.x.pixel(std::max(focus->t0, time.t0)), chart.min.y},
                           {chart.x.pixel(std::min(focus->t1, time.t1)), chart.max.y},
                           to_im(with_alpha(ui.style.palette.accent, 0.2f)));
    }
    if (const auto& now = ui.workspace.view().time; now && *now >= time.t0 && *now <= time.t1) {
        list.AddLine({chart.x.pixel(*now), chart.min.y}, {chart.x.pixel(*now), chart.max.y}, ui.style.accent,
                     ui.px(1.5f));
    }
    if (measured) chart_legend(ui, measured->bone_radius);
    if (!hovered && !active) return;
    const double t = std::clamp(chart.x.value(ImGui::GetIO().MousePos.x), chart.time.t0, chart.time.t1);
    if (const ClearancePiece* piece = piece_at(clearance, t)) {
        const BodyStep* step = measured ? step_at(*measured, t) : nullptr;
        ImGui::SetTooltip("%s: %s m\nsample %d of %s, sample %d of %s%s", with_unit(t, "s").c_str(),
                          signed_metres(clearance_at(*piece, t)).c_str(), piece->a_sample,
                          findings.sides[0].label.c_str(), piece->b_sample, findings.sides[1].label.c_str(),
                          step ? bones_line(findings, step->nearest).c_str() : "");
    } else {
        ImGui::SetTooltip("%s: only one of them is present", with_unit(t, "s").c_str());
    }
    if (!active) return;
    const double from = std::clamp(chart.x.value(ImGui::GetIO().MouseClickedPos[0].x), chart.time.t0, chart.time.t1);
    if (!ImGui::GetIO().KeyShift) {
        if (ui.workspace.view().time != t) ui.invoke("time.at", formatted("%.17g", t));
    } else if (from != t) {
        ui.invoke("focus.time", formatted("%.17g:%.17g", std::min(from, t), std::max(from, t)));
    }
}

}  // namespace mobbscope::app
