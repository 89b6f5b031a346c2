#include <app/panels/panels.h>
#include <app/ui/swatch.h>
#include <app/ui/widgets.h>
#include <base/text.h>
#include <render/text/labels.h>
#include <scene/drawn_agent.h>
#include <scene/fit_text.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::app {

namespace {

// Pixels at scale 1.
constexpr float kChart = 150;
constexpr float kPoint = 2.2f;
constexpr float kNear = 14;  // of the mouse to a point
constexpr float kLeastLabels = 40;

constexpr double kHighest = 3;  // costs, as multiples of the least, that the chart shows
constexpr int kRows = 6;        // of the list below it

Rgba color_of(mobb::TreeKind kind) { return palette_color(static_cast<int>(kind)); }

/// The cheapest fits of a kind, by the samples of their leaves; of a kind without leaves one.
struct KindLine {
    mobb::TreeKind kind;
    std::vector<std::size_t> rows;
};

std::vector<KindLine> lines_of(const SweepResult& result) {
    std::map<mobb::TreeKind, std::map<int, std::size_t>> best;
    for (std::size_t i = 0; i < result.rows.size(); ++i) {
        const SweepRow& row = result.rows[i];
        const int leaf = mobb::info(row.fit.tree).splits() ? row.fit.leaf : 0;
        const auto at = best[row.fit.tree].try_emplace(leaf, i).first;
        if (row.cost.mean < result.rows[at->second].cost.mean) at->second = i;
    }
    std::vector<KindLine> out;
    for (const auto& [kind, by_leaf] : best) {
        out.push_back({kind, {}});
        for (const auto& [leaf, row] : by_leaf) out.back().rows.push_back(row);
    }
    return out;
}

/// "938 ns"
std::string cost_text(double cost) { return figure(cost, 3) + " ns"; }

/// "-30 %", to the present fit
std::string change_text(const SweepResult& result, const SweepRow& row) {
    const double change = 100 * (row.cost.mean / result.rows[result.present].cost.mean - 1);
    return formatted("%+.*f %%", std::abs(change) < 9.95 ? 1 : 0, change);
}

void tell_row(const SweepResult& result, const SweepRow& row) {
    std::string text = sweep_words(row.fit, result.order.present) + '\n';
    text += cost_text(row.cost.mean) + " a query, \u00B1 " + figure(row.cost.standard_error, 2) + ", over " +
            counted(result.queries, "query", "queries") + '\n';
    text += figure(row.tests.boxes(), 3) + " box tests, " + figure(row.tests[mobb::TestKind::samples], 3) +
            " sample pairs, " + figure(row.tests[mobb::TestKind::time], 3) + " tests of time\n";
    if (row.cost.max > 0) {
        text += "95 % of queries cost at most " + cost_text(row.cost.p95) + ", 99 % " + cost_text(row.cost.p99) +
                ", all " + cost_text(row.cost.max) + '\n';
    }
    if (!result.why.empty() && &row != &result.rows[result.recommended]) {
        text += formatted("%+.3g", row.difference) + " ns to the recommended one, \u00B1 " +
                figure(row.difference_error, 2) + " (standard error of the paired difference)\n";
    }
    text += counted(row.nodes, "node", "nodes") + ", " + figure(static_cast<double>(row.bytes) / 1024, 3) + " KiB\n";
    ImGui::SetTooltip("%sclick to fit the trees so", text.c_str());
}

void apply(const Ui& ui, const SweepRow& row) {
    ui.invoke("tree.fit", fit_text(row.fit, ui.workspace.fitted().options()));
}

/// Costs of all kinds over the samples of a leaf.
class SweepChart {
  public:
    SweepChart(Ui& ui, const SweepResult& result)
        : ui_(ui), result_(result), list_(*ImGui::GetWindowDrawList()), font_(*ui.style.caption) {
        std::vector<KindLine> lines = lines_of(result);
        double least = result.rows.front().cost.mean, most = 0;
        int longest = 2;
        for (const SweepRow& row : result.rows) least = std::min(least, row.cost.mean);
        for (const KindLine& line : lines) {
            for (const std::size_t i : line.rows) {
                const SweepRow& row = result.rows[i];
                most = std::max(most, std::min(row.cost.mean, kHighest * least));
                if (mobb::info(line.kind).splits()) longest = std::max(longest, row.fit.leaf);
            }
        }
        lines_ = std::move(lines);
        const float width = std::max(1.0f, ImGui::GetContentRegionAvail().x);
        min_ = ImGui::GetCursorScreenPos();
        float labels = ui.px(kLeastLabels);
        for (const KindLine& line : lines_) labels = std::max(labels, text_size(font_, label(line)).x);
        max_ = {min_.x + std::max(ui.px(60), width - labels - ui.px(8)), min_.y + ui.px(kChart)};
        x_ = {0, std::log(static_cast<double>(longest)), min_.x + ui.px(6), max_.x};
        const double room = 0.1 * std::max(most - least, 0.05 * least);
        y_ = {least - 2 * room, most + room, max_.y, min_.y};
        ImGui::InvisibleButton("sweep chart", {width, ui.px(kChart) + font_.FontSize + ui.px(6)});
        ui.mark_only("sweep.chart");
        hovered_ = ImGui::IsItemHovered();
        clicked_ = ImGui::IsItemClicked();
    }

