/// What one test costs, on this machine.
#pragma once

#include <paper_tables/measure.h>
#include <paper_tables/workload.h>

#include <array>
#include <optional>

namespace mobbscope {

/// Nanoseconds; none where the workload makes no such test.
struct TestCosts {
    std::array<std::optional<double>, mobb::kBoxKindCount> boxes;  ///< by BoxKind
    std::optional<double> sample_pair;  ///< of the direct search: with stepping from pair to pair

    std::optional<double>& operator[](mobb::BoxKind kind) { return boxes[static_cast<std::size_t>(kind)]; }
    const std::optional<double>& operator[](mobb::BoxKind kind) const { return boxes[static_cast<std::size_t>(kind)]; }
};

/// Times the box tests that the workload's own queries make, each many times over, and the direct search per pair.
/// `base` gives the fit.
TestCosts measure_test_costs(const Workload& workload, const mobb::FitOptions& base);

}  // namespace mobbscope
