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
    build({0, clip_->count()}, -1, 0);
    // Depth-first order is within a level the order of time.
    std::vector<int> counts(static_cast<std::size_t>(depth_), 0);
    for (Place& place : places_) place.in_level = counts[static_cast<std::size_t>(place.level)]++;
}

std::size_t Tree::bytes() const {
    return nodes_.size() * sizeof(Node) + places_.size() * sizeof(Place) + boxes_.size() * sizeof(Box);
}

Box Tree::box(int i) const {
    const Node& n = node(i);
    return is_upright(n.kind) ? over_time(n.kind, n.rectangle, time_scale() * t0(n), time_scale() * t1(n))
                              : stored_box(i);
}

int Tree::build(SampleRange range, int parent, int level) {
    const int index = static_cast<int>(nodes_.size());
    const TreeInfo& kinds = info(options_.tree);
    const Box box = fit(level == 0 ? kinds.root : kinds.below, *clip_, range, options_.axes, options_.time_scale);
    nodes_.push_back({rectangle_of(box), range.first, range.count, -1, box.kind});
    places_.push_back({parent, level, 0});
    if (!is_upright(box.kind)) {
        boxes_.resize(nodes_.size());
        boxes_.back() = box;
    }
    depth_ = std::max(depth_, level + 1);
    const bool is_last_level = level + 1 == options_.levels;
    if (range.count > options_.leaf && !is_last_level) {
        // Split at the middle sample: the reading of "(t_max - t_min) / 2" in Section 3.
        const int half = (range.count + 1) / 2;
        build({range.first, half}, index, level + 1);
        const int second_child = build({range.first + half, range.count - half}, index, level + 1);
        nodes_[static_cast<std::size_t>(index)].second_child = second_child;
    }
    return index;
}

}  // namespace mobb
