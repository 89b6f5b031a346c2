/// A tree as `fit --json` has it.
#pragma once

#include <base/json_writer.h>
#include <explain/tree_cost.h>
#include <mobb/tree.h>

#include <string>

namespace mobbscope {

/// What a query of the tree against itself is expected to make and was counted to, per-level figures and every node of
/// the tree over the clip of that name. `cost`: its standard_cost; null: it has none.
void write_tree(JsonWriter& out, const std::string& clip, const mobb::Tree& tree, const TreeCost* cost);

/// The members `clip`, the fit's and `nodes` of the same, of nodes without what is counted or expected of them.
void write_fitted_nodes(JsonWriter& out, const std::string& clip, const mobb::Tree& tree);

}  // namespace mobbscope
