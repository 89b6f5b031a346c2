#include <app/session/cost_inspector.h>
#include <scene/fitted_scene.h>

#include <algorithm>
#include <numeric>
#include <string_view>
#include <utility>
#include <vector>

namespace mobbscope::app {

namespace {

// The jobs are known by their titles.
constexpr const char* kCountAll = "Counting the tests of all queries";
constexpr const char* kCountAround = "Counting the tests around a node";

bool is_under_way(const Workspace& workspace, std::string_view title) {
    return std::ranges::any_of(workspace.jobs,
                               [&](const RunningJob& running) { return running.job->title() == title; });
}

}  // namespace

const SceneCosts* CostInspector::costs() const { return workspace_.derived().costs.get(); }

void CostInspector::count(std::function<void()> then) {
    if (costs()) return then ? then() : void();
    if (is_under_way(workspace_, kCountAll)) {
        if (then) then_ = std::move(then);
        return;
    }
    then_ = std::move(then);
    jobs_.start(kCountAll, [this, in = workspace_.document().fitted](JobControl& control) -> Job::Finish {
        SceneCosts found = scene_costs(*in, progress_of(control));
        return [this, in, found = std::make_shared<const SceneCosts>(std::move(found))] { take(in, found); };
    });
}

void CostInspector::take(const std::shared_ptr<const FittedScene>& in, const std::shared_ptr<const SceneCosts>& found) {
    workspace_.keep_counted(in, found);
    const FittedScene& now = *workspace_.document().fitted;
    std::function<void()> then = std::exchange(then_, nullptr);
    if (ask_the_same(*in, now)) {
        if (then) then();
        return;
    }
    const bool wanted = then || order == Order::tests || branches_of == Of::scene;
    if (wanted && !now.queries().empty()) count(std::move(then));
}

const Sandwich* CostInspector::sandwich() const {
    const auto& known = workspace_.derived().sandwich;
    return known ? &*known : nullptr;
}

void CostInspector::show_sandwich(TreeNode node) {
    // Cancel the previous request: it could finish later.
    std::erase_if(workspace_.jobs, [](const RunningJob& running) { return running.job->title() == kCountAround; });
    if (sandwich() && sandwich()->of == node) return;
    jobs_.start(kCountAround, [this, in = workspace_.document().fitted, node](JobControl& control) -> Job::Finish {
        Sandwich found = sandwich_of(*in, node, progress_of(control));
        return [this, in, found = std::move(found)]() mutable {
            // Of other trees it would be another node.
            if (ask_the_same(*in, *workspace_.document().fitted)) workspace_.derived().sandwich = std::move(found);
        };
    });
}

bool CostInspector::lists_hits_first() const {
    return order == Order::hits && workspace_.fitted().queries().size() > std::size_t{kFewQueries};
}

const std::vector<int>& CostInspector::listed() const {
    if (order == Order::tests && costs()) return costs()->by_tests;
    const std::shared_ptr<const FittedScene> of = workspace_.shown();
    const std::shared_ptr<const QueryAnswers::Known> known = lists_hits_first() ? answers_.known() : nullptr;
    std::vector<int>& out = listed_.queries;
    if (listed_.of == of && listed_.hits_first == known) return out;
    listed_.of = of;
    listed_.hits_first = known;
    out.resize(of->queries().size());
    std::iota(out.begin(), out.end(), 0);
    const auto is_hit = [&](int query) { return std::ranges::binary_search(known->hits, query); };
    if (known) std::stable_partition(out.begin(), out.end(), is_hit);
    return out;
}

std::string tree_node_name(const Workspace& workspace, TreeNode node) {
    const mobb::Tree& tree = workspace.fitted().tree(node.clip);
    return workspace.fitted().scene().clips[static_cast<std::size_t>(node.clip)].name + ' ' +
           std::to_string(tree.level(node.node)) + '.' + std::to_string(tree.place_in_level(node.node));
}

}  // namespace mobbscope::app
