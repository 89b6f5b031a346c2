#include <base/error.h>
#include <base/file.h>
#include <base/json_writer.h>
#include <base/text.h>
#include <cli/command_line.h>
#include <cli/options.h>
#include <cli/program.h>
#include <explain/placement_map.h>
#include <render/drawlist/picture_options.h>
#include <render/pictures/map_picture.h>
#include <render/vector/vector_picture.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::cli {

namespace {

struct MapCommandArguments : FittedArguments {
    int query = 0;
    MapOrder order;
    std::filesystem::path out;
    DrawingArguments drawing{.size = {960, 800}};
};

/// "dx=-5:5"
MapRange parse_axis(const std::string& text) {
    const std::size_t equals = text.find('=');
    const std::string axis = text.substr(0, equals);
    const std::optional<MapAxis> known = map_axis_from_name(axis);
    if (!known)
        throw std::invalid_argument(in_quotes(axis) + " is not one of " + listed(map_axis_names()) +
                                    "; write it like dx=-5:5,dy=-5:5");
    const auto range = equals == std::string::npos ? std::nullopt : parse_range(text.substr(equals + 1));
    if (!range)
        throw std::invalid_argument(in_quotes(text) + " has no range of two finite numbers; write it like " + axis +
                                    "=-5:5");
    return {*known, range->first, range->second};
}

void parse_axes(const std::string& text, MapOrder& order) {
    const std::size_t comma = text.find(',');
    if (comma == std::string::npos || text.find(',', comma + 1) != std::string::npos)
        throw std::invalid_argument("a map has two axes; write them like dx=-5:5,dy=-5:5");
    order.across = parse_axis(text.substr(0, comma));
    order.up = parse_axis(text.substr(comma + 1));
    check(order);
}

/// "256x256"
void parse_cells(const std::string& text, MapOrder& order) {
    const std::size_t times = std::min(text.find('x'), text.size());
    const int width = parse_int(text.substr(0, times)).value_or(0);
    const int height = parse_int(text.substr(std::min(times + 1, text.size()))).value_or(0);
    for (const int side : {width, height}) {
        if (side < 1 || side > kMostMapCells)
            throw std::invalid_argument(in_quotes(text) +
                                        " is not a number of cells; write it like 256x256, each from 1 to " +
                                        std::to_string(kMostMapCells));
    }
    order.width = width;
    order.height = height;
}

void write_map(std::ostream& out, int query, const PlacementMap& map) {
    const MapOrder& order = map.order;
    JsonWriter json(out);
    json.begin_object();
    json.member("query", query);
    json.begin_object("over", JsonWriter::Layout::row);
    for (const MapRange& range : {order.across, order.up}) json.member(name(range.axis), {range.from, range.to});
    json.end_object();
    json.key("cells");
    json.tuple(order.width, order.height);
    json.member("show", name(order.show));
    json.begin_array("values");
    for (int y = 0; y < order.height; ++y) {
        json.begin_array(JsonWriter::Layout::row);
        for (int x = 0; x < order.width; ++x) {
            if (order.show == MapShow::clearance) {
                json.value(map.value(x, y));
            } else {
                json.value(static_cast<std::int64_t>(map.value(x, y)));
            }
        }
        json.end_array();
    }
    json.end_array();
    json.end_object();
}

void run_map(MapCommandArguments& arguments) {
    if (arguments.out.empty() && !arguments.json)
        throw UsageError("map makes a picture or JSON: give -o MAP.png or --json");
    check_picture_output(arguments.out);
    const FittedScene scene = fitted(load(arguments.file, arguments.import_options), arguments.fit);
    check_asks(scene, arguments.file);
    refuse_bodies(scene.scene(), "a map");
    const std::size_t count = scene.queries().size();
    if (static_cast<std::size_t>(arguments.query) >= count)
        throw InputError(arguments.file,
                         "there is no query " + std::to_string(arguments.query) + "; " +
                             (count == 1 ? "0 is the only one" : "they go from 0 to " + std::to_string(count - 1)));
    if (!arguments.out.empty()) check_output(arguments.out);
    const SceneQuery query = scene.queries()[static_cast<std::size_t>(arguments.query)];
    if (arguments.fit.brute) arguments.order.search = Search::direct;
    try {
        check(arguments.order, query.b.placement, scene.tree(query.b).clip());
    } catch (const std::invalid_argument& error) {
        throw InputError(arguments.file, "query " + std::to_string(arguments.query) + ": " + error.what());
    }
    const PlacementMap map = map_placements(scene, query, arguments.order, {}, tell("asked", "placements"));
    const std::string a = cleaned(query.a.name), b = cleaned(query.b.name);
    if (!arguments.out.empty()) {
        const DrawList list =
            map_picture(map, a, b, arguments.drawing.size, arguments.drawing.theme, arguments.drawing.scale);
        write_file(arguments.out, picture_bytes(arguments.out, list, kPictureSamples, arguments.drawing.backend));
    }
    if (arguments.json) {
        write_map(std::cout, arguments.query, map);
    } else {
        std::cout << arguments.query << ": " << map_words(map, a, b) << '\n';
    }
    flush_results();
}

void add_map_options(Command& command, MapCommandArguments& arguments) {
    add_fitted_options(command, arguments, "The values as JSON", Brute::allowed);
    add_parsed(command, "--query", arguments.query, whole_number_within(0, std::numeric_limits<int>::max()),
               "Which query, from 0 (0)", "K");
    const auto set_axes = [&arguments](const std::string& text) { parse_axes(text, arguments.order); };
    command
        .add_option("--over", set_axes,
                    "What is added to B's placement: two of dx and dy (m), dheading (degrees) and dstart (s), each "
                    "with its range; the first goes to the right",
                    "dx=A:B,dy=A:B")
        .required();
    const auto set_cells = [&arguments](const std::string& text) { parse_cells(text, arguments.order); };
    command.add_option("--cells", set_cells, "Placements to the right and upwards (256x256)", "WxH");
    add_parsed(command, "--show", arguments.order.show, one_of(map_show_from_name, "answer, clearance, tests"),
               "answer (whether they collide), clearance (the least, in metres) or tests (of boxes and samples) "
               "(answer)",
               "WHAT");
    add_parsed(command, "-o,--output", arguments.out, parse_output_name, "The picture: .png, .svg or .pdf", "MAP.png");
    add_drawing_options(command, arguments.drawing);
}

}  // namespace

void add_map_command(Command& program) {
    program.add_subcommand("map", "Ask a query at many placements of its B: where would the two collide?",
                           add_map_options, run_map);
}

}  // namespace mobbscope::cli
