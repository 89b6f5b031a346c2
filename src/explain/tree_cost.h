/// What a query of a tree costs, under the workload that is chosen: tests that were counted, times their prices.
#pragma once

#include <explain/branch_costs.h>
#include <explain/expected_cost.h>
#include <explain/query_workload.h>
#include <mobb/tree.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

namespace mobbscope {

/// Standard placements are counted until the means of box tests and of sample pairs have standard errors below this
/// part of them, this many at first, ...
inline constexpr double kCountedError = 0.005;
inline constexpr std::size_t kFirstCounted = 4096;
inline constexpr std::uint64_t kCountedSeed = 0;
/// ... and at most this many of each clip of a scene: where disks hardly ever meet, pairs of samples are rare. Of a
/// scene with more clips fewer, so that all of them take seconds.
constexpr std::size_t most_counted(std::size_t clips) {
    constexpr std::size_t kOfAll = std::size_t{1} << 24;
    return std::clamp(kOfAll / std::max<std::size_t>(clips, 1), std::size_t{1} << 17, std::size_t{1} << 22);
}

/// Tests of the first standard placements of a tree against itself.
struct PlacementCount {
    std::size_t placements = 0;
    MeanTests sums{};  ///< of all of them
    // Sums of the squares of what each of them makes.
    double box_squares = 0, pair_squares = 0;

    void add(const mobb::TestCounts& tests, std::size_t times = 1);
    void add(const PlacementCount& others);
    /// Of the mean of box tests or of sample pairs, whichever has the larger one, as a part of that mean. The cost has
    /// none that is larger.
    double standard_error() const;
    /// Whether no more need be counted. `most`: see most_counted.
    bool is_enough(std::size_t most) const;
};

/// Of the tree against itself under standard placements, or of all trees of a scene in its queries.
struct TreeCost {
    std::shared_ptr<const mobb::Tree> tree;
    QueryWorkload::Kind workload = QueryWorkload::Kind::placements;
    std::size_t queries = 0;          ///< that were counted
    MeanTests tests{};                ///< of a query
    std::vector<MeanTests> levels{};  ///< by the level of the pair of nodes, in all `tests`
    std::vector<double> shares{};     ///< by node of the tree: its part of all box tests
    // Of placements, whose tests `expected` divides among levels and nodes:
    PlacementCount count{};
    std::shared_ptr<const ExpectedCost> expected{};

    /// ns, of some tests of the tree
    double ns(const MeanTests& some) const { return cost_of(some); }
    double ns() const { return ns(tests); }
    /// The part of the cost that some of its tests are, 0 to 1.
    double part(const MeanTests& some) const;
};

/// Why no cost of a tree is known: of blocks, or of a clip so far out that it cannot be placed. Empty of all others.
std::string_view why_no_cost(const mobb::Tree& tree);

/// Counts the first placements, or with `so_far` more of them, up to twice as many. Null where why_no_cost says why.
/// `progress` is told of the placements of this step; it may throw to end the work.
std::shared_ptr<const TreeCost> counted_on(const std::shared_ptr<const mobb::Tree>& tree, const TreeCost* so_far,
                                           std::size_t most, const Progress& progress = {});
/// Counts until it is enough. Null likewise.
std::shared_ptr<const TreeCost> standard_cost(const std::shared_ptr<const mobb::Tree>& tree,
                                              std::size_t most = most_counted(1), const Progress& progress = {});

/// The mean of a scene's queries. `tree`: that of the clip, whose nodes get their shares.
TreeCost cost_in_scene(const SceneCosts& costs, int clip, const std::shared_ptr<const mobb::Tree>& tree);

}  // namespace mobbscope
