/// Chains where they are placed.
#pragma once

#include <mobb/blocks.h>
#include <mobb/chain.h>

#include <algorithm>
#include <array>

namespace mobb {

/// The placed samples of one link, or of the joint behind it, with their indices in the chain.
class ChainSamples {
  public:
    /// Below a node that is not of several links.
    ChainSamples(const Chain& chain, const ChainNode& node, const PlacedFrame& frame)
        : link_(&chain.links_[static_cast<std::size_t>(node.link)]),
          frame_(&frame),
          dt_(chain.dt()),
          until_(node.is_joint() ? link_->end() : link_->until),
          is_joint_(node.is_joint()) {}

    Disk disk(int i) const { return placed(link_->disk(i), frame_->rotation, frame_->translate); }
    Disk disk_at_end(int i) const {
        if (is_joint_) return placed(link_->runs_on_to(), frame_->rotation, frame_->translate);
        return disk(link_->linear && i + 1 < link_->end() ? i + 1 : i);
    }
    double time(int i) const { return frame_->start + std::min(i, until_) * dt_; }
    bool is_linear() const { return link_->linear; }
    static constexpr bool kStoredInFrame = false;  // but in that of the link's clip
    StoredDisks stored() const {
        return {link_->samples, link_->first, frame_->rotation * link_->rotation,
                frame_->rotation(link_->translate) + frame_->translate};
    }

  private:
    const Chain::Link* link_;
    const PlacedFrame* frame_;
    double dt_;
    int until_;  ///< they end when this sample begins
    bool is_joint_;
};

/// A chain seen through a placement: a node source of the traversal and a sample source of the direct search. Its
/// answers are bit for bit those of the clip of all its samples. It refers to the chain, which must outlive it, stay
/// where it is, and not change meanwhile.
class PlacedChain {
  public:
    /// Throws std::invalid_argument, naming the number, unless is_valid(placement, chain.most_start()).
    PlacedChain(const Chain& chain, const Placement& placement)
        : chain_(&chain),
          dt_(chain.dt()),
          until_(chain.until()),
          frame_{checked(placement, chain.most_start()).rotation(), placement.translate, placement.start, chain.reach(),
                 chain.duration()} {}
    PlacedChain(const Chain&&, const Placement&) = delete;

    const Chain& chain() const { return *chain_; }
    ChainNode node(int id) const { return chain_->node(id); }
    std::array<int, 2> children(int, const ChainNode& node) const { return node.children; }
    Rectangle rectangle(const ChainNode& node) const { return chain_->rectangle(node); }
    Box box(int, const ChainNode& node) const { return chain_->box(node); }
    Box stored_box(int, const ChainNode& node) const { return chain_->box(node); }
    double time_scale() const { return chain_->time_scale(); }
    const PlacedFrame& frame() const { return frame_; }
    /// The placed samples below a node of a link.
    ChainSamples samples(const ChainNode& node) const { return {*chain_, node, frame_}; }
    const PlacedChain& samples() const { return *this; }
    bool has_blocks(const ChainNode& node) const { return node.kind == BoxKind::block; }
    /// Those of a link whose tree has blocks. They refer to the place.
    PlacedBlocks blocks(const ChainNode& node, LinkPlace& place) const {
        place = {chain_->rotation(node.link), chain_->translate(node.link), node.first, node.until, frame_};
        return PlacedBlocks::of_link(*chain_->part(node.link).tree().blocks(), place);
    }
    /// Global time, as the samples that bound the node have it.
    double begin(const ChainNode& node) const { return time(node.first); }
    double end(const ChainNode& node) const { return time(node.until); }
    /// Of the root.
    double begin_time() const { return time(first()); }
    double end_time() const { return time(end()); }

    int first() const { return chain_->first(); }
    int end() const { return chain_->end(); }
    /// Sample i in the world; in O(log links).
    Disk disk(int i) const { return placed(chain_->disk(i), frame_.rotation, frame_.translate); }
    /// What sample i has become when it ends.
    Disk disk_at_end(int i) const { return placed(chain_->disk_at_end(i), frame_.rotation, frame_.translate); }
    bool is_linear() const { return chain_->is_linear(); }
    double dt() const { return dt_; }
    /// Global time at which sample i begins; time(i + 1) is when it ends (see Clip::time). Never decreases with i.
    double time(int i) const { return frame_.start + std::min(i, until_) * dt_; }

  private:
    const Chain* chain_;
    double dt_;
    int until_;  ///< of the chain
    PlacedFrame frame_;
};

}  // namespace mobb
