#include <cli/command_line.h>
#include <cli/options.h>
#include <cli/program.h>
#include <explain/level_columns.h>
#include <explain/tree_json.h>

#include <algorithm>
#include <iostream>
#include <string>
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
    const std::vector<mobb::LevelFigures> levels = mobb::level_figures(tree);
    std::vector<std::string> lines(1 + levels.size(), " ");
    for (const mobb::LevelColumn& column : mobb::kLevelColumns) {
        std::vector<std::string> cells{std::string(column.name) + level_unit(column)};
        for (const mobb::LevelFigures& figures : levels) cells.push_back(level_text(column, figures));
        const std::size_t width = std::ranges::max(cells, {}, &std::string::size).size();
        const std::string gap(&column == &mobb::kLevelColumns.front() ? 1 : 3, ' ');
        for (std::size_t i = 0; i < lines.size(); ++i) {
            lines[i] += gap + std::string(width - cells[i].size(), ' ') + cells[i];
        }
    }
    for (const std::string& line : lines) std::cout << line << '\n';
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
    program.add_subcommand("fit", "Fit a tree to every clip and show how tight its levels are", add_options_of_fit,
                           run_fit);
}

}  // namespace mobbscope::cli
