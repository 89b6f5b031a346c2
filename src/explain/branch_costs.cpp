#include <explain/branch_costs.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace mobbscope {

namespace {

/// Of the events first .. end - 1.
std::int64_t tests_of(const Recursion& recursion, int first, int end) {
    const auto all = [&](int count) {
        return count == 0 ? 0 : recursion.so_far[static_cast<std::size_t>(count) - 1].all();
    };
    return all(end) - all(first);
}

/// Calls `use` with each query of the scene, its recursion and the clips of its sides.
template <class Use>
void for_each_recursion(const FittedScene& fitted, const CostProgress& told, const Use& use) {
    const std::size_t count = fitted.queries().size();
    for (std::size_t i = 0; i < count; ++i) {
        const SceneQuery query = fitted.queries()[i];
        const RecordedQuery recorded = record(fitted, query);
        use(i, recursion_of(recorded.trace, fitted.placed(query.a), fitted.placed(query.b), 0),
            std::array{query.a.clip, query.b.clip});
        if (told) told(i + 1, count);
    }
}

std::array<int, 2> nodes_of(const RecursionPair& pair) { return {pair.a, pair.b}; }

/// Whether none of the pairs that led to this one is of the same node of that side.
bool is_outermost(const Recursion& recursion, const RecursionPair& pair, std::size_t side) {
    return pair.parent < 0 ||
           nodes_of(recursion.pairs[static_cast<std::size_t>(pair.parent)])[side] != nodes_of(pair)[side];
}

/// Sums in order of what they come to.
template <class Key, class Value, class Of>
std::vector<Value> by_cost(const std::map<Key, Value>& sums, const Of& cost) {
    std::vector<Value> out;
    out.reserve(sums.size());
    for (const auto& [key, value] : sums) out.push_back(value);
    std::ranges::stable_sort(out, std::greater<>(), cost);
    return out;
}

}  // namespace

std::vector<BranchCost> costliest_branches(const Recursion& recursion, const FocusWindow& focus, const InFocus& inside,
                                           std::size_t most) {
    std::vector<int> before(inside.size() + 1);  // events in the focus, of those before each
    for (std::size_t i = 0; i < inside.size(); ++i) before[i + 1] = before[i] + inside[i];
    std::vector<BranchCost> out;
    for (int i = 0; i < static_cast<int>(recursion.pairs.size()); ++i) {
        const RecursionPair& pair = recursion.pairs[static_cast<std::size_t>(i)];
        const bool in_focus = inside.empty() || inside[static_cast<std::size_t>(pair.last)] != 0;
        if (!pair.has_children() || !in_focus || i == focus.branch.value_or(0)) continue;
        const int events = inside.empty() ? pair.end - pair.last - 1
                                          : before[static_cast<std::size_t>(pair.end)] -
                                                before[static_cast<std::size_t>(pair.last) + 1];
        if (events > 0) out.push_back({i, events});
    }
    const auto count = std::min(most, out.size());
    const auto costlier = [](const BranchCost& a, const BranchCost& b) {
        return a.events != b.events ? a.events > b.events : a.pair < b.pair;
    };
    std::partial_sort(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(count), out.end(), costlier);
    out.resize(count);
    return out;
}

SceneCosts scene_costs(const FittedScene& fitted, const CostProgress& told) {
    SceneCosts out;
    std::map<TreeNode, NodeCost> nodes;
    for_each_recursion(fitted, told, [&](std::size_t, const Recursion& recursion, const std::array<int, 2>& clips) {
        out.tests.push_back(recursion.total().all());
        for (const RecursionPair& pair : recursion.pairs) {
            const std::int64_t own = tests_of(recursion, pair.first, pair.last + 1);
            const std::int64_t all = tests_of(recursion, pair.first, pair.end);
            for (std::size_t side = 0; side < 2; ++side) {
                const TreeNode at{clips[side], nodes_of(pair)[side]};
                NodeCost& cost = nodes.try_emplace(at, NodeCost{at}).first->second;
                cost.own += own;
                cost.below -= own;
                if (is_outermost(recursion, pair, side)) cost.below += all;
            }
        }
    });
    out.nodes = by_cost(nodes, [](const NodeCost& cost) { return cost.own + cost.below; });
    out.by_tests.resize(out.tests.size());
    std::iota(out.by_tests.begin(), out.by_tests.end(), 0);
    std::ranges::stable_sort(out.by_tests, std::greater<>(),
                             [&](int query) { return out.tests[static_cast<std::size_t>(query)]; });
    return out;
}

std::int64_t tests_at(const SceneCosts& costs, double share) {
    const auto last = static_cast<double>(costs.by_tests.size() - 1);
    const auto from_most = static_cast<std::size_t>(std::lround((1 - share) * last));
    return costs.tests[static_cast<std::size_t>(costs.by_tests[from_most])];
}

Sandwich sandwich_of(const FittedScene& fitted, TreeNode node, const CostProgress& told) {
    using Nodes = std::array<TreeNode, 2>;
    std::map<Nodes, Sandwich::Neighbour> above, below;
    for_each_recursion(fitted, told, [&](std::size_t, const Recursion& recursion, const std::array<int, 2>& clips) {
        const auto tree_nodes = [&](const RecursionPair& pair) {
            return Nodes{TreeNode{clips[0], pair.a}, TreeNode{clips[1], pair.b}};
        };
        const auto is_of = [&](const RecursionPair& pair) {
            const Nodes nodes = tree_nodes(pair);
            return nodes[0] == node || nodes[1] == node;
        };
        const auto add = [&](std::map<Nodes, Sandwich::Neighbour>& to, const RecursionPair& neighbour,
                             const RecursionPair& pays) {
            const Nodes nodes = tree_nodes(neighbour);
            to.try_emplace(nodes, Sandwich::Neighbour{nodes, 0}).first->second.tests +=
                tests_of(recursion, pays.first, pays.end);
        };
        for (const RecursionPair& pair : recursion.pairs) {
            if (pair.parent < 0) continue;
            const RecursionPair& parent = recursion.pairs[static_cast<std::size_t>(pair.parent)];
            const bool enters = is_of(pair) && !is_of(parent);
            const bool leaves = is_of(parent) && !is_of(pair);
            if (enters) add(above, parent, pair);
            if (leaves) add(below, pair, pair);
        }
    });
    const auto cost = [](const Sandwich::Neighbour& neighbour) { return neighbour.tests; };
    return {node, by_cost(above, cost), by_cost(below, cost)};
}

}  // namespace mobbscope
