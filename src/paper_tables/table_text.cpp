#include <base/text.h>
#include <paper_tables/table_report.h>

#include <algorithm>
#include <cstdio>
#include <map>

namespace mobbscope {

namespace {

/// A number in a column: `decimals` behind the point, right-aligned to `width`; "-" for zero tests.
std::string cell(double value, int width, int decimals) {
    char text[64];
    if (value == 0) {
        std::snprintf(text, sizeof text, "%*s", width, "-");
    } else {
        std::snprintf(text, sizeof text, "%*.*f", width, decimals, value);
    }
    return text;
}

std::string left(std::string_view text, int width) {
    std::string out(text);
    out.resize(std::max(out.size(), static_cast<std::size_t>(width)), ' ');
    return out;
}

std::string percent(double share) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f %%", 100 * share);
    return text;
}

void write_rows(std::ostream& out, const TableReport& report) {
    out << "method           ns/query   quartiles           2D      3D  moving    aabb  sample pairs   steps  "
           "root rejects | paper: us      2D      3D  samples\n";
    for (const TableRow& row : report.table.rows) {
        char quartiles[64];
        std::snprintf(quartiles, sizeof quartiles, "%.1f..%.1f", row.time_ns_q1, row.time_ns_q3);
        out << left(row.method, 15) << cell(row.time_ns, 10, 1) << "   " << left(quartiles, 16) << cell(row.obb2d, 6, 2)
            << cell(row.obb3d, 8, 2) << cell(row.moving, 8, 2) << cell(row.aabb, 8, 2) << cell(row.samples, 14, 2)
            << cell(row.sample_steps, 8, 2) << "  "
            << (row.leaf == 0 ? std::string("           -")
                              : std::string(12 - std::min<std::size_t>(12, percent(row.root_rejected).size()), ' ') +
                                    percent(row.root_rejected));
        if (const std::optional<PaperRow> paper = paper_row(report.workload, row.method)) {
            out << " |" << cell(paper->time_us, 10, 1) << cell(paper->obb2d, 8, 2) << cell(paper->obb3d, 8, 2)
                << cell(paper->samples, 9, 2);
        } else {
            out << " |";
        }
        out << '\n';
    }
}

void write_costs(std::ostream& out, const TestCosts& costs) {
    const char* before = "One test costs, in ns: ";
    const auto one = [&](const char* what, const std::optional<double>& cost) {
        if (!cost) return;
        out << before << what << ' ' << cell(*cost, 0, 2);
        before = ", ";
    };
    one("2D boxes", costs.obb2d);
    one("3D boxes", costs.obb3d);
    one("moving boxes", costs.moving);
    one("aabb", costs.aabb);
    one("a pair of samples", costs.sample_pair);
    out << (before[0] == ',' ? ".\n" : "No test was made, so none has a price.\n");
    if (costs.obb2d && costs.sample_pair) {
        out << "A 2D box test is worth " << cell(*costs.obb2d / *costs.sample_pair, 0, 1)
            << " sample pairs; on the paper's machine it was worth n_min/2 = 5 steps.\n";
    }
}

void write_sweep(std::ostream& out, const std::vector<TableRow>& sweep) {
    if (sweep.empty()) return;
    std::vector<int> leaves;
    std::vector<std::string> methods;
    std::map<std::pair<std::string, int>, const TableRow*> by;
    for (const TableRow& row : sweep) {
        if (std::find(leaves.begin(), leaves.end(), row.leaf) == leaves.end()) leaves.push_back(row.leaf);
        if (std::find(methods.begin(), methods.end(), row.method) == methods.end()) methods.push_back(row.method);
        by[{row.method, row.leaf}] = &row;
    }
    out << "\nn_min, ns/query (box tests; sample pairs)\n" << left("", 8);
    for (const std::string& method : methods) out << left(method, 26);
    out << '\n';
    for (const int leaf : leaves) {
        out << left(std::to_string(leaf), 8);
        for (const std::string& method : methods) {
            const TableRow& row = *by.at({method, leaf});
            char text[96];
            std::snprintf(text, sizeof text, "%.1f (%.1f; %.1f)", row.time_ns,
                          row.obb2d + row.obb3d + row.moving + row.aabb, row.samples);
            out << left(text, 26);
        }
        out << '\n';
    }
    out << left("best", 8);
    for (const std::string& method : methods) {
        const TableRow* best = nullptr;
        for (const int leaf : leaves) {
            const TableRow* row = by.at({method, leaf});
            if (!best || row->time_ns < best->time_ns) best = row;
        }
        out << left("n_min " + std::to_string(best->leaf), 26);
    }
    out << '\n';
}

}  // namespace

double root_rejected(const TableReport& report) {
    for (const TableRow& row : report.table.rows) {
        if (row.method == "mobb") return row.root_rejected;
    }
    return 0;
}

void write_text(std::ostream& out, const TableReport& report) {
    out << (report.workload == "table1" ? "Table 1" : "Table 2") << ": " << report.description << '\n'
        << counted(report.queries, "query", "queries") << " between " << counted(report.clips, "clip", "clips")
        << " of " << brief(report.mean_duration) << " s on average; seed " << report.seed << ", "
        << counted(report.rounds, "round", "rounds") << ".\n"
        << "On " << report.machine << ".\n"
        << percent(report.table.positive) << " collide; the MOBB roots alone reject " << percent(root_rejected(report))
        << ".\n\n";
    write_rows(out, report);
    out << "\nTimes are medians over the rounds. A sample whose hold overlaps two of the other clip's has two "
           "partners: pairs "
           "count both,\nsteps count it once, as the paper seems to.\n";
    write_costs(out, report.costs);
    write_sweep(out, report.sweep);
}

}  // namespace mobbscope
