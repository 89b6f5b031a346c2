#include <base/error.h>
#include <cli/columns.h>
#include <cli/command_line.h>
#include <cli/compared_fits_table.h>
#include <cli/options.h>
#include <cli/program.h>
#include <explain/fit_findings.h>
#include <explain/level_columns.h>
#include <explain/node_values.h>
#include <explain/tree_cost.h>
#include <explain/tree_json.h>
#include <import/tracks/text_rows.h>
#include <scene/fit_text.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::cli {

namespace {

struct FitCommandArguments : FittedArguments {
    bool csv = false;
    std::vector<std::string> compare;  ///< fits
};

/// Counts what the trees of a scene cost, and says how far that is.
class ClipCosts {
  public:
    explicit ClipCosts(const FittedScene& fitted) : fitted_(fitted) {}

    std::shared_ptr<const TreeCost> of(int clip) const {
        const std::size_t clips = fitted_.scene().clips.size();
        const std::shared_ptr<const mobb::Tree>& tree = fitted_.shared_tree(clip);
        std::shared_ptr<const TreeCost> out = standard_cost(tree, most_counted(clips));
        told_(static_cast<std::size_t>(clip) + 1, clips);
        return out;
    }

  private:
    const FittedScene& fitted_;
    Progress told_ = tell("counted", "clips");
};

void print_json(const FittedScene& fitted) {
    JsonWriter out(std::cout);
    out.begin_object();
    out.begin_array("trees");
    const ClipCosts costs(fitted);
    for (int i = 0; i < static_cast<int>(fitted.scene().clips.size()); ++i) {
        const std::shared_ptr<const TreeCost> cost = costs.of(i);
        write_tree(out, fitted.scene().clips[static_cast<std::size_t>(i)].name, fitted.tree(i), cost.get());
    }
    out.end_array();
    out.end_object();
}

/// A row for each node; a cell of what there is none of is empty.
void print_csv(const FittedScene& fitted) {
    std::cout << "clip,tree,leaf,axes,time_scale,index,parent,level,first,count,is_leaf,kind,t0,t1,volume,tightness,"
                 "share,box_tests,empty,floor,overhang,waste\n";
    const ClipCosts costs(fitted);
    for (int clip = 0; clip < static_cast<int>(fitted.scene().clips.size()); ++clip) {
        const mobb::Tree& tree = fitted.tree(clip);
        const mobb::FitOptions& options = tree.options();
        const std::shared_ptr<const TreeCost> cost = costs.of(clip);
        const NodeValues values(fitted.shared_tree(clip), cost ? cost->shares : std::vector<double>());
        const auto figure_of = [&values](NodeField field, int node) {
            const double value = values.value(field, node);
            return std::isnan(value) ? std::string() : format_double(value);
        };
        const std::string name = csv_field(fitted.scene().clips[static_cast<std::size_t>(clip)].name);
        for (int i = 0; i < static_cast<int>(tree.nodes().size()); ++i) {
            const mobb::Node& node = tree.node(i);
            const mobb::Box box = tree.box(i);
            std::cout << name << ',' << mobb::name(options.tree) << ',' << options.leaf << ','
                      << mobb::name(options.axes) << ',' << format_double(options.time_scale) << ',' << i << ','
                      << tree.parent(i) << ',' << tree.level(i) << ',' << node.first << ',' << node.count << ','
                      << (tree.is_leaf(i) ? "true" : "false") << ',' << mobb::info(box.kind).name << ','
                      << format_double(tree.t0(node)) << ',' << format_double(tree.t1(node)) << ','
                      << figure_of(NodeField::volume, i) << ',' << figure_of(NodeField::fill, i) << ','
                      << figure_of(NodeField::share, i) << ','
                      << (cost ? format_double(values.value(NodeField::share, i) * cost->tests.boxes()) : "");
            for (const NodeField field : {NodeField::empty, NodeField::floor, NodeField::overhang, NodeField::waste})
                std::cout << ',' << figure_of(field, i);
            std::cout << '\n';
        }
    }
}

/// "against itself: 1.56 box tests and 0.768 sample pairs counted, 29 ns +- 0.4 % (201728 standard placements, seed 0:
/// shift over 25.6 m^2, start within +-2 s)"
std::string counted_words(const TreeCost& cost) {
    const StandardPlacements& of = cost.expected->placements;
    return "against itself: " + figure(cost.tests.boxes(), 3) + " box tests and " +
           figure(cost.tests[mobb::TestKind::samples], 3) + " sample pairs counted, " + figure(cost.ns(), 3) +
           " ns +- " + figure(100 * cost.count.standard_error(), 1) + " % (" +
           counted(cost.queries, "standard placement", "standard placements") + ", seed " +
           std::to_string(kCountedSeed) + ": shift over " + figure(of.area(), 3) + " m^2, start within +-" +
           brief(of.offset) + " s)";
}

void print_levels(const mobb::Tree& tree, const TreeCost* counted) {
    const std::vector<mobb::LevelFigures> levels = mobb::level_figures(tree);
    std::vector<Column> columns;
    for (const mobb::LevelColumn& column : mobb::kLevelColumns) {
        columns.push_back({std::string(column.name) + level_unit(column)});
        for (const mobb::LevelFigures& figures : levels) columns.back().push_back(level_text(column, figures));
    }
    if (counted) {
        Column tests{"box tests"}, cost{"cost ns"};
        for (std::size_t i = 0; i < levels.size(); ++i) {
            const MeanTests at = i < counted->levels.size() ? counted->levels[i] : MeanTests();
            tests.push_back(figure(at.boxes(), 3));
            cost.push_back(figure(counted->ns(at), 3));
        }
        columns.push_back(std::move(tests));
        columns.push_back(std::move(cost));
    }
    print_columns(columns);
}

void print_tree(const std::string& clip, const mobb::Tree& tree, const TreeCost* cost) {
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
    std::cout << "  " << (cost ? counted_words(*cost) : std::string(why_no_cost(tree))) << '\n';
    print_levels(tree, cost);
    const std::vector<double> shares = cost ? cost->shares : std::vector<double>();
    for (const FitFinding& found : fit_findings(tree, shares)) std::cout << "  notice: " << found.text << '\n';
}

void print_trees(const FittedScene& fitted) {
    const ClipCosts costs(fitted);
    for (int i = 0; i < static_cast<int>(fitted.scene().clips.size()); ++i) {
        const std::shared_ptr<const TreeCost> cost = costs.of(i);
        print_tree(fitted.scene().clips[static_cast<std::size_t>(i)].name, fitted.tree(i), cost.get());
    }
}

/// Of every clip. Throws InputError for what is no fit.
void print_comparisons(const Scene& scene, const FitCommandArguments& arguments) {
    const mobb::FitOptions base = arguments.fit.over(scene.fit);
    std::vector<mobb::FitOptions> fits;
    for (const std::string& text : arguments.compare) {
        try {
            fits.push_back(parse_fit(text, base));
        } catch (const std::invalid_argument& error) {
            throw InputError(std::string("--compare: ") + error.what());
        }
    }
    if (fits.size() < 2) throw InputError("--compare: give two fits or more, such as mobb,leaf=10 moving");
    std::vector<ClipComparison> all;
    for (const SceneClip& clip : scene.clips)
        all.push_back(comparison_of(clip.name, clip.clip, fits, most_counted(scene.clips.size())));
    if (!arguments.json) {
        std::ranges::for_each(all, print_compared_fits);
        return;
    }
    JsonWriter out(std::cout);
    out.begin_object();
    out.list("compared", all, [&out](const ClipComparison& found) { write_compared_fits(out, found); });
    out.end_object();
}

void run_fit(const FitCommandArguments& arguments) {
    Scene scene = load(arguments.file, arguments.import_options);
    if (!arguments.compare.empty()) {
        print_comparisons(scene, arguments);
        return flush_results();
    }
    const FittedScene trees = fitted(std::move(scene), arguments.fit);
    const auto print = arguments.csv ? print_csv : arguments.json ? print_json : print_trees;
    print(trees);
    flush_results();
}

void add_options_of_fit(Command& command, FitCommandArguments& arguments) {
    const Option json = add_fitted_options(command, arguments, "Levels and nodes as JSON");
    const Option csv = command.add_flag("--csv", arguments.csv, "Nodes as CSV, a row each").excludes(json);
    command
        .add_list_option(
            "--compare", [&arguments](const std::vector<std::string>& fits) { arguments.compare = fits; },
            "Two fits or more side by side, such as mobb,leaf=10 moving: which is tighter, and which costs less", "FIT")
        .excludes(csv);
}

}  // namespace

void add_fit_command(Command& program) {
    program.add_subcommand("fit", "Fit a tree to every clip and show how tight its levels are, and what they cost",
                           add_options_of_fit, run_fit);
}

}  // namespace mobbscope::cli
