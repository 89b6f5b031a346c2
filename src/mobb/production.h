/// Do two placed clips ever collide? The fast way: through blocks, several at a time. mobb/query.h has the contacts.
#pragma once

#include <mobb/blocks.h>
#include <mobb/kinds.h>
#include <mobb/predicate.h>
#include <mobb/separation.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace mobb {

/// Where a link of a chain lies in it, and where that is placed.
struct LinkPlace {
    Rotation rotation;        ///< of the link's clip, into the chain
    glm::dvec2 translate{0};  ///< likewise, metres
    int first = 0;            ///< the chain's index of the link's first sample
    int until = 0;            ///< and of the sample at whose begin the link's own samples end
    PlacedFrame chain;        ///< of the whole chain
};

/// Blocks where their clip is placed: in the world, or by a link of a chain that is placed there. A sample source of
/// the direct search. It refers to the blocks, which must outlive it and stay where they are.
class alignas(64) PlacedBlocks {
  public:
    /// Throws std::invalid_argument, naming the number, unless is_valid(placement).
    PlacedBlocks(const Blocks& blocks, const Placement& placement)
        : PlacedBlocks(blocks, Rotation::from_degrees(checked(placement).rotate_deg), placement.translate,
                       placement.start, 0, blocks.steps(), nullptr) {}
    /// As a Placement, with a rotation that is known. Throws likewise, and unless the squares of cosine and sine add up
    /// to 1, within 1e-9.
    PlacedBlocks(const Blocks& blocks, const Rotation& rotation, glm::dvec2 translate, double start)
        : PlacedBlocks(blocks, checked(rotation), checked(Placement{.translate = translate, .start = start}).translate,
                       start, 0, blocks.steps(), nullptr) {}
    PlacedBlocks(const Blocks&&, const Placement&) = delete;
    PlacedBlocks(const Blocks&&, const Rotation&, glm::dvec2, double) = delete;

    const Blocks& blocks() const { return *blocks_; }
    /// From the clip's frame to the world's.
    const Rotation& rotation() const { return rotation_; }
    /// The same in single precision: cosine and sine.
    float cosine() const { return cosine_; }
    float sine() const { return sine_; }
    /// Where the origin of the blocks lies in the world.
    glm::dvec2 center() const { return center_; }
    /// The root in the world: its centre is center() in the middle between begin_time() and end_time(); its velocity in
    /// m/s, and its radius in metres, with as much more as the rounding of what is computed from them.
    bool moves() const { return moves_; }  ///< if not, the velocity is 0
    float velocity_x() const { return velocity_x_; }
    float velocity_y() const { return velocity_y_; }
    float radius() const { return radius_; }
    /// Global times at which the first sample begins and the last one ends.
    double begin_time() const { return begin_; }
    double end_time() const { return end_; }
    /// Of the clip, from when its first sample begins.
    PlacedFrame frame() const {
        return {rotation_, translate_, begin_, link_ ? link_->chain.reach : blocks_->reach(),
                blocks_->steps() * blocks_->dt()};
    }

    /// Global time at which sample 0 begins, of the clip or of the chain.
    double start() const { return start_; }
    int first() const { return first_; }
    int end() const { return first_ + blocks_->count(); }
    double dt() const { return blocks_->dt(); }
    /// Sample i in the world, first() <= i < end().
    Disk disk(int i) const {
        const Disk& own = blocks_->disks()[i - first_];
        if (!link_) return placed(own, rotation_, translate_);
        return placed(placed(own, link_->rotation, link_->translate), link_->chain.rotation, link_->chain.translate);
    }
    Disk disk_at_end(int i) const { return disk(is_linear() && i + 1 < end() ? i + 1 : i); }
    bool is_linear() const { return blocks_->is_linear(); }
    /// Global time at which sample i begins; time(i + 1) is when it ends (see Clip::time).
    double time(int i) const { return i < end() ? start_ + i * dt() : end_; }
    /// No number that times are computed from is larger, seconds: what their rounding is measured by.
    double largest_time() const { return std::abs(start_) + end() * dt(); }
    static constexpr double kTimeError = 0x1p-48;  ///< of them, with a wide margin
    /// begin_time() in parts of a sample (see Blocks::kLogParts), to the nearest: how two clips of one dt are shifted
    /// against each other follows from these. kNoParts where that is too inexact, of samples that last long or begin
    /// late: there it takes the difference of their begin_time().
    std::int64_t begin_parts() const { return begin_parts_; }
    static constexpr std::int64_t kNoParts = std::numeric_limits<std::int64_t>::min();
    /// What this one adds to the slack of tests in single precision, metres: where roots meet, what is farther apart
    /// than the sum is apart for sure.
    float slack() const { return slack_; }

