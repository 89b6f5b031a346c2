/// A measured table, and its two forms: text for people, JSON for programs.
#pragma once

#include <base/json_writer.h>
#include <paper_tables/measure.h>
#include <paper_tables/test_costs.h>

#include <cstdint>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
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
    std::vector<TableRow> sweep;     ///< of sweep_methods; empty if not asked for
    std::vector<TableRow> variants;  ///< of variant_methods; empty if not asked for
};

/// The share of the queries that the test of the MOBB roots answers: Table 1's "80 %".
double root_rejected(const TableReport& report);

void write_text(std::ostream& out, const TableReport& report);
void write_json(std::ostream& out, const TableReport& report);

struct PaperRow {
    double time_us = 0;  ///< Table 1: 3.0 GHz Athlon; Table 2: 3 GHz Pentium 4
    double obb2d = 0;
    double obb3d = 0;
    double samples = 0;  ///< to be compared with TableRow::sample_steps
};

/// The row of a method ("mobb_1level", ...) in "table1" or "table2"; none for what the paper did not measure.
std::optional<PaperRow> paper_row(std::string_view table, std::string_view method);

}  // namespace mobbscope
