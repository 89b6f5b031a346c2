/// The figures of a tree's nodes: how much room each box wastes, and what it costs.
#pragma once

#include <explain/avoidable.h>
#include <explain/branch_costs.h>
#include <mobb/tree.h>
#include <scene/node_field.h>

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace mobbscope {

/// The area of a box's outline on the floor, over all its time, m^2: of its shadow from above.
double floor_area(const mobb::Box& box);

/// The part of a box's volume outside t0..t1 (seconds), 0 to 1, of a tree of that time scale. Along time the box is the
/// sum of its three edges: how much of it lies below a time is a piecewise polynomial of the third degree.
double overhang_in_time(const mobb::Box& box, double time_scale, double t0, double t1);

/// Columns by node. A value that a node does not have is NaN.
class NodeValues {
  public:
    /// `shares`: its part of all box tests by node; empty: not known.
    NodeValues(std::shared_ptr<const mobb::Tree> tree, std::span<const double> shares);

    /// Its part of all box tests by node, where the constructor did not know.
    void add_shares(std::span<const double> shares);
    /// What the queries of the scene found of the trees of `clip`, too.
    void add_tests(const SceneCosts& costs, int clip);
    void add_avoidable(const BlameInScene& blame, int clip);
    /// ... of which a column is not known any more.
    void forget(NodeField field);

    const mobb::Tree& tree() const { return *tree_; }
    int size() const { return static_cast<int>(tree_->nodes().size()); }
    /// Of ranges (samples, time) where they begin.
    std::span<const double> column(NodeField field) const { return columns_[static_cast<std::size_t>(field)]; }
    double value(NodeField field, int node) const { return column(field)[static_cast<std::size_t>(node)]; }
    /// Whether any node has it.
    bool has(NodeField field) const;
    /// ... of ranges to where they end.
    FieldRange range(NodeField field, int node) const;
    bool passes(const NodeFilter& filter, int node) const;

  private:
    std::vector<double>& of(NodeField field) { return columns_[static_cast<std::size_t>(field)]; }

    std::shared_ptr<const mobb::Tree> tree_;
    std::array<std::vector<double>, kNodeFieldCount> columns_;
};

}  // namespace mobbscope
