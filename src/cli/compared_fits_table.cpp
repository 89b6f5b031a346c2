#include <base/text.h>
#include <cli/columns.h>
#include <cli/compared_fits_table.h>
#include <cli/options.h>
#include <explain/tree_cost.h>
#include <scene/scene_json.h>

#include <cstddef>
#include <iostream>
#include <optional>
#include <utility>

namespace mobbscope::cli {

namespace {

/// Of the levels, of the leaves where fits end at different levels, and of a query as a whole.
struct ComparedRow {
    std::string name;
    const ComparedLevel* level = nullptr;  ///< null: the query's
};

std::vector<ComparedRow> compared_rows(const ComparedFits& fits) {
    std::vector<ComparedRow> out;
    for (const ComparedLevel& level : fits.levels) out.push_back({std::to_string(level.level), &level});
    if (fits.differ_in_depth()) out.push_back({"leaves", &fits.leaves});
    out.push_back({"all", nullptr});
    return out;
}

/// A star stands before the best.
std::string compared_cell(const ComparedFigure* figure_of, std::size_t fit, double in_unit) {
    if (!figure_of || !figure_of->values[fit]) return figure_of ? "-" : "";
    return (figure_of->best == static_cast<int>(fit) ? "* " : "") + figure(*figure_of->values[fit] * in_unit, 3);
}

std::string compared_difference(const ComparedFigure* figure_of, std::size_t fit) {
    const std::optional<double> by = figure_of ? figure_of->difference(fit) : std::nullopt;
    return by ? formatted("%+.1f", 100 * *by) : "";
}

void write_compared_figure(JsonWriter& out, const char* name, const ComparedFigure& of) {
    out.begin_object(name, JsonWriter::Layout::row);
    out.values("values", of.values);
    out.member("best", of.best < 0 ? std::nullopt : std::optional(of.best));
    out.end_object();
}

void write_compared_level(JsonWriter& out, const ComparedLevel& level) {
    out.begin_object();
    if (level.level >= 0) out.member("level", level.level);
    write_compared_figure(out, "volume", level.volume);
    write_compared_figure(out, "fill", level.fill);
    if (level.level >= 0) write_compared_figure(out, "cost", level.cost);
    out.end_object();
}

}  // namespace

ClipComparison comparison_of(const std::string& clip, const mobb::ClipPtr& samples,
                             std::span<const mobb::FitOptions> fits, std::size_t most) {
    ClipComparison out{clip, {}, {}};
    std::vector<std::shared_ptr<const TreeCost>> costs;
    for (const mobb::FitOptions& fit : fits) {
        out.trees.push_back(std::make_shared<const mobb::Tree>(samples, fit));
        costs.push_back(standard_cost(out.trees.back(), most, tell("counted", "placements")));
    }
    out.fits = compared(out.trees, costs);
    return out;
}

void print_compared_fits(const ClipComparison& of) {
    const ComparedFits& fits = of.fits;
    std::cout << cleaned(of.clip) << ": " << verdict(fits) << '\n';
    const std::vector<ComparedRow> rows = compared_rows(fits);
    std::vector<Column> columns{{"level"}};
    for (const ComparedRow& row : rows) columns.back().push_back(row.name);
    const auto add = [&](const std::string& heading, auto cell_of) {
        Column column{heading};
        for (const ComparedRow& row : rows) column.push_back(cell_of(row));
        columns.push_back(std::move(column));
    };
    const std::size_t count = fits.names.size();
    for (std::size_t fit = 0; fit < count; ++fit) {
        const std::string& name = fits.names[fit];
        add(name + " m^2*s",
            [&](const ComparedRow& row) { return compared_cell(row.level ? &row.level->volume : nullptr, fit, 1); });
        if (fit > 0)
            add("+- %", [&](const ComparedRow& row) {
                return compared_difference(row.level ? &row.level->volume : nullptr, fit);
            });
        add("fill %",
            [&](const ComparedRow& row) { return compared_cell(row.level ? &row.level->fill : nullptr, fit, 100); });
        const auto cost = [&](const ComparedRow& row) {
            return !row.level ? &fits.cost : row.level->level < 0 ? nullptr : &row.level->cost;
        };
        add("ns", [&](const ComparedRow& row) { return compared_cell(cost(row), fit, 1); });
        if (fit > 0) add("+- %", [&](const ComparedRow& row) { return compared_difference(cost(row), fit); });
    }
    print_columns(columns, true);
}

void write_compared_fits(JsonWriter& out, const ClipComparison& of) {
    out.begin_object();
    out.members("clip", of.clip, "verdict", verdict(of.fits));
    out.begin_array("fits");
    for (std::size_t fit = 0; fit < of.trees.size(); ++fit) {
        out.begin_object();
        out.member("name", of.fits.names[fit]);
        out.key("fit");
        write_fit(out, of.trees[fit]->options());
        out.end_object();
    }
    out.end_array();
    out.list("levels", of.fits.levels, [&](const ComparedLevel& level) { write_compared_level(out, level); });
    out.key("leaves");
    write_compared_level(out, of.fits.leaves);
    write_compared_figure(out, "cost", of.fits.cost);
    out.end_object();
}

}  // namespace mobbscope::cli
