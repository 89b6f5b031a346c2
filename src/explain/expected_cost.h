/// The tests that a query is expected to make under standard placements, worked out from the boxes without asking one:
/// how they are divided among nodes and levels. How many they are is counted (tree_cost.h).
#pragma once

#include <explain/query_workload.h>
#include <mobb/tree.h>

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace mobbscope {

/// Pairs of nodes that are worked out on each level: where there are more, as many are drawn from all, and count for
/// the others (fits of up to 64 nodes a level are worked out whole; measured, the others are within 0.1 % with a leaf
/// of 10 and 2 % with one of 1).
inline constexpr std::size_t kExpectedPairs = 4096;

/// A query of two trees. The traversal visits pairs of nodes of one level:
///
///     tests of boxes = P + sum over pairs (p, q) of inner nodes, and over their children (a, b), of k(p, q) share(a,
///     b)
///
/// with P = share(root, root); share(a, b) = (h_a + h_b)/(2 offset), the chance that two nodes of durations h share
/// time; k(p, q) = the least of meeting_area/area over p, q and the pairs that led to them, 1 at most. `bound` has
/// these: more than is counted, because a query that hits ends.
///
/// `tests` have max(0, k area - H)/area for k, H being the area of the shifts at which the two have collided before:
///
///     H = pi R^2 + 2 R min(D, sqrt(k area/pi) - R),   R = r + e/2
///
/// r: both mean radii added; D: how far the two have moved against each other (root of the mean square) since both are
/// there, up to the middle of the pair, but no farther than to the edge of a disk of the area at which they meet; e:
/// how much farther than a tube of that length the disks of that time reach, as those of people do who stand and sway.
struct ExpectedCost {
    StandardPlacements placements;
    MeanTests tests;
    MeanTests bound;
    std::vector<MeanTests>
        levels;  ///< the tests by the level of the nodes; of two leaves or a leaf and an inner node too
    /// By node of A and of B: its part of the expected tests of boxes, of which each counts half for either side. Both
    /// sums are 1/2.
    std::array<std::vector<double>, 2> shares;

    /// Of a tree against itself: the two added.
    std::vector<double> node_shares() const;
};

/// None of a tree of blocks. `most_pairs`: see kExpectedPairs.
std::optional<ExpectedCost> expected_cost(const mobb::Tree& a, const mobb::Tree& b,
                                          std::size_t most_pairs = kExpectedPairs);
/// node_shares of a tree against itself; empty of blocks.
std::vector<double> expected_shares(const mobb::Tree& tree);

}  // namespace mobbscope
