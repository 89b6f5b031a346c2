#include <render/pictures/sweep_chart.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>

namespace mobbscope {

namespace {

enum class Over { leaf, time_scale };

bool matters(Over over, mobb::TreeKind kind) {
    return over == Over::leaf ? mobb::info(kind).splits() : mobb::info(kind).uses_time_scale();
}

double value_of(Over over, const mobb::FitOptions& fit) {
    return over == Over::leaf ? static_cast<double>(fit.leaf) : fit.time_scale;
}

bool varies(Over over, const SweepResult& result) {
    const double first = value_of(over, result.rows.front().fit);
    return std::ranges::any_of(result.rows, [&](const SweepRow& row) {
        return matters(over, row.fit.tree) && value_of(over, row.fit) != first;
    });
}

/// Of blocks nothing is estimated, and trees of one level have no leaves of some size.
bool is_drawn(const SweepResult& result, const SweepRow& row) {
    return row.estimate && row.fit.levels == result.order.present.levels;
}

/// Kinds have the same colours in all charts.
Chart::Series series_of(mobb::TreeKind kind) {
    return {std::string(mobb::info(kind).label), {}, static_cast<std::size_t>(kind)};
}

}  // namespace

SweepChart sweep_chart(const SweepResult& result, std::optional<std::size_t> now) {
    SweepChart out;
    const Over over = !varies(Over::leaf, result) && varies(Over::time_scale, result) ? Over::time_scale : Over::leaf;
    out.chart.x = over == Over::leaf ? Chart::Axis{"samples of a leaf", "", Chart::Scale::factors}
                                     : Chart::Axis{"time scale", "m/s", Chart::Scale::factors};
    out.chart.y = {"estimated", std::string(kEstimatedUnit), Chart::Scale::factors};
    // By kind and value the cheapest row.
    std::map<mobb::TreeKind, std::map<double, std::size_t>> cheapest;
    double least = value_of(over, result.rows.front().fit), most = least;
    for (std::size_t i = 0; i < result.rows.size(); ++i) {
        const SweepRow& row = result.rows[i];
        if (!is_drawn(result, row)) continue;
        const double value = matters(over, row.fit.tree) ? value_of(over, row.fit) : 0;
        if (value > 0) {
            least = std::min(least, value);
            most = std::max(most, value);
        }
        const auto at = cheapest[row.fit.tree].try_emplace(value, i).first;
        if (row.estimate->cost.mean < result.rows[at->second].estimate->cost.mean) at->second = i;
    }
    for (const auto& [kind, rows] : cheapest) {
        Chart::Series series = series_of(kind);
        out.rows.emplace_back();
        const auto add = [&](double value, std::size_t row) {
            series.points.push_back({value, result.rows[row].estimate->cost.mean});
            out.rows.back().push_back(row);
        };
        for (const auto& [value, row] : rows) {
            if (value > 0) {
                add(value, row);
            } else {
                add(least, row);
                add(most, row);
            }
        }
        out.chart.series.push_back(std::move(series));
    }
    const auto mark = [&](const char* text, std::size_t row, bool recommended) {
        if (!is_drawn(result, result.rows[row])) return;
        const mobb::FitOptions& fit = result.rows[row].fit;
        out.chart.marks.push_back({text, matters(over, fit.tree) ? value_of(over, fit) : std::sqrt(least * most),
                                   result.rows[row].estimate->cost.mean, recommended});
    };
    const std::optional<std::size_t> best = result.of(Protocol::warm).recommended;
    if (now && now != best) mark("now", *now, false);
    if (best) mark(now == best ? "now, and best" : "best", *best, true);
    return out;
}

Chart time_scale_chart(const std::vector<LevelCurve>& curves, std::size_t level, CurveOf of) {
    Chart out;
    out.x = {"time scale", "m/s", Chart::Scale::factors};
    out.y = of == CurveOf::volume ? Chart::Axis{"volume of level " + std::to_string(level), "m\u00B2\u00B7s"}
                                  : Chart::Axis{"expected on level " + std::to_string(level), "ns a query"};
    out.y.from_zero = true;
    double least = 0, most = 0;
    for (const LevelCurve& curve : curves) {
        if (!mobb::info(curve.fit.tree).uses_time_scale()) continue;
        least = least == 0 ? curve.fit.time_scale : std::min(least, curve.fit.time_scale);
        most = std::max(most, curve.fit.time_scale);
    }
    for (const LevelCurve& curve : curves) {
        const LevelCurve::Level& at = curve.levels[std::min(level, curve.levels.size() - 1)];
        const double value = of == CurveOf::volume ? at.volume : at.cost;
        Chart::Series series = series_of(curve.fit.tree);
        if (!mobb::info(curve.fit.tree).uses_time_scale()) {
            series.points = {{least, value}, {most, value}};
            out.series.push_back(std::move(series));
            continue;
        }
        if (out.series.empty() || out.series.back().name != series.name) out.series.push_back(std::move(series));
        out.series.back().points.push_back({curve.fit.time_scale, value});
    }
    return out;
}

}  // namespace mobbscope