    void draw() {
        list_.AddRectFilled(min_, max_, ui_.style.raised);
        draw_scales();
        list_.PushClipRect(min_, max_, true);
        for (const KindLine& line : lines_) draw_line(line);
        draw_marked(result_.present, ui_.style.text, "now");
        if (!result_.why.empty() && result_.recommended != result_.present)
            draw_marked(result_.recommended, ui_.style.accent, "best");
        list_.PopClipRect();
        draw_labels();
        point_at_mouse();
    }

  private:
    static std::string label(const KindLine& line) { return std::string(mobb::info(line.kind).label); }

    ImVec2 place_of(std::size_t i) const {
        const SweepRow& row = result_.rows[i];
        // A kind without leaves is a line across; it is pointed at its right end.
        const bool splits = mobb::info(row.fit.tree).splits();
        return {splits ? x_.pixel(std::log(static_cast<double>(row.fit.leaf))) : x_.last, y_.pixel(row.cost.mean)};
    }

    void draw_scales() const {
        const auto height_of = [&](const std::string&) { return 2 * font_.FontSize; };
        const double step = ruler_step(y_.from, y_.to, y_.first - y_.last, height_of);
        for (const double cost : ticks(y_.from, y_.to, step)) {
            const float y = std::floor(y_.pixel(cost));
            if (y - font_.FontSize < min_.y) continue;
            list_.AddLine({min_.x, y}, {max_.x, y}, ui_.style.border, ui_.px(1));
            draw_text(list_, font_, {min_.x + ui_.px(3), y - font_.FontSize}, ui_.style.quiet,
                      tick_text(cost, step) + " ns");
        }
        constexpr std::array kLeaves{1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000};
        float free = min_.x;
        for (const int leaf : kLeaves) {
            const float x = x_.pixel(std::log(static_cast<double>(leaf)));
            const std::string text = std::to_string(leaf);
            const float half = 0.5f * text_size(font_, text).x;
            if (x > max_.x + 1 || x - half < free) continue;
            list_.AddLine({x, max_.y}, {x, max_.y + ui_.px(3)}, ui_.style.quiet, ui_.px(1));
            draw_text(list_, font_, {x - half, max_.y + ui_.px(4)}, ui_.style.quiet, text);
            free = x + half + ui_.px(8);
        }
        const char* name = "samples a leaf";
        if (const float at = max_.x + ui_.px(10); free < at)
            draw_text(list_, font_, {at, max_.y + ui_.px(4)}, ui_.style.quiet,
                      fitted_text(name, ImGui::GetItemRectMax().x - at));
    }

