/// Do two placed clips ever collide? The fast way: through blocks, several at a time. mobb/query.h has the contacts.
#pragma once

#include <mobb/blocks.h>
#include <mobb/kinds.h>
#include <mobb/predicate.h>
#include <mobb/separation.h>

#include <cassert>
#include <cmath>
#include <cstddef>
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
    PlacedFrame chain;        ///< of the whole chain
};

/// Blocks where their clip is placed: in the world, or by a link of a chain that is placed there. A sample source of
/// the direct search. It refers to the blocks, which must outlive it and stay where they are.
class alignas(64) PlacedBlocks {
  public:
    /// Requires is_valid(placement).
    PlacedBlocks(const Blocks& blocks, const Placement& placement)
        : PlacedBlocks(blocks, Rotation::from_degrees(placement.rotate_deg), placement.translate, placement.start) {
        assert(is_valid(placement));
    }
    /// As a Placement, with a rotation that is known.
    PlacedBlocks(const Blocks& blocks, const Rotation& rotation, glm::dvec2 translate, double start)
        : PlacedBlocks(blocks, rotation, translate, start, 0, nullptr) {}
    PlacedBlocks(const Blocks&&, const Placement&) = delete;
    /// As a link of a chain. The place must outlive it, too.
    PlacedBlocks(const Blocks& blocks, const LinkPlace& link)
        : PlacedBlocks(blocks, link.chain.rotation * link.rotation,
                       link.chain.rotation(link.translate) + link.chain.translate, link.chain.start, link.first,
                       &link) {}

    const Blocks& blocks() const { return *blocks_; }
    /// From the clip's frame to the world's.
    const Rotation& rotation() const { return rotation_; }
    /// The same in single precision: cosine and sine.
    float cosine() const { return cosine_; }
    float sine() const { return sine_; }
    /// Where the origin of the blocks lies in the world, and how far their disks reach from there, metres.
    glm::dvec2 center() const { return center_; }
    float radius() const { return radius_; }
    /// Global times at which the first sample begins and the last one ends.
    double begin() const { return begin_; }
    double end_time() const { return end_; }
    /// Of the clip, from when its first sample begins.
    PlacedFrame frame() const {
        return {rotation_, translate_, begin_, link_ ? link_->chain.reach : blocks_->reach(),
                blocks_->count() * blocks_->dt()};
    }

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
    /// Global time at which sample i begins; time(i + 1) is when it ends.
    double time(int i) const { return start_ + i * dt(); }
    /// No number that times are computed from is larger, seconds: what their rounding is measured by.
    float largest_time() const { return largest_time_; }
    /// By how much the disks may be elsewhere for having been placed, metres; part of radius(), too.
    float rounding() const { return rounding_; }

  private:
    PlacedBlocks(const Blocks& blocks, const Rotation& rotation, glm::dvec2 translate, double start, int first,
                 const LinkPlace* link)
        : center_(rotation(blocks.origin()) + translate),
          begin_(start + first * blocks.dt()),
          end_(start + (first + blocks.count()) * blocks.dt()),
          cosine_(static_cast<float>(rotation.c)),
          sine_(static_cast<float>(rotation.s)),
          blocks_(&blocks),
          largest_time_(rounded_up(std::abs(start) + (first + blocks.count()) * blocks.dt())),
          rotation_(rotation),
          translate_(translate),
          start_(start),
          link_(link),
          first_(first) {
        const double reach = link ? link->chain.reach : blocks.reach();
        const double rounding = 1e-9 + 0x1p-44 * (std::abs(translate.x) + std::abs(translate.y) + reach);
        radius_ = rounded_up(blocks.radius() + rounding);
        rounding_ = rounded_up(rounding);
    }

    // One cache line for what is pruned by, one for the samples.
    glm::dvec2 center_;
    double begin_, end_;
    float cosine_, sine_;
    const Blocks* blocks_;
    float radius_, rounding_, largest_time_;
    Rotation rotation_;
    glm::dvec2 translate_;
    double start_;  ///< of sample 0: of the clip, or of the chain
    const LinkPlace* link_;
    int first_;
};

/// Whether two share time and their roots may meet: without that they do not collide.
inline bool roots_meet(const PlacedBlocks& a, const PlacedBlocks& b) {
    const glm::dvec2 between = b.center() - a.center();
    // The predicate of swept disks takes them for nearer than they are, by up to a share of all lengths involved (see
    // RelativeFrame::cover_swept_disks): they are at most a few times the radii where roots touch.
    constexpr double kSwept = 1e-6;
    const double reach = (1 + kSwept) * static_cast<double>(a.radius() + b.radius());
    // Without a branch, which would often be mispredicted.
    return static_cast<bool>(static_cast<unsigned>(overlap_in_time(a.begin(), a.end_time(), b.begin(), b.end_time())) &
                             static_cast<unsigned>(between.x * between.x + between.y * between.y <= reach * reach));
}

/// Is told of the pairs of samples that collide, in order of time; says whether to stop.
struct HitSink {
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
/// Whether two ever collide: as direct_search finds, on every machine.
inline bool intersects(const PlacedBlocks& a, const PlacedBlocks& b) {
    return roots_meet(a, b) && first_hit_below_roots(a, b).has_value();
}

/// The first of `others` that collides with `a`: its index, or none.
std::optional<std::size_t> intersects_any(const PlacedBlocks& a, std::span<const PlacedBlocks* const> others);

/// Two clips to be tested against each other.
struct BlocksPair {
    const PlacedBlocks* a = nullptr;
    const PlacedBlocks* b = nullptr;
};

/// Whether each pair collides: sooner than one by one. Requires as many answers as pairs.
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
