/// The production structure: blocks of consecutive samples under disks that bound them, level over level, in arrays
/// that are read several blocks at a time.
#pragma once

#include <mobb/box.h>
#include <mobb/clip.h>

#include <array>
#include <cstddef>
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
/// holds the whole clip and stands still.
class alignas(64) Blocks {
  public:
    static constexpr int kLogSamples = 4;
    static constexpr int kSamples = 1 << kLogSamples;
    static constexpr int kFanOut = 8;
    static constexpr int kMostAtTop = 128;

    /// Takes time in proportion to the samples times the levels. Throws std::invalid_argument if there is no clip.
    explicit Blocks(ClipPtr clip);

    const Clip& clip() const { return *clip_; }
    const ClipPtr& shared_clip() const { return clip_; }

    int count() const { return count_; }  ///< of samples
    double dt() const { return dt_; }
    double per_dt() const { return per_dt_; }  ///< 1 / dt()
    bool is_linear() const { return linear_; }
    const Disk* disks() const { return disks_; }  ///< of the clip
    double reach() const { return reach_; }       ///< of the clip

    int levels() const { return level_count_; }
    /// Blocks of a level, 0 <= level < levels(); samples that each has, but for the last one.
    int count(int level) const { return levels_[static_cast<std::size_t>(level)].count; }
    static constexpr int span(int level) { return 1 << log_span(level); }
    static constexpr int log_span(int level) { return kLogSamples + 3 * level; }

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

    /// Disks as the query reads them, several at a time: of block or sample i at [i] of each array. Some more can be
    /// read before the first and behind the last one, which are not numbers: of blocks kBlockPad, of samples kSamples
    /// and kSamplePad. Relative to origin(), metres.
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
    static constexpr int kBlockPad = 8, kSamplePad = 2 * kSamples;
    Paths paths(int level) const { return paths_of(levels_[static_cast<std::size_t>(level)]); }
    /// Around two consecutive blocks of level 0: at [j] of j - 1 and j, 0 <= j <= count(0).
    Paths pairs() const { return paths_of(pairs_); }
    /// The samples: of a linear clip around what each runs through.
    Paths samples() const { return paths_of(samples_); }
    /// Around two consecutive samples: at [j] of j - 1 and j, 0 <= j <= count().
    Paths sample_pairs() const { return paths_of(sample_pairs_); }
    /// The middle of the root, in the clip's frame, and its radius.
    glm::dvec2 origin() const { return origin_; }
    double radius() const { return radius_; }
    float extent() const { return extent_; }  ///< an upper bound in metres on |x| + |y| + r about the origin
    float speed() const { return speed_; }    ///< at which no bound's centre moves faster, m/s
    std::size_t bytes() const;                ///< of memory, without the clip

  private:
    struct Level {
        std::size_t at = 0;  ///< of the first array in values_
        int stride = 0;      ///< from there to the next one
        int count = 0;
        int arrays = 0;  ///< as many of Paths as there are, from the first on
    };
    static_assert(kFanOut == 8 && kMostAtTop >= kFanOut);
    static constexpr std::size_t kMostLevels = 7;
    static_assert(kMaxSamples / kSamples >> (3 * (kMostLevels - 1)) < kMostAtTop);
    static constexpr int kStill = 3, kMoving = 6;

    Level add_arrays(int count, int arrays, int pad);
    Level add_level(int level);
    Level add_samples();
    Level add_pairs(const Level& of);
    MovingDisk bound(const Level& level, int block, int span) const;
    MovingDisk root() const { return {origin_, glm::dvec2(0), radius_}; }
    bool has_root_above() const { return level_count_ > 1 || levels_[0].count > 1; }
    Paths paths_of(const Level& level) const { return {values_.data() + level.at, level.stride}; }

    // First what every query reads.
    double dt_, per_dt_;
    int count_;
    int level_count_ = 0;
    float extent_ = 0;
    float speed_ = 0;
    std::vector<float> values_;
    bool linear_;
    Level pairs_, samples_, sample_pairs_;
    std::array<Level, kMostLevels> levels_{};
    const Disk* disks_;
    double reach_;
    glm::dvec2 origin_{0};
    double radius_ = 0;
    ClipPtr clip_;
};

}  // namespace mobb
