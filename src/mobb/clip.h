/// Clips and where they are placed: a motion reduced to a path of disks on the floor (paper, Section 3).
#pragma once

#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace mobb {

/// One sample: a disk on the floor, in metres. r >= 0.
struct Disk {
    double x = 0;
    double y = 0;
    double r = 0;
};

/// The largest coordinate or radius (m) and the longest duration or start time (s) that are taken for real.
inline constexpr double kMaxLength = 1e9;
inline constexpr double kMaxTime = 1e12;
/// The largest angle of a rotation that is taken, degrees.
inline constexpr double kMaxDegrees = 1e9;

/// Two half-open time intervals overlap if they share more than this many seconds; sharing an end point is not
/// overlapping.
inline constexpr double kMinOverlap = 1e-9;
/// Seconds from sample to sample are more than this: else what two samples share may never be over kMinOverlap.
inline constexpr double kLeastDt = 2 * kMinOverlap;

/// How much of each sample's time is not sure, in seconds, of what starts at `start` and lasts `duration`: doubles
/// round where samples begin and end, and what is shared for at most kMinOverlap is not tested.
inline double unsure_time(double start, double duration) {
    return kMinOverlap + 0x1p-52 * (std::abs(start) + 2 * duration);
}
/// The largest |start| in seconds, at most kMaxTime, at which that is at most half of dt. So each sample shares enough
/// time with another one, whoever is there with it. Below 0: there is no such start.
inline double most_start(double dt, double duration) {
    return std::min(kMaxTime, 0x1p52 * (dt / 2 - kMinOverlap) - 2 * duration);
}

/// Sample and node indices are int; a tree has fewer than twice as many nodes as samples.
inline constexpr std::size_t kMaxSamples = 500'000'000;

/// What a disk does until the next sample. `held`: it stays (paper, Section 3). `linear`: centre and radius run
/// linearly to those of the next sample, as swept disks (the paper's alternative, Section 3), and the clip ends at its
/// last sample. A linear clip of one sample holds it for dt.
enum class Motion { held, linear };

std::string_view name(Motion motion);
std::optional<Motion> motion_from_name(std::string_view name);
std::span<const std::string_view> motion_names();

/// N >= 1 disks at uniform spacing dt > 0 seconds; disk i belongs to [time(i), time(i + 1)). Immutable: share it
/// freely.
class Clip {
  public:
    /// Throws std::invalid_argument, naming the sample, if dt is not finite or not over kLeastDt, there is no sample, a
    /// number is not finite or beyond kMaxLength, a radius is negative, the clip lasts longer than kMaxTime, or there
    /// are more samples than kMaxSamples.
    Clip(double dt, std::vector<Disk> samples, Motion motion = Motion::held);

    double dt() const { return dt_; }
    Motion motion() const { return motion_; }
    int count() const { return static_cast<int>(samples_.size()); }
    std::span<const Disk> samples() const { return samples_; }
    /// Whether samples run to the next ones: of a linear clip of more than one sample.
    bool runs() const { return motion_ == Motion::linear && count() > 1; }
    /// How many dt the clip lasts: one for each sample, as the last one has its cylinder too (reading of Eq. 1,
    /// "o < t_end"); where samples run, one for each from a sample to the next.
    int steps() const { return runs() ? count() - 1 : count(); }
    /// Likewise of samples [first, end), 0 <= first < end <= count().
    int steps(int first, int end) const { return std::min(end, steps()) - first; }
    /// Clip time in seconds at which sample i begins and the one before it ends, 0 <= i <= count(). The last sample of
    /// a clip that runs begins and ends at once.
    double time(int i) const { return std::min(i, steps()) * dt_; }
    double duration() const { return steps() * dt_; }  ///< seconds
    /// Seconds from when the clip begins to when the next one of a chain does: a linear one runs on to it for dt.
    double until_next() const { return count() * dt_; }
    /// See most_start: who starts farther from time 0, in seconds, is refused.
    double most_start() const { return most_start_; }
    /// An upper bound in metres on |x| + |y| + r over the samples: what the slack of box tests is made from.
    double reach() const { return reach_; }

  private:
    double dt_;
    Motion motion_;
    std::vector<Disk> samples_;
    double most_start_;
    double reach_;
};

using ClipPtr = std::shared_ptr<const Clip>;

/// Cosine and sine of a rotation, exact for multiples of 90 degrees.
struct Rotation {
    double c = 1;
    double s = 0;

    /// Throws std::invalid_argument unless `degrees` is finite and within kMaxDegrees.
    static Rotation from_degrees(double degrees);
    glm::dvec2 operator()(glm::dvec2 v) const { return {c * v.x - s * v.y, s * v.x + c * v.y}; }
    Rotation inverse() const { return {c, -s}; }
    /// First `other`, then this.
    Rotation operator*(const Rotation& other) const { return {c * other.c - s * other.s, s * other.c + c * other.s}; }
};

/// An angle in degrees, counter-clockwise, with its rotation: worked out once, where it is made. Read, and compared, as
/// degrees.
class Turn {
  public:
    Turn() = default;
    /// Multiples of 90 degrees rotate exactly. What is not finite, or beyond kMaxDegrees, has no rotation, and nothing
    /// can be placed by it (see is_valid).
    Turn(double degrees);  // NOLINT(google-explicit-constructor): rotate_deg = 90
    /// By a cosine and a sine, as exact as floats have them; they are scaled to a length of 1. Throws
    /// std::invalid_argument unless their squares add up to 1, within 1e-6.
    static Turn by(double cosine, double sine);

