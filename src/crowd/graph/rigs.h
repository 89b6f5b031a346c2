/// Which recordings can be compared, and by which of their joints.
#pragma once

#include <scene/motion_graph.h>
#include <scene/scene.h>

#include <cstddef>
#include <vector>

namespace mobbscope {

/// The number of each clip's rig, counted from 0 in the order of their first clips; -1: it has no skeleton. Clips are
/// of one rig if their joints have the same names, hang on each other in the same way and have the same root.
std::vector<int> rig_of_each_clip(const Scene& scene);

/// The rigs of a scene's clips.
struct SceneRigs {
    std::vector<GraphRig> rigs;  ///< by number
    std::vector<int> of_clip;    ///< rig_of_each_clip
};

/// Tells rigs apart and chooses the joints that count: the root, and below it every joint whose bone is at least a
/// tenth of the rig's longest limb, for fingers and eyes would outvote the legs. A bone's length is the median over the
/// frames of all the rig's clips, so their order does not matter. What carries the path is no limb: a bone that begins
/// in the root, and one whose length changes by more than a tenth within a clip. What stands above the root does not
/// count.
SceneRigs rigs_of(const Scene& scene);

/// Lets the graph say by which joints its moves are measured: those of its scene's clips (rigs_of). Rigs that no move
/// is of are left out.
void set_rigs(MotionGraph& graph, const SceneRigs& of_scene);

/// Indices of the skeleton's joints that have the names, in the order of the names, of the root and what is below it;
/// End Sites are no joints. Throws std::invalid_argument, naming it, if there is none of a name.
std::vector<std::size_t> joints_of(const GraphRig& rig, const Skeleton& skeleton);

}  // namespace mobbscope
