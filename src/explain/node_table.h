/// The table of a tree's nodes: its columns, its rows in order, and rows as text.
#pragma once

#include <explain/node_values.h>

#include <span>
#include <string>
#include <vector>

namespace mobbscope {

/// The columns of the table, in the order in which they are shown.
std::span<const NodeField> node_columns();
/// "volume, m²·s"
std::string column_heading(NodeField field);
/// Whether larger values are worse: those come first when somebody sorts by it.
bool is_worse_if_more(NodeField field);

/// As the table shows it: "2.3", "0..15", "48.2"; empty: the node has none. `exact`: with all digits of a number, parts
/// as such and not in percent.
std::string node_text(const NodeValues& values, NodeField field, int node, bool exact = false);

/// The nodes that pass a filter, in the order of the tree; null: all.
std::vector<int> nodes_that_pass(const NodeValues& values, const NodeFilter* filter);
/// The column of nodes sorts by level and place.
void sort_nodes(std::vector<int>& nodes, const NodeValues& values, NodeField field, bool descending);

/// These columns of these nodes, with their names above: with commas between them, or tabs.
std::string node_rows(const NodeValues& values, std::span<const NodeField> columns, std::span<const int> nodes,
                      char separator);

}  // namespace mobbscope
