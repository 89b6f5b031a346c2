/// The poses of a recording as point clouds, the way that motion graphs compare them (Kovar, Gleicher and Pighin,
/// "Motion Graphs", 2002, section 3.1).
#pragma once

#include <import/skeleton/skeleton.h>
#include <mobb/clip.h>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace mobbscope {

/// Where a body's joints are in every frame of a recording.
struct PoseTrack {
    double dt = 1;                  ///< seconds from frame to frame
    int rig = 0;                    ///< recordings of one rig have the same joints
    std::size_t joints = 0;         ///< that count, at least 1
    std::vector<glm::dvec2> root;   ///< on the floor, frame after frame, metres
    std::vector<glm::vec3> points;  ///< frame after frame: x and y from the frame's root, z the height; metres

    int frames() const { return static_cast<int>(root.size()); }
    std::span<const glm::vec3> at(int frame) const {
        return std::span(points).subspan(static_cast<std::size_t>(frame) * joints, joints);
    }
    /// The root's velocity from a frame to the next, metres per second. The next frame exists.
    glm::dvec2 velocity(int frame) const {
        const auto i = static_cast<std::size_t>(frame);
        return (root[i + 1] - root[i]) / dt;
    }
};

/// Tells rigs apart, by the names of their joints and what hangs on what, and makes their tracks. Joints count whose
/// bone is at least a tenth of the rig's longest, in the first frame of its first track: fingers and eyes would outvote
/// the legs. Those of a rig are the same for all its tracks.
class Rigs {
  public:
    PoseTrack track(const mobb::Clip& clip, const Skeleton& skeleton);
    int count() const { return static_cast<int>(rigs_.size()); }

  private:
    struct Rig {
        std::string key;
        std::vector<std::size_t> joints;
    };
    std::vector<Rig> rigs_;
};

}  // namespace mobbscope
