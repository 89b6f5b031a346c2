/// Tables as text.
#pragma once

#include <string>
#include <vector>

namespace mobbscope::cli {

/// A heading, and under it a cell for each row.
using Column = std::vector<std::string>;

/// Columns side by side, as wide as they need, to the right; `first_to_left`: the first has words. Requires columns of
/// equal length.
void print_columns(const std::vector<Column>& columns, bool first_to_left = false);

}  // namespace mobbscope::cli
