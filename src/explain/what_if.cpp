#include <base/text.h>
#include <explain/what_if.h>
#include <mobb/box.h>
#include <mobb/fit.h>
#include <mobb/separation.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>

namespace mobbscope {

namespace {

/// The kind that the options give a node; its box may have become another.
mobb::BoxKind kind_of(const mobb::Tree& tree, int node) {
    const mobb::TreeInfo& kinds = mobb::info(tree.options().tree);
    return node == 0 ? kinds.root : kinds.below;
}

bool have_test(mobb::BoxKind a, mobb::BoxKind b) {
    return std::ranges::any_of(mobb::kPairTests,
                               [&](const mobb::PairTest& test) { return test.a == a && test.b == b; });
}

/// How many samples of a node the first child gets for both children's boxes to have the least volume.
int tightest_split(const mobb::Tree& tree, int index) {
    const mobb::Node& node = tree.node(index);
    const mobb::FitOptions& options = tree.options();
    const auto volume_of = [&](int first, int count) {
        const mobb::Box box =
            mobb::fit(mobb::info(options.tree).below, tree.clip(), {first, count}, options.axes, options.time_scale);
        return mobb::volume(box, options.time_scale);
    };
    const int places = std::min(kSplitPlaces, node.count - 1);
    int best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (int i = 1; i <= places; ++i) {
        const auto count = static_cast<int>(std::int64_t{node.count} * i / (places + 1));
        const double volume = volume_of(node.first, count) + volume_of(node.first + count, node.count - count);
        if (volume >= least) continue;
        least = volume;
        best = count;
    }
    return best;
}

void add_splits(std::vector<mobb::NodeChange>& out, const mobb::Tree& tree, int index) {
    const int count = tree.node(index).count;
    std::vector<int> splits;
    const int present = tree.is_leaf(index) ? 0 : tree.node(tree.children(index)[0]).count;
    if (present > 0) {
        splits = {count / 4, count - count / 4, tightest_split(tree, index)};
    } else if (tree.level(index) + 1 != tree.options().levels) {
        splits = {(count + 1) / 2};
    }
    std::erase_if(splits, [&](int split) { return split == present || split == 0 || split == count; });
    std::ranges::sort(splits);
    splits.erase(std::unique(splits.begin(), splits.end()), splits.end());
    const std::array<int, 2> children = tree.children(index);
    if (present > 0 && tree.is_leaf(children[0]) && tree.is_leaf(children[1])) splits.push_back(0);
    for (const int split : splits) out.push_back({.node = index, .split = split});
}

NodeVariant variant_of(const std::shared_ptr<const mobb::Tree>& tree, const mobb::NodeChange& change) {
    NodeVariant out{.change = change, .tree = tree};
    const auto volume_of = [&](int node) { return mobb::volume(tree->box(node), tree->time_scale()); };
    out.volume = volume_of(change.node);
    if (tree->is_leaf(change.node)) return out;
    for (const int child : tree->children(change.node)) out.children += volume_of(child);
    return out;
}

}  // namespace

std::vector<mobb::NodeChange> node_changes(const mobb::Tree& tree, int node) {
    std::vector<mobb::NodeChange> out;
    if (tree.blocks()) return out;
    const mobb::BoxKind kind = kind_of(tree, node), below = mobb::info(tree.options().tree).below;
    const mobb::BoxAxes directions = mobb::info(kind).axes;
    if (directions == mobb::BoxAxes::floor || directions == mobb::BoxAxes::space_time) {
        for (const mobb::Axes axes : {mobb::Axes::endpoints, mobb::Axes::covariance, mobb::Axes::minarea}) {
            if (axes != tree.options().axes) out.push_back({.node = node, .axes = axes});
        }
    }
    for (const mobb::BoxKind other : mobb::kBoxKinds) {
        if (other != kind && have_test(other, below)) out.push_back({.node = node, .kind = other});
    }
    add_splits(out, tree, node);
    return out;
}

std::string change_words(const mobb::Tree& tree, const mobb::NodeChange& change) {
    if (change.axes) return "axes " + std::string(mobb::name(*change.axes));
    if (change.kind) return std::string(mobb::info(*change.kind).title);
    if (!change.split) return "as it is";
    if (*change.split == 0) return "a leaf";
    return "split " + std::to_string(*change.split) + " + " +
           std::to_string(tree.node(change.node).count - *change.split);
}

const NodeVariant& WhatIf::best() const {
    const NodeVariant& least =
        *std::ranges::min_element(variants, {}, [](const NodeVariant& variant) { return variant.cost; });
    return least.difference.mean < -3 * least.difference.standard_error ? least : variants.front();
}

std::string change_in_per_cent(const WhatIf& found, const NodeVariant& variant, std::string_view between) {
    const double whole = found.variants.front().cost;
    std::string out = formatted("%+.2f", 100 * variant.difference.mean / whole);
    out += between;
    return out + formatted("%.2f", 100 * variant.difference.standard_error / whole);
}

WhatIf what_if(const QueryWorkload& workload, std::span<const std::shared_ptr<const mobb::Tree>> trees, int clip,
               int node, const Progress& progress) {
    std::vector<std::shared_ptr<const mobb::Tree>> asked(trees.begin(), trees.end());
    auto& changed = asked[static_cast<std::size_t>(clip)];
    const std::shared_ptr<const mobb::Tree> present = changed;
    if (present->blocks()) throw std::invalid_argument("all blocks are built alike: no node of them can be other");
    if (node < 0 || static_cast<std::size_t>(node) >= present->nodes().size()) {
        throw std::invalid_argument("there is no node " + std::to_string(node) + ": give 0 to " +
                                    std::to_string(present->nodes().size() - 1));
    }
    std::vector<mobb::NodeChange> changes = node_changes(*present, node);
    changes.insert(changes.begin(), {.node = node});
    WhatIf out{.node = node, .queries = workload.queries.size(), .variants = {}};
    std::vector<double> costs;  // of the node as it is
    std::size_t done = 0;
    for (const mobb::NodeChange& change : changes) {
        if (done > 0) changed = std::make_shared<const mobb::Tree>(present->shared_clip(), present->options(), change);
        const auto tell = [&](std::size_t counted, std::size_t) {
            progress(done + counted, changes.size() * out.queries);
        };
        const std::vector<mobb::TestCounts> counts =
            count_tests(workload, asked, 0, progress ? Progress(tell) : Progress());
        done += out.queries;
        NodeVariant variant = variant_of(changed, change);
        variant.tests = mean_tests(counts);
        variant.cost = cost_of(variant.tests);
        std::vector<double> differences;
        differences.reserve(counts.size());
        for (std::size_t i = 0; i < counts.size(); ++i) {
            const double cost = cost_of(counts[i]);
            if (out.variants.empty()) costs.push_back(cost);
            differences.push_back(cost - costs[i]);
        }
        variant.difference = spread_of(differences);
        out.variants.push_back(std::move(variant));
    }
    return out;
}

}  // namespace mobbscope
