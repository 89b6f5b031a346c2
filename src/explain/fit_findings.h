/// What stands out in a fit, and what would mend it: each finding is measured, not guessed.
#pragma once

#include <explain/query_workload.h>
#include <mobb/tree.h>

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {

struct FitFinding {
    enum class Kind {
        loose_levels,  ///< boxes grow from a level to those below it
        small_leaves,
        large_leaves,
        costly_node,   ///< much more than its part of the tests
        jump,          ///< a step of the path that spoils the boxes around it
        radius_spike,  ///< likewise of the radius
    };
    Kind kind = Kind::loose_levels;
    std::string text;  ///< one sentence with its numbers
    double cost = 0;   ///< the part of a query's cost that goes with it
    // Where to look; -1: nowhere of that kind.
    int level = -1, node = -1, sample = -1;
    std::optional<mobb::FitOptions> mend{};  ///< a fit without it; none: the clip itself would have to change
};

/// As in files: "loose_levels", "small_leaves", ...
std::string_view name(FitFinding::Kind kind);

/// What a mend changes, in short: "MOBB", "leaf 40, all levels", "8 m/s".
std::string mend_words(const mobb::FitOptions& mend, const mobb::FitOptions& now);

/// One of each kind at most, the most costly first. Costs are counted (tests times price), of the fit and of what would
/// mend it, on the same standard placements of the clip against itself. `shares`: by node its part of all box tests;
/// without them no node is found costly. `progress` is told of the placements of each fit that is tried; it may throw
/// to end the work.
std::vector<FitFinding> fit_findings(const mobb::Tree& tree, std::span<const double> shares,
                                     const Progress& progress = {});

}  // namespace mobbscope
