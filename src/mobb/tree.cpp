#include <mobb/tree.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace mobb {

void check(const FitOptions& options) {
    if (static_cast<std::size_t>(options.tree) >= kTreeKindCount) throw std::invalid_argument("tree is no TreeKind");
    if (static_cast<std::size_t>(options.axes) >= axes_names().size()) throw std::invalid_argument("axes is no Axes");
    if (options.leaf < 1) throw std::invalid_argument("leaf must be at least 1");
    if (options.levels < 0) throw std::invalid_argument("levels must be 0 (all) or more");
    const double w = options.time_scale;
    if (!(w >= 1 / kMaxTimeScale && w <= kMaxTimeScale)) {
        throw std::invalid_argument("time_scale must be between 1e-6 and 1e6 m/s");
    }
}

Tree::Tree(ClipPtr clip, const FitOptions& options) : clip_(std::move(clip)), options_(options) {
    if (!clip_) throw std::invalid_argument("a tree needs a clip");
    check(options_);
    if (options_.tree == TreeKind::production) {
        build_blocks();
    } else {
        build({0, clip_->count()}, -1, 0);
    }
    // Depth-first order is within a level the order of time.
    std::vector<int> counts(static_cast<std::size_t>(depth_), 0);
    places_.reserve(nodes_.size());
    for (const Node& node : nodes_) places_.push_back(counts[static_cast<std::size_t>(node.level)]++);
}

int Tree::build(SampleRange range, int parent, int level) {
    const int index = static_cast<int>(nodes_.size());
    Node node;
    const TreeInfo& kinds = info(options_.tree);
    node.box = fit(level == 0 ? kinds.root : kinds.below, *clip_, range, options_.axes, options_.time_scale);
    node.first = range.first;
    node.count = range.count;
    node.parent = parent;
    node.level = level;
    nodes_.push_back(node);
    depth_ = std::max(depth_, level + 1);
    const bool is_last_level = level + 1 == options_.levels;
    if (range.count > options_.leaf && !is_last_level) {
        // Split at the middle sample: the reading of "(t_max - t_min) / 2" in Section 3.
        const int half = (range.count + 1) / 2;
        const int first_child = build({range.first, half}, index, level + 1);
        const int second_child = build({range.first + half, range.count - half}, index, level + 1);
        nodes_[static_cast<std::size_t>(index)].children[0] = first_child;
        nodes_[static_cast<std::size_t>(index)].children[1] = second_child;
    }
    return index;
}

void Tree::build_blocks() {
    blocks_ = std::make_shared<const Blocks>(clip_);
    const int count = blocks_->node_count();
    const double w = options_.time_scale;
    for (int i = 0; i < count; ++i) {
        const Blocks::Node block = blocks_->node(i);
        Node node;
        node.first = block.first;
        node.count = block.count;
        node.box = box_around(block.bound, w * (node.first * clip_->dt()), w * (node.end() * clip_->dt()));
        node.level = blocks_->node(0).level - block.level;
        if (i > 0) {
            node.parent = node.level == 1 ? 0 : blocks_->node_of(block.level + 1, block.block / Blocks::kFanOut);
            int(&siblings)[2] = nodes_[static_cast<std::size_t>(node.parent)].children;
            if (siblings[0] < 0) siblings[0] = i;
            siblings[1] = i;
        }
        nodes_.push_back(node);
        depth_ = std::max(depth_, node.level + 1);
    }
}

int Tree::child_with(const Node& node, int sample) const {
    int child = node.children[0];
    while (nodes_[static_cast<std::size_t>(child)].end() <= sample)
        child = options_.tree == TreeKind::production ? child + 1 : node.children[1];
    return child;
}

}  // namespace mobb
