#include <base/error.h>
#include <base/file.h>
#include <base/json_writer.h>
#include <base/numbers_in_text.h>
#include <base/text.h>
#include <cli/columns.h>
#include <cli/command_line.h>
#include <cli/options.h>
#include <cli/program.h>
#include <explain/fit_sweep.h>
#include <explain/time_scale_curves.h>
#include <explain/tree_cost.h>
#include <import/tracks/text_rows.h>
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
#include <tuple>
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
    std::uint64_t seed = kCountedSeed;
    std::filesystem::path out;
    DrawingArguments drawing{.size = {960, 640}};
};

using Layout = JsonWriter::Layout;

/// A row's line in a file: over all queries, or over those in which a clip takes part.
struct RowFigures {
    const SweepRow& row;
    std::optional<std::string> clip;
    std::size_t queries;
    const MeanTests* tests;  ///< null where nothing is estimated
    const Spread* cost;
    bool all;  ///< over all queries
};

/// Calls `write` with each row over all clips; if there are several, also over each one that takes part in a query.
template <class Write>
void for_each_row(const Scene& scene, const SweepResult& result, Write write) {
    const bool single = scene.clips.size() == 1;
    for (const SweepRow& row : result.rows) {
        const auto& estimate = row.estimate;
        write(RowFigures{row, single ? std::optional(scene.clips[0].name) : std::nullopt, result.queries,
                         estimate ? &estimate->tests : nullptr, estimate ? &estimate->cost : nullptr, true});
        for (std::size_t i = 0; estimate && i < estimate->clips.size(); ++i) {
            const SweepClip& clip = estimate->clips[i];
            if (clip.queries == 0) continue;
            write(RowFigures{row, scene.clips[i].name, clip.queries, &clip.tests, &clip.cost, false});
        }
    }
}

/// Estimated figures by name; none where nothing is estimated, and no error of one query.
std::vector<std::pair<const char*, std::optional<double>>> estimates_of(const RowFigures& of) {
    const auto known = [&](auto value) { return of.cost ? std::optional<double>(value()) : std::nullopt; };
    return {{"box_tests", known([&] { return of.tests->boxes(); })},
            {"sample_pairs", known([&] { return (*of.tests)[mobb::TestKind::samples]; })},
            {"cost", known([&] { return of.cost->mean; })},
            {"standard_error", known([&] { return of.cost->standard_error; })},
            {"p95", known([&] { return of.cost->p95; })},
            {"p99", known([&] { return of.cost->p99; })},
            {"max", known([&] { return of.cost->max; })}};
}

std::optional<double> time_ns(const SweepRow& row, Protocol protocol) {
    return row.time(protocol) ? std::optional(row.time(protocol)->ns) : std::nullopt;
}
std::optional<double> time_error(const SweepRow& row, Protocol protocol) {
    return row.time(protocol) ? std::optional(row.time(protocol)->error) : std::nullopt;
}

void write_options(JsonWriter& out, const mobb::FitOptions& fit) {
    out.members("tree", mobb::name(fit.tree), "leaf", fit.leaf, "axes", mobb::name(fit.axes), "time_scale",
                fit.time_scale);
}

void write_all_options(JsonWriter& out, const mobb::FitOptions& fit) {
    write_options(out, fit);
    out.member("levels", fit.levels);
}

void write_times(JsonWriter& out, const char* key, const SweepRow& row,
                 std::optional<double> (*number)(const SweepRow&, Protocol)) {
    out.begin_object(key, Layout::row);
    for (const Protocol protocol : kProtocols) out.member(name(protocol), number(row, protocol));
    out.end_object();
}

