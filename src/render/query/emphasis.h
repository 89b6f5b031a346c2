/// Which disks a picture points out, decided once: what draws them and what explains them cannot disagree.
#pragma once

#include <explain/query_progress.h>
#include <scene/drawn_agent.h>

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace mobbscope {

struct Emphasis {
    std::optional<double> cursor;               ///< global seconds, where the time cursor is drawn
    std::vector<std::optional<int>> at_cursor;  ///< by subject: the sample that holds then
    std::optional<std::array<int, 2>> hits;     ///< samples of A and B that collide
    bool dims = false;                          ///< disks outside the nodes under test step back

    /// True if any path has a sample at the cursor.
    bool cuts() const;
};

/// `begin`, `end`: of the paths. `progress`: of the query in the view, or null.
Emphasis emphasis_of(const ViewState& view, std::span<const DrawnAgent> agents, double begin, double end,
                     const QueryProgress* progress);

}  // namespace mobbscope
