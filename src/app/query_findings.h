/// All that the window says about a query beyond its answer and trace; kept until scene or query change.
#pragma once

#include <app/clearance.h>
#include <app/floor_paths.h>
#include <app/recursion.h>
#include <render/subject.h>

#include <vector>

namespace mobbscope::app {

struct QueryFindings {
    std::vector<Subject> sides;  ///< A and B; refer to the fitted scene
    Clearance clearance;
    FloorPaths floor;  ///< known only where there is no contact
    Recursion recursion;
};

/// Requires a query in the view, and `recorded` to be its record.
QueryFindings find_out(const FittedScene& fitted, const ViewState& view, const RecordedQuery& recorded);

}  // namespace mobbscope::app
