/// Fits of one clip side by side: how tight their levels are, what they cost, and which is better where.
#pragma once

#include <explain/tree_cost.h>
#include <mobb/level_figures.h>
#include <mobb/tree.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {

enum class Better { less, more };

/// Numbers of which one is better than the other by no more than this part count as alike: percentages without decimals
/// do not show less.
inline constexpr double kAlike = 0.005;

/// A number of each fit.
struct ComparedFigure {
    std::vector<std::optional<double>> values;  ///< by fit
    int best = -1;  ///< the fit that is better than all others; -1: none is, or only one has a number

    /// How much larger another fit's number is than the first one's, as a part of that; below 0: smaller. None: one of
    /// them has no number, or the first has 0.
    std::optional<double> difference(std::size_t fit) const;
};

struct ComparedLevel {
    int level = 0;          ///< -1: the last level of each fit, whatever its number
    ComparedFigure volume;  ///< m^2*s; the less the better
    ComparedFigure fill;    ///< the part of it that the disks take, 0 to 1; the more the better
    ComparedFigure cost;    ///< ns of a query, for pairs of this level; the less the better
};

struct ComparedFits {
    std::vector<std::string> names;     ///< what tells the fits apart
    std::vector<ComparedLevel> levels;  ///< from the root on; those that a fit does not have are empty there
    ComparedLevel leaves;               ///< its cost is not known
    ComparedFigure cost;                ///< ns, of a query

    /// Whether the fits end at different levels, so that no level has the leaves of all.
    bool differ_in_depth() const;
};

/// Finds the best of the numbers, if it is better than every other by more than a part of that one.
void find_best(ComparedFigure& figure, Better better, double alike = kAlike);

/// `costs`: by tree; null: not known. The best cost is less than the others by more than three standard errors.
/// Requires trees over one clip, as many costs, and no null tree.
ComparedFits compared(std::span<const std::shared_ptr<const mobb::Tree>> trees,
                      std::span<const std::shared_ptr<const TreeCost>> costs);

/// "moving is tighter on all levels (28 % less volume at the leaves) and costs 30 % less a query."
std::string verdict(const ComparedFits& fits);

/// The node of another tree over the same clip that holds the same samples, or the most similar ones: those that both
/// nodes hold are the largest part of those that either holds.
int node_over_same_samples(const mobb::Tree& from, int node, const mobb::Tree& to);

}  // namespace mobbscope