void write_row(JsonWriter& out, const RowFigures& figures) {
    out.begin_object(Layout::row);
    out.member("clip", figures.clip);
    write_all_options(out, figures.row.fit);
    for (const auto& [key, value] : estimates_of(figures)) out.member(key, value);
    if (figures.all) {
        write_times(out, "time_ns", figures.row, time_ns);
        write_times(out, "time_error_ns", figures.row, time_error);
        out.members("memory", figures.row.bytes, "nodes", figures.row.nodes);
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

/// Null where nothing is recommended.
void write_recommended(JsonWriter& out, const char* key, const SweepResult& result, Protocol protocol) {
    const SweepAdvice& advice = result.of(protocol);
    if (!advice.recommended) {
        out.key(key);
        return out.null();
    }
    const SweepRow &chosen = result.rows[*advice.recommended], &present = result.rows[result.present];
    const auto cost = [](const SweepRow& row) {
        return row.estimate ? std::optional(row.estimate->cost.mean) : std::nullopt;
    };
    out.begin_object(key);
    write_all_options(out, chosen.fit);
    out.members("cost", cost(chosen), "present_cost", cost(present));
    write_times(out, "time_ns", chosen, time_ns);
    write_times(out, "present_time_ns", present, time_ns);
    out.members("memory", chosen.bytes, "present_memory", present.bytes, "why", advice.why);
    out.end_object();
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
    for (const Protocol protocol : kProtocols)
        out.member(std::string(name(protocol)) + "_queries", result.of(protocol).queries);
    out.end_object();
    out.member("unit", kEstimatedUnit);
    out.begin_array("rows");
    for_each_row(scene, result, [&](const RowFigures& figures) { write_row(out, figures); });
    out.end_array();
    write_recommended(out, "recommended", result, Protocol::warm);
    write_recommended(out, "recommended_cold", result, Protocol::cold);
    out.begin_array("undecided");
    for (const Protocol protocol : kProtocols) {
        for (const std::size_t row : result.of(protocol).undecided) {
            out.begin_object(Layout::row);
            out.member("protocol", name(protocol));
            write_all_options(out, result.rows[row].fit);
            write_times(out, "time_ns", result.rows[row], time_ns);
            write_times(out, "time_error_ns", result.rows[row], time_error);
            out.member("memory", result.rows[row].bytes);
            out.end_object();
        }
    }
    out.end_array();
    out.begin_object("why");
    for (const Protocol protocol : kProtocols) out.member(name(protocol), result.of(protocol).why);
    out.end_object();
    if (!curves.empty()) write_curves(out, curves);
    out.end_object();
}

void print_sweep_csv(const Scene& scene, const SweepResult& result) {
    std::cout << "clip,tree,leaf,axes,time_scale,levels,box_tests,sample_pairs,cost,standard_error,p95,p99,max,warm_ns,"
                 "warm_error_ns,cold_ns,cold_error_ns,memory,nodes,queries\n";
    for_each_row(scene, result, [&](const RowFigures& figures) {
        const SweepRow& row = figures.row;
        const mobb::FitOptions& fit = row.fit;
        std::cout << csv_field(figures.clip.value_or("")) << ',' << mobb::name(fit.tree) << ',' << fit.leaf << ','
                  << mobb::name(fit.axes) << ',' << format_double(fit.time_scale) << ',' << fit.levels;
        const auto number = [](std::optional<double> value) {
            std::cout << ',' << (value && std::isfinite(*value) ? format_double(*value) : "");
        };
        for (const auto& [key, value] : estimates_of(figures)) number(value);
        const auto of_all = [&](std::optional<double> value) { number(figures.all ? value : std::nullopt); };
        for (const Protocol protocol : kProtocols) {
            of_all(time_ns(row, protocol));
            of_all(time_error(row, protocol));
        }
        of_all(static_cast<double>(row.bytes));
        of_all(static_cast<double>(row.nodes));
        std::cout << ',' << figures.queries << '\n';
    });
}

/// The rows that are worth a line: what was measured, the fastest warm one first, and the best estimates of other kinds
/// and axes.
std::vector<std::size_t> shown_rows(const SweepResult& result) {
    std::vector<std::size_t> order(result.rows.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    const auto estimate = [&](std::size_t i) {
        return result.rows[i].estimate ? result.rows[i].estimate->cost.mean : 0;
    };
    const auto rank = [&](std::size_t i) {
        const auto& time = result.rows[i].time(Protocol::warm);
        return std::tuple(!time, time ? time->ns : estimate(i));
    };
    std::ranges::stable_sort(order, {}, rank);
    std::vector<std::size_t> lines;
    for (const std::size_t i : order) {
        const SweepRow& row = result.rows[i];
        // Leaves between which no node has its size make the same trees, and of these one is shown.
        const auto same = [&](std::size_t other) {
            const SweepRow& shown = result.rows[other];
            const bool same_kind = shown.fit.tree == row.fit.tree && shown.fit.axes == row.fit.axes;
            return same_kind &&
                   (!row.time(Protocol::warm) || (shown.nodes == row.nodes && estimate(other) == estimate(i)));
        };
        if (i == result.present || i == result.fastest(Protocol::warm) || i == result.fastest(Protocol::cold) ||
            (std::ranges::none_of(lines, same) && lines.size() < kMostLines))
            lines.push_back(i);
    }
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
    out += grouped(result.queries) + (result.queries == 1 ? " standard placement" : " standard placements");
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
    const auto cell = [](std::optional<double> value, int digits = 3) {
        return value && std::isfinite(*value) ? figure(*value, digits) : "-";
    };
    const auto is_chosen = [&](Protocol protocol) {
        const SweepAdvice& advice = result.of(protocol);
        return advice.recommended == row || std::ranges::find(advice.undecided, row) != advice.undecided.end();
    };
    std::vector<std::string> out{sweep_words(of.fit, result.order.present) + (row == result.present ? " (now)" : "")};
    for (const Protocol protocol : kProtocols) {
        out.push_back((is_chosen(protocol) ? "* " : "") + cell(time_ns(of, protocol)));
        out.push_back(cell(time_error(of, protocol), 2));
    }
    out.push_back(bytes_text(of.bytes));
    out.push_back(std::to_string(of.nodes));
    const std::optional<SweepEstimate>& estimate = of.estimate;
    const auto estimated = [&](auto value) {
        return estimate ? std::optional<double>(value(*estimate)) : std::nullopt;
    };
    out.push_back(cell(estimated([](const SweepEstimate& e) { return e.cost.mean; })));
    out.push_back(cell(estimated([](const SweepEstimate& e) { return e.cost.standard_error; }), 2));
    out.push_back(cell(estimated([](const SweepEstimate& e) { return e.cost.p99; })));
    out.push_back(cell(estimated([](const SweepEstimate& e) { return e.tests.boxes(); })));
    out.push_back(cell(estimated([](const SweepEstimate& e) { return e.tests[mobb::TestKind::samples]; })));
    return out;
}

void print_sweep_text(const Scene& scene, const QueryWorkload& workload, const SweepResult& result) {
    std::cout << workload_words(scene, workload, result) << '\n';
    std::vector<Column> table{{"fit"},   {"warm ns"},      {"+-"}, {"cold ns"}, {"+-"},        {"memory"},
                              {"nodes"}, {"estimated ns"}, {"+-"}, {"p99"},     {"box tests"}, {"sample pairs"}};
    const std::vector<std::size_t> shown = shown_rows(result);
    for (const std::size_t row : shown) {
        const std::vector<std::string> cells = cells_of(result, row);
        for (std::size_t i = 0; i < cells.size(); ++i) table[i].push_back(cells[i]);
    }
    print_columns(table, true);
    std::cout << " a query, measured on this machine: warm, asked before; cold, with nothing of it in the caches. "
                 "Estimated: counted tests times price, the same everywhere\n";
    if (shown.size() < result.rows.size())
        std::cout << " " << result.rows.size() << " fits were tried, --csv and --json have them all\n";
    for (const Protocol protocol : kProtocols) std::cout << name(protocol) << ": " << result.of(protocol).why << '\n';
    std::optional<std::size_t> told = result.present;
    for (const Protocol protocol : kProtocols) {
        const std::optional<std::size_t> best = result.of(protocol).recommended;
        if (!best || best == result.present || best == told) continue;
        told = best;
        const auto [options, json] = applied(result.rows[*best].fit);
        std::cout << "to use what is best " << name(protocol) << ": " << options << ", or in a scene: \"fit\": {"
                  << json << "}\n";
    }
}

void draw_sweep(const SweepCommandArguments& arguments, const Scene& scene, const QueryWorkload& workload,
                const SweepResult& result) {
    Chart chart = sweep_chart(result, result.present).chart;
    const std::string& why = result.of(Protocol::warm).why;
    chart.title = "measured, warm: " + why.substr(0, why.find(';'));  // all of it does not fit
    chart.caption = workload_words(scene, workload, result);
    const DrawingArguments& drawing = arguments.drawing;
    const DrawList list = chart_picture({chart}, drawing.size, drawing.theme, drawing.scale).list;
    write_file(arguments.out, picture_bytes(arguments.out, list, kPictureSamples, drawing.backend));
}

void run_sweep(SweepCommandArguments& arguments) {
    check_picture_output(arguments.out);
    const Scene scene = load_file_or_folder(arguments.file, arguments.import_options);
    refuse_bodies(scene, "a sweep");
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
    add_parsed(command, "--seed", arguments.seed, parse_seed, "Seed of the placements (0)", "S");
    const Option json = command.add_flag("--json", arguments.json, "Everything as JSON");
    Option csv = command.add_flag("--csv", arguments.csv, "The rows as CSV");
    csv.excludes(json);
    add_parsed(command, "-o,--output", arguments.out, parse_output_name,
               "Estimated cost over the leaf, as a picture: .png, .svg or .pdf", "PLOT.png");
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
