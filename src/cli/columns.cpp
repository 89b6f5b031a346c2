#include <cli/columns.h>

#include <algorithm>
#include <cstddef>
#include <iostream>

namespace mobbscope::cli {

void print_columns(const std::vector<Column>& columns, bool first_to_left) {
    std::vector<std::string> lines(columns.front().size(), " ");
    for (const Column& cells : columns) {
        const bool is_first = &cells == &columns.front();
        const std::size_t width = std::ranges::max(cells, {}, &std::string::size).size();
        const std::string gap(is_first ? 1 : 3, ' ');
        for (std::size_t i = 0; i < lines.size(); ++i) {
            const std::string room(width - cells[i].size(), ' ');
            lines[i] += gap;
            lines[i] += is_first && first_to_left ? cells[i] + room : room + cells[i];
        }
    }
    for (const std::string& line : lines) std::cout << line << '\n';
}

}  // namespace mobbscope::cli
