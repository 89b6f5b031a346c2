/// Trees where their clips are placed.
#pragma once

#include <mobb/blocks.h>
#include <mobb/tree.h>

#include <array>

namespace mobb {

/// A tree seen through a placement: a node source of the traversal. It refers to the tree, which must outlive it and
/// stay where it is.
class PlacedTree {
  public:
    /// Throws std::invalid_argument, naming the number, unless is_valid(placement, tree.clip().most_start()).
    PlacedTree(const Tree& tree, const Placement& placement)
        : nodes_(tree.nodes().data()), placed_(tree.clip(), placement), tree_(&tree) {}
    PlacedTree(const Tree&&, const Placement&) = delete;

    const Tree& tree() const { return *tree_; }
    const Node& node(int i) const { return nodes_[i]; }
    double time_scale() const { return tree_->time_scale(); }
    const PlacedClip& placed_clip() const { return placed_; }
    const PlacedFrame& frame() const { return placed_.frame(); }
    std::array<int, 2> children(int i, const Node& node) const { return {i + 1, node.second_child}; }
    const Rectangle& rectangle(const Node& node) const { return node.rectangle; }
    Box box(int i, const Node&) const { return tree_->box(i); }
    const Box& stored_box(int i, const Node&) const { return tree_->stored_box(i); }
    /// The placed samples below a node, with their indices in the clip.
    const PlacedClip& samples(const Node&) const { return placed_; }
    const PlacedClip& samples() const { return placed_; }
    bool has_blocks(const Node& node) const { return node.kind == BoxKind::block; }
    /// Those below the root of a tree that has blocks.
    PlacedBlocks blocks(const Node&, LinkPlace&) const { return PlacedBlocks::of_tree(*tree_->blocks(), frame()); }
    /// Global time, as the samples that bound the node have it: so a node is never apart from what its samples meet.
    double begin(const Node& node) const { return placed_.time(node.first); }
    double end(const Node& node) const { return placed_.time(node.end()); }
    /// Of the root, which is not read for it.
    double begin_time() const { return frame().start; }
    double end_time() const { return frame().start + frame().duration; }

  private:
    const Node* nodes_;
    PlacedClip placed_;
    const Tree* tree_;
};

}  // namespace mobb
