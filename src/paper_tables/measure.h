/// Methods measured on a workload: counts, answers and times.
#pragma once

#include <mobb/observer.h>
#include <mobb/tree.h>
#include <paper_tables/workload.h>

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace mobbscope {

struct Method {
    std::string name;                         ///< as in the output of `bench`
    std::optional<mobb::FitOptions> options;  ///< none: the direct search
};

/// Of one method, per query. Counts are means over all queries.
struct TableRow {
    std::string method;
    int leaf = 0;           ///< n_min; 0 for the direct search
    double time_ns = 0;     ///< median over the rounds of the round's mean
    double time_ns_q1 = 0;  ///< lower and upper quartile over the rounds
    double time_ns_q3 = 0;
    std::array<double, mobb::kTestKindCount> tests{};  ///< by TestKind::index(); of samples: pairs (i, j)
    double sample_steps = 0;    ///< samples of A among them: the paper's count, where a sample has one partner
    double root_rejected = 0;   ///< share of the queries that were answered by the test of the roots
    double root_box_tests = 0;  ///< of the two roots, per query

    double& operator[](mobb::TestKind test) { return tests[test.index()]; }
    double operator[](mobb::TestKind test) const { return tests[test.index()]; }
    double box_tests() const;
};

struct TableRows {
    std::vector<TableRow> rows;  ///< in the order of the methods
    double positive = 0;         ///< share of the queries that collide
};

/// Told what is being done, and how much of it.
using MeasureProgress = std::function<void(const std::string& doing, int done, int all)>;

/// Runs every method on the same queries, `rounds` >= 1 times. In a round the methods take turns after each block of
/// queries, beginning with another one each time, so that what slows the machine down slows all of them. Placing the
/// clips (sine and cosine) is not timed, building the trees neither. Every method's contact is compared with the direct
/// search's; throws DisagreementError where they differ.
TableRows measure(const Workload& workload, const std::vector<Method>& methods, int rounds,
                  const MeasureProgress& progress = {});

/// The hierarchical methods at n_min from 1 to 50, the paper's range: rows by n_min, then method.
std::vector<TableRow> sweep_leaf(const Workload& workload, mobb::FitOptions base, int rounds,
                                 const MeasureProgress& progress = {});

/// Two methods answered a query differently: a fault of ours, said with the query.
struct DisagreementError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The paper's rows and the baselines: brute, mobb_1level, umobb_1level, and the kinds of trees.
/// `base` gives all but the kind and the levels.
std::vector<Method> table_methods(const mobb::FitOptions& base);

/// Those with a hierarchy, for a sweep of n_min.
std::vector<Method> hierarchical_methods(const mobb::FitOptions& base);

/// Processor, cores, compiler and whether this program was built to be fast.
std::string machine_words();

}  // namespace mobbscope
