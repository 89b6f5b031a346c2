#include <base/error.h>
#include <base/file.h>
#include <base/json_writer.h>
#include <base/text.h>
#include <cli/columns.h>
#include <cli/command_line.h>
#include <cli/options.h>
#include <cli/program.h>
#include <explain/fit_sweep.h>
#include <explain/time_scale_curves.h>
#include <import/tracks/csv.h>
#include <render/pictures/sweep_chart.h>
#include <render/vector/vector_picture.h>
#include <scene/load_files.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::cli {

namespace {

constexpr int kLeastQueries = 2, kMostQueries = 1'000'000;
constexpr std::size_t kMostLines = 15;

struct SweepCommandArguments : FittedArguments {
    SweepOrder over;
    bool csv = false;
    bool of_scene = false;  ///< the scene's own queries
    std::uint64_t seed = 1;
    std::filesystem::path out;
    DrawingArguments drawing{.size = {960, 640}};
};

using Layout = JsonWriter::Layout;

/// A row's line in a file: over all queries, or over those in which a clip takes part.
struct RowFigures {
    const SweepRow& row;
    std::optional<std::string> clip;
    std::size_t queries;
    const MeanTests& tests;
    const Spread& cost;
    bool all;  ///< over all queries
};

/// Calls `write` with each row over all clips; if there are several, also over each one that takes part in a query.
template <class Write>
void for_each_row(const Scene& scene, const SweepResult& result, Write write) {
    const bool single = scene.clips.size() == 1;
    for (const SweepRow& row : result.rows) {
        write(RowFigures{row, single ? std::optional(scene.clips[0].name) : std::nullopt, result.queries, row.tests,
                         row.cost, true});
        for (std::size_t i = 0; i < row.clips.size(); ++i) {
            const SweepClip& clip = row.clips[i];
            if (clip.queries == 0) continue;
            write(RowFigures{row, scene.clips[i].name, clip.queries, clip.tests, clip.cost, false});
        }
    }
}

void write_options(JsonWriter& out, const mobb::FitOptions& fit) {
    out.members("tree", mobb::name(fit.tree), "leaf", fit.leaf, "axes", mobb::name(fit.axes), "time_scale",
                fit.time_scale);
}

void write_all_options(JsonWriter& out, const mobb::FitOptions& fit) {
    write_options(out, fit);
    out.member("levels", fit.levels);
}

void write_row(JsonWriter& out, const RowFigures& figures, bool has_quantiles) {
    out.begin_object(Layout::row);
    out.member("clip", figures.clip);
    write_all_options(out, figures.row.fit);
    out.members("box_tests", figures.tests.boxes(), "sample_pairs", figures.tests[mobb::TestKind::samples]);
    out.members("cost", figures.cost.mean, "standard_error", figures.cost.standard_error);
    const auto if_known = [&](double quantile) { return has_quantiles ? std::optional(quantile) : std::nullopt; };
    out.members("p95", if_known(figures.cost.p95), "p99", if_known(figures.cost.p99), "max",
                if_known(figures.cost.max));
    if (figures.all) {
        out.members("difference", figures.row.difference, "difference_error", figures.row.difference_error);
        out.members("nodes", figures.row.nodes, "bytes", figures.row.bytes);
    }
    out.member("queries", figures.queries);
    out.end_object();
}

void write_curves(JsonWriter& out, const std::vector<LevelCurve>& curves) {
    out.begin_array("levels");
    for (const LevelCurve& curve : curves) {
        out.begin_object(Layout::row);
        write_options(out, curve.fit);
        out.begin_array("levels");
        for (std::size_t i = 0; i < curve.levels.size(); ++i) {
            out.row("level", i, "volume", curve.levels[i].volume, "cost", curve.levels[i].cost);
        }
        out.end_array();
        out.end_object();
    }
    out.end_array();
}

void print_sweep_json(const Scene& scene, const QueryWorkload& workload, const SweepResult& result,
                      const std::vector<LevelCurve>& curves) {
    JsonWriter out(std::cout);
    out.begin_object();
    const bool placed = workload.kind == QueryWorkload::Kind::placements;
    const auto of_placements = [&](auto value) { return placed ? std::optional(value) : std::nullopt; };
    out.begin_object("workload", Layout::row);
    out.members("kind", name(workload.kind), "area", of_placements(workload.area), "offset",
                of_placements(workload.offset), "seed", of_placements(workload.seed), "queries", result.queries);
    out.end_object();
    out.member("unit", unit_of(result.order.cost));
    const bool has_quantiles = result.order.cost == SweepCost::price;
    out.begin_array("rows");
    for_each_row(scene, result, [&](const RowFigures& figures) { write_row(out, figures, has_quantiles); });
    out.end_array();
    const SweepRow& chosen = result.rows[result.recommended];
    out.begin_object("recommended");
    write_all_options(out, chosen.fit);
    out.members("cost", chosen.cost.mean, "present_cost", result.rows[result.present].cost.mean, "why", result.why);
    out.end_object();
    out.begin_array("exceptions");
    for (const SweepException& exception : result.exceptions) {
        out.begin_object(Layout::row);
        out.member("clip", scene.clips[static_cast<std::size_t>(exception.clip)].name);
        write_all_options(out, result.rows[exception.row].fit);
        out.member("saving", exception.saving);
        out.end_object();
    }
    out.end_array();
    if (!curves.empty()) write_curves(out, curves);
    out.end_object();
}

void print_sweep_csv(const Scene& scene, const SweepResult& result) {
    std::cout << "clip,tree,leaf,axes,time_scale,levels,box_tests,sample_pairs,cost,standard_error,difference,"
                 "difference_error,p95,p99,max,nodes,bytes,queries\n";
    const bool has_quantiles = result.order.cost == SweepCost::price;
    for_each_row(scene, result, [&](const RowFigures& figures) {
        const mobb::FitOptions& fit = figures.row.fit;
        std::cout << csv_field(figures.clip.value_or("")) << ',' << mobb::name(fit.tree) << ',' << fit.leaf << ','
                  << mobb::name(fit.axes) << ',' << format_double(fit.time_scale) << ',' << fit.levels;
        const auto number = [](double value, bool known = true) {
            std::cout << ',' << (known && std::isfinite(value) ? format_double(value) : "");
        };
        number(figures.tests.boxes());
        number(figures.tests[mobb::TestKind::samples]);
        number(figures.cost.mean);
        number(figures.cost.standard_error);
        number(figures.row.difference, figures.all);
        number(figures.row.difference_error, figures.all);
        for (const double quantile : {figures.cost.p95, figures.cost.p99, figures.cost.max}) {
            number(quantile, has_quantiles);
        }
        number(static_cast<double>(figures.row.nodes), figures.all);
        number(static_cast<double>(figures.row.bytes), figures.all);
        std::cout << ',' << figures.queries << '\n';
    });
}

/// The rows that are worth a line: the best of each kind and axes, the present one, and the next best of other trees;
/// the best first.
std::vector<std::size_t> shown_rows(const SweepResult& result) {
    std::vector<std::size_t> order(result.rows.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    const auto cost = [&](std::size_t i) { return result.rows[i].cost.mean; };
    std::ranges::stable_sort(order, {}, cost);
    std::vector<std::size_t> lines{result.recommended};
    const auto add_if = [&](auto is_new) {
        for (const std::size_t i : order) {
            const auto same = [&](std::size_t other) { return !is_new(result.rows[i], result.rows[other]); };
            if (lines.size() < kMostLines && std::ranges::none_of(lines, same)) lines.push_back(i);
        }
    };
    if (result.present != result.recommended) lines.push_back(result.present);
    const auto other_kind = [](const SweepRow& a, const SweepRow& b) {
        return a.fit.tree != b.fit.tree || a.fit.axes != b.fit.axes;
    };
    // Leaves between which no node has its size make the same trees.
    const auto other_trees = [&](const SweepRow& a, const SweepRow& b) {
        return other_kind(a, b) || a.cost.mean != b.cost.mean || a.nodes != b.nodes;
    };
    add_if([&](const SweepRow& a, const SweepRow& b) { return other_kind(a, b); });
    add_if(other_trees);
    std::ranges::stable_sort(lines, {}, cost);
    return lines;
}

std::string workload_words(const Scene& scene, const QueryWorkload& workload, const SweepResult& result) {
    const std::size_t clips = scene.clips.size();
    std::string out = counted(clips, "clip", "clips") + ", ";
    if (workload.kind == QueryWorkload::Kind::queries) {
        const std::size_t all = query_count(scene);
        if (result.queries < all) out += std::to_string(result.queries) + " of ";
        return out + counted(all, "query", "queries") + " of the scene";
    }
    out += counted(result.queries, "standard placement", "standard placements");
    out += clips == 1 ? " of it against itself" : " of each against each and itself";
    return out + " (shift over " + figure(workload.area, 3) + " m^2, start within +-" + figure(workload.offset, 3) +
           " s, seed " + std::to_string(workload.seed) + ")";
}

/// Fit options that are not as in the scene, for the command line and for a scene.
std::pair<std::string, std::string> applied(const mobb::FitOptions& fit) {
    const mobb::TreeInfo& kind = mobb::info(fit.tree);
    const std::string tree(mobb::name(fit.tree)), axes(mobb::name(fit.axes)), leaf = std::to_string(fit.leaf),
                                                                              scale = format_double(fit.time_scale);
    std::string options = "--tree " + tree, json = "\"tree\": \"" + tree + '"';
    if (kind.splits()) {
        options += " --leaf " + leaf;
        json += ", \"leaf\": " + leaf;
    }
    if (kind.splits() && fit.levels != 0) {
        options += " --levels " + std::to_string(fit.levels);
        json += ", \"levels\": " + std::to_string(fit.levels);
    }
    if (kind.chooses_axes()) {
        options += " --axes " + axes;
        json += ", \"axes\": \"" + axes + '"';
    }
    if (kind.uses_time_scale()) {
        options += " --time-scale " + scale;
        json += ", \"time_scale\": " + scale;
    }
    return {options, json};
}

std::vector<std::string> cells_of(const SweepResult& result, std::size_t row) {
    const SweepRow& of = result.rows[row];
    const bool is_best = row == result.recommended, has_quantiles = result.order.cost == SweepCost::price;
    const auto cell = [](double value) { return std::isfinite(value) ? figure(value, 3) : "-"; };
    const auto quantile = [&](double value) { return has_quantiles ? cell(value) : "-"; };
    const double more = 100 * of.difference / result.rows[result.recommended].cost.mean;
    return {
        (is_best ? "* " : "  ") + sweep_words(of.fit, result.order.present) + (row == result.present ? " (now)" : ""),
        cell(of.cost.mean),
        cell(of.cost.standard_error),
        is_best ? "" : formatted("%+.1f %%", more),
        cell(of.tests.boxes()),
        cell(of.tests[mobb::TestKind::samples]),
        quantile(of.cost.p95),
        quantile(of.cost.p99),
        quantile(of.cost.max),
        std::to_string(of.nodes),
        bytes_text(of.bytes)};
}

void print_sweep_text(const Scene& scene, const QueryWorkload& workload, const SweepResult& result) {
    std::cout << workload_words(scene, workload, result) << '\n';
    std::vector<Column> table{{"fit"}, {"cost"}, {"+-"},  {"against *"}, {"box tests"}, {"sample pairs"},
                              {"p95"}, {"p99"},  {"max"}, {"nodes"},     {"memory"}};
    const std::vector<std::size_t> shown = shown_rows(result);
    for (const std::size_t row : shown) {
        const std::vector<std::string> cells = cells_of(result, row);
        for (std::size_t i = 0; i < cells.size(); ++i) table[i].push_back(cells[i]);
    }
    print_columns(table, true);
    std::cout << " cost of a query in " << unit_of(result.order.cost);
    if (shown.size() < result.rows.size())
        std::cout << "; " << result.rows.size() << " fits were tried, --csv and --json have them all";
    std::cout << '\n' << result.why << '\n';
    for (const SweepException& exception : result.exceptions) {
        std::cout << "  " << cleaned(scene.clips[static_cast<std::size_t>(exception.clip)].name) << ": "
                  << sweep_words(result.rows[exception.row].fit, result.order.present) << " would cost it "
                  << figure(100 * exception.saving, 2) << " % less\n";
    }
    if (result.recommended == result.present) return;
    const auto [options, json] = applied(result.rows[result.recommended].fit);
    std::cout << "to use it: " << options << ", or in a scene: \"fit\": {" << json << "}\n";
}

void draw_sweep(const SweepCommandArguments& arguments, const Scene& scene, const QueryWorkload& workload,
                const SweepResult& result) {
    Chart chart = sweep_chart(result, result.present).chart;
    chart.title = result.why.substr(0, result.why.find(';'));  // all of it does not fit
    chart.caption = workload_words(scene, workload, result);
    const DrawingArguments& drawing = arguments.drawing;
    const DrawList list = chart_picture({chart}, drawing.size, drawing.theme, drawing.scale).list;
    write_file(arguments.out, picture_bytes(arguments.out, list, kPictureSamples, drawing.backend));
}

void run_sweep(SweepCommandArguments& arguments) {
    check_picture_output(arguments.out);
    const Scene scene = load_file_or_folder(arguments.file, arguments.import_options);
    SweepOrder order = arguments.over;
    order.present = arguments.fit.over(scene.fit);
    if (!order.varies()) {
        const SweepOrder usual = usual_sweep(order.present);
        order.trees = usual.trees;
        order.leaf = usual.leaf;
    }
    std::vector<mobb::ClipPtr> clips;
    for (const SceneClip& clip : scene.clips) clips.push_back(clip.clip);
    if (clips.empty()) throw InputError(arguments.file, "there are no clips to fit");
    if (arguments.of_scene && query_count(scene) == 0) {
        throw InputError(arguments.file,
                         "there is nothing to ask; add queries, or two agents at least, or leave out --queries scene");
    }
    const QueryWorkload workload = arguments.of_scene ? scene_workload(scene, order.most_queries)
                                                      : standard_workload(clips, order.most_queries, arguments.seed);
    if (!arguments.out.empty()) check_output(arguments.out);
    const SweepResult result =
        at_place(arguments.file, "", [&] { return sweep_fits(clips, workload, order, tell("tried", "fits")); });
    if (!arguments.out.empty()) draw_sweep(arguments, scene, workload, result);
    if (arguments.csv) {
        print_sweep_csv(scene, result);
    } else if (arguments.json) {
        const bool has_curves = !order.time_scale.values.empty();
        print_sweep_json(scene, workload, result,
                         has_curves ? time_scale_curves(clips, result, tell("worked out", "time scales"))
                                    : std::vector<LevelCurve>{});
    } else {
        print_sweep_text(scene, workload, result);
    }
    flush_results();
}

void add_sweep_options(Command& command, SweepCommandArguments& arguments) {
    const auto path = [&arguments](const std::string& text) { arguments.file = parse_file_name(text); };
    command.add_option("FILE", path, openable_files() + ", or a folder of clips", "").required();
    command.add_repeated_option(
        "--over", [&arguments](const std::string& text) { set_over(arguments.over, text); },
        "What is varied, one option each time: tree=all or mobb,umobb; leaf=1:200 or 5,10,20; axes=all; "
        "time_scale=0.1:30. A range A:B is tried at as many values as needed (tree=all and leaf=1:200)",
        "NAME=VALUES");
    const auto set_queries = [&arguments](const std::string& text) {
        arguments.of_scene = text == "scene";
        if (arguments.of_scene) return;
        const std::optional<int> number = parse_int(text);
        if (!number || *number < kLeastQueries || *number > kMostQueries) {
            throw std::invalid_argument(in_quotes(text) + " is neither scene nor a whole number from " +
                                        std::to_string(kLeastQueries) + " to " + std::to_string(kMostQueries));
        }
        arguments.over.most_queries = static_cast<std::size_t>(*number);
    };
    command.add_option("--queries", set_queries,
                       "scene, for the scene's own queries; or how many standard placements of its clips at most "
                       "(16000)",
                       "scene|N");
    add_parsed(command, "--seed", arguments.seed, parse_seed, "Seed of the placements (1)", "S");
    add_parsed(command, "--cost", arguments.over.cost, one_of(sweep_cost_from_name, "price, time"),
               "price (tests times what each costs: the same everywhere) or time (measured on one thread) (price)",
               "WHAT");
    const Option json = command.add_flag("--json", arguments.json, "Everything as JSON");
    Option csv = command.add_flag("--csv", arguments.csv, "The rows as CSV");
    csv.excludes(json);
    add_parsed(command, "-o,--output", arguments.out, parse_output_name,
               "Cost over the leaf, as a picture: .png, .svg or .pdf", "PLOT.png");
    add_fit_options(command, arguments.fit);
    add_import_options(command, arguments.import_options);
    add_drawing_options(command, arguments.drawing);
}

}  // namespace

void add_sweep_command(Command& program) {
    program.add_subcommand("sweep", "Try many fits of the same clips on the same queries: which should I ship?",
                           add_sweep_options, run_sweep);
}

}  // namespace mobbscope::cli
