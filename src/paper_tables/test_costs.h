/// What one test costs, on this machine.
#pragma once

#include <paper_tables/measure.h>
#include <paper_tables/workload.h>

#include <optional>

namespace mobbscope {

/// Nanoseconds; none where the workload makes no such test.
struct TestCosts {
    std::optional<double> obb2d;
    std::optional<double> obb3d;
    std::optional<double> moving;
    std::optional<double> aabb;
    std::optional<double> sample_pair;  ///< of the direct search: with stepping from pair to pair
};

/// Times the box tests that the workload's own queries make, each many times over, and the direct search per pair.
/// `base` gives the fit.
TestCosts measure_test_costs(const Workload& workload, const mobb::FitOptions& base);

}  // namespace mobbscope
