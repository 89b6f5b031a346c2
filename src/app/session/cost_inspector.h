/// What the queries of the scene cost, in all and by node.
#pragma once

#include <app/document/workspace.h>
#include <app/session/jobs.h>
#include <app/session/query_answers.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace mobbscope::app {

/// A list of no more queries needs no scrolling.
inline constexpr int kFewQueries = 9;

class CostInspector {
  public:
    CostInspector(Workspace& workspace, Jobs& jobs, QueryAnswers& answers)
        : workspace_(workspace), jobs_(jobs), answers_(answers) {}

    enum class Of { query, scene };
    Of branches_of = Of::query;  ///< whose branches are listed
    enum class Order { hits, number, tests };
    Order order = Order::hits;  ///< of the list of queries

    /// Null until they were counted.
    const SceneCosts* costs() const;
    /// Counts them, in the background where that takes long, and calls `then`; at once if they are known. While they
    /// are being counted it only takes `then`. They are counted anew if the scene asks something else by the end.
    void count(std::function<void()> then = {});
    /// Of the node that was asked for last; null: of none.
    const Sandwich* sandwich() const;
    void show_sandwich(TreeNode node);

    /// Whether those that hit are listed first: not of a few, which are seen all at once.
    bool lists_hits_first() const;
    /// The queries in the order of their list. Valid until that changes.
    const std::vector<int>& listed() const;

  private:
    void take(const std::shared_ptr<const FittedScene>& in, const std::shared_ptr<const SceneCosts>& found);

    Workspace& workspace_;
    Jobs& jobs_;
    QueryAnswers& answers_;
    std::function<void()> then_;  ///< of the count that is under way
    struct Listed {
        std::shared_ptr<const FittedScene> of;
        std::shared_ptr<const QueryAnswers::Known> hits_first;  ///< null: they stand in their order
        std::vector<int> queries;
    };
    mutable Listed listed_;  ///< sorting half a million takes longer than a frame
};

/// "walk 2.1": a node of a clip's tree.
std::string tree_node_name(const Workspace& workspace, TreeNode node);

}  // namespace mobbscope::app
