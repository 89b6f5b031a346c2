/// The nodes of the tree in focus as a table: filtered, sorted, and stepped through in that order.
#pragma once

#include <app/document/node_figures.h>
#include <app/document/workspace.h>
#include <explain/node_table.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope::app {

class NodeInspector {
  public:
    NodeInspector(Workspace& workspace, NodeFigures& figures) : workspace_(workspace), figures_(figures) {}

    std::optional<NodeFilter> filter;  ///< none: all
    NodeField by = NodeField::waste;
    bool descending = true;  ///< the worst first

    /// By another column, the worst first; by the same one the other way round.
    void sort_by(NodeField field);

    // These require clips, and are of the clip in focus.

    /// What is known now: of tests and avoidable overlaps, what has been counted.
    std::shared_ptr<const NodeValues> values() const;
    /// The columns that some node has a value in, and those of what can be counted.
    std::vector<NodeField> columns() const;
    /// Whether the queries of the scene have not been counted yet.
    bool can_count() const;
    /// The rows.
    std::shared_ptr<const std::vector<int>> listed() const;
    /// How many nodes pass.
    int hits(const NodeFilter& of) const;

    /// The selected node, if it is of that clip's tree; -1: none is. Likewise the one that is pointed at.
    int selected() const { return node_of(workspace_.selection); }
    int hovered() const { return node_of(workspace_.hovered); }
    /// A node as the selection; none: nobody in the picture plays the clip.
    std::optional<Selection> selection_of(int node) const;
    /// The node `by_rows` further on, where none is selected from the begin or the end; none: it ends there.
    std::optional<int> beside(int by_rows) const;

  private:
    int node_of(const Selection& selection) const;

    struct Kept {
        std::shared_ptr<const mobb::Tree> tree;
        std::int64_t counted = -1;  ///< SceneFigures::revision
        friend bool operator==(const Kept&, const Kept&) = default;
    };
    struct Order {
        std::shared_ptr<const NodeValues> of;
        std::string filter;
        NodeField by = NodeField::waste;
        bool descending = false;
        friend bool operator==(const Order&, const Order&) = default;
    };

    Workspace& workspace_;
    NodeFigures& figures_;
    // What was asked for last.
    mutable Kept kept_;
    mutable std::shared_ptr<const NodeValues> values_;  ///< of what is kept
    mutable Order order_;
    mutable std::shared_ptr<const std::vector<int>> listed_;                     ///< in that order
    mutable std::pair<std::shared_ptr<const NodeValues>, std::string> hits_of_;  ///< with the filter's text
    mutable int hits_ = 0;
};

}  // namespace mobbscope::app
