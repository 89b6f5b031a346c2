#include <base/error.h>
#include <base/text.h>
#include <scene/motion_graph.h>
#include <scene/scene.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <unordered_set>

namespace mobbscope {

namespace {

using Layout = JsonWriter::Layout;

using Neighbours = std::vector<std::vector<int>>;

/// Adds the nodes reached from one that are not seen yet, each after those that it leads to.
void add_reached(const Neighbours& next, int from, std::vector<bool>& seen, std::vector<int>& out) {
    struct Step {
        int node;
        std::size_t done = 0;
    };
    if (seen[static_cast<std::size_t>(from)]) return;
    seen[static_cast<std::size_t>(from)] = true;
    std::vector<Step> open{{from}};
    while (!open.empty()) {
        const auto node = static_cast<std::size_t>(open.back().node);
        if (open.back().done == next[node].size()) {
            out.push_back(open.back().node);
            open.pop_back();
            continue;
        }
        const int other = next[node][open.back().done++];
        if (seen[static_cast<std::size_t>(other)]) continue;
        seen[static_cast<std::size_t>(other)] = true;
        open.push_back({other});
    }
}

constexpr double kMaxAngle = 1e9;  // degrees, as for placements

double read_bound(const JsonPlace& bounds, const char* key) {
    const auto bound = bounds.find(key);
    if (!bound || bound->is_null()) return std::numeric_limits<double>::infinity();
    return bound->number(0, mobb::kMaxLength);
}

GraphBounds read_bounds(const JsonPlace& place) {
    place.allow_only({"pose_distance", "root_speed"});
    return {read_bound(place, "pose_distance"), read_bound(place, "root_speed")};
}

std::vector<GraphHub> read_hubs(const JsonPlace& place) {
    if (place.size() == 0) place.fail("there is no hub; add one");
    std::vector<GraphHub> hubs;
    std::unordered_set<std::string> names;
    for (int i = 0; i < place.size(); ++i) {
        const JsonPlace hub = place[i];
        hub.allow_only({"name"});
        const JsonPlace name = hub.require("name");
        if (name.string().empty()) name.fail("a hub needs a name");
        if (!names.insert(name.string()).second) name.fail("another hub is named " + in_quotes(name.string()));
        hubs.push_back({name.string()});
    }
    return hubs;
}

GraphRig read_rig(const JsonPlace& place) {
    place.allow_only({"joints"});
    const JsonPlace joints = place.require("joints");
    if (joints.size() == 0) joints.fail("there is no joint; name those that count");
    GraphRig rig;
    std::unordered_set<std::string> names;
    for (int i = 0; i < joints.size(); ++i) {
        const JsonPlace name = joints[i];
        if (!names.insert(name.string()).second) name.fail("the joint " + in_quotes(name.string()) + " is given twice");
        rig.joints.push_back(name.string());
    }
    return rig;
}

Stance read_stance(const JsonPlace& place) {
    place.require_size(3, "[x, y, heading in degrees]");
    return {{place[0].number(-kMostStance, kMostStance), place[1].number(-kMostStance, kMostStance)},
            place[2].number(-kMaxAngle, kMaxAngle)};
}

TurnedMove read_turned(const JsonPlace& place, int moves) {
    place.allow_only({"move", "deg"});
    return {place.require("move").integer(0, moves - 1), place.require("deg").number(-180, 180)};
}

constexpr double kSameHeading = 1e-6;  // degrees: more than rounding

/// Checks a turned move against the one that it is a variant of.
void check_turned(const JsonPlace& place, const std::vector<GraphMove>& moves, const GraphMove& turned) {
    if (!turned.turned) return;
    const JsonPlace variant = place.require("turned");
    const JsonPlace of = variant.require("move");
    const GraphMove& base = moves[static_cast<std::size_t>(turned.turned->move)];
    if (base.turned) of.fail("that move is turned itself; name the one that it is a variant of");
    if (turned.from != base.from || turned.to != base.to || turned.rig != base.rig)
        of.fail("that move joins other hubs, or is of another rig; name the one that this is a variant of");
    if (turned.entry != base.entry) of.fail("that move has another entry; a turned one begins as it does");
    const double heading = base.exit.heading_deg + turned.turned->deg;
    if (!(std::abs(std::remainder(turned.exit.heading_deg - heading, 360.0)) <= kSameHeading)) {
        const JsonPlace exit = place.require("exit");
        exit[2].fail("a move that turns by " + brief(turned.turned->deg) + " degrees ends at " + brief(heading) +
                     " degrees; give those");
    }
}

/// As std::remainder(degrees, 360), to the last bit; sooner where that is a subtraction, which is exact then.
double within_half_a_turn(double degrees) {
    const double size = std::abs(degrees);
    if (size <= 180) return degrees;
    if (size < 540 && size != 360) return degrees - std::copysign(360.0, degrees);
    return std::remainder(degrees, 360.0);
}

void write_stance(JsonWriter& out, const char* key, const Stance& stance) {
    out.member(key, {stance.position.x, stance.position.y, stance.heading_deg});
}

}  // namespace

double heading_of(glm::dvec2 way) { return std::atan2(way.y, way.x) * 180 / std::numbers::pi; }

MoveEnd end_of(const mobb::Placement& at, const Stance& exit, double duration) {
    return {at.rotation()(exit.position) + at.translate, at.rotate_deg + exit.heading_deg, at.start + duration};
}

mobb::Placement beginning_at(const MoveEnd& end, const Stance& entry) {
    // Headings add up over a long walk: kept within a turn, they stay exact.
    mobb::Placement next{{}, within_half_a_turn(end.heading_deg - entry.heading_deg), end.time};
    next.translate = end.position - next.rotation()(entry.position);
    return next;
}

mobb::Placement following(const mobb::Placement& before, const Stance& exit, double duration, const Stance& entry) {
    return beginning_at(end_of(before, exit, duration), entry);
}

std::vector<int> strong_components(int nodes, const std::vector<std::pair<int, int>>& edges) {
    const auto count = static_cast<std::size_t>(nodes);
    Neighbours next(count);
    Neighbours before(count);
    for (const auto& [from, to] : edges) {
        next[static_cast<std::size_t>(from)].push_back(to);
        before[static_cast<std::size_t>(to)].push_back(from);
    }
    // Kosaraju's algorithm: backwards from the nodes that lead to most.
    std::vector<int> order;
    std::vector<bool> seen(count, false);
    for (int node = 0; node < nodes; ++node) add_reached(next, node, seen, order);
    std::reverse(order.begin(), order.end());
    std::vector<int> first(count);  // of each node, the least node of its component
    seen.assign(count, false);
    for (const int node : order) {
        std::vector<int> members;
        add_reached(before, node, seen, members);
        if (members.empty()) continue;
        const int least = *std::min_element(members.begin(), members.end());
        for (const int member : members) first[static_cast<std::size_t>(member)] = least;
    }
    std::vector<int> number(count, -1);
    std::vector<int> out;
    int components = 0;
    for (const int node : first) {
        int& of = number[static_cast<std::size_t>(node)];
        if (of < 0) of = components++;
        out.push_back(of);
    }
    return out;
}

std::vector<int> hub_components(const MotionGraph& graph) {
    std::vector<std::pair<int, int>> edges;
    for (const GraphMove& move : graph.moves) edges.emplace_back(move.from, move.to);
    return strong_components(static_cast<int>(graph.hubs.size()), edges);
}

std::vector<std::vector<int>> moves_by_hub(const MotionGraph& graph) {
    std::vector<std::vector<int>> by_hub(graph.hubs.size());
    for (std::size_t i = 0; i < graph.moves.size(); ++i) {
        by_hub[static_cast<std::size_t>(graph.moves[i].from)].push_back(static_cast<int>(i));
    }
    return by_hub;
}

MotionGraph read_graph(const JsonPlace& place, const std::function<int(const JsonPlace&)>& clip_at) {
    place.allow_only({"hubs", "bounds", "rigs", "moves"});
    MotionGraph graph;
    graph.hubs = read_hubs(place.require("hubs"));
    const auto bounds = place.find("bounds");
    constexpr double kNone = std::numeric_limits<double>::infinity();
    graph.bounds = bounds ? read_bounds(*bounds) : GraphBounds{kNone, kNone};
    if (const auto rigs = place.find("rigs")) {
        for (int i = 0; i < rigs->size(); ++i) graph.rigs.push_back(read_rig((*rigs)[i]));
    }
    const JsonPlace moves = place.require("moves");
    if (moves.size() == 0) moves.fail("there is no move; add one");
    const int last_hub = static_cast<int>(graph.hubs.size()) - 1;
    const int last_rig = static_cast<int>(graph.rigs.size()) - 1;
    for (int i = 0; i < moves.size(); ++i) {
        const JsonPlace move = moves[i];
        move.allow_only({"clip", "from", "to", "entry", "exit", "rig", "turned"});
        const auto rig = move.find("rig");
        if (rig && graph.rigs.empty()) rig->fail("the graph lists no rigs; add \"rigs\", or leave this out");
        graph.moves.push_back({clip_at(move.require("clip")), move.require("from").integer(0, last_hub),
                               move.require("to").integer(0, last_hub), read_stance(move.require("entry")),
                               read_stance(move.require("exit")), rig ? rig->integer(0, last_rig) : -1});
        if (const auto turned = move.find("turned")) graph.moves.back().turned = read_turned(*turned, moves.size());
    }
    for (int i = 0; i < moves.size(); ++i)
        check_turned(moves[i], graph.moves, graph.moves[static_cast<std::size_t>(i)]);
    return graph;
}

void write_bounds(JsonWriter& out, const GraphBounds& bounds) {
    out.key("bounds");
    // An infinite number is written as null, which reads as no bound.
    out.row("pose_distance", bounds.pose_distance, "root_speed", bounds.root_speed);
}

void write_graph(JsonWriter& out, const MotionGraph& graph, const std::function<std::string(int)>& clip_name) {
    out.begin_object();
    out.list("hubs", graph.hubs, [&](const GraphHub& hub) { out.row("name", hub.name); });
    write_bounds(out, graph.bounds);
    if (!graph.rigs.empty()) {
        out.list("rigs", graph.rigs, [&](const GraphRig& rig) {
            out.begin_object(Layout::row);
            out.values("joints", rig.joints);
            out.end_object();
        });
    }
    out.list("moves", graph.moves, [&](const GraphMove& move) {
        out.begin_object(Layout::row);
        out.members("clip", clip_name(move.clip), "from", move.from, "to", move.to);
        write_stance(out, "entry", move.entry);
        write_stance(out, "exit", move.exit);
        if (move.rig >= 0) out.member("rig", move.rig);
        if (move.turned) {
            out.key("turned");
            out.row("move", move.turned->move, "deg", move.turned->deg);
        }
        out.end_object();
    });
    out.end_object();
}

void check_moves(const Scene& scene, const MotionGraph& graph, const std::string& file) {
    std::size_t moves = 0, samples = 0;
    for (const GraphMove& move : graph.moves) {
        if (move.turned) continue;
        ++moves;
        samples += static_cast<std::size_t>(scene.clips[static_cast<std::size_t>(move.clip)].clip->count());
    }
    if (samples <= kMostMoveSamples + kSamplesOfMove * moves) return;
    throw InputError(file, "of " + counted(moves, "move", "moves") + " there are " + std::to_string(samples) +
                               " samples, more than " + std::to_string(kMostMoveSamples) + " and " +
                               std::to_string(kSamplesOfMove) + " for each; take shorter moves, or lower fps");
}

}  // namespace mobbscope
