#include <explain/expected_cost.h>
#include <explain/scene_figures.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

namespace mobbscope {

namespace {

constexpr std::size_t kMostCounted = 4;  // scenes: as many as there are views side by side

}  // namespace

SceneFigures::Counted* SceneFigures::counted_in(const std::shared_ptr<const FittedScene>& fitted) {
    auto at = std::ranges::find(counted_, fitted, &Counted::in);
    if (at == counted_.end())
        at = std::ranges::find_if(counted_, [&](const Counted& each) { return ask_the_same(*each.in, *fitted); });
    return at == counted_.end() ? nullptr : &*at;
}

void SceneFigures::take(const std::shared_ptr<const FittedScene>& fitted, std::shared_ptr<const SceneCosts> costs,
                        std::shared_ptr<const BlameInScene> blame) {
    Counted* same = counted_in(fitted);
    if (same ? same->costs == costs && same->blame == blame : !costs && !blame) return;
    if (same) counted_.erase(counted_.begin() + (same - counted_.data()));
    if (counted_.size() == kMostCounted) counted_.pop_back();
    counted_.insert(counted_.begin(), {fitted, std::move(costs), std::move(blame)});
    ++revision_;
}

/// Counts them first, unless that is done elsewhere.
SceneFigures::Counted SceneFigures::known(const std::shared_ptr<const FittedScene>& fitted, NodeField field) {
    const Counted* found = counted_in(fitted);
    Counted out = found ? *found : Counted{fitted, nullptr, nullptr};
    if (counting_ == Counting::elsewhere || fitted->queries().empty()) return out;
    if (field == NodeField::tests && !out.costs) out.costs = std::make_shared<const SceneCosts>(scene_costs(*fitted));
    if (field == NodeField::avoidable && !out.blame)
        out.blame = std::make_shared<const BlameInScene>(blame_in(*fitted));
    take(fitted, out.costs, out.blame);
    return out;
}

bool SceneFigures::is_counted(const std::shared_ptr<const FittedScene>& fitted, NodeField field) {
    const Counted counted = known(fitted, field);
    return field == NodeField::tests ? counted.costs != nullptr
                                     : field == NodeField::avoidable && counted.blame != nullptr;
}

SceneFigures::Kept& SceneFigures::kept(const std::shared_ptr<const mobb::Tree>& tree, int clip) {
    const auto of_tree = kept_.find(tree);
    if (of_tree != kept_.end()) {
        if (const auto at = of_tree->second.find(clip); at != of_tree->second.end()) return at->second;
    } else {
        // Nobody else has them: one reference is the key's, and one that of the values of each clip.
        std::erase_if(kept_, [](const auto& each) {
            return each.first.use_count() == 1 + static_cast<long>(each.second.size());
        });
    }
    return kept_[tree].emplace(clip, Kept{.values = NodeValues(tree, {})}).first->second;
}

const NodeValues& SceneFigures::of(const std::shared_ptr<const FittedScene>& fitted, int clip, NodeField field) {
    const std::shared_ptr<const mobb::Tree>& tree = fitted->shared_tree(clip);
    Kept& out = kept(tree, clip);
    if (field == NodeField::share && !out.has_shares) {
        out.values.add_shares(expected_shares(*tree));
        out.has_shares = true;
    }
    if (field == NodeField::tests) {
        if (const auto costs = known(fitted, field).costs; costs != out.costs) {
            costs ? out.values.add_tests(*costs, clip) : out.values.forget(field);
            out.costs = costs;
        }
    }
    if (field == NodeField::avoidable) {
        if (const auto blame = known(fitted, field).blame; blame != out.blame) {
            blame ? out.values.add_avoidable(*blame, clip) : out.values.forget(field);
            out.blame = blame;
        }
    }
    return out.values;
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
