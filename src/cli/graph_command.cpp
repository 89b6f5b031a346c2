#include <base/file.h>
#include <base/text.h>
#include <cli/command_line.h>
#include <cli/graph_report.h>
#include <cli/options.h>
#include <cli/program.h>
#include <crowd/graph/build_graph.h>
#include <crowd/graph/build_words.h>
#include <crowd/graph/graph_options.h>
#include <render/drawlist/picture_options.h>
#include <render/pictures/graph_picture.h>
#include <render/vector/vector_picture.h>
#include <scene/motion_graph.h>

#include <cstddef>
#include <filesystem>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::cli {

namespace {

struct BuildArguments {
    std::vector<std::filesystem::path> places;
    std::filesystem::path out;
    GraphOptions options;
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
    const BuiltGraph built =
        make_graph(std::move(recordings.scene), arguments.options, place,
                   [comparing = tell("compared", "moments"), measuring = tell("measured", "clips")](
                       GraphStage stage, std::size_t done, std::size_t all) {
                       (stage == GraphStage::comparing ? comparing : measuring)(done, all);
                   });
    if (built.scene.graph->moves.empty()) {
        complain(place + ": " + why_no_move(built.report) + ", so no graph is written");
        return kFailed;
    }
    write_file(arguments.out, to_json(built.scene, arguments.inline_samples));
    std::cout << cleaned(arguments.out.string()) << ": " << size_in_words(*built.scene.graph) << '\n';
    if (!arguments.options.whole) {
        for (const std::string& sentence : in_words(built.report)) std::cout << sentence << '\n';
        for (const std::string& warning : warnings_of(built.report)) warn(warning);
    }
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

void add_build_options(Command& command, BuildArguments& arguments) {
    GraphOptions& options = arguments.options;
    command.add_option("PLACE", arguments.places, "Clip files, and folders of them with their subfolders", "")
        .required();
    add_parsed(command, "-o,--output", arguments.out, parse_output_name, "The graph, a scene", "GRAPH.json").required();
    add_number_options(command, graph_options(), options);
    command.add_flag("--whole", options.whole, std::string(kWholeHelp));
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
    add_parsed(command, "-o,--output", arguments.out, parse_output_name, "The picture: .png, .svg or .pdf", "OUT.png")
        .required();
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
