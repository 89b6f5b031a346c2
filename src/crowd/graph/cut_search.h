/// Finds the frames of recordings that are like a given moment: the places at which they may be cut.
#pragma once

#include <crowd/graph/pose_distance.h>
#include <crowd/graph/rigs.h>
#include <scene/motion_graph.h>
#include <scene/scene.h>

#include <glm/vec2.hpp>

#include <vector>

namespace mobbscope {

/// A recording prepared for the search for cuts.
struct Recording {
    int clip = 0;  ///< index into the clips of the scene of recordings
    PoseTrack track;
    PoseWindows windows;
    int first = 0;  ///< frames [first, end) may be cuts: far enough from both ends, after the T-pose
    int end = 0;
};

/// The scene's clips that have a skeleton, in their order. `rigs`: rigs_of(scene).
std::vector<Recording> recordings_of(const Scene& scene, const SceneRigs& rigs);

/// A frame at which clips may begin and end.
struct HubMoment {
    int recording = 0;
    int frame = 0;
    double heading_deg = 0;  ///< in the recording: the root's direction of travel around the frame, or else after it
    glm::dvec2 velocity{0};  ///< of the root, metres per second, with the heading along +x
};

HubMoment hub_moment(const std::vector<Recording>& recordings, int recording, int frame);

/// A frame that is like a hub.
struct Cut {
    int recording = 0;
    int frame = 0;
    double heading_deg = 0;  ///< in the recording: what the hub's +x is here
    double distance = 0;     ///< of the poses, metres
};

/// All cuts at a hub: of each run of frames that differ from the hub by at most half of each bound, the most similar
/// one. Only recordings of the hub's rig are searched. Ordered by recording and frame. The root's velocity is measured
/// from the frame before and to the next.
std::vector<Cut> cuts_like(const std::vector<Recording>& recordings, const HubMoment& hub, const GraphBounds& bounds);

}  // namespace mobbscope
