#include <app/session/cost_inspector.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace mobbscope::app {

const SceneCosts* CostInspector::costs() const {
    const auto& known = workspace_.derived().costs;
    return known ? &*known : nullptr;
}

void CostInspector::count(std::function<void()> then) {
    if (costs()) return then ? then() : void();
    jobs_.start("Counting the tests of all queries",
                [this, in = workspace_.document().fitted, then = std::move(then)](JobControl& control) -> Job::Finish {
                    SceneCosts found = scene_costs(*in, progress_of(control));
                    return [this, in, then, found = std::move(found)]() mutable {
                        if (in != workspace_.document().fitted) return;
                        workspace_.derived().costs = std::move(found);
                        if (then) then();
                    };
                });
}

const Sandwich* CostInspector::sandwich() const {
    const auto& known = workspace_.derived().sandwich;
    return known ? &*known : nullptr;
}

void CostInspector::show_sandwich(TreeNode node) {
    jobs_.start("Counting the tests around a node",
                [this, in = workspace_.document().fitted, node](JobControl& control) -> Job::Finish {
                    Sandwich found = sandwich_of(*in, node, progress_of(control));
                    return [this, in, found = std::move(found)]() mutable {
                        if (in == workspace_.document().fitted) workspace_.derived().sandwich = std::move(found);
                    };
                });
}

bool CostInspector::lists_hits_first() const {
    return order == Order::hits && workspace_.fitted().queries().size() > std::size_t{kFewQueries};
}

std::vector<int> CostInspector::listed() const {
    if (order == Order::tests && costs()) return costs()->by_tests;
    std::vector<int> out(workspace_.fitted().queries().size());
    std::iota(out.begin(), out.end(), 0);
    if (!lists_hits_first()) return out;
    const QueryAnswers::Known known = answers_.known();
    const auto is_hit = [&](int query) { return std::ranges::binary_search(known.hits, query); };
    std::ranges::stable_partition(out, is_hit);
    return out;
}

std::string tree_node_name(const Workspace& workspace, TreeNode node) {
    const mobb::Tree& tree = workspace.fitted().tree(node.clip);
    return workspace.fitted().scene().clips[static_cast<std::size_t>(node.clip)].name + ' ' +
           std::to_string(tree.level(node.node)) + '.' + std::to_string(tree.place_in_level(node.node));
}

}  // namespace mobbscope::app
