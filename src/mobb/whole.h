/// Placed clips without a tree, and placed blocks, as one leaf: so they are asked against trees and chains.
#pragma once

#include <mobb/blocks.h>
#include <mobb/box.h>
#include <mobb/clip.h>

#include <array>
#include <concepts>

namespace mobb {

/// A node source of one node, under a rectangle that holds the clip. It refers to what is placed.
template <class Placed>
requires std::same_as<Placed, PlacedClip> || std::same_as<Placed, PlacedBlocks>
class Whole {
    static constexpr bool kBlocks = std::same_as<Placed, PlacedBlocks>;

  public:
    explicit Whole(const Placed& placed) : placed_(&placed), frame_(placed.frame()) {
        if constexpr (kBlocks) {
            const Blocks& blocks = placed.blocks();
            leaf_.rectangle = {blocks.origin(), {1, 0}, glm::dvec2(blocks.radius())};
        } else {
            leaf_.rectangle = {{0, 0}, {1, 0}, glm::dvec2(frame_.reach)};
        }
        leaf_.first = placed.first();
        leaf_.until = placed.end();
    }

    struct Leaf {
        Rectangle rectangle;  ///< in the clip's own frame
        int first = 0, until = 0;
        BoxKind kind = BoxKind::obb2d;

        static constexpr bool is_leaf() { return true; }
        int end() const { return until; }
    };
    const Leaf& node(int) const { return leaf_; }
    std::array<int, 2> children(int, const Leaf&) const { return {-1, -1}; }
    const Rectangle& rectangle(const Leaf& leaf) const { return leaf.rectangle; }
    Box box(int, const Leaf& leaf) const { return over_time(leaf.kind, leaf.rectangle, 0, frame_.duration); }
    Box stored_box(int i, const Leaf& leaf) const { return box(i, leaf); }
    double time_scale() const { return 1; }
    const PlacedFrame& frame() const { return frame_; }
    const Placed& samples() const { return *placed_; }
    const Placed& samples(const Leaf&) const { return *placed_; }
    bool has_blocks(const Leaf&) const { return kBlocks; }
    PlacedBlocks blocks(const Leaf&, LinkPlace&) const requires kBlocks { return *placed_; }
    double begin(const Leaf&) const { return begin_time(); }
    double end(const Leaf&) const { return end_time(); }
    double begin_time() const { return placed_->time(leaf_.first); }
    double end_time() const { return placed_->time(leaf_.until); }

  private:
    const Placed* placed_;
    PlacedFrame frame_;
    Leaf leaf_;
};

}  // namespace mobb