  private:
    friend class PlacedTree;
    friend class PlacedChain;

    // Of what is placed already: queries make these as they go, so nothing is checked again.
    /// As the clip of a tree.
    static PlacedBlocks of_tree(const Blocks& blocks, const PlacedFrame& tree) {
        return {blocks, tree.rotation, tree.translate, tree.start, 0, blocks.steps(), nullptr};
    }
    /// As a link of a chain. The place must outlive it, too.
    static PlacedBlocks of_link(const Blocks& blocks, const LinkPlace& link) {
        return {blocks,
                link.chain.rotation * link.rotation,
                link.chain.rotation(link.translate) + link.chain.translate,
                link.chain.start,
                link.first,
                link.until,
                &link};
    }
    PlacedBlocks(const Blocks& blocks, const Rotation& rotation, glm::dvec2 translate, double start, int first,
                 int until, const LinkPlace* link)
        : center_(rotation(blocks.origin()) + translate),
          begin_(start + first * blocks.dt()),
          end_(start + until * blocks.dt()),
          blocks_(&blocks),
          cosine_(static_cast<float>(rotation.c)),
          sine_(static_cast<float>(rotation.s)),
          first_(first),
          rotation_(rotation),
          translate_(translate),
          start_(start),
          link_(link) {
        // By how much the disks may be elsewhere for having been placed.
        const double reach = link ? link->chain.reach : blocks.reach();
        const double rounding = 1e-9 + 0x1p-44 * (std::abs(translate.x) + std::abs(translate.y) + reach);
        // No centre of a root moves farther than this from the origin, nor is it farther from another one's that it
        // meets.
        const double lengths = 3 * blocks.radius();
        constexpr double kTaxicab = 1.4143;  // what |x| + |y| of a length is at most
        slack_ = rounded_up(rounding + kLengthError * (kTaxicab * lengths + static_cast<double>(blocks.extent())));
        // Which samples share time must be told to half of what they must share.
        constexpr double kParts = std::int64_t{1} << Blocks::kLogParts, kMostSamples = 1 << 29;
        const double samples = begin_ * blocks.per_dt();
        const double time_error = kTimeError * largest_time();
        if (time_error + blocks.dt() / kParts < kMinOverlap / 4 && std::abs(samples) < kMostSamples)
            begin_parts_ = static_cast<std::int64_t>(samples * kParts + (samples < 0 ? -0.5 : 0.5));
        // It is not asked whether it does: of short clips some do, and a branch on that would often be mispredicted.
        moves_ = blocks.is_short();
        if (moves_) {
            const glm::dvec2 velocity = rotation(blocks.velocity());
            velocity_x_ = static_cast<float>(velocity.x);
            velocity_y_ = static_cast<float>(velocity.y);
        }
        // Above what single precision leaves out, and the predicate of swept disks: that takes them for nearer than
        // they are, by up to a share of all lengths involved (see RelativeFrame::cover_swept_disks). And above how far
        // the root moves in as much time as rounding may hide.
        constexpr double kRootError = 0x1p-19;
        radius_ = rounded_up((moves_ ? blocks.moving_radius() : blocks.radius()) + rounding +
                             time_error * blocks.root_speed() + kRootError * lengths);
    }

    /// What rounding in single precision adds at most, as a share of the lengths involved, with a wide margin.
    static constexpr double kLengthError = 0x1p-17;

