/// The rows of the tables: ways to answer a query.
#pragma once

#include <mobb/tree.h>

#include <optional>
#include <string>
#include <vector>

namespace mobbscope {

struct Method {
    std::string name;                         ///< as in the output of `bench`
    std::optional<mobb::FitOptions> options;  ///< none: the direct search
};

/// The paper's rows and the baselines: brute, mobb_1level, umobb_1level, mobb, umobb, hybrid1, hybrid2, moving, aabb.
/// `base` gives all but the kind and the levels.
std::vector<Method> table_methods(const mobb::FitOptions& base);

/// Those with a hierarchy, for a sweep of n_min.
std::vector<Method> hierarchical_methods(const mobb::FitOptions& base);

}  // namespace mobbscope
