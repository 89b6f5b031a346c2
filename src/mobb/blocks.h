/// Do two placed clips ever collide? The fast way: through blocks of consecutive samples under disks that bound them,
/// level over level, in arrays that are read several blocks at a time. mobb/query.h has the contacts.
#pragma once

#include <mobb/box.h>
#include <mobb/clip.h>
#include <mobb/kinds.h>
#include <mobb/predicate.h>
#include <mobb/separation.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
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
    const Disk* disks() const { return disks_; }       ///< of the clip
    double reach() const { return reach_; }            ///< of the clip
    double most_start() const { return most_start_; }  ///< of the clip

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
    /// `number` counts. They cover half a block before and behind, and half a window spacing more, as B's
    /// nearest stored window can be that far off. Window `number` is at place_of_number(number).
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
    /// Of long clips, and where moving makes it no smaller, it is the first one, and stands still.
    bool is_short() const { return count_ <= kShort; }
    static constexpr int kShort = 8 * kSamples;
    glm::dvec2 root_begin() const { return root_begin_; }  ///< its centre when the clip begins, in the clip's frame
    glm::dvec2 velocity() const { return velocity_; }      ///< m/s
    double root_speed() const { return root_speed_; }      ///< its length, or a little more
    /// Metres: of the second root, with as much more as single precision leaves out where roots meet.
    double root_radius() const { return root_radius_; }
    /// What this clip adds to the slack of tests in single precision, metres: where roots meet, what is farther apart
    /// than the sum is apart for sure, but for the rounding of where clips are placed (see RootsApart).
    float slack() const { return slack_; }
    float speed() const { return speed_; }  ///< at which no bound's centre moves faster, m/s
    /// Metres: each of samples() lies within any neighbour of it that is grown by so much.
    float step() const { return step_; }
    /// Fixed-point sample time, for clips of one dt: 2^kLogParts units to a sample.
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

    // One cache line for what is asked of roots, and one for what is asked next.
    glm::dvec2 root_begin_{0}, velocity_{0};
    double root_radius_ = 0, root_speed_ = 0;
    double dt_;
    double reach_;
    glm::dvec2 origin_{0};
    const float* first_window_ = nullptr;  ///< in values_, as the next one
    const float* first_sample_ = nullptr;
    double per_dt_;
    std::int64_t sure_parts_;
    float slack_ = 0;
    int count_;
    double most_start_;
    int window_stride_ = 0;
    int level_count_ = 0;
    int steps_;
    float step_ = 0, speed_ = 0;
    bool linear_;
    std::array<Level, kMostLevels> levels_{};
    std::vector<float> values_;
    const Disk* disks_;
    double radius_ = 0;
    ClipPtr clip_;
};

/// Where a link of a chain lies in it, and where that is placed.
struct LinkPlace {
    Rotation rotation;        ///< of the link's clip, into the chain
    glm::dvec2 translate{0};  ///< likewise, metres
    int first = 0;            ///< the chain's index of the link's first sample
    int until = 0;            ///< and of the sample at whose begin the link's own samples end
    PlacedFrame chain;        ///< of the whole chain
};

/// Blocks where their clip is placed: in the world, or by a link of a chain that is placed there. A sample source of
/// the direct search. It refers to the blocks, which must outlive it and stay where they are. Nothing is worked out
/// here: how two lie against each other is, once a query.
class alignas(64) PlacedBlocks {
  public:
    /// Of no clip: it may only be assigned to.
    PlacedBlocks() = default;
    /// Throws std::invalid_argument, naming the number, unless is_valid(placement, blocks.most_start()).
    PlacedBlocks(const Blocks& blocks, const Placement& placement)
        : PlacedBlocks(blocks, checked(placement, blocks.most_start()).rotation(), placement.translate, placement.start,
                       placement.start + blocks.steps() * blocks.dt(), nullptr) {}
    PlacedBlocks(const Blocks&&, const Placement&) = delete;

    const Blocks& blocks() const { return *blocks_; }
    /// From the clip's frame to the world's.
    const Rotation& rotation() const { return rotation_; }
    glm::dvec2 translate() const { return translate_; }
    /// An upper bound in metres on |x| + |y| + r over the disks, before they are placed in the world.
    double reach() const { return link_ ? link_->chain.reach : blocks_->reach(); }
    /// Global times at which the first sample begins and the last one ends.
    double begin_time() const { return begin_; }
    double end_time() const { return end_; }
    /// Of the clip, from when its first sample begins.
    PlacedFrame frame() const {
        return {rotation_, translate_, begin_time(), reach(), blocks_->steps() * blocks_->dt()};
    }

