#include <base/text.h>
#include <paper_tables/table_report.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace mobbscope {

namespace {

using NamedRow = std::pair<std::string_view, PaperRow>;

constexpr NamedRow kTable1[] = {
    {"mobb_1level", {4.6, 0.45, 0, 10.3}}, {"umobb_1level", {4.5, 0, 0.45, 10.0}}, {"mobb", {2.3, 1.7, 0, 0.91}},
    {"umobb", {2.2, 0.16, 1.53, 0.77}},    {"hybrid1", {2.1, 0.40, 1.34, 0.77}},   {"hybrid2", {2.0, 1.5, 0.25, 0.81}},
};

constexpr NamedRow kTable2[] = {
    {"mobb_1level", {68.3, 0.83, 0, 306}}, {"umobb_1level", {68.1, 0, 0.83, 307}}, {"mobb", {5.9, 27.5, 0, 4.15}},
    {"umobb", {6.8, 0.62, 21.6, 3.10}},    {"hybrid1", {6.8, 1.45, 20.8, 3.10}},   {"hybrid2", {6.0, 26.7, 0.83, 4.15}},
};

template <std::size_t N>
std::optional<PaperRow> find(const NamedRow (&rows)[N], std::string_view method) {
    for (const auto& [name, row] : rows) {
        if (name == method) return row;
    }
    return std::nullopt;
}

void write_paper(JsonWriter& out, const std::string& table, const std::string& method) {
    const std::optional<PaperRow> row = paper_row(table, method);
    if (!row) return out.member("paper", std::optional<double>());
    out.key("paper");
    out.row("time_ns", row->time_us * 1000, "obb2d", row->obb2d, "obb3d", row->obb3d, "samples", row->samples);
}

void write_figures(JsonWriter& out, const TableRow& row) {
    out.members("method", row.method, "leaf", row.leaf, "time_ns", row.time_ns);
    out.member("time_ns_quartiles", {row.time_ns_q1, row.time_ns_q3});
    for (const mobb::TestKind test : mobb::kTestKinds) out.member(mobb::name(test), row[test]);
    out.members("sample_steps", row.sample_steps, "root_box_tests", row.root_box_tests);
    out.member("root_rejected", row.root_rejected);
    out.members("depth", row.trees.depth, "nodes", row.trees.nodes, "bytes", row.trees.bytes);
    out.member("build_ns", row.trees.build_ns);
}

/// What is known of each level: of the trees, and of the pairs of nodes that are so deep.
void write_level_lists(JsonWriter& out, const TableRow& row) {
    out.values("volumes", row.trees.volumes);
    out.list("pair_levels", row.pair_levels, [&](const PairLevel& level) {
        out.row("pairs", level.pairs, "apart_in_time", level.apart_in_time, "separated", level.separated, "sampled",
                level.sampled, "queries_ended", level.ended);
    });
}

/// A number in a column: `decimals` behind the point, right-aligned to `width`; "-" for zero tests.
std::string cell(double value, int width, int decimals) {
    return value == 0 ? formatted("%*s", width, "-") : formatted("%*.*f", width, decimals, value);
}

std::string left(std::string_view text, int width) {
    std::string out(text);
    out.resize(std::max(out.size(), static_cast<std::size_t>(width)), ' ');
    return out;
}

std::string right(std::string_view text, int width) {
    return std::string(std::max<std::size_t>(text.size(), static_cast<std::size_t>(width)) - text.size(), ' ') +
           std::string(text);
}

/// Of the column of a kind's tests.
int width_of(mobb::BoxKind kind) { return kind == mobb::kBoxKinds.front() ? 6 : 8; }

std::string percent(double share) { return formatted("%.1f %%", 100 * share); }

void write_rows(std::ostream& out, const TableReport& report) {
    out << "method           ns/query   quartiles       ";
    for (const mobb::BoxKind kind : mobb::kBoxKinds) out << right(mobb::info(kind).heading, width_of(kind));
    out << "  sample pairs  root rejects   steps | paper: us      2D      3D  samples\n";
    for (const TableRow& row : report.table.rows) {
        out << left(row.method, 15) << cell(row.time_ns, 10, 1) << "   "
            << left(formatted("%.1f..%.1f", row.time_ns_q1, row.time_ns_q3), 16);
        for (const mobb::BoxKind kind : mobb::kBoxKinds) out << cell(row[kind], width_of(kind), 2);
        out << cell(row[mobb::TestKind::samples], 14, 2) << "  "
            << right(row.leaf == 0 ? "-" : percent(row.root_rejected), 12) << cell(row.sample_steps, 8, 2);
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
    const auto one = [&](std::string_view what, const std::optional<double>& cost) {
        if (!cost) return;
        out << before << what << ' ' << cell(*cost, 0, 2);
        before = ", ";
    };
    for (const mobb::BoxKind kind : mobb::kBoxKinds) one(mobb::info(kind).plural, costs[kind]);
    one("a pair of samples", costs.sample_pair);
    out << (before[0] == ',' ? ".\n" : "No test was made, so none has a price.\n");
    const std::optional<double>& two_d = costs[mobb::BoxKind::obb2d];
    if (two_d && costs.sample_pair) {
        const double worth = *two_d / *costs.sample_pair;
        out << "By itself a 2D box test is worth " << cell(worth, 0, 1)
            << " sample pairs. The paper's rule makes n_min twice that, " << cell(2 * worth, 0, 0)
            << " (its own: 10); --sweep measures the best.\n";
    }
}

/// Where the pairs of nodes end that a query visits, and what the boxes of each level hold, of the paper's two trees.
void write_levels(std::ostream& out, const TableReport& report) {
    const auto volume = [](const TableRow& row, std::size_t level) {
        const std::vector<double>& volumes = row.trees.volumes;
        return volumes[std::min(level, volumes.size() - 1)];
    };
    const auto mobb = std::ranges::find(report.table.rows, "mobb", &TableRow::method);
    for (const TableRow& row : report.table.rows) {
        if (row.leaf == 0 || row.levels == 1) continue;
        out << "\n"
            << row.method << ": " << formatted("%.1f", row.trees.depth) << " levels, "
            << formatted("%.1f", row.trees.nodes) << " nodes, "
            << bytes_text(static_cast<std::uintmax_t>(std::lround(row.trees.bytes))) << " a tree, built in "
            << formatted("%.1f", row.trees.build_ns / 1000) << " us\n"
            << "level   pairs  apart in time  separated  sampled  queries that end  volume, MOBB = 1\n";
        for (std::size_t i = 0; i < row.pair_levels.size(); ++i) {
            const PairLevel& level = row.pair_levels[i];
            const auto of_pairs = [&](double part) { return right(percent(part / level.pairs), 9); };
            out << left(std::to_string(i), 5) << cell(level.pairs, 8, 3) << "      " << of_pairs(level.apart_in_time)
                << "  " << of_pairs(level.separated) << of_pairs(level.sampled) << "         "
                << right(percent(level.ended), 9);
            if (mobb != report.table.rows.end() && i < row.trees.volumes.size()) {
                out << cell(volume(row, i) / volume(*mobb, i), 18, 3);
            }
            out << '\n';
        }
    }
}

/// The methods that a sweep or variants are compared with, measured in the same rounds.
void write_beside(std::ostream& out, const std::vector<TableRow>& rows) {
    const char* before = "In the same rounds: ";
    for (const TableRow& row : rows) {
        if (row.leaf != 0 && row.levels != 1) continue;
        out << before << row.method << formatted(" %.1f", row.time_ns);
        before = ", ";
    }
    out << " ns/query\n";
}

void write_sweep(std::ostream& out, const std::vector<TableRow>& sweep) {
    if (sweep.empty()) return;
    std::vector<int> leaves;
    std::vector<std::string> methods;
    std::map<std::pair<std::string, int>, const TableRow*> by;
    for (const TableRow& row : sweep) {
        if (row.leaf == 0 || row.levels == 1) continue;
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
            const std::string text =
                formatted("%.1f (%.1f; %.1f)", row.time_ns, row.box_tests(), row[mobb::TestKind::samples]);
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
    write_beside(out, sweep);
}

void write_variants(std::ostream& out, const std::vector<TableRow>& variants) {
    if (variants.empty()) return;
    out << "\nVariants              ns/query  box tests    pairs   steps  build us   volumes from the root on, m^2*s\n";
    for (const TableRow& row : variants) {
        if (row.levels == 1) continue;
        out << left(row.method, 20) << cell(row.time_ns, 10, 1) << cell(row.box_tests(), 11, 2)
            << cell(row[mobb::TestKind::samples], 9, 2) << cell(row.sample_steps, 8, 2)
            << cell(row.trees.build_ns / 1000, 10, 1) << "  ";
        for (std::size_t i = 0; i < std::min<std::size_t>(row.trees.volumes.size(), 5); ++i) {
            out << ' ' << brief(std::round(row.trees.volumes[i]));
        }
        out << '\n';
    }
    write_beside(out, variants);
}

}  // namespace

std::optional<PaperRow> paper_row(std::string_view table, std::string_view method) {
    if (table == "table1") return find(kTable1, method);
    if (table == "table2") return find(kTable2, method);
    return std::nullopt;
}

void write_json(std::ostream& stream, const TableReport& report) {
    JsonWriter out(stream);
    out.begin_object();
    out.members("workload", report.workload, "description", report.description, "machine", report.machine);
    out.members("queries", report.queries, "seed", report.seed, "rounds", report.rounds);
    out.key("clips");
    out.row("count", report.clips, "mean_duration", report.mean_duration);
    out.members("positive", report.table.positive, "root_rejected", root_rejected(report));
    out.list("rows", report.table.rows, [&](const TableRow& row) {
        out.begin_object();
        write_figures(out, row);
        write_level_lists(out, row);
        write_paper(out, report.workload, row.method);
        out.end_object();
    });
    out.begin_object("test_ns", JsonWriter::Layout::row);
    for (const mobb::BoxKind kind : mobb::kBoxKinds) out.member(mobb::name(kind), report.costs[kind]);
    out.member("sample_pair", report.costs.sample_pair);
    out.end_object();
    if (!report.sweep.empty()) {
        out.list("leaf_sweep", report.sweep, [&](const TableRow& row) {
            out.begin_object(JsonWriter::Layout::row);
            write_figures(out, row);
            out.end_object();
        });
    }
    if (!report.variants.empty()) {
        out.list("variants", report.variants, [&](const TableRow& row) {
            out.begin_object();
            write_figures(out, row);
            write_level_lists(out, row);
            out.end_object();
        });
    }
    out.end_object();
}

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
    out << "\nTimes are the processor's, medians over the rounds. A sample whose hold overlaps two of the other clip's "
           "has\n"
           "two partners: pairs count both, steps count it once, as the paper's samples seem to.\n";
    write_costs(out, report.costs);
    write_levels(out, report);
    write_sweep(out, report.sweep);
    write_variants(out, report.variants);
}

}  // namespace mobbscope