    operator double() const {  // NOLINT(google-explicit-constructor)
        return degrees_ == degrees_ ? degrees_ : degrees_of_rotation();
    }
    const Rotation& rotation() const { return rotation_; }
    bool has_rotation() const { return rotation_.c == rotation_.c; }

  private:
    double degrees_of_rotation() const;

    Rotation rotation_;   ///< NaN where there is none
    double degrees_ = 0;  ///< NaN where they are worked out as they are asked for
};

/// Places a clip in the world: rotate about the clip's origin, then translate, and start at a global time.
struct Placement {
    glm::dvec2 translate{0, 0};  ///< metres
    Turn rotate_deg{};           ///< degrees, or Turn::by a cosine and a sine
    double start = 0;            ///< seconds, global

    /// From the clip's frame to the world's.
    const Rotation& rotation() const { return rotate_deg.rotation(); }

    friend bool operator==(const Placement&, const Placement&) = default;
};

/// True if every number is finite and within kMaxLength, kMaxDegrees and `most_start`: Clip::most_start of what is
/// placed.
inline bool is_valid(const Placement& placement, double most_start = kMaxTime) {
    // Written so that NaN fails it.
    return std::abs(placement.translate.x) <= kMaxLength && std::abs(placement.translate.y) <= kMaxLength &&
           placement.rotate_deg.has_rotation() && std::abs(placement.start) <= most_start;
}

/// Throws std::invalid_argument, naming the number of a placement that is_valid does not take.
[[noreturn]] void refuse_placement(const Placement& placement, double most_start);

/// The placement, or else refuses it: all that is placed is checked so when it is made. Compared with what is not a
/// number, everything would be apart; and times that doubles cannot tell apart are shared by nobody.
inline const Placement& checked(const Placement& placement, double most_start) {
    if (!is_valid(placement, most_start)) [[unlikely]]
        refuse_placement(placement, most_start);
    return placement;
}

/// A disk that is rotated about the origin and then translated. Every sample that is placed comes through here, so that
/// all of them agree bit for bit.
inline Disk placed(const Disk& d, const Rotation& rotation, glm::dvec2 translate) {
    return {rotation.c * d.x - rotation.s * d.y + translate.x, rotation.s * d.x + rotation.c * d.y + translate.y, d.r};
}

/// A frame on the floor and in time as it is placed in the world, and how far what lies in it reaches.
struct PlacedFrame {
    Rotation rotation;
    glm::dvec2 translate{0, 0};  ///< metres
    double start = 0;            ///< seconds, global
    double reach = 0;            ///< an upper bound in metres on |x| + |y| + r over the disks, in the frame
    double duration = 0;         ///< seconds from the frame's time 0 to the end of the last disk
};

/// Consecutive disks as they are stored, and how they are placed in the world but for rounding.
struct StoredDisks {
    const Disk* disks;
    int first;  ///< the sample that the first disk is
    Rotation rotation;
    glm::dvec2 translate{0, 0};  ///< metres

    const Disk* at(int sample) const { return disks + (sample - first); }
};

/// A clip seen through a placement: samples in world metres and global seconds. It refers to the clip, which must
/// outlive it and stay where it is.
class PlacedClip {
  public:
    /// Throws std::invalid_argument, naming the number, unless is_valid(placement, clip.most_start()).
    PlacedClip(const Clip& clip, const Placement& placement)
        : samples_(clip.samples().data()),
          dt_(clip.dt()),
          last_to_(clip.motion() == Motion::linear ? clip.count() - 1 : -1),
          steps_(clip.steps()),
          clip_(&clip),
          rotate_deg_(checked(placement, clip.most_start()).rotate_deg),
          frame_{placement.rotation(), placement.translate, placement.start, clip.reach(), clip.duration()} {}
    PlacedClip(const Clip&&, const Placement&) = delete;

    const Clip& clip() const { return *clip_; }
    int count() const { return clip_->count(); }
    int first() const { return 0; }      ///< index of the first sample
    int end() const { return count(); }  ///< one past the index of the last
    Placement placement() const { return {frame_.translate, rotate_deg_, frame_.start}; }
    const Rotation& rotation() const { return frame_.rotation; }
    const PlacedFrame& frame() const { return frame_; }
    static constexpr bool kStoredInFrame = true;
    StoredDisks stored() const { return {samples_, 0, frame_.rotation, frame_.translate}; }

    /// Sample i in the world.
    Disk disk(int i) const { return placed(samples_[i], frame_.rotation, frame_.translate); }
    /// What sample i has become when it ends: of a linear clip the next sample, where there is one.
    Disk disk_at_end(int i) const { return disk(i < last_to_ ? i + 1 : i); }
    bool is_linear() const { return last_to_ >= 0; }
    double dt() const { return dt_; }
    /// Global time at which sample i begins; time(i + 1) is when it ends (see Clip::time). Never decreases with i.
    double time(int i) const { return frame_.start + std::min(i, steps_) * dt_; }

  private:
    const Disk* samples_;
    double dt_;
    int last_to_;  ///< the last sample that another runs to; -1 of a held clip
    int steps_;    ///< of the clip
    const Clip* clip_;
    Turn rotate_deg_;
    PlacedFrame frame_;
};

}  // namespace mobb