    void draw_line(const KindLine& line) const {
        const ImU32 color = to_im(color_of(line.kind));
        if (!mobb::info(line.kind).splits()) {
            const float y = place_of(line.rows.front()).y;
            dashed_line(list_, {min_.x, y}, {max_.x, y}, color, ui_.px(1.5f), ui_.px(4));
            return;
        }
        std::vector<ImVec2> points;
        for (const std::size_t i : line.rows) points.push_back(place_of(i));
        list_.AddPolyline(points.data(), static_cast<int>(points.size()), color, 0, ui_.px(1.5f));
        for (const ImVec2 point : points) list_.AddCircleFilled(point, ui_.px(kPoint), color);
    }

    void draw_marked(std::size_t row, ImU32 color, const char* word) const {
        const ImVec2 at = place_of(row);
        list_.AddCircle(at, ui_.px(5), color, 0, ui_.px(1.6f));
        const ImVec2 size = text_size(font_, word);
        const float x = std::clamp(at.x - 0.5f * size.x, min_.x + 2, max_.x - size.x - 2);
        const bool above = at.y - ui_.px(7) - size.y > min_.y;
        draw_text(list_, font_, {x, above ? at.y - ui_.px(7) - size.y : at.y + ui_.px(6)}, color, word);
    }

    /// Behind the ends of the lines, none over another.
    void draw_labels() const {
        std::vector<std::pair<float, const KindLine*>> ends;
        for (const KindLine& line : lines_)
            ends.emplace_back(std::clamp(place_of(line.rows.back()).y, min_.y, max_.y), &line);
        std::ranges::sort(ends, {}, &std::pair<float, const KindLine*>::first);
        const float height = font_.FontSize;
        float low = max_.y + 0.5f * height;  // the lowest may reach to here
        std::vector<float> tops(ends.size());
        for (std::size_t i = ends.size(); i-- > 0;) {
            tops[i] = std::min(ends[i].first - 0.5f * height, low - height);
            low = tops[i];
        }
        float high = min_.y - 0.5f * height;
        for (std::size_t i = 0; i < ends.size(); ++i) {
            tops[i] = std::max(tops[i], high);
            high = tops[i] + height;
            draw_text(list_, font_, {max_.x + ui_.px(5), tops[i]},
                      to_im(readable(color_of(ends[i].second->kind), ui_.style.palette)), label(*ends[i].second));
        }
    }

    /// The point next to the mouse tells of its fit, and a click applies it.
    void point_at_mouse() {
        std::optional<std::size_t> nearest;
        float least = ui_.px(kNear);
        for (const KindLine& line : lines_) {
            for (const std::size_t i : line.rows) {
                const ImVec2 at = place_of(i);
                ui_.marks.add("sweep.point." + std::to_string(i),
                              {{at.x - ui_.px(2), at.y - ui_.px(2)}, {at.x + ui_.px(2), at.y + ui_.px(2)}});
                const ImVec2 mouse = ImGui::GetIO().MousePos;
                const float away = std::hypot(at.x - mouse.x, at.y - mouse.y);
                if (away < least) least = away, nearest = i;
            }
        }
        if (!hovered_ || !nearest) return;
        const ImVec2 at = place_of(*nearest);
        list_.AddCircle(at, ui_.px(5), ui_.style.text, 0, ui_.px(1));
        tell_row(result_, result_.rows[*nearest]);
        if (clicked_) apply(ui_, result_.rows[*nearest]);
    }

