#include <mobb/tree.h>

#include <mobb/name_table.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace mobb {

namespace {

constexpr std::array<std::string_view, 4> kTreeKindNames{"mobb", "umobb", "hybrid1", "hybrid2"};
constexpr std::array<std::string_view, 3> kAxesNames{"endpoints", "covariance", "minarea"};

bool is_free_box(TreeKind kind, int level) {
    switch (kind) {
        case TreeKind::mobb:
            return false;
        case TreeKind::umobb:
            return true;
        case TreeKind::hybrid1:
            return level > 0;
        case TreeKind::hybrid2:
            return level == 0;
    }
    return false;
}

}  // namespace

std::string_view name(TreeKind kind) { return kTreeKindNames[static_cast<std::size_t>(kind)]; }
std::string_view name(Axes axes) { return kAxesNames[static_cast<std::size_t>(axes)]; }
std::string_view name(BoxKind kind) { return kind == BoxKind::obb2d ? "obb2d" : "obb3d"; }
std::optional<TreeKind> tree_kind(std::string_view name) { return from_name<TreeKind>(kTreeKindNames, name); }
std::optional<Axes> axes_from_name(std::string_view name) { return from_name<Axes>(kAxesNames, name); }
std::span<const std::string_view> tree_kind_names() { return kTreeKindNames; }
std::span<const std::string_view> axes_names() { return kAxesNames; }

void check(const FitOptions& options) {
    if (options.leaf < 1) throw std::invalid_argument("leaf must be at least 1");
    if (options.levels < 0) throw std::invalid_argument("levels must be 0 (all) or more");
    const double w = options.time_scale;
    if (!(w >= 1 / kMaxTimeScale && w <= kMaxTimeScale)) {
        throw std::invalid_argument("time_scale must be between 1e-6 and 1e6 m/s");
    }
}

Tree::Tree(ClipPtr clip, const FitOptions& options) : clip_(std::move(clip)), options_(options) {
    check(options_);
    build({0, clip_->count()}, -1, 0);
}

int Tree::build(SampleRange range, int parent, int level) {
    const int index = static_cast<int>(nodes_.size());
    Node node;
    node.box = is_free_box(options_.tree, level) ? fit_obb3d(*clip_, range, options_.axes, options_.time_scale)
                                                 : fit_obb2d(*clip_, range, options_.axes, options_.time_scale);
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

double cylinder_volume(const Clip& clip) {
    double sum = 0;
    for (const Disk& d : clip.samples()) sum += d.r * d.r;
    return std::numbers::pi * sum * clip.dt();
}

std::vector<LevelFigures> level_figures(const Tree& tree) {
    std::vector<LevelFigures> levels(static_cast<std::size_t>(tree.depth()));
    for (const Node& node : tree.nodes()) {
        const double v = volume(node.box, tree.time_scale());
        const int last = node.is_leaf() ? tree.depth() - 1 : node.level;
        for (int level = node.level; level <= last; ++level) {
            levels[static_cast<std::size_t>(level)].nodes += 1;
            levels[static_cast<std::size_t>(level)].volume += v;
        }
    }
    const double cylinders = cylinder_volume(tree.clip());
    for (std::size_t i = 0; i < levels.size(); ++i) {
        levels[i].level = static_cast<int>(i);
        if (levels[i].volume > 0) levels[i].tightness = cylinders / levels[i].volume;
    }
    return levels;
}

}  // namespace mobb
