/// The ways to answer a query that are measured beside each other.
#pragma once

#include <mobb/tree.h>

#include <optional>
#include <string>
#include <vector>

namespace mobbscope {

struct Method {
    std::string name;                         ///< as in the output of `bench`
    std::optional<mobb::FitOptions> options;  ///< none: the direct search
    bool boxes_in_walk = false;               ///< mobb::WalkTests::time_and_boxes
    bool batch = false;                       ///< of blocks: mobb::intersects_each, 1,000 at a time
};

/// The paper's rows and the baselines: brute, mobb_1level, umobb_1level, and the kinds of trees; blocks also as a
/// batch. `base` gives all but the kind and the levels.
std::vector<Method> table_methods(const mobb::FitOptions& base);

/// All kinds of trees at n_min from 1 to 200 (the paper's range ends at 50), by n_min, then kind; first brute and the
/// trees of one level, to compare with.
std::vector<Method> sweep_methods(const mobb::FitOptions& base);

/// What `base` leaves open, for MOBB and UMOBB: the other axes, time scales of a quarter to four times base's, and box
/// tests where a leaf meets an inner node. First one level, MOBB and UMOBB as `base` has them, to compare with.
std::vector<Method> variant_methods(const mobb::FitOptions& base);

}  // namespace mobbscope
