/// A motion graph in the manner of Snap-Together Motion (Gleicher et al. 2003, the paper's [3]): short clips that begin
/// and end in common poses, the hubs. Whatever ends in a hub may be followed by whatever begins there. It is the key
/// `graph` of a scene file, whose clips it joins.
#pragma once

#include <base/json.h>
#include <base/json_writer.h>
#include <mobb/clip.h>

#include <glm/vec2.hpp>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope {

struct Scene;  // scene/scene.h

/// Where a body stands on the floor of its clip, and which way it faces.
struct Stance {
    glm::dvec2 position{0};  ///< metres
    double heading_deg = 0;  ///< counter-clockwise from +x
    friend bool operator==(const Stance&, const Stance&) = default;
};

/// A pose in which clips begin and end.
struct GraphHub {
    std::string name;
    friend bool operator==(const GraphHub&, const GraphHub&) = default;
};

/// Of which move another is a variant whose way is bent (scene/clip_turn.h).
struct TurnedMove {
    int move = 0;    ///< index into MotionGraph::moves, of one that is no variant itself
    double deg = 0;  ///< that it turns further, counter-clockwise
    friend bool operator==(const TurnedMove&, const TurnedMove&) = default;
};

/// A clip of the scene as an edge from hub to hub.
struct GraphMove {
    int clip = 0;  ///< index into Scene::clips
    int from = 0;  ///< index into MotionGraph::hubs
    int to = 0;
    Stance entry;  ///< at the clip's first sample
    Stance exit;   ///< where the next clip's first sample comes: one dt after the last sample
    int rig = -1;  ///< index into MotionGraph::rigs; -1: the clip has no skeleton, or the file does not say
    std::optional<TurnedMove> turned{};  ///< none: a move of its own
    friend bool operator==(const GraphMove&, const GraphMove&) = default;
};

/// What the poses of moves are compared by. Moves of different rigs have no pose distance.
struct GraphRig {
    /// Names of the joints that count, each once; all joints below the root that have the name. A name that is not
    /// UTF-8 is written as '#' and the joint's index.
    std::vector<std::string> joints;
    friend bool operator==(const GraphRig&, const GraphRig&) = default;
};

/// How far a joint between two moves may be from continuous. Infinite where nothing was asked.
struct GraphBounds {
    double pose_distance = 0;  ///< metres: root mean square over the joints, bodies aligned on the floor
    double root_speed = 0;     ///< metres per second: change of the root's velocity
    friend bool operator==(const GraphBounds&, const GraphBounds&) = default;
};

/// Metres: moves add up, and what is placed must stay within mobb::kMaxLength.
inline constexpr double kMostStance = 1e6;

struct MotionGraph {
    std::vector<GraphHub> hubs;
    std::vector<GraphMove> moves;
    GraphBounds bounds;
    std::vector<GraphRig> rigs;  ///< empty in a file that does not say, as older ones, and where no clip has a skeleton
    friend bool operator==(const MotionGraph&, const MotionGraph&) = default;
};

/// Degrees from +x, counter-clockwise.
double heading_of(glm::dvec2 way);

/// Where and when a placed move has ended: what follows begins there.
struct MoveEnd {
    glm::dvec2 position{0};  ///< metres
    double heading_deg = 0;
    double time = 0;  ///< global seconds
};
/// `duration`: seconds until the next move begins, as Clip::until_next.
MoveEnd end_of(const mobb::Placement& placed, const Stance& exit, double duration);
/// The placement of a move that begins there.
mobb::Placement beginning_at(const MoveEnd& end, const Stance& entry);

/// The placement of a move that begins where another, placed, ends: one rigid motion of the floor, and `duration`
/// seconds later, which is Clip::until_next of the move before.
mobb::Placement following(const mobb::Placement& before, const Stance& exit, double duration, const Stance& entry);

/// For each node the number of its strongly connected component, counted from 0 in the order of their first nodes.
/// `edges`: pairs of nodes in [0, nodes), from and to.
std::vector<int> strong_components(int nodes, const std::vector<std::pair<int, int>>& edges);

/// For each hub the number of the part of the graph that it belongs to: from all hubs of a part moves lead to all
/// others of it. Counted from 0 in the order of their first hubs.
std::vector<int> hub_components(const MotionGraph& graph);

/// The moves that begin in each hub: indices into graph.moves in their order, by hub.
std::vector<std::vector<int>> moves_by_hub(const MotionGraph& graph);

/// `clip_at` gives the index of the clip that a place names, or throws InputError. Checks that there is a hub and a
/// move, that hubs have names of their own, that rigs have joints, each once, that moves join hubs and are of rigs that
/// exist, that turned ones begin and end as what they are variants of, and that stances and bounds are in range.
/// A hub that no move leaves is allowed. Throws InputError.
MotionGraph read_graph(const JsonPlace& place, const std::function<int(const JsonPlace&)>& clip_at);

/// The member `bounds` of an object.
void write_bounds(JsonWriter& out, const GraphBounds& bounds);

/// `clip_name` gives the name of the clip with an index.
void write_graph(JsonWriter& out, const MotionGraph& graph, const std::function<std::string(int)>& clip_name);

/// The most samples that the moves of a graph have together, and more for each: a crowd has every move turned some
/// forty ways.
inline constexpr std::size_t kMostMoveSamples = 500'000;
inline constexpr std::size_t kSamplesOfMove = 1'000;

/// Throws InputError naming the file if the moves of the scene's graph are too long for a crowd to play.
void check_moves(const Scene& scene, const MotionGraph& graph, const std::string& file);

}  // namespace mobbscope
