/// What branches of queries cost: of one query by pair, of all queries of a scene by node.
#pragma once

#include <explain/focus_window.h>
#include <explain/recursion.h>
#include <mobb/trace.h>
#include <scene/fitted_scene.h>

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace mobbscope {

struct BranchCost {
    int pair = 0;    ///< index into Recursion::pairs
    int events = 0;  ///< below it, and in the focus
};
/// The pairs of a query with most events below them, the costliest first; those of the focus, without what it is of:
/// the root or the focused branch.
std::vector<BranchCost> costliest_branches(const Recursion& recursion, const FocusWindow& focus, const InFocus& inside,
                                           std::size_t most);

/// A node of a clip's tree.
struct TreeNode {
    int clip = 0, node = 0;
    friend auto operator<=>(const TreeNode&, const TreeNode&) = default;
};

/// What the tests of a node cost, over all queries of a scene, in tests as counters have them (of samples: pairs). Each
/// test counts once, also where both sides play the clip.
struct NodeCost {
    TreeNode at;
    std::int64_t own = 0;    ///< of the node itself
    std::int64_t below = 0;  ///< of pairs below one that the node is in, without its own
    std::int64_t boxes = 0;  ///< tests of its box, once for either side: those of all nodes are twice all box tests
};

struct SceneCosts {
    std::vector<std::int64_t> tests;  ///< by query
    std::vector<NodeCost> nodes;      ///< that were tested; the costliest first, by own and below
    std::vector<int> by_tests;        ///< queries, the costliest first
    mobb::TestCounts kinds;           ///< of all queries
    /// Of all queries, by the level of the pair's nodes: the upper one's, where a leaf meets those below another node.
    std::vector<mobb::TestCounts> levels;
    int in_part = 0;  ///< queries whose recording stopped: nodes have what was recorded of them
};

using CostProgress = std::function<void(std::size_t done, std::size_t all)>;
/// Asks every query of the scene again. `told` is called after each.
SceneCosts scene_costs(const FittedScene& fitted, const CostProgress& told = {}, const mobb::TraceBound& bound = {});

/// The tests of the query that stands at a share (0..1) of all, in order: 0.5 is the median. Requires queries.
std::int64_t tests_at(const SceneCosts& costs, double share);

/// A node between the pairs that called pairs with it, and those that they called, over all queries of a scene.
struct Sandwich {
    struct Neighbour {
        std::array<TreeNode, 2> nodes;  ///< of A and of B
        std::int64_t tests = 0;  ///< in the pairs with the node, and below them, that it called; or its own and below
    };
    TreeNode of;
    std::vector<Neighbour> above, below;  ///< the costliest first
};
Sandwich sandwich_of(const FittedScene& fitted, TreeNode node, const CostProgress& told = {});

}  // namespace mobbscope
