#include <explain/node_values.h>
#include <mobb/level_figures.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace mobbscope {

namespace {

constexpr double kNoFigure = std::numeric_limits<double>::quiet_NaN();
/// Edges that are shorter along time than this part of the longest add nothing that is seen, but rounding.
constexpr double kLeastEdge = 1e-4;
constexpr double kOfRounding = 1e-12;  // of a volume: less than that is left of differences where nothing should be

double cross(const glm::dvec3& a, const glm::dvec3& b) { return std::abs(a.x * b.y - a.y * b.x); }

/// How much of a sum of numbers, each uniform within +-`reach`, is at most x.
class SumOfUniform {
  public:
    explicit SumOfUniform(const std::array<double, 3>& reach) {
        const double longest = *std::ranges::max_element(reach);
        for (const double each : reach) {
            if (each > kLeastEdge * longest) reach_[count_++] = each;
        }
    }

    /// Volume of the corner of a box that a plane cuts off, over that of the box.
    double at_most(double x) const {
        double whole = 1, least = 0;
        for (std::size_t i = 0; i < count_; ++i) {
            whole *= 2 * reach_[i] * static_cast<double>(i + 1);
            least -= reach_[i];
        }
        if (count_ == 0) return x >= 0 ? 1 : 0;
        if (x <= least) return 0;
        if (x >= -least) return 1;
        double sum = 0;
        for (unsigned corner = 0; corner < (1u << count_); ++corner) {
            double beyond = x - least, sign = 1;
            for (std::size_t i = 0; i < count_; ++i) {
                if (((corner >> i) & 1u) == 0) continue;
                beyond -= 2 * reach_[i];
                sign = -sign;
            }
            if (beyond <= 0) continue;
            for (std::size_t i = 0; i < count_; ++i) sign *= beyond;
            sum += sign;
        }
        return std::clamp(sum / whole, 0.0, 1.0);
    }

  private:
    std::array<double, 3> reach_{};
    std::size_t count_ = 0;
};

}  // namespace

double floor_area(const mobb::Box& box) {
    if (mobb::info(box.kind).round)
        return std::numbers::pi * box.half.x * box.half.x + 4 * box.half.x * glm::length(box.drift);
    const std::array<glm::dvec3, 3> edges = mobb::half_edges(box);
    return 4 * (cross(edges[0], edges[1]) + cross(edges[1], edges[2]) + cross(edges[2], edges[0]));
}

double overhang_in_time(const mobb::Box& box, double time_scale, double t0, double t1) {
    const std::array<glm::dvec3, 3> edges = mobb::half_edges(box);
    const SumOfUniform along({std::abs(edges[0].z), std::abs(edges[1].z), std::abs(edges[2].z)});
    const double inside = along.at_most(time_scale * t1 - box.center.z) - along.at_most(time_scale * t0 - box.center.z);
    return std::clamp(1 - inside, 0.0, 1.0);
}

NodeValues::NodeValues(std::shared_ptr<const mobb::Tree> tree, std::span<const double> shares)
    : tree_(std::move(tree)) {
    const auto all = static_cast<std::size_t>(size());
    for (std::vector<double>& column : columns_) column.assign(all, kNoFigure);
    const bool leans = std::ranges::any_of(
        tree_->nodes(), [](const mobb::Node& node) { return mobb::info(node.kind).axes == mobb::BoxAxes::space_time; });
    for (int i = 0; i < size(); ++i) {
        const auto at = static_cast<std::size_t>(i);
        const mobb::Node& node = tree_->node(i);
        const mobb::Box box = tree_->box(i);
        const double volume = mobb::volume(box, tree_->time_scale());
        const double filled = mobb::cylinder_volume(tree_->clip(), {node.first, node.count});
        of(NodeField::node)[at] = i;
        of(NodeField::level)[at] = tree_->level(i);
        of(NodeField::sample)[at] = node.first;
        of(NodeField::count)[at] = node.count;
        of(NodeField::time)[at] = tree_->t0(node);
        of(NodeField::leaf)[at] = tree_->is_leaf(i) ? 1 : 0;
        of(NodeField::volume)[at] = volume;
        // A box around samples that stand may be as large as their cylinders, and differ by rounding.
        const double empty = volume - filled < kOfRounding * volume ? 0 : volume - filled;
        of(NodeField::empty)[at] = empty;
        of(NodeField::waste)[at] = tree_->is_leaf(i) ? empty : volume;
        // Parents come before their children.
        if (const int parent = tree_->parent(i); parent >= 0)
            of(NodeField::waste)[static_cast<std::size_t>(parent)] -= volume;
        if (volume > 0) of(NodeField::fill)[at] = filled / volume;
        of(NodeField::floor)[at] = floor_area(box);
        // The last sample of a linear clip takes no time, so its box has no volume.
        if (leans && volume > 0)
            of(NodeField::overhang)[at] = overhang_in_time(box, tree_->time_scale(), tree_->t0(node), tree_->t1(node));
    }
    for (std::size_t i = 0; i < all; ++i) {
        double& waste = of(NodeField::waste)[i];
        if (std::abs(waste) < kOfRounding * of(NodeField::volume)[i]) waste = 0;
    }
    add_shares(shares);
}

void NodeValues::add_shares(std::span<const double> shares) { std::ranges::copy(shares, of(NodeField::share).begin()); }

void NodeValues::add_tests(const SceneCosts& costs, int clip) {
    std::ranges::fill(of(NodeField::tests), 0.0);
    for (const NodeCost& cost : costs.nodes) {
        if (cost.at.clip != clip) continue;
        of(NodeField::tests)[static_cast<std::size_t>(cost.at.node)] = static_cast<double>(cost.boxes);
    }
}

void NodeValues::add_avoidable(const BlameInScene& blame, int clip) {
    for (int i = 0; i < size(); ++i)
        of(NodeField::avoidable)[static_cast<std::size_t>(i)] = static_cast<double>(blame.of(clip, i));
}

void NodeValues::forget(NodeField field) { std::ranges::fill(of(field), kNoFigure); }

bool NodeValues::has(NodeField field) const {
    return std::ranges::any_of(column(field), [](double value) { return !std::isnan(value); });
}

FieldRange NodeValues::range(NodeField field, int node) const {
    const double first = value(field, node);
    const mobb::Node& covers = tree_->node(node);
    if (field == NodeField::sample) return {first, first + covers.count - 1};
    if (field == NodeField::time) return {first, tree_->t1(covers)};
    return {first, first};
}

bool NodeValues::passes(const NodeFilter& filter, int node) const {
    return filter.passes([&](const NodeFilter::Term& term) {
        if (term.level >= 0) {
            const bool is =
                tree_->level(node) == term.level && tree_->place_in_level(node) == static_cast<int>(term.value);
            return is == (term.comparison == Comparison::equal);
        }
        const NodeField field = NodeFilter::field(term);
        FieldRange of = range(field, node);
        if (info(field).unit == "%") of = {100 * of.least, 100 * of.most};
        return compares(of, term.comparison, term.value);
    });
}

}  // namespace mobbscope
