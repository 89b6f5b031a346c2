/// Methods measured on a workload: counts, answers and times.
#pragma once

#include <mobb/observer.h>
#include <paper_tables/methods.h>
#include <paper_tables/workload.h>

#include <array>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace mobbscope {

/// What became of the pairs of nodes that are so deep in the recursion, per query. Means over all queries.
struct PairLevel {
    double pairs = 0;          ///< that were tested: 1 at level 0
    double apart_in_time = 0;  ///< of those
    double separated = 0;      ///< by a box test
    double sampled = 0;        ///< two leaves whose samples were measured
    double ended = 0;          ///< share of the queries that come to no pair deeper than this
};

/// Of the trees of a method.
struct TreeFigures {
    double depth = 0;     ///< levels, mean over the clips
    double nodes = 0;     ///< mean over the clips
    double bytes = 0;     ///< mean over the clips: nodes and indices, without the clip
    double build_ns = 0;  ///< of one tree, mean over the clips; median over the rounds
    /// By level, of all clips: m^2*s. Of a tree that ends above a level its leaves count.
    std::vector<double> volumes;
};

/// Of one method, per query. Counts are means over all queries.
struct TableRow {
    std::string method;
    int leaf = 0;           ///< n_min; 0 for the direct search
    int levels = 0;         ///< 0: all
    double time_ns = 0;     ///< of the processor: median over the rounds of the round's mean
    double time_ns_q1 = 0;  ///< lower and upper quartile over the rounds
    double time_ns_q3 = 0;
    std::array<double, mobb::kTestKindCount> tests{};  ///< by TestKind::index(); of samples: pairs (i, j)
    double sample_steps = 0;    ///< samples of A among them: the paper's count, where a sample has one partner
    double root_rejected = 0;   ///< share of the queries that were answered by the test of the roots
    double root_box_tests = 0;  ///< of the two roots, per query
    std::vector<PairLevel> pair_levels{};  ///< by depth; empty for the direct search
    TreeFigures trees{};                   ///< of the direct search: none

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
/// queries, shuffled each time: so all are met by what slows the machine down, and by what another method leaves in the
/// caches. Placing the clips (sine and cosine) is not timed; building the trees is, by itself. Every method's contact
/// is compared with the direct search's; throws DisagreementError where they differ.
TableRows measure(const Workload& workload, const std::vector<Method>& methods, int rounds,
                  const MeasureProgress& progress = {});

/// Two methods answered a query differently: a fault of ours, said with the query.
struct DisagreementError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Processor, cores, compiler and whether this program was built to be fast.
std::string machine_words();

}  // namespace mobbscope