    Ui& ui_;
    const SweepResult& result_;
    ImDrawList& list_;
    const ImFont& font_;
    std::vector<KindLine> lines_;
    ImVec2 min_, max_;
    ChartAxis x_;  ///< logarithm of the samples
    ChartAxis y_;  ///< ns
    bool hovered_ = false, clicked_ = false;
};

/// The cheapest fits, a row each.
void best_rows(Ui& ui, const SweepResult& result) {
    std::vector<std::size_t> order(result.rows.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return result.rows[i].cost.mean; });
    order.resize(std::min<std::size_t>(order.size(), kRows));
    if (std::ranges::find(order, result.present) == order.end()) order.push_back(result.present);
    const mobb::FitOptions& now = ui.workspace.fitted().options();
    rows(ui, "sweep rows", static_cast<int>(order.size()), kRows + 1, [&](int k) {
        const SweepRow& fit = result.rows[order[static_cast<std::size_t>(k)]];
        const std::string remark = cost_text(fit.cost.mean) + "  " + change_text(result, fit);
        if (row(ui, {.mark = "sweep.row." + std::to_string(k),
                     .name = sweep_words(fit.fit, result.order.present),
                     .remark = remark,
                     .selected = fit.fit == now}))
            apply(ui, fit);
        if (ImGui::IsItemHovered()) tell_row(result, fit);
    });
}

/// What is recommended, and the way to it.
void recommendation(Ui& ui, const SweepInspector::Shown& shown) {
    const SweepResult& result = *shown.rows;
    const bool keeps = result.recommended == result.present;
    framed(ui, to_im(with_alpha(ui.style.palette.separated, 0.14f)), to_im(ui.style.palette.separated), [&] {
        ImGui::PushFont(ui.style.title);
        const std::string name = sweep_words(result.rows[result.recommended].fit, result.order.present);
        words(to_im(readable(ui.style.palette.separated, ui.style.palette)), keeps ? "keep " + name : name);
        ImGui::PopFont();
        words(ui.style.text, result.why);
        ui.mark_only("sweep.why");
        command_button(ui, "Apply", "tree.sweep_apply", "sweep.apply");
    });
}

std::string workload_words(const SweepInspector::Shown& shown) {
    const std::string count = counted(shown.rows->queries, "query", "queries");
    if (shown.workload == QueryWorkload::Kind::queries) return count + " of this scene";
    return count + ": shift over " + figure(shown.area, 3) + " m\u00B2, start within \u00B1" + brief(shown.offset) +
           " s";
}

}  // namespace

void sweep_panel(Ui& ui, SweepInspector& sweeps) {
    if (ui.workspace.empty() || !section(ui, "WHICH TREE TO SHIP", "", true)) return;
    const auto shown = sweeps.result();
    if (shown && !shown->rows->why.empty() && sweeps.is_of_scene()) recommendation(ui, *shown);
    if (shown && !sweeps.is_of_scene()) {
        words(ui.style.warning, "The clips or queries have changed since these were tried.");
        ui.mark_only("sweep.stale");
    }
    if (shown && !shown->rows->rows.empty()) {
        SweepChart(ui, *shown->rows).draw();
        best_rows(ui, *shown->rows);
        words(ui.style.quiet, workload_words(*shown));
    } else if (!sweeps.is_running()) {
        words(ui.style.quiet,
              "Tries all kinds of trees with leaves of 1 to 200 samples on the same queries, and says which costs "
              "least.");
    }
    if (sweeps.is_running()) {
        command_button(ui, "Cancel", "tree.sweep_cancel", "sweep.cancel");
    } else {
        command_button(ui, shown ? "Try again" : "Try all", "tree.sweep", "sweep.start");
    }
    for (const auto& [command, label] :
         {std::pair("tree.sweep_axes", "axes"), {"tree.sweep_time_scale", "time scale"}}) {
        ImGui::SameLine(0, ui.px(10));
        bool on = find_command(command)->checked(ui.session);
        if (ImGui::Checkbox(label, &on)) ui.invoke(command);
        ui.mark(command);
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", std::string(find_command(command)->doc).c_str());
    }
}

}  // namespace mobbscope::app
