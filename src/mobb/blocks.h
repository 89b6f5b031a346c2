/// The production structure: blocks of consecutive samples under disks that bound them, level over level, in arrays
/// that are read several blocks at a time.
#pragma once

#include <mobb/box.h>
#include <mobb/clip.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace mobb {

/// A number in single precision that is not less, for values from 0 to 1e38.
inline float rounded_up(double value) { return static_cast<float>(value * (1 + 0x1p-22)); }

/// A disk on the floor whose centre moves linearly: what bounds a block.
struct MovingDisk {
    glm::dvec2 from{0};   ///< centre when the block begins, metres
    glm::dvec2 drift{0};  ///< what the centre moves by until the block ends, metres
    double radius = 0;    ///< metres
};

/// Around the disks of samples [first, end) for as long as they last; of a linear clip as they run. It moves from the
/// first centre to the last. Requires 0 <= first < end <= clip.count().
MovingDisk bounding_disk(const Clip& clip, int first, int end);

/// The box that stands for it from t0 to t1, in w*t.
inline Box box_around(const MovingDisk& disk, double t0, double t1) {
    Box box;
    box.kind = BoxKind::block;
    const glm::dvec2 middle = disk.from + disk.drift / 2.0;
    box.center = {middle.x, middle.y, (t0 + t1) / 2};
    box.half = {disk.radius, disk.radius, (t1 - t0) / 2};
    box.drift = disk.drift / 2.0;
    return box;
}

/// The blocks of one clip, in single precision about an origin near the clip. Immutable; safe to query from any number
/// of threads.
///
/// A block of level 0 has kSamples samples, one of level l + 1 as many as kFanOut blocks of level l; the last of a
/// level may have fewer. Levels are added until one has at most kMostAtTop blocks. A block's bound holds each of its
/// disks for as long as it lasts; of a linear clip the disks as they run. Bounds of level 0 stand still: they are the
/// cheapest to test, and in so short a time hardly anything moves far. Those of higher levels move. The root's bound
/// holds the whole clip and stands still. These are the nodes that an observer is told of.
///
/// Where nobody watches, and clips are of one dt, there is no need for whole blocks: runs of as many samples of one
/// clip are tested against windows of the other, each of which holds all samples that share time with a run.
class alignas(64) Blocks {
  public:
    static constexpr int kLogSamples = 4;
    static constexpr int kSamples = 1 << kLogSamples;
    static constexpr int kLogFanOut = 3;
    static constexpr int kFanOut = 1 << kLogFanOut;
    static constexpr int kMostAtTop = 128;

    /// Takes time in proportion to the samples times the levels. Throws std::invalid_argument if there is no clip.
    explicit Blocks(ClipPtr clip);
    Blocks(const Blocks&) = delete;
    Blocks& operator=(const Blocks&) = delete;
    Blocks(Blocks&&) = default;
    Blocks& operator=(Blocks&&) = default;
    ~Blocks() = default;

    const Clip& clip() const { return *clip_; }
    const ClipPtr& shared_clip() const { return clip_; }

    int count() const { return count_; }  ///< of samples
    int steps() const { return steps_; }  ///< of the clip: how many dt it lasts
    /// How many dt of them pass in `span` samples from `first` on, at least 0.
    int steps(int first, int span) const { return clip_->steps(first, std::min(first + span, count_)); }
    double dt() const { return dt_; }
    double per_dt() const { return per_dt_; }  ///< 1 / dt()
    bool is_linear() const { return linear_; }
    const Disk* disks() const { return disks_; }  ///< of the clip
    double reach() const { return reach_; }       ///< of the clip

    int levels() const { return level_count_; }
    /// Blocks of a level, 0 <= level < levels(); samples that each has, but for the last one.
    int count(int level) const { return levels_[static_cast<std::size_t>(level)].count; }
    static constexpr int span(int level) { return 1 << log_span(level); }
    static constexpr int log_span(int level) { return kLogSamples + kLogFanOut * level; }

