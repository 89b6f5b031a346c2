/// How far apart two moments of motion are.
///
/// A moment is the point cloud of a body's joints in five frames, spread over a quarter of a second: so poses count and
/// how they change (Kovar et al. 2002, section 3.1). Two moments are brought together by a rigid motion of the floor
/// that puts root on root in the middle frame and turns as little apart as can be, which has a closed form. Kovar lets
/// the roots come apart too; here paths must join, so the distance is never less than his. As the alignments are a
/// group of isometries, distances obey the triangle inequality.
#pragma once

#include <import/skeleton/motion.h>
#include <mobb/clip.h>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace mobbscope {

/// Where a body's joints are in every frame of a recording.
struct PoseTrack {
    double dt = 1;                  ///< seconds from frame to frame
    int rig = 0;                    ///< tracks of one rig have the same joints
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

/// The track of a clip with its skeleton. `joints`: those that count, at least one (joints_of, crowd/graph/rigs.h).
PoseTrack pose_track(const mobb::Clip& clip, const Skeleton& skeleton, int rig, std::span<const std::size_t> joints);

inline constexpr std::size_t kWindowFrames = 5;

/// The frames of a moment, counted from its middle one; at 30 Hz -4, -2, 0, 2, 4.
std::array<int, kWindowFrames> window_offsets(double dt);

/// Two moments brought together.
struct Alignment {
    double distance = 0;  ///< root mean square over joints and frames, metres
    double turn_deg = 0;  ///< what turns the second onto the first
};

/// Every moment of a track that has all its frames, ready to be compared.
class PoseWindows {
  public:
    explicit PoseWindows(const PoseTrack& track);

    /// The frames that may be a moment's middle: [first(), end()); none if end() <= first().
    int first() const { return reach_; }
    int end() const { return end_; }

    /// Compares moments of two tracks of one rig and dt. Both frames are within their tracks' [first(), end()).
    static Alignment compare(const PoseWindows& a, int frame_a, const PoseWindows& b, int frame_b);

  private:
    /// Points of a moment: all x, then all y, then all z.
    std::span<const float> moment(int frame) const {
        return std::span(points_).subspan(static_cast<std::size_t>(frame - reach_) * 3 * size_, 3 * size_);
    }

    int reach_;
    int end_;
    std::size_t size_;  ///< points of a moment
    std::vector<float> points_;
    std::vector<double> squares_;  ///< of each moment, the sum over its points
};

/// The distance of two moments joined as they stand: a turned by -heading_a about its root, b by -heading_b. Frames
/// that one of the tracks lacks are left out; where no frame is left the nearest ones that each has are compared. One
/// rig and dt. A frame may be one beyond the track's last.
double joined_distance(const PoseTrack& a, int frame_a, double heading_a, const PoseTrack& b, int frame_b,
                       double heading_b);

}  // namespace mobbscope
