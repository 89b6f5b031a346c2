#include <explain/expected_cost.h>
#include <explain/tree_cost.h>

#include <array>
#include <span>
#include <utility>

namespace mobbscope {

namespace {

MeanTests a_query(const mobb::TestCounts& counts, std::size_t queries) {
    MeanTests out;
    for (const mobb::TestKind kind : mobb::kTestKinds)
        out[kind] = static_cast<double>(counts[kind]) / static_cast<double>(queries);
    return out;
}

}  // namespace

TreeCost standard_cost(const std::shared_ptr<const mobb::Tree>& tree, const Progress& progress) {
    TreeCost out{.tree = tree};
    if (std::optional<ExpectedCost> expected = expected_cost(*tree, *tree)) {
        out.area = expected->placements.area();
        out.offset = expected->placements.offset;
        out.tests = expected->tests;
        out.bound = expected->bound;
        out.shares = expected->node_shares();
        out.levels = std::move(expected->levels);
        return out;
    }
    const std::array clips{tree->shared_clip()};
    const QueryWorkload workload = standard_workload(clips, kCountedPlacements, kCountedSeed);
    out.area = workload.area;
    out.offset = workload.offset;
    out.queries = workload.queries.size();
    out.tests = mean_tests(count_tests(workload, std::span(&tree, 1), 0, progress));
    return out;
}

TreeCost cost_in_scene(const SceneCosts& costs, int clip, const std::shared_ptr<const mobb::Tree>& tree) {
    TreeCost out{.tree = tree, .workload = QueryWorkload::Kind::queries, .queries = costs.tests.size()};
    out.tests = a_query(costs.kinds, out.queries);
    mobb::TestCounts in_levels;
    for (const mobb::TestCounts& level : costs.levels) {
        out.levels.push_back(a_query(level, out.queries));
        for (const mobb::TestKind kind : mobb::kTestKinds) in_levels[kind] += level[kind];
    }
    out.shares.resize(tree->nodes().size());
    if (in_levels.boxes() == 0) return out;
    for (const NodeCost& cost : costs.nodes) {
        if (cost.at.clip == clip)
            out.shares[static_cast<std::size_t>(cost.at.node)] =
                static_cast<double>(cost.boxes) / (2 * static_cast<double>(in_levels.boxes()));
    }
    return out;
}

double TreeCost::part(const MeanTests& some) const {
    const double all = ns(tests);
    return all > 0 ? ns(some) / all : 0;
}

}  // namespace mobbscope