    /// Global time at which sample 0 begins, of the clip or of the chain.
    double start() const { return link_ ? link_->chain.start : begin_; }
    int first() const { return link_ ? link_->first : 0; }
    int end() const { return first() + blocks_->count(); }
    double dt() const { return blocks_->dt(); }
    /// Sample i in the world, first() <= i < end().
    Disk disk(int i) const {
        if (!link_) return placed(blocks_->disks()[i], rotation_, translate_);
        return placed(placed(blocks_->disks()[i - link_->first], link_->rotation, link_->translate),
                      link_->chain.rotation, link_->chain.translate);
    }
    Disk disk_at_end(int i) const { return disk(is_linear() && i + 1 < end() ? i + 1 : i); }
    bool is_linear() const { return blocks_->is_linear(); }
    static constexpr bool kStoredInFrame = false;  // but, of a link, in that of its clip
    StoredDisks stored() const { return {blocks_->disks(), first(), rotation_, translate_}; }
    /// Global time at which sample i begins; time(i + 1) is when it ends (see Clip::time).
    double time(int i) const { return i < end() ? start() + i * dt() : end_; }
    /// Seconds: not less than from start() to end_time().
    double longest() const { return (link_ ? link_->chain.duration : blocks_->count() * dt()) + dt(); }

  private:
    friend class PlacedTree;
    friend class PlacedChain;

    // Of what is placed already: queries make these as they go, so nothing is checked again.
    /// As the clip of a tree.
    static PlacedBlocks of_tree(const Blocks& blocks, const PlacedFrame& tree) {
        return {blocks, tree.rotation, tree.translate, tree.start, tree.start + blocks.steps() * blocks.dt(), nullptr};
    }
    /// As a link of a chain. The place must outlive it, too.
    static PlacedBlocks of_link(const Blocks& blocks, const LinkPlace& link) {
        return {blocks,
                link.chain.rotation * link.rotation,
                link.chain.rotation(link.translate) + link.chain.translate,
                link.chain.start + link.first * blocks.dt(),
                link.chain.start + link.until * blocks.dt(),
                &link};
    }
    PlacedBlocks(const Blocks& blocks, const Rotation& rotation, glm::dvec2 translate, double begin, double end,
                 const LinkPlace* link)
        : blocks_(&blocks), rotation_(rotation), translate_(translate), begin_(begin), end_(end), link_(link) {}

    const Blocks* blocks_ = nullptr;
    Rotation rotation_;
    glm::dvec2 translate_{0};
    double begin_ = 0, end_ = 0;
    const LinkPlace* link_ = nullptr;
};
static_assert(sizeof(PlacedBlocks) == 64);

/// How the roots of two lie against each other: worked out once a query.
struct RootsApart {
    Rotation turn;       ///< from B's frame to A's
    glm::dvec2 between;  ///< metres from A's Blocks::root_begin() to B's, in A's frame
    double rounding;     ///< metres by which disks may be elsewhere for having been placed, of both together
    double time_error;   ///< seconds by which times may be wrong for having been rounded, likewise
    bool meet;           ///< whether the two share time and their roots may meet: without that they do not collide

    /// Of the largest numbers that times are computed from, with a wide margin.
    static constexpr double kTimeError = 0x1p-48;

    RootsApart() = default;
    RootsApart(const PlacedBlocks& a, const PlacedBlocks& b) {
        const Blocks &of_a = a.blocks(), &of_b = b.blocks();
        const double begin_a = a.begin_time(), begin_b = b.begin_time();
        const double from = std::max(begin_a, begin_b), until = std::min(a.end_time(), b.end_time());
        const Rotation to_a = a.rotation().inverse();
        turn = to_a * b.rotation();
        between = (to_a(b.translate() - a.translate()) - of_a.root_begin()) + turn(of_b.root_begin());
        // Where roots meet, B is placed no farther from A than they reach, and begins no later than A lasts.
        rounding = 1e-9 + 0x1p-42 * (std::abs(a.translate().x) + std::abs(a.translate().y) + (a.reach() + b.reach()));
        time_error = 2 * kTimeError * (std::abs(until) + (a.longest() + b.longest()));
        double reach = of_a.root_radius() + of_b.root_radius() + rounding;
        glm::dvec2 nearest = between;
        // It is not asked whether they move: of short clips some do, and a branch on that would often be mispredicted.
        if (of_a.is_short() || of_b.is_short()) {
            const glm::dvec2 va = of_a.velocity(), vb = turn(of_b.velocity()), v = vb - va;
            const glm::dvec2 there = between + (vb * (from - begin_b) - va * (from - begin_a));
            // Against a division by 0 alone: in 1e12 s who hardly moves gets far.
            constexpr double kNoWay = std::numeric_limits<double>::min();
            const double moment = -(there.x * v.x + there.y * v.y) / (v.x * v.x + v.y * v.y + kNoWay);
            nearest = there + std::max(std::min(moment, until - from), 0.0) * v;
            // And as far as they move in as much time as rounding may hide.
            reach += time_error * (of_a.root_speed() + of_b.root_speed());
        }
        // Without a branch, for the same reason.
        meet = static_cast<bool>(static_cast<unsigned>(until - from > kMinOverlap) &
                                 static_cast<unsigned>(nearest.x * nearest.x + nearest.y * nearest.y <= reach * reach));
    }
};

