/// Do two placed clips ever collide? The fast way: through blocks, several at a time. mobb/query.h has the contacts.
#pragma once

#include <mobb/blocks.h>
#include <mobb/kinds.h>
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
/// the direct search. It refers to the blocks, which must outlive it and stay where they are. As large as a cache line.
class alignas(64) PlacedBlocks {
  public:
    /// Requires is_valid(placement).
    PlacedBlocks(const Blocks& blocks, const Placement& placement)
        : PlacedBlocks(blocks, Rotation::from_degrees(placement.rotate_deg), placement.translate, placement.start) {
        assert(is_valid(placement));
    }
    /// As a Placement, with a rotation that is known.
    PlacedBlocks(const Blocks& blocks, const Rotation& rotation, glm::dvec2 translate, double start)
        : blocks_(&blocks),
          rotation_(rotation),
          translate_(translate),
          start_(start),
          rounding_(rounding_of(translate, blocks.reach())) {}
    PlacedBlocks(const Blocks&&, const Placement&) = delete;
    /// As a link of a chain. The place must outlive it, too.
    PlacedBlocks(const Blocks& blocks, const LinkPlace& link)
        : blocks_(&blocks),
          link_(&link),
          rotation_(link.chain.rotation * link.rotation),
          translate_(link.chain.rotation(link.translate) + link.chain.translate),
          start_(link.chain.start),
          first_(link.first),
          rounding_(rounding_of(translate_, link.chain.reach)) {}

    const Blocks& blocks() const { return *blocks_; }
    /// From the clip's frame to the world's.
    const Rotation& rotation() const { return rotation_; }
    glm::dvec2 translate() const { return translate_; }
    /// Of the clip, from when its first sample begins.
    PlacedFrame frame() const {
        return {rotation_, translate_, time(first_), reach(), blocks_->count() * blocks_->dt()};
    }
    double reach() const { return link_ ? link_->chain.reach : blocks_->reach(); }

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
    /// By how much the disks may be elsewhere for having been placed, metres.
    double rounding() const { return static_cast<double>(rounding_); }
    /// Global time at which sample i begins; time(i + 1) is when it ends.
    double time(int i) const { return start_ + i * dt(); }
    /// No number that times are computed from is larger, seconds: what their rounding is measured by.
    double largest_time() const { return std::abs(start_) + end() * dt(); }

  private:
    static float rounding_of(glm::dvec2 translate, double reach) {
        return static_cast<float>(0x1p-43 * (std::abs(translate.x) + std::abs(translate.y) + reach));
    }

    const Blocks* blocks_;
    const LinkPlace* link_ = nullptr;
    Rotation rotation_;
    glm::dvec2 translate_;
    double start_;  ///< of sample 0: of the clip, or of the chain
    int first_ = 0;
    float rounding_;
};
static_assert(sizeof(PlacedBlocks) == 64);

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

/// The earliest pair, or none.
std::optional<SamplePair> first_hit(const PlacedBlocks& a, const PlacedBlocks& b);
/// All pairs. Returns whether the sink stopped it.
bool for_each_hit(const PlacedBlocks& a, const PlacedBlocks& b, HitSink sink);

/// Whether two ever collide: as direct_search finds, on every machine.
inline bool intersects(const PlacedBlocks& a, const PlacedBlocks& b) { return first_hit(a, b).has_value(); }

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

    virtual void enter(int a, int b) = 0;
    virtual void leave() = 0;
    virtual void time_test(bool overlap) = 0;
    virtual void box_test(BoxKind test, const Separation& separation) = 0;
    virtual void sample_pair(int i, int j, double squared_distance) = 0;
    virtual void sample_test(bool hit) = 0;

  protected:
    ~BlockObserver() = default;
};

/// What for_each_hit does once it has found that the roots share time and may meet; with an observer if there is one.
bool for_each_hit_below_roots(const PlacedBlocks& a, const PlacedBlocks& b, HitSink sink, BlockObserver* observer);

/// The sets of instructions that this machine can run queries with, the fastest first; "scalar" is always the last.
std::vector<std::string_view> instruction_sets();
/// All queries of the process use this one from now on; false if it is not among them. Answers do not depend on it:
/// this is for tests and measurements, when no query runs.
bool use_instruction_set(std::string_view name);

}  // namespace mobb
