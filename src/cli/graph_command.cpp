#include <base/file.h>
#include <base/text.h>
#include <cli/command_line.h>
#include <cli/graph_report.h>
#include <cli/options.h>
#include <cli/program.h>
#include <crowd/graph/build_graph.h>
#include <render/drawlist/picture_options.h>
#include <render/pictures/graph_picture.h>
#include <render/vector/vector_picture.h>
#include <scene/motion_graph.h>

#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace mobbscope::cli {

namespace {

constexpr double kMostSeconds = 3600;  // of a move
constexpr int kMostCount = 10'000;

struct BuildArguments {
    std::vector<std::filesystem::path> places;
    std::filesystem::path out;
    GraphOptions options;
    bool whole = false;
    bool strict = false;
    bool inline_samples = false;
    ImportOptions import_options;
};

struct InfoArguments {
    std::filesystem::path file;
    bool json = false;
};

struct DrawArguments {
    std::filesystem::path file;
    std::filesystem::path out;
    DrawingArguments drawing;
};

std::string moves_text(std::size_t count) { return counted(count, "move", "moves"); }

std::string hubs_text(std::size_t count) { return counted(count, "hub", "hubs"); }

void print_report(const BuildReport& report) {
    std::cout << "from " << counted(report.recordings, "recording", "recordings") << ", " << brief(report.seconds)
              << " s of " << counted(report.rigs, "rig", "rigs") << ": " << counted(report.pieces, "piece", "pieces")
              << " between the hubs\n"
              << "left out: " << report.alike << " that go like others or are more than --moves; "
              << moves_text(report.dead_ends) << " and " << hubs_text(report.dropped_hubs)
              << " at dead ends or in parts of fewer than --least-moves\n"
              << "measured again from the files: " << counted(report.joints_checked, "join", "joins") << "; "
              << moves_text(report.broken) << " dropped that broke a bound\n";
    if (report.rigs_left_out > 0) {
        warn(counted(report.rigs_left_out, "rig has", "rigs have") +
             " no pose that comes again often enough, and no part in the graph");
    }
    if (report.without_joints > 0) {
        warn(counted(report.without_joints, "clip has", "clips have") + " no joints, and no part in the graph");
    }
    if (report.too_long > 0) {
        warn(counted(report.too_long, "clip has", "clips have") +
             " too many samples to keep the joints of each, and no part in the graph; lower --fps");
    }
}

BuiltGraph whole_graph(Scene recordings) {
    recordings.graph = std::make_shared<MotionGraph>(graph_of_whole_clips(recordings));
    return {std::move(recordings), {}};
}

/// What names the input in a message.
std::string place_of(const std::vector<std::filesystem::path>& places) {
    return places.size() == 1 ? places.front().string() : counted(places.size(), "place", "places");
}

void warn_of_left_out(const std::vector<std::string>& left_out, std::size_t files) {
    for (const std::string& why : left_out) warn("left out: " + why);
    if (left_out.empty()) return;
    warn("left out " + std::to_string(left_out.size()) + " of " + counted(files, "file", "files") +
         "; with --strict a bad file ends the build");
}

int build(const BuildArguments& arguments) {
    check_file_name(arguments.out);
    check_extension(arguments.out, ".json", "a graph is written as .json; rename the output");
    check_output(arguments.out);
    const auto files = clip_files(arguments.places);
    Recordings recordings =
        load_recordings(files, arguments.out, arguments.import_options, arguments.strict, tell("read", "files"));
    warn_of_left_out(recordings.left_out, files.size());
    check_output(arguments.out);  // again: now the files are known
    const std::string place = place_of(arguments.places);
    BuiltGraph built = arguments.whole
                           ? whole_graph(std::move(recordings.scene))
                           : build_graph(recordings.scene, arguments.options, place, tell("compared", "moments"));
    if (!arguments.whole) check_graph(built, arguments.options.least_moves, tell("measured", "clips"));
    if (built.scene.graph->moves.empty()) {
        complain(place + ": measured again from the files no move keeps the bounds (" +
                 moves_text(built.report.broken) + " dropped that broke one), so no graph is written");
        return kFailed;
    }
    write_file(arguments.out, to_json(built.scene, arguments.inline_samples));
    const MotionGraph& graph = *built.scene.graph;
    std::cout << cleaned(arguments.out.string()) << ": " << hubs_text(graph.hubs.size()) << ", "
              << moves_text(graph.moves.size()) << '\n';
    if (!arguments.whole) print_report(built.report);
    flush_results();
    return kDone;
}

Scene load_graph(const std::filesystem::path& file) {
    Scene scene = load_scene(file, {}, tell("read", "clips"));
    if (!scene.graph) throw InputError(file, "there is no motion graph in it; make one with mobbscope graph build");
    return scene;
}

int info(const InfoArguments& arguments) {
    const Scene scene = load_graph(arguments.file);
    const GraphFigures figures = graph_figures(scene);
    const TransitionMeasures transitions = measure_transitions(scene, tell("measured", "clips"));
    const Continuity continuity = graph_continuity(scene);
    (arguments.json ? write_graph_info : print_graph_info)(std::cout, scene, figures, transitions, continuity);
    flush_results();
    const std::vector<std::string> broken = broken_bounds(scene, transitions, continuity);
    for (const std::string& sentence : broken) complain(shown_name(arguments.file) + ": " + sentence);
    return broken.empty() ? kDone : kFailed;
}

void draw(const DrawArguments& arguments) {
    check_file_name(arguments.out);
    check_picture_output(arguments.out);
    const Scene scene = load_graph(arguments.file);
    check_output(arguments.out);
    const DrawList list =
        graph_picture(scene, arguments.drawing.size, arguments.drawing.theme, arguments.drawing.scale);
    write_file(arguments.out, picture_bytes(arguments.out, list, kPictureSamples, arguments.drawing.backend));
}

/// "1:4" in seconds.
std::pair<double, double> parse_seconds(const std::string& text) {
    const auto range = parse_range(text);
    if (!range || !(range->first > 0) || !(range->second >= range->first) || range->second > kMostSeconds) {
        throw std::invalid_argument(in_quotes(text) + " is no range of seconds over 0 and up to " +
                                    brief(kMostSeconds) + "; write it like 1:4");
    }
    return *range;
}

void add_build_options(Command& command, BuildArguments& arguments) {
    GraphOptions& options = arguments.options;
    command.add_option("PLACE", arguments.places, "Clip files, and folders of them with their subfolders", "")
        .required();
    command.add_option("-o,--output", arguments.out, "The graph, a scene", "GRAPH.json").required();
    add_parsed(command, "--pose-distance", options.bounds.pose_distance, number_within(0, 1e9),
               "Metres that poses may differ by where moves join: root mean square over the joints (0.16)", "D");
    add_parsed(command, "--root-speed", options.bounds.root_speed, number_within(0, 1e9),
               "Metres per second that the root's velocity may change by there (0.6)", "V");
    const auto set_seconds = [&options](const std::string& text) {
        std::tie(options.least_seconds, options.most_seconds) = parse_seconds(text);
    };
    command.add_option("--seconds", set_seconds, "How long moves last (1:4)", "A:B");
    add_parsed(command, "--warp", options.warp, number_within(0, kMostSeconds),
               "Seconds over which a move is warped at either end to its hub's pose and velocity; 0: not at all (0.3)",
               "S");
    add_parsed(command, "--hubs", options.hubs, whole_number_within(1, kMostCount), "Most hubs for each rig (8)", "N");
    add_parsed(command, "--moves", options.moves, whole_number_within(1, kMostCount),
               "Most moves from one hub to another; those that differ most are taken (16)", "N");
    add_parsed(command, "--least-moves", options.least_moves, whole_number_within(1, kMostCount),
               "Parts of the graph with fewer are left out (3)", "N");
    add_parsed(command, "--candidates", options.candidates, whole_number_within(1, kMostCount),
               "Moments of each rig that are looked at as hubs (400)", "N");
    add_parsed(command, "--seed", options.seed, parse_seed, "Decides which moments those are (1)", "S");
    command.add_flag("--whole", arguments.whole, "Takes clips whole, from one hub to itself, and bounds nothing");
    command.add_flag("--strict", arguments.strict, "A bad file in a folder ends the build; without it it is left out");
    command.add_flag("--inline", arguments.inline_samples,
                     "Writes samples, so that the file stands alone; without it clips lead to their files");
    add_import_options(command, arguments.import_options);
}

void add_graph_info_options(Command& command, InfoArguments& arguments) {
    add_parsed(command, "GRAPH", arguments.file, parse_file_name, "A scene with a motion graph", "").required();
    command.add_flag("--json", arguments.json, "The same as JSON");
}

void add_draw_options(Command& command, DrawArguments& arguments) {
    add_parsed(command, "GRAPH", arguments.file, parse_file_name, "A scene with a motion graph", "").required();
    command.add_option("-o,--output", arguments.out, "The picture: .png, .svg or .pdf", "OUT.png").required();
    add_drawing_options(command, arguments.drawing);
}

}  // namespace

void add_graph_command(Command& program) {
    program.add_subcommand("graph", "Motion graphs: build, info, draw", [](Command& graph) {
        graph.require_subcommand();
        graph.add_subcommand(
            "build",
            "Cut a motion graph out of recordings, at poses that come again; exit status 1 if nothing keeps its bounds",
            add_build_options, build);
        graph.add_subcommand("info", "What is in a graph, and whether its bounds hold; exit status 1 if they do not",
                             add_graph_info_options, info);
        graph.add_subcommand("draw", "Draw a graph: hubs, moves and the floor paths from each hub", add_draw_options,
                             draw);
    });
}

}  // namespace mobbscope::cli
