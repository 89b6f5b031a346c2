#include <base/json_writer.h>
#include <base/text.h>
#include <cli/graph_info.h>
#include <scene/motion_graph.h>

#include <algorithm>
#include <cmath>
#include <iomanip>

namespace mobbscope::cli {

namespace {

using Layout = JsonWriter::Layout;

constexpr std::size_t kMostRows = 40;  // of a list for people; JSON has all

const std::string& clip_of_move(const Scene& scene, int move) {
    const GraphMove& of = scene.graph->moves[static_cast<std::size_t>(move)];
    return scene.clips[static_cast<std::size_t>(of.clip)].name;
}

/// Three decimals: millimetres.
std::string rounded(double value) { return brief(std::round(value * 1000) / 1000); }

void print_spread(std::ostream& out, const Scene& scene, const char* what, const char* unit,
                  const TransitionSpread& spread, double bound) {
    out << "  " << std::left << std::setw(16) << what << std::right;
    if (spread.count == 0) {
        out << "not measured: no two clips that join have one skeleton\n";
        return;
    }
    out << rounded(spread.median) << ' ' << unit << " median, " << rounded(spread.largest) << " at most (bound "
        << (std::isfinite(bound) ? brief(bound) : "none") << "), where "
        << in_quotes(clip_of_move(scene, spread.before)) << " goes on with "
        << in_quotes(clip_of_move(scene, spread.after)) << '\n';
}

void print_more(std::ostream& out, std::size_t all) {
    if (all > kMostRows) out << "  and " << all - kMostRows << " more\n";
}

void write_spread(JsonWriter& out, const char* key, const Scene& scene, const TransitionSpread& spread) {
    out.key(key);
    out.begin_object(Layout::row);
    out.member("count", static_cast<std::int64_t>(spread.count));
    const bool any = spread.count > 0;
    out.key("median");
    any ? out.value(spread.median) : out.null();
    out.key("largest");
    any ? out.value(spread.largest) : out.null();
    out.key("before");
    any ? out.value(clip_of_move(scene, spread.before)) : out.null();
    out.key("after");
    any ? out.value(clip_of_move(scene, spread.after)) : out.null();
    out.end_object();
}

}  // namespace

void print_graph_info(std::ostream& out, const Scene& scene, const GraphFigures& figures,
                      const TransitionMeasures& transitions) {
    const MotionGraph& graph = *scene.graph;
    out << cleaned(scene.file.string()) << ": " << counted(graph.hubs.size(), "hub", "hubs") << ", "
        << counted(figures.moves, "move", "moves") << ", " << brief(figures.seconds) << " s of motion\n"
        << "  a choice        every " << brief(figures.seconds_between_choices) << " s, among "
        << brief(figures.choices) << " moves on average\n";
    print_spread(out, scene, "pose distance", "m", transitions.pose_distance, graph.bounds.pose_distance);
    print_spread(out, scene, "root velocity", "m/s", transitions.root_speed, graph.bounds.root_speed);
    if (transitions.pose_distance.count > 0 && transitions.pose_distance.count < transitions.count) {
        out << "                  " << transitions.count - transitions.pose_distance.count << " of "
            << transitions.count << " joints have no pose distance: their clips have no skeleton, or another one\n";
    }
    out << "  hub       begin here   end here   m/s\n";
    for (std::size_t h = 0; h < std::min(figures.hubs.size(), kMostRows); ++h) {
        const HubFigures& hub = figures.hubs[h];
        out << "  " << std::left << std::setw(8) << cleaned(hub.name) << std::right << std::setw(12) << hub.begin
            << std::setw(11) << hub.end << std::setw(6) << brief(std::round(hub.speed * 100) / 100)
            << (hub.begin == 0 ? "   dead end" : "") << '\n';
    }
    print_more(out, figures.hubs.size());
    out << "  in " << counted(figures.components.size(), "part", "parts") << " whose hubs lead to each other\n";
    for (std::size_t c = 0; figures.components.size() > 1 && c < std::min(figures.components.size(), kMostRows); ++c) {
        const ComponentFigures& part = figures.components[c];
        out << "  part " << c << ": " << counted(part.hubs.size(), "hub", "hubs") << " from "
            << cleaned(figures.hubs[static_cast<std::size_t>(part.hubs.front())].name) << ", "
            << counted(part.moves, "move", "moves") << ", " << brief(part.seconds) << " s\n";
    }
    if (figures.components.size() > 1) print_more(out, figures.components.size());
    for (std::size_t s = 0; s < std::min(figures.sources.size(), kMostRows); ++s) {
        const SourceFigures& source = figures.sources[s];
        out << "  " << counted(source.moves, "move", "moves") << ", " << brief(source.seconds) << " s, from "
            << (source.file.empty() ? "samples in the file" : cleaned(source.file)) << '\n';
    }
    print_more(out, figures.sources.size());
}

void write_graph_info(std::ostream& to, const Scene& scene, const GraphFigures& figures,
                      const TransitionMeasures& transitions) {
    const MotionGraph& graph = *scene.graph;
    JsonWriter out(to);
    out.begin_object();
    out.member("file", scene.file.string());
    out.key("hubs");
    out.begin_array();
    for (const HubFigures& hub : figures.hubs) {
        out.begin_object(Layout::row);
        out.member("name", hub.name);
        out.member("begin", static_cast<std::int64_t>(hub.begin));
        out.member("end", static_cast<std::int64_t>(hub.end));
        out.member("speed", hub.speed);
        out.end_object();
    }
    out.end_array();
    out.member("moves", static_cast<std::int64_t>(figures.moves));
    out.member("seconds", figures.seconds);
    out.key("bounds");
    out.begin_object(Layout::row);
    out.member("pose_distance", graph.bounds.pose_distance);
    out.member("root_speed", graph.bounds.root_speed);
    out.end_object();
    out.key("joints");
    out.begin_object();
    out.member("count", static_cast<std::int64_t>(transitions.count));
    write_spread(out, "pose_distance", scene, transitions.pose_distance);
    write_spread(out, "root_speed", scene, transitions.root_speed);
    out.end_object();
    out.member("choices", figures.choices);
    out.member("seconds_between_choices", figures.seconds_between_choices);
    out.key("components");
    out.begin_array();
    for (const ComponentFigures& part : figures.components) {
        out.begin_object(Layout::row);
        out.key("hubs");
        out.begin_array(Layout::row);
        for (const int hub : part.hubs) out.value(hub);
        out.end_array();
        out.member("moves", static_cast<std::int64_t>(part.moves));
        out.member("seconds", part.seconds);
        out.end_object();
    }
    out.end_array();
    out.key("dead_ends");
    out.begin_array(Layout::row);
    for (const int hub : figures.dead_ends) out.value(hub);
    out.end_array();
    out.key("sources");
    out.begin_array();
    for (const SourceFigures& source : figures.sources) {
        out.begin_object(Layout::row);
        out.key("file");
        source.file.empty() ? out.null() : out.value(source.file);
        out.member("moves", static_cast<std::int64_t>(source.moves));
        out.member("seconds", source.seconds);
        out.end_object();
    }
    out.end_array();
    out.member("holds", broken_bounds(scene, transitions).empty());
    out.end_object();
}

std::vector<std::string> broken_bounds(const Scene& scene, const TransitionMeasures& transitions) {
    std::vector<std::string> out;
    const auto hold = [&](const TransitionSpread& spread, double bound, const char* what, const char* unit) {
        if (!exceeds(spread, bound)) return;
        out.push_back(std::string(what) + " is " + brief(spread.largest) + ' ' + unit + " where " +
                      in_quotes(clip_of_move(scene, spread.before)) + " goes on with " +
                      in_quotes(clip_of_move(scene, spread.after)) + ", over the bound of " + brief(bound) + ' ' +
                      unit);
    };
    hold(transitions.pose_distance, scene.graph->bounds.pose_distance, "the pose distance", "m");
    hold(transitions.root_speed, scene.graph->bounds.root_speed, "the change of the root's velocity", "m/s");
    return out;
}

}  // namespace mobbscope::cli
