#include <base/error.h>
#include <base/text.h>
#include <cli/command_line.h>
#include <cli/options.h>
#include <cli/program.h>
#include <paper_tables/built_in_clips.h>
#include <paper_tables/measure.h>
#include <paper_tables/methods.h>
#include <paper_tables/table_report.h>
#include <paper_tables/workload.h>
#include <scene/load_files.h>

#include <cstdint>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::cli {

namespace {

constexpr int kMostRounds = 1000;
constexpr double kLeastRange = 1e-3;  // metres
constexpr int kUsualQueries = 100'000;

struct BenchCommandArguments {
    std::string workload;
    std::vector<std::filesystem::path> paths;
    bool json = false;
    bool sweep = false;
    bool variants = false;
    std::optional<int> queries;
    std::optional<double> ahead;   ///< seconds
    std::optional<double> within;  ///< metres
    std::optional<double> range;   ///< metres
    int rounds = 5;
    std::uint64_t seed = 1;
    FitArguments fit;
    ImportOptions import_options;
};

std::vector<mobb::ClipPtr> clips_of(const Scene& scene) {
    std::vector<mobb::ClipPtr> clips;
    for (const SceneClip& clip : scene.clips) clips.push_back(clip.clip);
    return clips;
}

Scene scene_of(const std::vector<mobb::ClipPtr>& clips) {
    Scene scene;
    for (const mobb::ClipPtr& clip : clips) {
        scene.clips.push_back({"move" + std::to_string(scene.clips.size()), std::nullopt, {}, clip});
    }
    return scene;
}

Workload table2(const BenchCommandArguments& arguments) {
    Workload workload;
    workload.name = "table2";
    workload.clips = arguments.paths.empty() ? walks_in_a_volume(14, 42, arguments.seed)
                                             : clips_of(load_files(arguments.paths, arguments.import_options));
    QueryDraw draw{.seed = arguments.seed};
    draw.range = arguments.range.value_or(draw.range);
    workload.description = (arguments.paths.empty() ? std::string("built-in walks") : "clips from files") +
                           ", at random places within " + brief(draw.range) + " m, headings, and times within " +
                           brief(draw.offset) + " clip lengths";
    workload.queries = random_queries(workload.clips, arguments.queries.value_or(kUsualQueries), draw);
    return workload;
}

void show_progress(const std::string& doing, int done, int all) {
    std::cerr << "mobbscope: " << doing << ' ' << done + 1 << " of " << all << '\n';
}

/// Queries that a file brings, its pairs of agents if it brings none, or those that a crowd asks that plays the clips
/// or the graph of the files.
Workload table1(const BenchCommandArguments& arguments) {
    Scene scene = arguments.paths.empty() ? scene_of(short_moves(51, 2.1, arguments.seed))
                                          : load_files(arguments.paths, arguments.import_options);
    refuse_bodies(scene, "a table");
    const int most = arguments.queries.value_or(kUsualQueries);
    Workload workload;
    const bool pairs_alone = scene.queries.empty();
    if (query_count(scene) > 0 && (!pairs_alone || (!scene.crowd && !scene.graph))) {
        if (arguments.ahead || arguments.within)
            throw InputError("the files have their own queries; leave out --ahead and --within");
        workload = workload_of_scene(scene);
        if (workload.queries.size() > static_cast<std::size_t>(most)) {
            workload.queries.resize(static_cast<std::size_t>(most));
        }
        workload.description = pairs_alone ? "all pairs of agents" : "recorded queries";
    } else {
        CrowdDraw draw{.seed = arguments.seed};
        draw.ahead = arguments.ahead.value_or(draw.ahead);
        draw.within = arguments.within.value_or(draw.within);
        const std::string who = arguments.paths.empty() ? "built-in moves" : scene.graph ? "a motion graph" : "clips";
        workload = crowd_queries(std::move(scene), most, draw);
        workload.description = "what a crowd of 100 on 30 x 40 m asks in 120 s, playing " + who + ", choosing " +
                               brief(draw.ahead) + " s ahead, of all within " + brief(draw.within) + " m";
    }
    workload.name = "table1";
    return workload;
}

void measure_all(const BenchCommandArguments& arguments) {
    if (arguments.fit.tree || arguments.fit.levels)
        throw InputError("bench measures every tree, with all levels and with one; leave out --tree and --levels");
    if (arguments.workload == "table2" && (arguments.ahead || arguments.within))
        throw InputError("--ahead and --within are for the crowd of table1; leave them out");
    if (arguments.workload == "table1" && arguments.range)
        throw InputError("--range is for the random places of table2; leave it out");
    const Workload workload = arguments.workload == "table1" ? table1(arguments) : table2(arguments);
    if (workload.queries.empty())
        throw InputError("the crowd made no choice, so there are no queries; give shorter clips");
    const mobb::FitOptions base = arguments.fit.over(workload.fit);
    const MeasureProgress progress = arguments.json ? MeasureProgress{} : show_progress;
    TableReport report;
    report.workload = workload.name;
    report.description = workload.description;
    report.machine = machine_words();
    report.seed = arguments.seed;
    report.rounds = arguments.rounds;
    report.queries = static_cast<std::int64_t>(workload.queries.size());
    report.clips = static_cast<int>(workload.clips.size());
    report.mean_duration = mean_duration(workload);
    report.table = measure(workload, table_methods(base), arguments.rounds, progress);
    report.costs = measure_test_costs(workload, base);
    if (arguments.sweep) report.sweep = measure(workload, sweep_methods(base), arguments.rounds, progress).rows;
    if (arguments.variants) report.variants = measure(workload, variant_methods(base), arguments.rounds, progress).rows;
    arguments.json ? write_json(std::cout, report) : write_text(std::cout, report);
    flush_results();
}

int run_bench(const BenchCommandArguments& arguments) {
    try {
        measure_all(arguments);
        return kDone;
    } catch (const DisagreementError& error) {
        complain(error.what());
        return kFailed;
    }
}

void add_bench_options(Command& command, BenchCommandArguments& arguments) {
    command.add_option("WORKLOAD", arguments.workload, "table1 (short clips in a crowd) or table2 (long clips)", "")
        .required()
        .among({"table1", "table2"});
    command.add_option("PATH", arguments.paths,
                       "Clips or folders of them; for table1 also a motion graph, or a scene with queries; without "
                       "any, built-in clips",
                       "");
    command.add_flag("--json", arguments.json, "The figures as JSON");
    add_parsed(command, "--queries", arguments.queries, whole_number_within(1, kMaxQueries),
               "How many queries, at most (100000)", "N");
    add_parsed(command, "--seed", arguments.seed, parse_seed, "Seed of all that is random (1)", "S");
    add_parsed(command, "--rounds", arguments.rounds, whole_number_within(1, kMostRounds),
               "How often everything is timed; the median is reported (5)", "N");
    command.add_flag("--sweep", arguments.sweep, "Times and counts at n_min from 1 to 200 too");
    command.add_flag("--variants", arguments.variants,
                     "Also with other axes and time scales, and with box tests where a leaf meets an inner node");
    add_parsed(command, "--ahead", arguments.ahead, number_within(0, kMaxSimulated),
               "table1: seconds before its begin at which a move is chosen (2.5)", "S");
    add_parsed(command, "--within", arguments.within, number_within(0, kMaxArea),
               "table1: of each candidate against all that comes within M metres, at any time (1)", "M");
    add_parsed(command, "--range", arguments.range, number_within(kLeastRange, kMaxArea),
               "table2: B's middle comes within M metres of A's, in x and in y (3.5)", "M");
    add_fit_options(command, arguments.fit);
    add_import_options(command, arguments.import_options);
}

}  // namespace

void add_bench_command(Command& program) {
    program.add_subcommand(
        "bench", "Measure the paper's Table 1 or 2: counts and times of every kind of tree on the same queries",
        add_bench_options, run_bench);
}

}  // namespace mobbscope::cli
