/// Walking through a motion graph, move after move.
#pragma once

#include <scene/motion_graph.h>
#include <scene/scene.h>

#include <vector>

namespace mobbscope {

/// The moves that begin in each hub: indices into graph.moves in their order, by hub.
std::vector<std::vector<int>> moves_by_hub(const MotionGraph& graph);

/// Where `next` lies if it follows `before`, which is placed. Indices into the graph's moves; the scene has a graph.
mobb::Placement following(const Scene& scene, int before, const mobb::Placement& placed, int next);

/// A graph without bounds: every clip of the scene whole, from one hub to itself, its stances read from its path
/// (facing the way it goes at either end, over at least 0.1 m). Throws InputError, naming the clip, if one
/// begins or ends beyond kMostStance.
MotionGraph graph_of_whole_clips(const Scene& scene);

}  // namespace mobbscope
