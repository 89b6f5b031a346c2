#include <explain/query_progress.h>
#include <scene/view_state.h>

#include <cmath>
#include <map>
#include <string>

namespace mobbscope {

int event_of(const Step& step, const mobb::Trace& trace) {
    const int last = trace.size() - 1;
    if (last < 0) throw ViewMismatch("step", "the query made no test: it has no steps");
    switch (step.unit) {
        case Step::Unit::end:
            return last;
        case Step::Unit::percent:
            return static_cast<int>(std::lround(step.value / 100 * last));
        case Step::Unit::event:
            break;
    }
    if (step.value < 0 || step.value > last) {
        throw ViewMismatch("step", "there is no step " + std::to_string(static_cast<long long>(step.value)) +
                                       ": the query's go from 0 to " + std::to_string(last));
    }
    return static_cast<int>(step.value);
}

QueryProgress progress_at(const mobb::Trace& trace, int step) {
    QueryProgress out;
    out.step = step;
    out.event = trace[step];
    std::array<std::map<int, NodeProgress>, 2> known;
    for (int i = 0; i <= step; ++i) {
        const mobb::Trace::Event event = trace[i];
        const std::array<int, 2> nodes{event.a, event.b};
        for (std::size_t side = 0; side < 2; ++side) {
            NodeProgress& node = known[side][nodes[side]];
            node.event = i;
            node.outcome = event.outcome;
            if (event.parent < 0) continue;
            const mobb::Trace::Event parent = trace[event.parent];
            const int above = side == 0 ? parent.a : parent.b;
            if (above != nodes[side]) known[side][above].refined = true;
        }
    }
    // The pairs that called this one are still open, whatever their nodes met since; a hit settles them all.
    const bool hit = out.event.outcome == mobb::Outcome::hit;
    for (int i = out.event.parent; i >= 0; i = trace[i].parent) {
        const mobb::Trace::Event event = trace[i];
        for (std::size_t side = 0; side < 2; ++side) {
            NodeProgress& node = known[side][side == 0 ? event.a : event.b];
            node.open = true;
            node.outcome = hit ? mobb::Outcome::hit : mobb::Outcome::overlap;
        }
    }
    for (std::size_t side = 0; side < 2; ++side) {
        known[side].erase(side == 0 ? out.event.a : out.event.b);
        for (auto& [index, node] : known[side]) {
            node.node = index;
            out.nodes[side].push_back(node);
        }
    }
    return out;
}

}  // namespace mobbscope
