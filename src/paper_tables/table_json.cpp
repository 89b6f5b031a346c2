#include <paper_tables/table_report.h>

namespace mobbscope {

namespace {

void write_optional(JsonWriter& out, std::string_view key, const std::optional<double>& value) {
    out.key(key);
    value ? out.value(*value) : out.null();
}

void write_paper(JsonWriter& out, const std::string& table, const std::string& method) {
    out.key("paper");
    const std::optional<PaperRow> row = paper_row(table, method);
    if (!row) return out.null();
    out.begin_object(JsonWriter::Layout::row);
    out.member("time_ns", row->time_us * 1000);
    out.member("obb2d", row->obb2d);
    out.member("obb3d", row->obb3d);
    out.member("samples", row->samples);
    out.end_object();
}

void write_figures(JsonWriter& out, const TableRow& row) {
    out.member("method", row.method);
    out.member("leaf", row.leaf);
    out.member("time_ns", row.time_ns);
    out.key("time_ns_quartiles");
    out.numbers({row.time_ns_q1, row.time_ns_q3});
    out.member("time", row.time_tests);
    out.member("obb2d", row.obb2d);
    out.member("obb3d", row.obb3d);
    out.member("moving", row.moving);
    out.member("aabb", row.aabb);
    out.member("samples", row.samples);
    out.member("sample_steps", row.sample_steps);
    out.member("root_box_tests", row.root_box_tests);
    out.member("root_rejected", row.root_rejected);
}

}  // namespace

void write_json(std::ostream& stream, const TableReport& report) {
    JsonWriter out(stream);
    out.begin_object();
    out.member("workload", report.workload);
    out.member("description", report.description);
    out.member("machine", report.machine);
    out.member("queries", report.queries);
    out.key("seed");
    out.value(static_cast<std::int64_t>(report.seed));
    out.member("rounds", report.rounds);
    out.key("clips");
    out.begin_object(JsonWriter::Layout::row);
    out.member("count", report.clips);
    out.member("mean_duration", report.mean_duration);
    out.end_object();
    out.member("positive", report.table.positive);
    out.member("root_rejected", root_rejected(report));
    out.key("rows");
    out.begin_array();
    for (const TableRow& row : report.table.rows) {
        out.begin_object();
        write_figures(out, row);
        write_paper(out, report.workload, row.method);
        out.end_object();
    }
    out.end_array();
    out.key("test_ns");
    out.begin_object(JsonWriter::Layout::row);
    write_optional(out, "obb2d", report.costs.obb2d);
    write_optional(out, "obb3d", report.costs.obb3d);
    write_optional(out, "moving", report.costs.moving);
    write_optional(out, "aabb", report.costs.aabb);
    write_optional(out, "sample_pair", report.costs.sample_pair);
    out.end_object();
    if (!report.sweep.empty()) {
        out.key("leaf_sweep");
        out.begin_array();
        for (const TableRow& row : report.sweep) {
            out.begin_object(JsonWriter::Layout::row);
            write_figures(out, row);
            out.end_object();
        }
        out.end_array();
    }
    out.end_object();
}

}  // namespace mobbscope
