/// Charts with invented numbers.
#pragma once

#include <render/pictures/chart_picture.h>

#include <cmath>
#include <string>

namespace mobbscope {
inline namespace testing {

/// What a query costs with four trees over the leaf size.
inline Chart small_chart() {
    Chart chart{
        .title = "Cost of a query over the leaf size: crossing.json",
        .caption = "12,000 standard placements within 61.4 m\u00B2 and \u00B14.2 s, seed 1; bars: standard error",
        .x = {.name = "leaf size", .unit = "samples", .scale = Chart::Scale::factors},
        .y = {.name = "cost of a query", .unit = "ns", .from_zero = true},
        .series = {},
        .marks = {{.text = "now: MOBB, leaf 10", .x = 10, .y = 938.0},
                  {.text = "recommended: moving, leaf 40", .x = 40, .y = 655.0, .recommended = true}}};
    const struct {
        std::string name;
        double level, curve, best;
    } trees[] = {{"MOBB", 800, 380, 35}, {"UMOBB", 1010, 500, 60}, {"moving", 655, 420, 40}, {"aabb", 1040, 350, 45}};
    for (const auto& tree : trees) {
        Chart::Series series{.name = tree.name, .points = {}};
        for (const double leaf : {1.0, 2.0, 3.0, 5.0, 8.0, 10.0, 13.0, 20.0, 40.0, 60.0, 100.0, 200.0}) {
            const double away = std::log10(leaf / tree.best);
            double cost = tree.level + tree.curve * away * away * (away < 0 ? 1 : 1.4);
            if (tree.name == "MOBB" && leaf == 10) cost = 938;
            series.points.push_back({leaf, std::round(cost), 45});
        }
        chart.series.push_back(series);
    }
    return chart;
}

/// Volume by level over the time scale, and the present one.
inline Chart small_level_chart() {
    Chart chart{.title = "Volume by level over the time scale",
                .caption = "UMOBB, leaf 10",
                .x = {.name = "time scale w", .unit = "m/s", .scale = Chart::Scale::factors},
                .y = {.name = "volume", .unit = "m\u00B2\u00B7s", .scale = Chart::Scale::factors},
                .series = {},
                .marks = {{.text = "now: 1 m/s", .x = 1}},
                .colors = Chart::Colors::sequence};
    for (int level = 0; level < 8; ++level) {
        Chart::Series series{.name = "level " + std::to_string(level), .points = {}};
        for (int i = 0; i <= 12; ++i) {
            const double w = std::round(1000 * 0.1 * std::pow(300.0, i / 12.0)) / 1000;
            const double away = std::log10(w / (0.5 + 0.5 * level));
            series.points.push_back({w, std::round(10 * 5000 * std::pow(0.6, level) * (1 + away * away)) / 10});
        }
        chart.series.push_back(series);
    }
    return chart;
}

}  // namespace testing
}  // namespace mobbscope
