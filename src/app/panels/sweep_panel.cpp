#include <app/panels/panels.h>
#include <app/ui/overlay.h>
#include <app/ui/widgets.h>
#include <base/numbers_in_text.h>
#include <base/text.h>
#include <render/pictures/sweep_chart.h>
#include <scene/fit_text.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::app {

namespace {

// Pixels at scale 1.
constexpr float kChart = 190;
constexpr float kNearPoint = 14;  // of the mouse to a point

/// "UMOBB 34, minarea, 4 m/s": what matters to its kind and is not as in `base`, and the samples of a leaf.
std::string short_words(const mobb::FitOptions& fit, const mobb::FitOptions& base) {
    const mobb::TreeInfo& kind = mobb::info(fit.tree);
    std::string out(kind.label);
    if (kind.splits()) out += fit.levels == 1 ? " 1 level" : ' ' + std::to_string(fit.leaf);
    if (kind.chooses_axes() && fit.axes != base.axes) out += ", " + std::string(mobb::name(fit.axes));
    if (kind.uses_time_scale() && fit.time_scale != base.time_scale) out += ", " + brief(fit.time_scale) + " m/s";
    return out;
}

/// Whether there are times, and so advice. There are none in pictures that are to be the same each time.
bool has_times(const SweepResult& result) { return result.of(Protocol::warm).queries > 0; }

/// "938 ns"
std::string cost_text(double cost) { return figure(cost, 3) + " ns"; }

/// The row that the trees are fitted as now; none: that was not tried.
std::optional<std::size_t> row_of_now(const Ui& ui, const SweepResult& result) {
    const auto at = std::ranges::find(result.rows, ui.workspace.fitted().options(), &SweepRow::fit);
    if (at == result.rows.end()) return std::nullopt;
    return static_cast<std::size_t>(at - result.rows.begin());
}

std::string ns_text(const std::optional<FitTime>& time) { return time ? figure(time->ns, 3) : "-"; }

void tell_row(const SweepResult& result, const SweepRow& row) {
    std::string text = sweep_words(row.fit, result.order.present) + '\n';
    for (const Protocol protocol : kProtocols) {
        const std::optional<FitTime>& time = row.time(protocol);
        if (!time) continue;
        text += "measured, " + std::string(name(protocol)) + ": " + cost_text(time->ns) + " a query";
        if (std::isfinite(time->error)) text += ", \u00B1 " + figure(time->error, 2);
        text += '\n';
    }
    if (const std::optional<SweepEstimate>& estimate = row.estimate) {
        text += "estimated: " + cost_text(estimate->cost.mean) + " a query";
        if (result.queries > 1) text += ", \u00B1 " + figure(estimate->cost.standard_error, 2);
        text += ", over " + counted(result.queries, "query", "queries") + '\n';
        text += figure(estimate->tests.boxes(), 3) + " box tests, " +
                figure(estimate->tests[mobb::TestKind::samples], 3) + " sample pairs, " +
                figure(estimate->tests[mobb::TestKind::time], 3) + " tests of time\n";
        text += "95 % of queries cost at most " + cost_text(estimate->cost.p95) + ", 99 % " +
                cost_text(estimate->cost.p99) + ", all " + cost_text(estimate->cost.max) + '\n';
    } else {
        text += "not estimated: tests of blocks have no price\n";
    }
    text += counted(row.nodes, "node", "nodes") + ", " + bytes_text(row.bytes) + '\n';
    ImGui::SetTooltip("%s%s", text.c_str(), result.has_ended() ? "click to fit the trees so" : "sweeping");
}

void apply_row(const Ui& ui, const SweepRow& row) {
    ui.invoke("tree.fit", fit_text(row.fit, ui.workspace.fitted().options()));
}

/// A chart across the panel, and the names of its lines below it; returns where its points are, on the screen.
std::vector<std::vector<std::optional<ImVec2>>> draw_chart(Ui& ui, Chart chart, const std::string& mark) {
    chart.has_names = false;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const PictureSize size{std::max(8, static_cast<int>(ImGui::GetContentRegionAvail().x)),
                           static_cast<int>(ui.px(kChart))};
    const ChartPicture picture = chart_picture({chart}, size, ui.style.palette.dark ? Theme::dark : Theme::light,
                                               static_cast<double>(ui.style.scale));
    ImGui::InvisibleButton(mark.c_str(), {static_cast<float>(size.width), static_cast<float>(size.height)});
    ui.mark_only(mark);
    draw_overlay(ui, picture.list, at);
    std::vector<std::vector<std::optional<ImVec2>>> points;
    for (const auto& series : picture.points.front()) {
        points.emplace_back();
        for (const auto& point : series)
            points.back().push_back(point ? std::optional(ImVec2(at.x + point->x, at.y + point->y)) : std::nullopt);
    }
    return points;
}

/// Which line is which.
void series_names(Ui& ui, const Chart& chart) {
    ImGui::PushFont(ui.style.caption);
    const float side = ui.px(7), line = ImGui::GetTextLineHeight();
    for (std::size_t i = 0; i < chart.series.size(); ++i) {
        const std::string& name = chart.series[i].name;
        const Rgba color = series_color(chart, i, ui.style.palette);
        if (i > 0) flow(side + ui.px(12) + ImGui::CalcTextSize(name.c_str()).x);
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const float top = at.y + 0.5f * (line - side);
        ImGui::GetWindowDrawList()->AddRectFilled({at.x, top}, {at.x + side, top + side}, to_im(color), ui.px(2));
        ImGui::Dummy({side, line});
        ImGui::SameLine(0, ui.px(4));
        text_line(to_im(readable(color, ui.style.palette)), name);
    }
    ImGui::PopFont();
}

/// Estimated costs over the samples of a leaf. The point next to the mouse tells of its fit, and a click applies it.
void cost_chart(Ui& ui, const SweepResult& result) {
    const SweepChart chart = sweep_chart(result, row_of_now(ui, result));
    const auto points = draw_chart(ui, chart.chart, "sweep.chart");
    const bool hovered = ImGui::IsItemHovered(), clicked = ImGui::IsItemClicked();
    series_names(ui, chart.chart);
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    std::optional<std::size_t> nearest;
    ImVec2 nearest_at{};
    float least = ui.px(kNearPoint);
    for (std::size_t series = 0; series < chart.rows.size(); ++series) {
        for (std::size_t i = 0; i < chart.rows[series].size(); ++i) {
            if (!points[series][i]) continue;
            const ImVec2 there = *points[series][i];
            ui.marks.add("sweep.point." + std::to_string(chart.rows[series][i]),
                         {{there.x - 2, there.y - 2}, {there.x + 2, there.y + 2}});
            const float away = std::hypot(there.x - mouse.x, there.y - mouse.y);
            if (away >= least) continue;
            least = away;
            nearest = chart.rows[series][i];
            nearest_at = there;
        }
    }
    if (!hovered || !nearest) return;
    ImGui::GetWindowDrawList()->AddCircle(nearest_at, ui.px(6), ui.style.text, 0, ui.px(1.4f));
    tell_row(result, result.rows[*nearest]);
    if (clicked && result.has_ended()) apply_row(ui, result.rows[*nearest]);
}

/// The level that is shown, over the time scale.
void curves_chart(Ui& ui, const SweepInspector& sweeps, const std::vector<LevelCurve>& curves) {
    const LevelRange shown = ui.workspace.view().levels;
    std::size_t depth = 1;
    for (const LevelCurve& curve : curves) depth = std::max(depth, curve.levels.size());
    const std::size_t level = shown.leaves ? depth - 1 : static_cast<std::size_t>(std::max(0, shown.last));
    const Chart chart = time_scale_chart(curves, level, sweeps.shows_volume ? CurveOf::volume : CurveOf::cost);
    draw_chart(ui, chart, "sweep.curves");
    series_names(ui, chart);
    if (small_button(ui, sweeps.shows_volume ? "Show cost" : "Show volume", "sweep.curves_of",
                     "Volume or expected cost of the level that is shown, over the time scale"))
        ui.later([](SweepInspector& now) { now.shows_volume = !now.shows_volume; });
}

/// The fastest fit of each kind, the present one, and those that are told of: the fastest first. Before the end the
/// cheapest by the estimate.
std::vector<std::size_t> best_of_kinds(const SweepResult& result, std::size_t now) {
    const auto rank = [&](std::size_t i) {
        const SweepRow& row = result.rows[i];
        const std::optional<FitTime>& time = row.time(Protocol::warm);
        return std::pair(!time, time ? time->ns : row.estimate ? row.estimate->cost.mean : 0);
    };
    std::map<mobb::TreeKind, std::size_t> best;
    for (std::size_t i = 0; i < result.rows.size(); ++i) {
        const auto at = best.try_emplace(result.rows[i].fit.tree, i).first;
        if (rank(i) < rank(at->second)) at->second = i;
    }
    std::set<std::size_t> out{now};
    for (const auto& [kind, row] : best) out.insert(row);
    for (const SweepAdvice& advice : result.advice) {
        if (advice.recommended) out.insert(*advice.recommended);
        out.insert(advice.undecided.begin(), advice.undecided.end());
    }
    std::vector<std::size_t> sorted(out.begin(), out.end());
    std::ranges::stable_sort(sorted, {}, rank);
    return sorted;
}

void best_rows(Ui& ui, const SweepResult& result) {
    const std::vector<std::size_t> best = best_of_kinds(result, row_of_now(ui, result).value_or(result.present));
    const int count = static_cast<int>(best.size());
    heading(ui, "FIT", has_times(result) ? "WARM  COLD ns  MEMORY" : "ESTIMATED ns");
    rows(ui, "sweep rows", count, count, [&](int k) {
        const SweepRow& fit = result.rows[best[static_cast<std::size_t>(k)]];
        std::string remark;
        std::vector<double> exact;
        if (has_times(result)) {
            for (const Protocol protocol : kProtocols) {
                remark += formatted("%5s ", ns_text(fit.time(protocol)).c_str());
                if (fit.time(protocol)) exact.push_back(fit.time(protocol)->ns);
            }
            remark += formatted("%8s", bytes_text(fit.bytes).c_str());
            exact.push_back(static_cast<double>(fit.bytes));
        } else if (fit.estimate) {
            remark = figure(fit.estimate->cost.mean, 3);
            exact.push_back(fit.estimate->cost.mean);
        }
        if (row(ui, {.mark = "sweep.row." + std::to_string(k),
                     .name = short_words(fit.fit, result.order.present),
                     .remark = remark,
                     .selected = fit.fit == ui.workspace.fitted().options(),
                     .exact = exact}) &&
            result.has_ended())
            apply_row(ui, fit);
        if (ImGui::IsItemHovered()) tell_row(result, fit);
    });
}

/// The way to what is recommended. It stands above all words that change, so that it stays under the mouse.
void apply_buttons(Ui& ui, const SweepResult& result) {
    command_button(ui, "Apply", "tree.sweep_apply", "sweep.apply");
    const std::optional<std::size_t> cold = result.of(Protocol::cold).recommended;
    if (!cold || cold == result.of(Protocol::warm).recommended) return;
    ImGui::SameLine();
    if (ImGui::Button("Apply cold")) apply_row(ui, result.rows[*cold]);
    ui.mark("sweep.apply_cold");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("Fits the trees as is recommended for cold queries");
}

/// What is recommended where queries are asked so.
void recommendation(Ui& ui, const SweepResult& result, Protocol protocol) {
    const SweepAdvice& advice = result.of(protocol);
    const std::string mark = protocol == Protocol::warm ? "sweep.why" : "sweep.why_cold";
    framed(ui, to_im(with_alpha(ui.style.palette.separated, 0.14f)), to_im(ui.style.palette.separated), [&] {
        // "moving boxes, leaf 34: 70 ns +-1, 30 % less than MOBB, leaf 10 (now)" and ", over 4,096 placements; ..."
        std::string why = advice.why;
        const bool is_as_then = row_of_now(ui, result) == result.present;
        if (const std::size_t now = why.find(" (now)"); now != std::string::npos && !is_as_then)
            why.replace(now, 6, " (before)");
        const std::size_t end = std::min(why.find(", over "), why.size());
        words(ui.style.quiet, protocol == Protocol::warm ? "warm: what a query reads is in the caches"
                                                         : "cold: what a query reads is in no cache");
        const ImU32 color =
            advice.recommended ? to_im(readable(ui.style.palette.separated, ui.style.palette)) : ui.style.text;
        ImGui::PushFont(ui.style.title);
        words(ui, color, why.substr(0, end));
        ImGui::PopFont();
        ui.mark_only(mark);
        if (end < why.size()) words(ui, ui.style.text, why.substr(end + 2));
    });
}

std::string asked_words(const SweepInspector::Shown& shown) {
    const std::size_t queries = shown.rows->queries;
    const std::string count = grouped(queries) + (queries == 1 ? " query" : " queries");
    if (shown.workload == QueryWorkload::Kind::queries) return count + " of this scene";
    return count + ": shift over " + figure(shown.area, 3) + " m\u00B2, start within \u00B1" + brief(shown.offset) +
           " s";
}

}  // namespace

