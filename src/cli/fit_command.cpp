#include <cli/command_line.h>
#include <cli/options.h>
#include <cli/program.h>
#include <explain/expected_cost.h>
#include <explain/fit_findings.h>
#include <explain/level_columns.h>
#include <explain/tree_json.h>

#include <algorithm>
#include <cstddef>
#include <iostream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::cli {

namespace {

void print_json(const FittedScene& fitted) {
    JsonWriter out(std::cout);
    out.begin_object();
    out.begin_array("trees");
    for (int i = 0; i < static_cast<int>(fitted.scene().clips.size()); ++i) {
        write_tree(out, fitted.scene().clips[static_cast<std::size_t>(i)].name, fitted.tree(i));
    }
    out.end_array();
    out.end_object();
}

/// "against itself: 1.56 box tests and 0.768 sample pairs expected, 29 ns (shift over 25.6 m^2, start within +-2 s)"
std::string expected_words(const ExpectedCost& expected) {
    return "against itself: " + figure(expected.tests.boxes(), 3) + " box tests and " +
           figure(expected.tests[mobb::TestKind::samples], 3) + " sample pairs expected, " +
           figure(cost_of(expected.tests), 3) + " ns (shift over " + figure(expected.placements.area(), 3) +
           " m^2, start within +-" + brief(expected.placements.offset) + " s)";
}

/// A heading, and under it a cell for each level.
using Column = std::vector<std::string>;

void print_columns(const std::vector<Column>& columns) {
    std::vector<std::string> lines(columns.front().size(), " ");
    for (const Column& cells : columns) {
        const std::size_t width = std::ranges::max(cells, {}, &std::string::size).size();
        const std::string gap(&cells == &columns.front() ? 1 : 3, ' ');
        for (std::size_t i = 0; i < lines.size(); ++i) {
            lines[i] += gap + std::string(width - cells[i].size(), ' ') + cells[i];
        }
    }
    for (const std::string& line : lines) std::cout << line << '\n';
}

void print_levels(const mobb::Tree& tree, const std::optional<ExpectedCost>& expected) {
    const std::vector<mobb::LevelFigures> levels = mobb::level_figures(tree);
    std::vector<Column> columns;
    for (const mobb::LevelColumn& column : mobb::kLevelColumns) {
        columns.push_back({std::string(column.name) + level_unit(column)});
        for (const mobb::LevelFigures& figures : levels) columns.back().push_back(level_text(column, figures));
    }
    if (expected) {
        Column tests{"box tests"}, cost{"cost %"};
        for (std::size_t i = 0; i < levels.size(); ++i) {
            const MeanTests at = i < expected->levels.size() ? expected->levels[i] : MeanTests();
            tests.push_back(figure(at.boxes(), 3));
            cost.push_back(figure(100 * cost_of(at) / cost_of(expected->tests), 3));
        }
        columns.push_back(std::move(tests));
        columns.push_back(std::move(cost));
    }
    print_columns(columns);
}

void print_tree(const std::string& clip, const mobb::Tree& tree) {
    const mobb::FitOptions& options = tree.options();
    std::cout << cleaned(clip) << ": " << counted(tree.clip().count(), "sample", "samples") << " in "
              << brief(tree.clip().duration()) << " s; " << mobb::name(options.tree) << " tree of "
              << counted(tree.nodes().size(), "node", "nodes");
    const mobb::TreeInfo& kind = mobb::info(options.tree);
    std::string said;
    const auto say = [&said](const std::string& what) { said += (said.empty() ? " (" : ", ") + what; };
    if (kind.splits()) say("leaf " + std::to_string(options.leaf));
    if (kind.chooses_axes()) say("axes " + std::string(mobb::name(options.axes)));
    if (kind.uses_time_scale()) say("time scale " + brief(options.time_scale) + " m/s");
    std::cout << said << (said.empty() ? "\n" : ")\n");
    const std::optional<ExpectedCost> expected = expected_cost(tree, tree);
    if (expected) std::cout << "  " << expected_words(*expected) << '\n';
    print_levels(tree, expected);
    for (const FitFinding& found : fit_findings(tree, expected)) std::cout << "  notice: " << found.text << '\n';
}

void print_trees(const FittedScene& fitted) {
    for (int i = 0; i < static_cast<int>(fitted.scene().clips.size()); ++i) {
        print_tree(fitted.scene().clips[static_cast<std::size_t>(i)].name, fitted.tree(i));
    }
}

void run_fit(const FittedArguments& arguments) {
    const FittedScene scene = fitted(load(arguments.file, arguments.import_options), arguments.fit);
    arguments.json ? print_json(scene) : print_trees(scene);
    flush_results();
}

void add_options_of_fit(Command& command, FittedArguments& arguments) {
    add_fitted_options(command, arguments, "Levels and nodes as JSON");
}

}  // namespace

void add_fit_command(Command& program) {
    program.add_subcommand("fit", "Fit a tree to every clip and show how tight its levels are, and what they cost",
                           add_options_of_fit, run_fit);
}

}  // namespace mobbscope::cli