    // One cache line for what is pruned by, one for what lies below.
    glm::dvec2 center_;
    double begin_, end_;
    std::int64_t begin_parts_ = kNoParts;
    const Blocks* blocks_;
    float velocity_x_ = 0, velocity_y_ = 0;
    float radius_;
    bool moves_;
    float cosine_, sine_;
    float slack_;
    int first_;
    Rotation rotation_;
    glm::dvec2 translate_;
    double start_;  ///< of sample 0: of the clip, or of the chain
    const LinkPlace* link_;
};

/// Whether two share time and their roots may meet, where these move.
inline bool moving_roots_meet(const PlacedBlocks& a, const PlacedBlocks& b) {
    // In the middle of the common time, and from there to when they are nearest.
    const double from = std::max(a.begin_time(), b.begin_time()), until = std::min(a.end_time(), b.end_time());
    const double middle = (from + until) / 2;
    const auto since_a = static_cast<float>(middle - (a.begin_time() + a.end_time()) / 2);
    const auto since_b = static_cast<float>(middle - (b.begin_time() + b.end_time()) / 2);
    const auto half = static_cast<float>((until - from) / 2);
    const glm::dvec2 between = b.center() - a.center();
    float x = static_cast<float>(between.x) + (b.velocity_x() * since_b - a.velocity_x() * since_a);
    float y = static_cast<float>(between.y) + (b.velocity_y() * since_b - a.velocity_y() * since_a);
    const float vx = b.velocity_x() - a.velocity_x(), vy = b.velocity_y() - a.velocity_y();
    constexpr float kNoWay = 1e-30F;  // where they hardly move, any moment does
    const float moment = -(x * vx + y * vy) / (vx * vx + vy * vy + kNoWay);
    const float nearest = std::max(std::min(moment, half), -half);
    x += nearest * vx;
    y += nearest * vy;
    const float reach = a.radius() + b.radius();
    // Without a branch, which would often be mispredicted.
    return static_cast<bool>(static_cast<unsigned>(until - from > kMinOverlap) &
                             static_cast<unsigned>(x * x + y * y <= reach * reach));
}
/// Whether two share time and their roots may meet: without that they do not collide.
inline bool roots_meet(const PlacedBlocks& a, const PlacedBlocks& b) {
    if (a.moves() || b.moves()) return moving_roots_meet(a, b);
    const glm::dvec2 between = b.center() - a.center();
    const auto reach = static_cast<double>(a.radius() + b.radius());
    return static_cast<bool>(
        static_cast<unsigned>(overlap_in_time(a.begin_time(), a.end_time(), b.begin_time(), b.end_time())) &
        static_cast<unsigned>(between.x * between.x + between.y * between.y <= reach * reach));
}

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

/// The earliest pair, or none, of two whose roots meet.
std::optional<SamplePair> first_hit_below_roots(const PlacedBlocks& a, const PlacedBlocks& b);
/// Whether two whose roots meet ever collide.
bool intersects_below_roots(const PlacedBlocks& a, const PlacedBlocks& b);
/// Whether two ever collide: as direct_search finds, on every machine.
inline bool intersects(const PlacedBlocks& a, const PlacedBlocks& b) {
    return roots_meet(a, b) && intersects_below_roots(a, b);
}

/// The first of `others` that collides with `a`: its index, or none. One by one, as whatever is worked out for those
/// behind it is in vain.
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

/// Whether each pair collides: sooner than one by one. Throws std::invalid_argument unless there are as many answers as
/// pairs.
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

/// All pairs, of two whose roots meet; with an observer if there is one. Returns whether the sink stopped it.
bool for_each_hit_below_roots(const PlacedBlocks& a, const PlacedBlocks& b, HitSink sink, BlockObserver* observer);
/// All pairs, earliest first. Returns whether the sink stopped it.
inline bool for_each_hit(const PlacedBlocks& a, const PlacedBlocks& b, HitSink sink) {
    return roots_meet(a, b) && for_each_hit_below_roots(a, b, sink, nullptr);
}

/// The sets of instructions that this machine can run queries with, the fastest first; "scalar" is always the last.
std::vector<std::string_view> instruction_sets();
/// All queries of the process use this one from now on; false if it is not among them. Answers do not depend on it:
/// this is for tests and measurements, when no query runs.
bool use_instruction_set(std::string_view name);

}  // namespace mobb