void sweep_panel(Ui& ui, SweepInspector& sweeps) {
    if (ui.workspace.empty()) return;
    // What it recommends is at the top of the section.
    if (sweeps.take_news()) ui.later([](Keys& keys) { keys.section = kSweepSection; });
    if (!section(ui, "WHICH TREE TO SHIP", "", true)) return;
    const auto shown = sweeps.result();
    if (!shown) {
        const bool placed = ui.workspace.workload() == QueryWorkload::Kind::placements;
        words(ui.style.quiet, std::string("Tries all kinds of trees with leaves of 1 to 200 samples on the same ") +
                                  (placed ? "standard placements of all clips" : "queries of this scene") +
                                  ", measures the best on this machine, and says which is fastest.");
    } else if (!sweeps.is_of_scene()) {
        words(ui.style.warning, "The clips or queries have changed since fits were tried.");
        ui.mark_only("sweep.stale");
    } else if (!shown->rows->rows.empty()) {
        if (has_times(*shown->rows)) {
            apply_buttons(ui, *shown->rows);
            for (const Protocol protocol : kProtocols) recommendation(ui, *shown->rows, protocol);
        } else if (shown->rows->has_ended()) {
            words(ui.style.quiet, "Not measured in a picture, which is the same each time: nothing is recommended.");
        }
        cost_chart(ui, *shown->rows);
        best_rows(ui, *shown->rows);
        words(ui, ui.style.quiet, asked_words(*shown), {shown->area, shown->offset});
        if (shown->curves) curves_chart(ui, sweeps, *shown->curves);
    }
    if (sweeps.is_running()) {
        command_button(ui, "Cancel", "tree.sweep_cancel", "sweep.cancel");
    } else {
        command_button(ui, shown ? "Try again" : "Try all", "tree.sweep", "sweep.start");
    }
    for (const auto& [command, label] :
         {std::pair("tree.sweep_axes", "axes"), {"tree.sweep_time_scale", "time scale"}}) {
        flow(ImGui::GetFrameHeight() + ui.px(4) + ImGui::CalcTextSize(label).x);
        bool on = find_command(command)->checked(ui.session);
        if (ImGui::Checkbox(label, &on)) ui.invoke(command);
        ui.mark(command);
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", std::string(find_command(command)->doc).c_str());
    }
}

}  // namespace mobbscope::app