    /// A block as a node: 0 is the root, then come the levels from the top down, each in the order of time. Where level
    /// 0 has one block, that is the root.
    struct Node {
        int level = 0;  ///< of blocks; levels() for a root above them
        int block = 0;
        int first = 0;  ///< samples
        int count = 0;
        MovingDisk bound;  ///< in the clip's frame, over these samples
    };
    int node_count() const;
    int node_of(int level, int block) const;
    Node node(int index) const;

    /// Blocks as the query reads them, several at a time: block i of a level at [i] of each array. Relative to
    /// origin(), metres. Behind the last one kReadAhead more can be read, which mean nothing.
    struct Paths {
        const float* arrays;
        std::ptrdiff_t stride;  ///< from one array to the next

        const float* x() const { return arrays; }
        const float* y() const { return arrays + stride; }
        const float* r() const { return arrays + 2 * stride; }
        // Of blocks that move, those above level 0: how far the centre moves over a whole block ...
        const float* dx() const { return arrays + 3 * stride; }
        const float* dy() const { return arrays + 4 * stride; }
        // ... and how long the block lasts, as a share of a whole one: 1 but of the last.
        const float* lasts() const { return arrays + 5 * stride; }
    };
    static constexpr int kReadAhead = 10;
    Paths paths(int level) const { return paths_of(levels_[static_cast<std::size_t>(level)]); }

    /// Two disks about each of several centres, relative to origin(), metres.
    struct Rings {
        const float* x;
        const float* y;
        const float* inner;  ///< radius of the sample itself, where there is one
        const float* outer;  ///< radius of what holds all samples that are meant
    };
    /// The samples: sample i at [i], -1 <= i <= count(), where the first and the last one stand once more,
    /// with -kNever as `inner`. Of a linear clip around what each runs through. `outer` holds the sample behind, too.
    /// Before and behind kRun more can be read, which mean nothing.
    Rings samples() const { return rings_from(first_sample_, count_ + 2); }
    /// Windows of consecutive samples, for runs of kRun samples of the other clip: about sample j, -kRun / 2 <= j <=
    /// count() + kRun / 2, `outer` holds those from j - kRun / 2 to j + kRun / 2. Where there is no sample j, the first
    /// or the last one is the centre, and `inner` is -kNever. They are stored at a few phases: those of kPhases[k]
    /// stand side by side, place p about sample kPhases[k] + kRun * p - kRun / 2, so that several are read at a time.
    /// Behind the last one kReadAhead more can be read, which mean nothing.
    Rings windows(int phase_index) const {
        return rings_from(first_window_ + std::ptrdiff_t{kRings} * window_stride_ * phase_index, window_stride_);
    }
    static constexpr int kLogRun = 4;
    static constexpr int kRun = 1 << kLogRun;
    static constexpr float kNever = 1e30F;
    /// Each number is the difference of two of these, modulo kRun: so windows of two clips can be had that lie as far
    /// apart as the clips do, at a third of the memory that all phases would take.
    static constexpr std::array kPhases{0, 1, 2, 5, 8};
    /// Of windows of A and of B: which of kPhases, and these.
    struct PhasePair {
        int index_a, index_b;
        int a, b;
    };
    /// A's phase is B's and so many samples more, modulo kRun.
    static constexpr PhasePair phases_apart(int samples) {
        return kPhasesApart[static_cast<std::uint32_t>(samples) % std::uint32_t{kRun}];
    }
    /// Windows for the blocks of a level above 0: with `outer` alone, and about every span(level - 1)-th sample, which
    /// `number` counts. They reach half a block before and behind, and half of the way to the next window
    /// more, as B's may be so far from where it should be. Window `number` is at place_of_number(number).
    Rings windows(int level, int number) const {
        const Level& of = levels_[static_cast<std::size_t>(level)];
        const int phase = (number + kFanOut / 2) & (kFanOut - 1);
        const float* const x = values_.data() + of.windows + std::ptrdiff_t{3} * of.window_stride * phase;
        const float* const outer = x + 2 * std::ptrdiff_t{of.window_stride};
        return {x, x + of.window_stride, outer, outer};
    }
    static constexpr int place_of_number(int number) { return (number + kFanOut / 2) >> kLogFanOut; }

