#include <base/error.h>
#include <base/file.h>
#include <base/json_writer.h>
#include <base/text.h>
#include <cli/command_line.h>
#include <cli/graph_report.h>
#include <cli/options.h>
#include <cli/program.h>
#include <crowd/graph/build_graph.h>
#include <crowd/graph/continuity.h>
#include <crowd/simulation/crowd_order.h>
#include <crowd/simulation/simulate.h>
#include <import/import.h>
#include <render/pictures/candidates.h>
#include <scene/crowd_run.h>
#include <scene/crowd_scene.h>
#include <scene/load_files.h>
#include <scene/motion_graph.h>
#include <scene/scene_edits.h>
#include <scene/scene_json.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::cli {

namespace {

constexpr int kMostRecorded = 500'000;  // some 2 KB each, with what is written

struct SimulateCommandArguments {
    std::filesystem::path graph;
    std::filesystem::path out;
    std::filesystem::path record;
    int record_queries = 20'000;
    bool record_all_pairs = false;
    std::optional<double> record_within;  ///< metres
    bool inline_samples = false;
    bool whole = false;
    bool json = false;
    bool check = false;  ///< the run that is given, in place of making one
    CrowdOrder order;
    FitArguments fit;
};

/// The scene whose graph is played, and nothing else of it.
Scene load_moves(const SimulateCommandArguments& arguments, Importer& importer) {
    Scene scene = played_part(load_files({arguments.graph}, {}, {}, &importer));
    if (arguments.whole) scene.graph = std::make_shared<const MotionGraph>(graph_of_whole_clips(scene));
    if (!scene.graph) {
        throw InputError(arguments.graph,
                         "there is no motion graph; make one with graph build, or give --whole, and every clip may "
                         "follow every other");
    }
    check_moves(scene, *scene.graph, arguments.graph.string());
    scene.fit = arguments.fit.over(scene.fit);
    return scene;
}

void check_run_outputs(const SimulateCommandArguments& arguments) {
    for (const std::filesystem::path& out : {arguments.out, arguments.record}) {
        check_extension(out, ".json", "a run and its queries are scenes; name it .json");
    }
    if (!arguments.record.empty() && meant(arguments.out) == meant(arguments.record)) {
        throw InputError(arguments.record, "-o and --record name the same file; rename one");
    }
    for (const std::filesystem::path& out : {arguments.out, arguments.record}) {
        if (!out.empty()) check_output(out);
    }
}

/// What a scene's file holds; its relative sources lead where they led.
std::string text_for(Scene scene, const std::filesystem::path& file, bool inline_samples) {
    move_to_file(scene, file);
    return to_json(scene, inline_samples);
}

/// A line on standard error for every tenth of a run, and every few seconds of a slow one.
class Report {
  public:
    explicit Report(double seconds) : seconds_(seconds) {}

    void operator()(const SimulationCounts& counts) {
        const bool is_slow = std::chrono::steady_clock::now() - said_ > std::chrono::seconds(5);
        if (counts.simulated < next_ * seconds_ / 10 && !is_slow) return;
        said_ = std::chrono::steady_clock::now();
        if (counts.choices == 0) return say("placed " + counted(counts.agents, "agent", "agents"));
        next_ = std::floor(counts.simulated * 10 / seconds_) + 1;
        say("simulated " + brief(std::round(counts.simulated * 10) / 10) + " of " + brief(seconds_) +
            " s: " + std::to_string(counts.agents) + " agents, " + std::to_string(counts.choices) + " choices, " +
            std::to_string(counts.off_floor + counts.colliding) + " candidates discarded, " +
            std::to_string(counts.pivots) + " turned on the way, " + std::to_string(counts.forced) + " forced" +
            (is_slow && counts.looked_at > 0
                 ? "; the next choice has looked at " + std::to_string(counts.looked_at) + " ways on"
                 : ""));
    }

