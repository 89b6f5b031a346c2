/// What a query of a tree costs, under the workload that is chosen.
#pragma once

#include <explain/branch_costs.h>
#include <explain/query_workload.h>
#include <mobb/tree.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace mobbscope {

/// The standard placements that are counted for trees without a formula.
inline constexpr std::size_t kCountedPlacements = 4096;
inline constexpr std::uint64_t kCountedSeed = 0;

/// Of the tree against itself under standard placements, or of all trees of a scene in its queries.
struct TreeCost {
    std::shared_ptr<const mobb::Tree> tree;
    QueryWorkload::Kind workload = QueryWorkload::Kind::placements;
    std::size_t queries = 0;           ///< that were counted; 0: it was worked out
    double area = 0;                   ///< of placements: m^2, of the shifts
    double offset = 0;                 ///< likewise: s, B starts within +-this
    MeanTests tests{};                 ///< of a query
    std::optional<MeanTests> bound{};  ///< of what is worked out: as if no query hit, so never less
    std::vector<MeanTests> levels{};   ///< by the level of the pair of nodes; empty: not known
    std::vector<double> shares{};      ///< by node of the tree: its part of all box tests; empty: not known

    const MeanTests& prices() const { return prices_of(tree->options().tree); }
    /// ns, of some tests of the tree
    double ns(const MeanTests& some) const { return cost_of(some, prices()); }
    /// The part of the cost that some of its tests are, 0 to 1.
    double part(const MeanTests& some) const;
};

/// Expected, or counted where there is no formula.
TreeCost standard_cost(const std::shared_ptr<const mobb::Tree>& tree, const Progress& progress = {});

/// The mean of a scene's queries. `tree`: that of the clip, whose nodes get their shares.
TreeCost cost_in_scene(const SceneCosts& costs, int clip, const std::shared_ptr<const mobb::Tree>& tree);

}  // namespace mobbscope
