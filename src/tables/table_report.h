/// A measured table, and its two forms: text for people, JSON for programs.
#pragma once

#include <scene/json_writer.h>
#include <tables/measure.h>
#include <tables/test_costs.h>

#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

namespace mobbscope {

struct TableReport {
    std::string workload;     ///< "table1" or "table2"
    std::string description;  ///< what the queries are
    std::string machine;
    std::uint64_t seed = 0;
    int rounds = 0;
    std::int64_t queries = 0;
    int clips = 0;
    double mean_duration = 0;  ///< of the clips, seconds
    TableRows table;
    TestCosts costs;
    std::vector<TableRow> sweep;  ///< the hierarchical methods again, at several n_min; empty if not asked for
};

/// The share of the queries that the test of the MOBB roots answers: Table 1's "80 %".
double root_rejected(const TableReport& report);

void write_text(std::ostream& out, const TableReport& report);
void write_json(std::ostream& out, const TableReport& report);

}  // namespace mobbscope