/// Is told of the pairs of samples that collide, in order of time; says whether to stop.
struct HitSink {
    static constexpr bool kAny = false;  ///< they are not told of all, if any will do
    bool (*on_hit)(void* receiver, int i, int j);
    void* receiver;

    bool operator()(int i, int j) const { return on_hit(receiver, i, j); }
};

/// A pair of samples that collides.
struct SamplePair {
    int a = 0;
    int b = 0;
};

/// The searches behind the queries below. They require that the roots meet.
namespace detail {
/// The earliest pair, or none.
std::optional<SamplePair> first_hit(const PlacedBlocks& a, const PlacedBlocks& b, const RootsApart& roots);
bool intersects(const PlacedBlocks& a, const PlacedBlocks& b, const RootsApart& roots);
}  // namespace detail

/// Whether two ever collide: as direct_search finds, on every machine.
inline bool intersects(const PlacedBlocks& a, const PlacedBlocks& b) {
    const RootsApart roots(a, b);
    return roots.meet && detail::intersects(a, b, roots);
}

/// The first of `others` that collides with `a`: its index, or none. Stops at the first hit: work
/// on later ones would be wasted.
inline std::optional<std::size_t> intersects_any(const PlacedBlocks& a, std::span<const PlacedBlocks* const> others) {
    // Placements lie anywhere in memory: they are fetched a few ahead.
    constexpr std::size_t kAhead = 4;
    for (std::size_t i = 0; i < others.size(); ++i) {
        if (intersects(a, *others[i])) return i;
        if (i + kAhead < others.size()) __builtin_prefetch(others[i + kAhead]);
    }
    return std::nullopt;
}

/// Two clips to be tested against each other.
struct BlocksPair {
    const PlacedBlocks* a = nullptr;
    const PlacedBlocks* b = nullptr;
};

/// Whether each pair collides. Placements that come from memory are fetched ahead, so that a query takes a quarter of
/// its time one by one; from the caches it takes as long. Throws std::invalid_argument unless there are as many answers
/// as pairs.
void intersects_each(std::span<const BlocksPair> pairs, std::span<bool> answers);

/// What watches the traversal of blocks, as TraversalObserver says: blocks are nodes by their numbers (see
/// Blocks::node).
class BlockObserver {
  public:
    static constexpr bool watches = true;

    virtual ~BlockObserver() = default;
    virtual void enter(int a, int b) = 0;
    virtual void leave() = 0;
    virtual void time_test(bool overlap) = 0;
    virtual void box_test(BoxKind test, const Separation& separation) = 0;
    virtual void sample_pair(int i, int j, double squared_distance) = 0;
    virtual void sample_test(bool hit) = 0;
};

namespace detail {
/// All pairs, earliest first. An observer, which may be null, is told of what lies below the roots, also where these do
/// not meet; the two must share time then. Returns whether the sink stopped it.
bool for_each_hit(const PlacedBlocks& a, const PlacedBlocks& b, const RootsApart& roots, HitSink sink,
                  BlockObserver* observer);
}  // namespace detail

/// All pairs, earliest first. Returns whether the sink stopped it.
inline bool for_each_hit(const PlacedBlocks& a, const PlacedBlocks& b, HitSink sink) {
    return detail::for_each_hit(a, b, RootsApart(a, b), sink, nullptr);
}

/// The sets of instructions that this machine can run queries with, the fastest first; "scalar" is always the last.
std::vector<std::string_view> instruction_sets();
/// All queries of the process use this one from now on; false if it is not among them. Answers do not depend on it:
/// this is for tests and measurements, when no query runs.
bool use_instruction_set(std::string_view name);

}  // namespace mobb
