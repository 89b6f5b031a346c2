/// A tree as `fit --json` has it.
#pragma once

#include <base/json_writer.h>
#include <mobb/tree.h>

#include <memory>
#include <string>

namespace mobbscope {

/// What a query of the tree against itself is expected to cost, per-level figures and every node of the tree over the
/// clip of that name.
void write_tree(JsonWriter& out, const std::string& clip, const std::shared_ptr<const mobb::Tree>& tree);

/// The members `clip`, the fit's and `nodes` of the same, of nodes without what is counted or expected of them.
void write_fitted_nodes(JsonWriter& out, const std::string& clip, const mobb::Tree& tree);

}  // namespace mobbscope
