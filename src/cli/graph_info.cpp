#include <base/file.h>
#include <base/json_writer.h>
#include <base/text.h>
#include <cli/continuity_report.h>
#include <cli/graph_info.h>
#include <scene/motion_graph.h>

#include <algorithm>
#include <cmath>
#include <iomanip>

namespace mobbscope::cli {

namespace {

using Layout = JsonWriter::Layout;

constexpr std::size_t kMostRows = 40;      // of a list for people; JSON has all
constexpr std::size_t kLongestNames = 80;  // characters of a list of joints

const std::string& clip_of_move(const Scene& scene, int move) {
    const GraphMove& of = scene.graph->moves[static_cast<std::size_t>(move)];
    return scene.clips[static_cast<std::size_t>(of.clip)].name;
}

/// Three decimals: millimetres.
std::string rounded(double value) { return brief(std::round(value * 1000) / 1000); }

/// One decimal.
std::string seconds_text(double value) { return brief(std::round(value * 10) / 10); }

void print_spread(std::ostream& out, const Scene& scene, const char* what, const char* unit,
                  const TransitionSpread& spread, double bound) {
    out << "  " << std::left << std::setw(16) << what << std::right;
    if (spread.count == 0) {
        out << "not measured: no two clips that join have one skeleton\n";
        return;
    }
    out << rounded(spread.median) << ' ' << unit << " median, " << rounded(spread.largest) << " at most (bound "
        << (std::isfinite(bound) ? brief(bound) : "none") << ") as recorded, where "
        << in_quotes(clip_of_move(scene, spread.before)) << " goes on with "
        << in_quotes(clip_of_move(scene, spread.after)) << '\n';
}

void print_more(std::ostream& out, std::size_t all) {
    if (all > kMostRows) out << "  and " << all - kMostRows << " more\n";
}

std::size_t moves_of_rig(const MotionGraph& graph, std::size_t rig) {
    return static_cast<std::size_t>(std::count_if(graph.moves.begin(), graph.moves.end(), [&](const GraphMove& move) {
        return move.rig == static_cast<int>(rig);
    }));
}

/// The names of the joints that count, as many as fit a line.
std::string joint_names(const GraphRig& rig) {
    std::string out;
    for (const std::string& joint : rig.joints) out += (out.empty() ? "" : ", ") + cleaned(joint);
    return shortened(out, kLongestNames);
}

void write_spread(JsonWriter& out, const char* key, const Scene& scene, const TransitionSpread& spread) {
    const auto if_any = [&spread](const auto& value) { return spread.count > 0 ? std::optional(value) : std::nullopt; };
    const auto clip = [&](int move) {
        return spread.count > 0 ? std::optional(clip_of_move(scene, move)) : std::nullopt;
    };
    out.begin_object(key, Layout::row);
    out.member("count", spread.count);
    out.member("median", if_any(spread.median));
    out.member("largest", if_any(spread.largest));
    out.member("before", clip(spread.before));
    out.member("after", clip(spread.after));
    out.end_object();
}

}  // namespace

void print_graph_info(std::ostream& out, const Scene& scene, const GraphFigures& figures,
                      const TransitionMeasures& transitions, const Continuity& continuity) {
    const MotionGraph& graph = *scene.graph;
    out << cleaned(shown_name(scene.file)) << ": " << counted(graph.hubs.size(), "hub", "hubs") << ", "
        << counted(figures.moves, "move", "moves") << ", " << seconds_text(figures.seconds) << " s of motion\n"
        << "  a choice        every " << brief(std::round(figures.seconds_between_choices * 100) / 100) << " s, among "
        << brief(std::round(figures.choices * 10) / 10) << " moves on average\n";
    print_spread(out, scene, "pose distance", "m", transitions.pose_distance, graph.bounds.pose_distance);
    print_spread(out, scene, "root velocity", "m/s", transitions.root_speed, graph.bounds.root_speed);
    if (transitions.pose_distance.count > 0 && transitions.pose_distance.count < transitions.count) {
        out << "                  " << transitions.count - transitions.pose_distance.count << " of "
            << transitions.count << " joins have no pose distance: their clips have no skeleton, or another one\n";
    }
    print_continuity(out, scene, continuity);
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
            << counted(part.moves, "move", "moves") << ", " << seconds_text(part.seconds) << " s\n";
    }
    if (figures.components.size() > 1) print_more(out, figures.components.size());
    for (std::size_t r = 0; r < std::min(graph.rigs.size(), kMostRows); ++r) {
        out << "  rig " << r << ": " << counted(moves_of_rig(graph, r), "move", "moves") << ", poses compared by "
            << counted(graph.rigs[r].joints.size(), "joint", "joints") << ": " << joint_names(graph.rigs[r]) << '\n';
    }
    print_more(out, graph.rigs.size());
    for (std::size_t s = 0; s < std::min(figures.sources.size(), kMostRows); ++s) {
        const SourceFigures& source = figures.sources[s];
        out << "  " << counted(source.moves, "move", "moves") << ", " << seconds_text(source.seconds) << " s, from "
            << (source.file.empty() ? "samples in the file" : cleaned(source.file)) << '\n';
    }
    print_more(out, figures.sources.size());
}

void write_graph_info(std::ostream& to, const Scene& scene, const GraphFigures& figures,
                      const TransitionMeasures& transitions, const Continuity& continuity) {
    JsonWriter out(to);
    out.begin_object();
    out.member("file", scene.file.string());
    out.list("hubs", figures.hubs, [&](const HubFigures& hub) {
        out.begin_object(Layout::row);
        out.member("name", hub.name);
        out.member("begin", hub.begin);
        out.member("end", hub.end);
        out.member("speed", hub.speed);
        out.end_object();
    });
    out.member("moves", figures.moves);
    out.member("seconds", figures.seconds);
    write_bounds(out, scene.graph->bounds);
    out.begin_object("joints");
    out.member("count", transitions.count);
    write_spread(out, "pose_distance", scene, transitions.pose_distance);
    write_spread(out, "root_speed", scene, transitions.root_speed);
    out.end_object();
    write_continuity(out, "continuity", scene, continuity);
    out.member("choices", figures.choices);
    out.member("seconds_between_choices", figures.seconds_between_choices);
    out.list("components", figures.components, [&](const ComponentFigures& part) {
        out.begin_object(Layout::row);
        out.values("hubs", part.hubs);
        out.member("moves", part.moves);
        out.member("seconds", part.seconds);
        out.end_object();
    });
    out.values("dead_ends", figures.dead_ends);
    std::size_t rig = 0;
    out.list("rigs", scene.graph->rigs, [&](const GraphRig& of) {
        out.begin_object(Layout::row);
        out.member("moves", moves_of_rig(*scene.graph, rig++));
        out.values("joints", of.joints);
        out.end_object();
    });
    out.list("sources", figures.sources, [&](const SourceFigures& source) {
        out.begin_object(Layout::row);
        out.key("file");
        source.file.empty() ? out.null() : out.value(source.file);
        out.member("moves", source.moves);
        out.member("seconds", source.seconds);
        out.end_object();
    });
    out.member("holds", broken_bounds(scene, transitions, continuity).empty());
    out.end_object();
}

std::vector<std::string> broken_bounds(const Scene& scene, const TransitionMeasures& transitions,
                                       const Continuity& continuity) {
    std::vector<std::string> out = broken_continuity(scene, continuity);
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
