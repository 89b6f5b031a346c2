/// Trees as JSON: one element of `trees` in the output of `fit --json` (contract, section 3).
#pragma once

#include <mobb/tree.h>
#include <scene/json_writer.h>

#include <string>

namespace mobbscope {

/// Per-level figures and every node of the tree over the clip of that name.
void write_tree(JsonWriter& out, const std::string& clip, const mobb::Tree& tree);

}  // namespace mobbscope
