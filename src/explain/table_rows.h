/// Rows of a table, each by its number: sorted, and as text.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace mobbscope {

/// In order of values, which stand as the rows do; equal ones stay as they stand, and NaN comes last.
void sort_rows(std::vector<int>& rows, std::span<const double> values, bool descending);

/// A line with the names of the columns, then one for each row; with commas between them, or tabs.
std::string rows_text(std::size_t columns, std::span<const int> rows, char separator,
                      const std::function<std::string(std::size_t column)>& name,
                      const std::function<std::string(std::size_t column, int row)>& cell);

}  // namespace mobbscope
