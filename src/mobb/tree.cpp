#include <mobb/fitting.h>
#include <mobb/tree.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace mobb {

void check(const FitOptions& options) {
    if (static_cast<std::size_t>(options.tree) >= kTreeKindCount) throw std::invalid_argument("tree is not a TreeKind");
    if (static_cast<std::size_t>(options.axes) >= axes_names().size())
        throw std::invalid_argument("axes is not an Axes");
    if (options.leaf < 1) throw std::invalid_argument("leaf must be at least 1");
    if (options.levels < 0) throw std::invalid_argument("levels must be 0 (all) or more");
    const double w = options.time_scale;
    if (!(w >= 1 / kMaxTimeScale && w <= kMaxTimeScale)) {
        throw std::invalid_argument("time_scale must be between 1e-6 and 1e6 m/s");
    }
}

namespace {

/// Of a tree over so many samples: a level's nodes hold one of two numbers of samples, of which one is the next.
std::size_t node_count(int samples, const FitOptions& options) {
    std::size_t nodes = 0, smaller = 1, larger = 0;  // on the level: nodes of `samples` and of `samples` + 1
    for (int level = 1;; ++level) {
        nodes += smaller + larger;
        const bool smaller_split = samples > options.leaf, larger_split = samples + 1 > options.leaf;
        if (level == options.levels || !(larger ? larger_split : smaller_split)) return nodes;
        if (!smaller_split) smaller = 0;
        // 2k splits into k and k; 2k + 1 into k + 1 and k.
        const bool is_even = samples % 2 == 0;
        const std::size_t next_smaller = is_even ? 2 * smaller + larger : smaller;
        const std::size_t next_larger = is_even ? larger : smaller + 2 * larger;
        samples /= 2;
        smaller = next_smaller;
        larger = next_larger;
    }
}

}  // namespace

Tree::Tree(ClipPtr clip, const FitOptions& options) : Tree(std::move(clip), options, NodeChange{}) {}

Tree::Tree(ClipPtr clip, const FitOptions& options, const NodeChange& change)
    : clip_(std::move(clip)), options_(options) {
    if (!clip_) throw std::invalid_argument("a tree needs a clip");
    check(options_);
    if (info(options_.tree).has_blocks()) {
        if (change.node >= 0) throw std::invalid_argument("all blocks are built alike: no node can be changed");
        build_blocks();
    } else {
        const std::size_t nodes = node_count(clip_->count(), options_);
        nodes_.reserve(nodes);
        places_.reserve(nodes);
        if (!is_upright(info(options_.tree).below)) boxes_.reserve(nodes);
        build({0, clip_->count()}, -1, 0, change);
        assert(change.split || nodes_.size() == nodes);
        if (change.node >= static_cast<int>(nodes_.size())) throw std::invalid_argument("there is no node to change");
    }
    // Depth-first order is within a level the order of time.
    std::vector<int> counts(static_cast<std::size_t>(depth_), 0);
    for (Place& place : places_) place.in_level = counts[static_cast<std::size_t>(place.level)]++;
}

std::size_t Tree::bytes() const {
    return nodes_.capacity() * sizeof(Node) + places_.capacity() * sizeof(Place) + boxes_.capacity() * sizeof(Box) +
           (blocks_ ? blocks_->bytes() : 0);
}

Box Tree::box(int i) const {
    const Node& n = node(i);
    return is_upright(n.kind) ? over_time(n.kind, n.rectangle, time_scale() * t0(n), time_scale() * t1(n))
                              : stored_box(i);
}

int Tree::build(SampleRange range, int parent, int level, const NodeChange& change) {
    const int index = static_cast<int>(nodes_.size());
    nodes_.push_back({{}, range.first, range.count});
    places_.push_back({parent, level, 0});
    depth_ = std::max(depth_, level + 1);
    const bool is_last_level = level + 1 == options_.levels;
    // Split at the middle sample: the reading of "(t_max - t_min) / 2" in Section 3.
    int first_count = range.count > options_.leaf && !is_last_level ? (range.count + 1) / 2 : 0;
    if (index == change.node && change.split) {
        first_count = *change.split;
        if (first_count < 0 || first_count >= range.count || (first_count > 0 && is_last_level))
            throw std::invalid_argument("the node cannot be split there");
    }
    if (first_count > 0) {
        build({range.first, first_count}, index, level + 1, change);
        const int second_child =
            build({range.first + first_count, range.count - first_count}, index, level + 1, change);
        nodes_[static_cast<std::size_t>(index)].second_child = second_child;
    }
    fit_box(index, level, change);
    return index;
}

void Tree::build_blocks() {
    blocks_ = std::make_shared<const Blocks>(clip_);
    const double w = options_.time_scale;
    const int top = blocks_->node(0).level, count = blocks_->node_count();
    nodes_.reserve(static_cast<std::size_t>(count));
    places_.reserve(static_cast<std::size_t>(count));
    boxes_.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
        const Blocks::Node block = blocks_->node(i);
        nodes_.push_back({{}, block.first, block.count, -1, BoxKind::block});
        boxes_.push_back(box_around(block.bound, w * t0(nodes_.back()), w * t1(nodes_.back())));
        const int level = top - block.level;
        const int parent = level == 0   ? -1
                           : level == 1 ? 0
                                        : blocks_->node_of(block.level + 1, block.block / Blocks::kFanOut);
        places_.push_back({parent, level, 0});
        depth_ = level + 1;
    }
}

std::array<int, 2> Tree::children(int i) const {
    if (is_leaf(i)) return {-1, -1};
    if (!blocks_) return {i + 1, node(i).second_child};
    const Blocks::Node block = blocks_->node(i);
    const int level = block.level - 1;
    if (i == 0) return {blocks_->node_of(level, 0), blocks_->node_of(level, blocks_->count(level) - 1)};
    const int first = block.block * Blocks::kFanOut;
    return {blocks_->node_of(level, first),
            blocks_->node_of(level, std::min(first + Blocks::kFanOut, blocks_->count(level)) - 1)};
}

int Tree::child_with(int i, int sample) const {
    const auto [first, last] = children(i);
    int child = first;
    while (node(child).end() <= sample) child = blocks_ ? child + 1 : last;
    return child;
}

void Tree::fit_box(int index, int level, const NodeChange& change) {
    const TreeInfo& kinds = info(options_.tree);
    BoxKind kind = level == 0 ? kinds.root : kinds.below;
    Axes axes = options_.axes;
    if (index == change.node) {
        kind = change.kind.value_or(kind);
        axes = change.axes.value_or(axes);
        if (info(kind).of_blocks) throw std::invalid_argument("a block is not a box of a single node");
    }
    Node& node = nodes_[static_cast<std::size_t>(index)];
    // A node that is not upright has no rectangle that bounds it: those above the change look at all samples.
    if (is_upright(kind) && is_upright(kinds.below) && !change.kind) {
        node.kind = kind;
        node.rectangle = fit_node(kind, *clip_, nodes_, index, axes);
        return;
    }
    const Box box = fit(kind, *clip_, {node.first, node.count}, axes, options_.time_scale);
    node.kind = box.kind;
    node.rectangle = rectangle_of(box);
    if (is_upright(box.kind)) return;
    boxes_.resize(std::max(boxes_.size(), static_cast<std::size_t>(index) + 1));
    boxes_[static_cast<std::size_t>(index)] = box;
}

}  // namespace mobb
