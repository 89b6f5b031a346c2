#include <base/text.h>
#include <explain/node_table.h>
#include <explain/table_rows.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace mobbscope {

namespace {

constexpr std::array kNodeColumns{NodeField::node,     NodeField::level, NodeField::sample, NodeField::waste,
                                  NodeField::empty,    NodeField::fill,  NodeField::volume, NodeField::floor,
                                  NodeField::overhang, NodeField::share, NodeField::tests,  NodeField::avoidable};
constexpr int kFigureDigits = 3;

std::string number_text(const NodeFieldInfo& about, double value, bool exact) {
    if (about.unit.empty()) return std::to_string(static_cast<std::int64_t>(value));
    if (exact) return format_double(value);
    if (about.kind == FieldKind::range) return formatted("%.3f", value);
    return figure(about.unit == "%" ? 100 * value : value, kFigureDigits);
}

}  // namespace

std::span<const NodeField> node_columns() { return kNodeColumns; }

std::string column_heading(NodeField field) {
    const NodeFieldInfo& about = info(field);
    std::string out(about.heading);
    if (!about.unit.empty()) out.append(", ").append(about.unit);
    return out;
}

bool is_worse_if_more(NodeField field) {
    return info(field).colors && !info(field).low_is_worse && field != NodeField::level;
}

std::string node_text(const NodeValues& values, NodeField field, int node, bool exact) {
    const NodeFieldInfo& about = info(field);
    const FieldRange range = values.range(field, node);
    if (std::isnan(range.least)) return "";
    if (about.kind == FieldKind::flag) return range.least > 0 ? "yes" : "";
    if (about.kind == FieldKind::node) {
        const mobb::Tree& tree = values.tree();
        return std::to_string(tree.level(node)) + '.' + std::to_string(tree.place_in_level(node));
    }
    const std::string first = number_text(about, range.least, exact);
    return range.least == range.most ? first : first + ".." + number_text(about, range.most, exact);
}

std::vector<int> nodes_that_pass(const NodeValues& values, const NodeFilter* filter) {
    std::vector<int> out;
    for (int node = 0; node < values.size(); ++node) {
        if (!filter || values.passes(*filter, node)) out.push_back(node);
    }
    return out;
}

void sort_nodes(std::vector<int>& nodes, const NodeValues& values, NodeField field, bool descending) {
    std::vector<double> keys(nodes.size());
    const double nodes_in_all = values.size();
    std::ranges::transform(nodes, keys.begin(), [&](int node) {
        if (field != NodeField::node) return values.value(field, node);
        return nodes_in_all * values.tree().level(node) + values.tree().place_in_level(node);
    });
    sort_rows(nodes, keys, descending);
}

std::string node_rows(const NodeValues& values, std::span<const NodeField> columns, std::span<const int> nodes,
                      char separator) {
    return rows_text(
        columns.size(), nodes, separator, [&](std::size_t column) { return std::string(info(columns[column]).name); },
        [&](std::size_t column, int node) { return node_text(values, columns[column], node, true); });
}

}  // namespace mobbscope