    /// The middle of the root, in the clip's frame, and its radius.
    glm::dvec2 origin() const { return origin_; }
    double radius() const { return radius_; }
    /// A second root, for what lasts shortly: it moves, with its centre at origin() in the middle of the clip's time.
    /// Velocity in m/s, and radius. Of long clips, and where moving makes it no smaller, it is the first one.
    bool is_short() const { return count_ <= kShort; }
    glm::dvec2 velocity() const { return velocity_; }
    double root_speed() const { return root_speed_; }  ///< its length
    double moving_radius() const { return moving_radius_; }
    static constexpr int kShort = 8 * kSamples;
    float extent() const { return extent_; }  ///< an upper bound in metres on |x| + |y| + r about the origin
    float speed() const { return speed_; }    ///< at which no bound's centre moves faster, m/s
    /// Metres: each of samples() lies within any neighbour of it that is grown by so much.
    float step() const { return step_; }
    /// Times of clips of one dt are told in parts of a sample, 1 / 2^kLogParts each.
    static constexpr int kLogParts = 33;
    /// So many must two samples share to collide for sure where their disks overlap. More than one has of a linear
    /// clip, whose disks are not known in between, and of samples that last for an instant.
    std::int64_t sure_parts() const { return sure_parts_; }
    std::size_t bytes() const;  ///< of memory, without the clip

  private:
    struct Level {
        std::size_t at = 0;       ///< of the first array in values_
        int count = 0;            ///< of blocks, and from one array to the next
        std::size_t windows = 0;  ///< in values_, of levels above 0
        int window_stride = 0;
        int arrays = 0;  ///< as many of Paths as there are, from the first on
    };
    static_assert(kMostAtTop >= kFanOut);
    static constexpr std::size_t kMostLevels = 7;
    static_assert(kMaxSamples / kSamples >> (kLogFanOut * (kMostLevels - 1)) < kMostAtTop);
    static constexpr int kStill = 3, kMoving = 6, kRings = 4;

    float* add_arrays(int count, int arrays);
    Level add_level(int level);
    void add_samples();
    void add_windows();
    void add_windows(int level);
    int window_stride() const { return (count_ + kRun) / kRun + 1; }  ///< places of the longest phase
    int window_stride(int level) const;
    MovingDisk bound(const Level& level, int block, int span) const;
    MovingDisk root() const { return {origin_, glm::dvec2(0), radius_}; }
    bool has_root_above() const { return level_count_ > 1 || levels_[0].count > 1; }
    Paths paths_of(const Level& level) const { return {values_.data() + level.at, level.count}; }
    static Rings rings_from(const float* x, std::ptrdiff_t stride) {
        return {x, x + stride, x + 2 * stride, x + 3 * stride};
    }

    /// The least phase of A that will do: runs of A then begin with its first sample where they can.
    static constexpr std::array<PhasePair, kRun> kPhasesApart = [] {
        std::array<PhasePair, kRun> out{};
        for (std::size_t a = kPhases.size(); a-- > 0;) {
            for (std::size_t b = 0; b < kPhases.size(); ++b) {
                out[static_cast<std::size_t>(kPhases[a] - kPhases[b] + kRun) % kRun] = {
                    static_cast<int>(a), static_cast<int>(b), kPhases[a], kPhases[b]};
            }
        }
        return out;
    }();

    // First what every query reads.
    double dt_, per_dt_;
    int count_;
    int level_count_ = 0;
    const float* first_window_ = nullptr;  ///< in values_, as the next one
    const float* first_sample_ = nullptr;
    int window_stride_ = 0;
    float extent_ = 0;
    std::int64_t sure_parts_;
    float speed_ = 0, step_ = 0;
    bool linear_;
    int steps_;
    std::array<Level, kMostLevels> levels_{};
    std::vector<float> values_;
    const Disk* disks_;
    double reach_;
    glm::dvec2 origin_{0}, velocity_{0};
    double root_speed_ = 0, radius_ = 0, moving_radius_ = 0;
    ClipPtr clip_;
};

}  // namespace mobb
