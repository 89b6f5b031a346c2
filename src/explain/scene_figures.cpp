#include <explain/expected_cost.h>
#include <explain/scene_figures.h>

#include <algorithm>
#include <cstddef>
#include <optional>

namespace mobbscope {

namespace {

constexpr std::size_t kMostFits = 4;  // whose figures are kept: those of views side by side

}  // namespace

void SceneFigures::take(const std::shared_ptr<const FittedScene>& fitted, const SceneCosts* costs,
                        std::shared_ptr<const BlameInScene> blame) {
    const bool same = counted_in_ && (counted_in_ == fitted || ask_the_same(*counted_in_, *fitted));
    counted_in_ = fitted;
    if (same && (costs != nullptr) == (costs_ != nullptr) && blame == blame_) return;
    if (!same || !costs || !costs_) costs_ = costs ? std::make_shared<const SceneCosts>(*costs) : nullptr;
    blame_ = std::move(blame);
    ++revision_;
}

void SceneFigures::know(const std::shared_ptr<const FittedScene>& fitted, NodeField field) {
    if (counting_ == Counting::elsewhere || fitted->queries().empty()) return;
    if (counted_in_ != fitted) take(fitted, nullptr, nullptr);
    if (field == NodeField::tests && !costs_) {
        const SceneCosts costs = scene_costs(*fitted);
        take(fitted, &costs, blame_);
    }
    if (field == NodeField::avoidable && !blame_)
        take(fitted, costs_.get(), std::make_shared<const BlameInScene>(blame_in(*fitted)));
}

bool SceneFigures::is_counted(const std::shared_ptr<const FittedScene>& fitted, NodeField field) {
    know(fitted, field);
    if (counted_in_ != fitted) return false;
    return field == NodeField::tests ? costs_ != nullptr : field == NodeField::avoidable && blame_ != nullptr;
}

const NodeValues& SceneFigures::of(const std::shared_ptr<const FittedScene>& fitted, int clip, NodeField field) {
    const std::shared_ptr<const mobb::Tree>& tree = fitted->shared_tree(clip);
    if (kept_.size() > kMostFits * fitted->scene().clips.size())
        std::erase_if(kept_, [](const auto& each) { return each.first.first.use_count() == 1; });
    const std::pair key(tree, clip);
    auto at = kept_.find(key);
    if (at == kept_.end()) at = kept_.emplace(key, Kept{.values = NodeValues(tree, {})}).first;
    Kept& kept = at->second;
    if (field == NodeField::share && !kept.has_shares) {
        if (const auto expected = expected_cost(*tree, *tree)) kept.values.add_shares(expected->node_shares());
        kept.has_shares = true;
    }
    const bool counts = is_counted(fitted, field);
    if (field == NodeField::tests && kept.tests_of != revision_) {
        counts ? kept.values.add_tests(*costs_, clip) : kept.values.forget(field);
        kept.tests_of = revision_;
    }
    if (field == NodeField::avoidable && kept.avoidable_of != revision_) {
        counts ? kept.values.add_avoidable(*blame_, clip) : kept.values.forget(field);
        kept.avoidable_of = revision_;
    }
    return kept.values;
}

NodeField SceneFigures::heat_of(const std::shared_ptr<const FittedScene>& fitted) {
    return is_counted(fitted, NodeField::tests) ? NodeField::tests : NodeField::share;
}

std::vector<double> SceneFigures::heat(const std::shared_ptr<const FittedScene>& fitted, int clip) {
    const NodeField field = heat_of(fitted);
    const NodeValues& values = of(fitted, clip, field);
    const mobb::Tree& tree = values.tree();
    std::vector<double> out(static_cast<std::size_t>(tree.clip().count()));
    // Of a node with those above it, which come before it.
    std::vector<double> sums(tree.nodes().size());
    for (int i = 0; i < values.size(); ++i) {
        const int parent = tree.parent(i);
        double& sum = sums[static_cast<std::size_t>(i)];
        sum = values.value(field, i) + (parent < 0 ? 0 : sums[static_cast<std::size_t>(parent)]);
        if (!tree.is_leaf(i)) continue;
        const mobb::Node& leaf = tree.node(i);
        std::fill_n(out.begin() + leaf.first, leaf.count, sum);
    }
    return out;
}

}  // namespace mobbscope
