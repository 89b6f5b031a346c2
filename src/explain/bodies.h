/// Which parts of two bodies touch while their disks overlap: of clips with skeletons, bones as capsules.
#pragma once

#include <explain/clearance.h>
#include <import/skeleton/motion.h>
#include <mobb/clip.h>
#include <mobb/query.h>

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace mobbscope {

/// Metres: of the capsule around each bone, where nobody says another.
inline constexpr double kBoneRadius = 0.05;
inline constexpr double kMostBoneRadius = 1;

/// Metres: how far from the least a distance may be where joints run from sample to sample. Of held samples it is
/// exact.
inline constexpr double kBodyTolerance = 1e-6;

/// From a joint to one that hangs on it, both below the disks' root or it. Of a root without any both are the root.
struct SkeletonBone {
    int from = 0, to = 0;
    friend bool operator==(const SkeletonBone&, const SkeletonBone&) = default;
};

std::vector<SkeletonBone> bones_of(const Skeleton& skeleton);

/// A joint's name; of the tip of a bone, which has none, "the end of Head".
std::string joint_words(const Skeleton& skeleton, int joint);

/// "LeftArm-LeftForeArm": the joints at both ends, with an en dash between them.
std::string bone_words(const Skeleton& skeleton, SkeletonBone bone);

/// A straight piece of the middle line of a capsule, metres: x, y and the height.
struct Segment {
    glm::dvec3 from{0}, to{0};
};

/// The points at which two segments are nearest, and their distance.
struct SegmentDistance {
    double distance = 0;
    glm::dvec3 a{0}, b{0};
};

SegmentDistance distance_of(const Segment& a, const Segment& b);

/// A clip where it is placed, with its skeleton, to both of which it refers.
class PlacedBody {
  public:
    PlacedBody(const mobb::PlacedClip& clip, const Skeleton& skeleton)
        : clip_(clip), skeleton_(skeleton), bones_(bones_of(skeleton)) {}

    const mobb::PlacedClip& clip() const { return clip_; }
    const Skeleton& skeleton() const { return skeleton_; }
    const std::vector<SkeletonBone>& bones() const { return bones_; }
    /// Where the bones are at a time of a sample: as long as it holds where they are then; of a linear clip each joint
    /// runs straight to where it is at the next sample.
    std::vector<Segment> place(int sample, double time) const;
    /// The sample as its disk runs, but around the whole body where the clip was given a smaller radius, and grown.
    mobb::SweptDisk grown(int sample, double by) const;

  private:
    double reach(int sample) const;

    const mobb::PlacedClip& clip_;
    const Skeleton& skeleton_;
    std::vector<SkeletonBone> bones_;
};

/// The two bones that are nearest at some time.
struct NearestBones {
    double time = 0;      ///< global seconds
    double distance = 0;  ///< metres between the capsules; < 0: how deep they overlap
    SkeletonBone a, b;
    glm::dvec3 a_point{0}, b_point{0};  ///< on the bones: where these are nearest
};

/// At a time at which these samples hold, or run.
NearestBones nearest_bones(const PlacedBody& a, int a_sample, const PlacedBody& b, int b_sample, double time,
                           double bone_radius);

/// Two samples that share time, for as long as their grown disks overlap.
struct BodyStep {
    int a_sample = 0, b_sample = 0;
    double t0 = 0, t1 = 0;  ///< global seconds, [t0, t1)
    NearestBones nearest;   ///< the least of that time
};

/// Capsules reach beyond the disks by their radius at the most, so the bodies touch only while disks grown by it
/// overlap, and are measured only then.
struct BodyDistances {
    double bone_radius = 0;
    std::vector<mobb::Interval> intervals;  ///< while grown disks overlap
    std::vector<BodyStep> steps;            ///< of the intervals, in order of time
    std::optional<std::size_t> nearest;     ///< the step with the least distance, the earliest of equals
    std::optional<NearestBones> first;      ///< when capsules first overlap; touching is not colliding
};

/// Called with steps done, of how many; it may throw.
using BodyProgress = std::function<void(std::size_t done, std::size_t all)>;

/// `clearance`: of the two clips.
BodyDistances body_distances(const PlacedBody& a, const PlacedBody& b, const Clearance& clearance, double bone_radius,
                             const BodyProgress& progress = {});

/// What that costs, in pairs of bones: an upper bound, but where disks are smaller than the bodies.
std::int64_t body_cost(const PlacedBody& a, const PlacedBody& b, const Clearance& clearance, double bone_radius);

}  // namespace mobbscope
