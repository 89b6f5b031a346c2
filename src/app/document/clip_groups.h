/// Clips that belong together, as the outline lists them.
#pragma once

#include <scene/scene.h>

#include <string>
#include <vector>

namespace mobbscope::app {

/// Clips of one folder and one rig.
struct ClipGroup {
    std::string title;       ///< what tells it from the others: "short", "Hips, 22 joints" or "short: Hips, 22 joints"
    std::vector<int> clips;  ///< indices into Scene::clips, ascending
};

/// By folder and, within one, by rig: clips have one rig if root and joints have the same names. In the order of their
/// first clips; empty where all would be in one group.
std::vector<ClipGroup> clip_groups(const Scene& scene);

}  // namespace mobbscope::app