  private:
    double seconds_;
    double next_ = 1;  ///< tenth
    std::chrono::steady_clock::time_point said_ = std::chrono::steady_clock::now();
};

struct Summary {
    SimulationCounts counts;
    double seconds = 0;                                               ///< that the run took
    std::optional<std::pair<std::size_t, std::uint64_t>> recorded{};  ///< queries written, of how many
    RunContinuity continuity{};
    double turn_rate = 0;  ///< degrees per second
};

double queries_per_second(const Summary& summary) {
    return summary.seconds > 0 ? static_cast<double>(summary.counts.queries) / summary.seconds : 0;
}

void print_run_json(const Scene& scene, const Summary& summary) {
    const SimulationCounts& c = summary.counts;
    JsonWriter out(std::cout);
    out.begin_object();
    out.members("agents", c.agents, "simulated_seconds", c.simulated, "plays", c.plays, "choices", c.choices);
    out.members("candidates", c.candidates, "off_floor", c.off_floor, "colliding", c.colliding);
    out.members("no_way_on", c.no_way_on, "in_the_way", c.in_the_way);
    out.members("pivots", c.pivots, "turn_rate", summary.turn_rate, "forced", c.forced);
    out.members("queries", c.queries, "most_held", c.most_held);
    out.members("wall_seconds", summary.seconds, "queries_per_second", queries_per_second(summary));
    if (summary.recorded) out.members("recorded", summary.recorded->first, "recorded_of", summary.recorded->second);
    write_continuity(out, "continuity", scene, summary.continuity.free);
    write_forced_continuity(out, "continuity_forced", summary.continuity.forced);
    out.end_object();
}

void print_run_text(const Summary& summary) {
    const SimulationCounts& c = summary.counts;
    std::cout << in_words(c) << '\n'
              << counted(c.candidates, "candidate", "candidates") << ": " << c.off_floor << " leave the floor, "
              << c.colliding << " collide, " << c.no_way_on << " have no way on, " << c.in_the_way
              << " end in somebody's way\n"
              << counted(c.pivots, "play turns", "plays turn") << " on the way, at most " << brief(summary.turn_rate)
              << " degrees/s; " << counted(c.forced, "play is", "plays are") << " forced\n"
              << counted(c.queries, "query", "queries") << " in " << brief(std::round(summary.seconds * 100) / 100)
              << " s: " << brief(std::round(queries_per_second(summary))) << " a second\n";
    if (summary.recorded) {
        std::cout << "recorded " << counted(summary.recorded->first, "query", "queries") << " of "
                  << summary.recorded->second << '\n';
    }
    print_continuity(std::cout, summary.continuity);
}

/// Trees are asked where one of the paper's kinds is named.
QueriedBy queried_by(const FitArguments& fit) {
    return fit.tree.value_or(mobb::TreeKind::blocks) == mobb::TreeKind::blocks ? QueriedBy::blocks : QueriedBy::trees;
}

/// Of a move that is not turned.
const std::string& clip_name(const Scene& run, int move) {
    return run.clips[static_cast<std::size_t>(run.graph->moves[static_cast<std::size_t>(move)].clip)].name;
}

void write_played(JsonWriter& out, const char* key, const MoveSet& moves, const PlannedMove& move, PlayKind kind,
                  const mobb::Placement& at, const std::vector<PlannedMove>& plan) {
    out.begin_object(key);
    out.members("clip", clip_name(moves.fitted().scene(), move.move), "move", move.move, "turn_deg", move.turn_deg,
                "kind", name(kind), "translate", at.translate, "rotate_deg", at.rotate_deg, "start", at.start);
    out.list("plan", plan, [&](const PlannedMove& next) { out.tuple(next.move, next.turn_deg); });
    out.end_object();
}

void write_asked(JsonWriter& out, const char* key, const MoveSet& moves, const AskedSide& side) {
    out.begin_object(key, JsonWriter::Layout::row);
    out.members("agent", moves.fitted().scene().crowd->agents[static_cast<std::size_t>(side.agent)].name, "clip",
                name_of(moves, side), "planned", side.is_planned, "translate", side.placement.translate, "rotate_deg",
                side.placement.rotate_deg, "start", side.placement.start);
    out.end_object();
}

void write_query(JsonWriter& out, const MoveSet& moves, const DecidingQuery& query) {
    const DecidingTrace traced = trace_of(query, moves.fitted().options());
    out.begin_object("query");
    write_asked(out, "a", moves, query.candidate);
    write_asked(out, "b", moves, query.other);
    out.member("collides", traced.recorded.contact.has_value());
    out.key("contact");
    write_contact(out, traced.recorded.contact);
    out.key("event");
    traced.step < 0 ? out.null() : write_event(out, traced.recorded.trace, traced.step);
    out.end_object();
}

void write_difference(JsonWriter& out, const MoveSet& moves, const RunDifference& difference) {
    const Scene& run = moves.fitted().scene();
    const FollowedChoice& remade = difference.remade;
    const Choice& choice = remade.choice;
    const CrowdAgent& agent = run.crowd->agents[static_cast<std::size_t>(remade.agent)];
    const Play& play = agent.plays[static_cast<std::size_t>(remade.play)];
    out.begin_object("difference");
    out.members("agent", agent.name, "play", remade.play, "time", choice.time, "due",
                difference.due.value_or(choice.time));
    write_played(out, "then", moves, moves.origin(play.move), play.kind, play.placement, play.plan);
    if (choice.candidates.empty()) {
        out.key("now");
        out.null();
    } else {
        const Candidate& taken = choice.candidates[choice.taken];
        write_played(out, "now", moves, {taken.move, taken.turn_deg}, choice.kind, taken.placement, choice.plan);
    }
    out.member("played", difference.played);
    out.begin_array("candidates");
    for (std::size_t i = 0; i < choice.candidates.size(); ++i) {
        const Candidate& candidate = choice.candidates[i];
        out.begin_object(JsonWriter::Layout::row);
        out.members("clip", clip_name(run, candidate.move), "move", candidate.move, "turn_deg", candidate.turn_deg,
                    "outcome", outcome_words(outcome_of(choice, i)));
        if (const auto& blocker = candidate.blocker) {
            out.members("meets", run.crowd->agents[static_cast<std::size_t>(blocker->agent)].name, "contact_time",
                        blocker->contact.time);
        }
        out.end_object();
    }
    out.end_array();
    out.key("decides");
    if (difference.other) {
        out.row("candidate", difference.other->candidate, "about", difference.other->about_way ? "way" : "collision");
    } else {
        out.null();
    }
    if (difference.query) {
        write_query(out, moves, *difference.query);
    } else {
        out.key("query");
        out.null();
    }
    out.end_object();
}

/// Makes the choices of the run in the file again; the exit status.
int check_stored_run(const Command& command, const SimulateCommandArguments& arguments) {
    for (const GivenOption& given : command.given()) {
        if (given.name == "GRAPH" || given.name == "--check" || given.name == "--json") continue;
        throw UsageError("--check takes the run as its file has it; leave out " + given.name);
    }
    const std::string file = shown_name(arguments.graph);
    const FittedScene run = fitted(load(arguments.graph, {}), {});
    if (!is_run(run.scene()))
        throw InputError(arguments.graph, "there is no run to check; give one that simulate wrote");
    const MoveSet moves(run);
    const RunCheck found = check_run(moves, tell("made", "plays again"));
    std::size_t plays = 0;
    for (const CrowdAgent& agent : run.scene().crowd->agents) plays += agent.plays.size();
    if (arguments.json) {
        JsonWriter out(std::cout);
        out.begin_object();
        out.members("plays", plays, "compared", found.plays, "agrees", !found.difference);
        if (found.difference) {
            write_difference(out, moves, *found.difference);
        } else {
            out.key("difference");
            out.null();
        }
        out.end_object();
    } else if (found.difference) {
        const std::vector<std::string> lines = difference_lines(moves, *found.difference);
        for (std::size_t i = 0; i < lines.size(); ++i) std::cout << (i > 0 ? "  " : "") << cleaned(lines[i]) << '\n';
    } else {
        std::cout << "all " << counted(plays, "play", "plays") << " come out as the run says\n";
    }
    flush_results();
    if (!found.difference) return kDone;
    complain(file + ": play " + std::to_string(found.plays + 1) + " of " + std::to_string(plays) +
             ", in the order of choices, does not come out as the run says");
    return kFailed;
}

int run_simulate(const Command& command, const SimulateCommandArguments& arguments) {
    if (arguments.check) return check_stored_run(command, arguments);
    if (arguments.out.empty()) throw UsageError("-o is missing: say where the run goes, or --check one");
    check_run_outputs(arguments);
    Importer importer;
    Scene scene = load_moves(arguments, importer);
    check_run_outputs(arguments);  // again: now all that is read is known
    const mobb::FitOptions fit = scene.fit;
    const FittedScene fitted(std::move(scene), fit);
    const MoveSet moves(fitted, arguments.order.turn_rate, queried_by(arguments.fit));
    std::optional<QuerySample> sample;
    if (!arguments.record.empty()) {
        const bool all = arguments.record_all_pairs || arguments.record_within;
        const int most = arguments.record_queries > 0 ? arguments.record_queries : kMostRecorded;
        sample.emplace(all ? Recorded::all : Recorded::asked, static_cast<std::size_t>(most),
                       arguments.order.options.seed,
                       arguments.record_within.value_or(std::numeric_limits<double>::infinity()));
    }
    Summary summary;
    const auto begin = std::chrono::steady_clock::now();
    Simulation simulation =
        simulate(moves, arguments.order.options, sample ? &*sample : nullptr, Report(arguments.order.options.seconds));
    summary.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    summary.counts = simulation.counts;
    summary.turn_rate = arguments.order.turn_rate;
    std::string record;
    if (sample) {
        summary.recorded.emplace(sample->size(), sample->offered());
        record = text_for(sample->workload(moves), arguments.record, arguments.inline_samples);
    }
    const Scene played = scene_of_run(moves, std::move(simulation.run), TurnedSkeletons::left_out);
    summary.continuity = run_continuity(played, importer);
    const std::string run = text_for(played, arguments.out, arguments.inline_samples);
    std::vector<FileBytes> files{{arguments.out, run}};
    if (sample) files.push_back({arguments.record, record});
    write_files(files);
    arguments.json ? print_run_json(played, summary) : print_run_text(summary);
    flush_results();
    return kDone;
}

void add_simulate_options(Command& command, SimulateCommandArguments& arguments) {
    add_parsed(command, "GRAPH", arguments.graph, parse_file_name,
               "A scene with a motion graph; with --whole clips, or a folder of them; with --check a run", "")
        .required();
    add_parsed(command, "-o,--output", arguments.out, parse_output_name, "The run, as a scene", "OUT.json");
    command.add_flag("--check", arguments.check,
                     "Make every choice of a run again; 1 and the first that differs, where one does");
    add_number_options(command, crowd_options(), arguments.order);
    add_parsed(command, "--threads", arguments.order.options.threads, whole_number_within(1, kMaxThreads),
               "At most (all)", "N");
    const Option record = add_parsed(command, "--record", arguments.record, parse_output_name,
                                     "Queries that were asked, as a scene", "FILE.json");
    add_parsed(command, "--record-queries", arguments.record_queries, whole_number_within(0, kMostRecorded),
               "How many, drawn at random; 0 is all, up to half a million (20000)", "N")
        .needs(record);
    const Option all = command
                           .add_flag("--record-all-pairs", arguments.record_all_pairs,
                                     "Draw from every candidate against everybody, as without a broad phase")
                           .needs(record);
    add_parsed(command, "--record-within", arguments.record_within, number_within(0, kMaxArea),
               "Draw from every candidate against all that lies within M metres, at any time", "M")
        .needs(record)
        .excludes(all);
    command.add_flag("--whole", arguments.whole, "Instead of a graph: every clip whole, and each may follow each");
    command.add_flag("--inline", arguments.inline_samples,
                     "Samples stand in what is written, which then needs no other file");
    command.add_flag("--json", arguments.json, "The summary as JSON");
    add_fit_options(command, arguments.fit);
}

}  // namespace

void add_simulate_command(Command& program) {
    program.add_subcommand("simulate",
                           "Let a crowd play the moves of a motion graph; nobody collides but who is forced to",
                           add_simulate_options, run_simulate);
}

}  // namespace mobbscope::cli
