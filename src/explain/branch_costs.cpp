#include <explain/branch_costs.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace mobbscope {

namespace {

/// Of A and of B.
using TreeNodes = std::array<TreeNode, 2>;

bool has(const TreeNodes& nodes, TreeNode node) { return nodes[0] == node || nodes[1] == node; }

/// A query of the scene, asked again.
struct AskedAgain {
    RecordedQuery recorded;
    Recursion recursion;
    std::array<int, 2> clips;               // of A and of B
    std::vector<std::int64_t> made_before;  // tests, by event; behind the last: all

    std::int64_t tests_of(int first, int end) const {
        return made_before[static_cast<std::size_t>(end)] - made_before[static_cast<std::size_t>(first)];
    }
    /// The pair's own.
    mobb::TestCounts counts_of(const RecursionPair& pair) const {
        mobb::TestCounts out;
        for (int i = pair.first; i <= pair.last; ++i) {
            const mobb::TestKind test = recorded.trace[i].test;
            out[test] += test == mobb::TestKind::samples ? tests_of(i, i + 1) : 1;
        }
        return out;
    }
    TreeNodes nodes_of(const RecursionPair& pair) const {
        return {TreeNode{clips[0], pair.a}, TreeNode{clips[1], pair.b}};
    }
    /// Whether one of the pairs that led to this one is of the node.
    bool is_below(const RecursionPair& pair, TreeNode node) const {
        for (int up = pair.parent; up >= 0; up = recursion.pairs[static_cast<std::size_t>(up)].parent) {
            if (has(nodes_of(recursion.pairs[static_cast<std::size_t>(up)]), node)) return true;
        }
        return false;
    }
};

std::vector<std::int64_t> tests_made_before(const mobb::Trace& trace) {
    std::vector<std::int64_t> out(static_cast<std::size_t>(trace.size()) + 1);
    for (int i = 0; i < trace.size(); ++i) {
        const mobb::Trace::Event event = trace[i];
        const bool samples = event.test == mobb::TestKind::samples;
        out[static_cast<std::size_t>(i) + 1] =
            out[static_cast<std::size_t>(i)] + (samples ? static_cast<std::int64_t>(event.pairs.size()) : 1);
    }
    return out;
}

/// Calls `use` with each query of the scene.
template <class Use>
void for_each_query(const FittedScene& fitted, const CostProgress& told, const mobb::TraceBound& bound,
                    const Use& use) {
    refuse_bodies(fitted.scene(), "the cost of all queries");
    const std::size_t count = fitted.queries().size();
    for (std::size_t i = 0; i < count; ++i) {
        const SceneQuery query = fitted.queries()[i];
        AskedAgain asked{record(fitted, query, Search::trees, bound), {}, {query.a.clip, query.b.clip}, {}};
        asked.recursion = recursion_of(asked.recorded.trace, fitted.placed(query.a), fitted.placed(query.b), 0);
        asked.made_before = tests_made_before(asked.recorded.trace);
        use(asked);
        if (told) told(i + 1, count);
    }
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

SceneCosts scene_costs(const FittedScene& fitted, const CostProgress& told, const mobb::TraceBound& bound) {
    SceneCosts out;
    std::map<TreeNode, NodeCost> nodes;
    for_each_query(fitted, told, bound, [&](const AskedAgain& asked) {
        out.tests.push_back(asked.recorded.tests.all());
        out.in_part += asked.recorded.trace.stopped() ? 1 : 0;
        for (const mobb::TestKind kind : mobb::kTestKinds) out.kinds[kind] += asked.recorded.tests[kind];
        for (const RecursionPair& pair : asked.recursion.pairs) {
            const std::int64_t own = asked.tests_of(pair.first, pair.last + 1);
            const std::int64_t all = asked.tests_of(pair.first, pair.end);
            const auto add = [&](TreeNode at) {
                NodeCost& cost = nodes.try_emplace(at, NodeCost{at}).first->second;
                cost.own += own;
                cost.below -= own;
                if (!asked.is_below(pair, at)) cost.below += all;
            };
            const TreeNodes of = asked.nodes_of(pair);
            add(of[0]);
            if (of[1] != of[0]) add(of[1]);
            const mobb::TestCounts tests = asked.counts_of(pair);
            for (const TreeNode side : of) nodes.at(side).boxes += tests.boxes();
            const auto level = [&](TreeNode at) {
                return static_cast<std::size_t>(fitted.tree(at.clip).level(at.node));
            };
            const std::size_t upper = std::min(level(of[0]), level(of[1]));
            if (out.levels.size() <= upper) out.levels.resize(upper + 1);
            for (const mobb::TestKind kind : mobb::kTestKinds) out.levels[upper][kind] += tests[kind];
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
    std::map<TreeNodes, Sandwich::Neighbour> above, below;
    for_each_query(fitted, told, {}, [&](const AskedAgain& asked) {
        const std::vector<RecursionPair>& pairs = asked.recursion.pairs;
        const auto is_of = [&](const RecursionPair& pair) { return has(asked.nodes_of(pair), node); };
        const auto add = [&](std::map<TreeNodes, Sandwich::Neighbour>& to, const RecursionPair& neighbour,
                             const RecursionPair& pays) {
            const TreeNodes nodes = asked.nodes_of(neighbour);
            to.try_emplace(nodes, Sandwich::Neighbour{nodes, 0}).first->second.tests +=
                asked.tests_of(pays.first, pays.end);
        };
        for (const RecursionPair& pair : pairs) {
            if (pair.parent < 0) continue;
            const RecursionPair& parent = pairs[static_cast<std::size_t>(pair.parent)];
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
