/// What queries would cost if one node of a tree were other: measured, each variant by a tree that is built with it.
#pragma once

#include <explain/query_workload.h>
#include <mobb/tree.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {

/// Placements that `fit --what-if` and the window ask.
inline constexpr std::size_t kWhatIfQueries = 50'000;
inline constexpr std::uint64_t kWhatIfSeed = 1;

/// Where a split was looked for: at this many places, evenly through the node.
inline constexpr int kSplitPlaces = 32;

/// What is tried in place of a node, simplest first; nothing of a tree of blocks, whose nodes are all of one make:
/// - the other axes;
/// - the other kinds of boxes that have a test in common with those of the tree: obb2d and obb3d;
/// - of an inner node: a split at a quarter, at three quarters, and where the volumes of the two children's boxes,
///   added, are least, of kSplitPlaces; of the last above leaves: none;
/// - of a leaf: a split in the middle.
std::vector<mobb::NodeChange> node_changes(const mobb::Tree& tree, int node);

/// "axes covariance", "3D box", "split 30 + 90", "a leaf"; "as it is".
std::string change_words(const mobb::Tree& tree, const mobb::NodeChange& change);

struct NodeVariant {
    mobb::NodeChange change;  ///< without any: as it is
    std::shared_ptr<const mobb::Tree> tree;
    double volume = 0;    ///< of the node's box, m^2*s
    double children = 0;  ///< of its children's boxes, added; 0 of a leaf
    MeanTests tests{};    ///< of a query
    double cost = 0;      ///< ns a query: tests times kTestPrices
    Spread difference{};  ///< of the cost to that of the tree as it is, query by query
};

struct WhatIf {
    int node = 0;
    std::size_t queries = 0;
    std::vector<NodeVariant> variants;  ///< the node as it is, then node_changes

    /// The one of least cost, if that is less by more than three standard errors; else the node as it is.
    const NodeVariant& best() const;
};

/// "-1.24 +- 0.05": how much a variant's cost differs from the present in per cent, and the standard error of that.
std::string change_in_per_cent(const WhatIf& found, const NodeVariant& variant, std::string_view between);

/// `trees`: by clip of the workload, none null; that of `clip` is built anew with each change of `node`, and takes part
/// on both sides of a query. `progress` is told of the queries of all variants. Throws std::invalid_argument if there
/// is no such node, or of a tree of blocks.
WhatIf what_if(const QueryWorkload& workload, std::span<const std::shared_ptr<const mobb::Tree>> trees, int clip,
               int node, const Progress& progress = {});

}  // namespace mobbscope
