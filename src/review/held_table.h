/// A golden of numbers and what there is now, side by side.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace mobbscope::app {

struct HeldRow {
    std::string of;              ///< "query 0, A and B", "fit of 'walk', node 3": rows of one stand together
    std::string what;            ///< "tests time"
    std::string golden, actual;  ///< empty: that side has none
    std::string ratio;           ///< of tests: "13 times fewer"
    bool changed = true;
};

/// Of answers that differ all rows, but for tests that neither side has; of nodes those that differ, of a trace those
/// of its first event that does. Without a golden all that there is. Empty if a side cannot be read.
std::vector<HeldRow> held_rows(const std::optional<std::string>& golden, const std::string& actual);

}  // namespace mobbscope::app
