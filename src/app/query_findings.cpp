#include <app/query_findings.h>

namespace mobbscope::app {

QueryFindings find_out(const FittedScene& fitted, const ViewState& view, const RecordedQuery& recorded) {
    QueryFindings out;
    out.sides = subjects(fitted, view);
    const mobb::PlacedTree& a = out.sides[0].placed;
    const mobb::PlacedTree& b = out.sides[1].placed;
    out.clearance = clearance_over_time(a.placed_clip(), b.placed_clip());
    if (!out.clearance.contact) out.floor = floor_paths(a.placed_clip(), b.placed_clip());
    out.recursion = recursion_of(recorded.trace, a, b);
    return out;
}

}  // namespace mobbscope::app
