#include <explain/query_progress.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

namespace mobbscope {

namespace {

/// The events up to a step that are told of, in order; the step's own is always there. Not of Past::pair.
std::vector<int> events_of_past(const mobb::Trace& trace, int step, Past past) {
    const int parent = trace[step].parent;
    std::vector<int> out;
    // The two roots have no parent, and so no siblings.
    const int first = past == Past::all || parent < 0 ? 0 : parent + 1;
    for (int i = step; i >= first; --i) {
        const bool sibling = past == Past::siblings && parent >= 0 && trace[i].parent == parent;
        if (i == step || past == Past::all || sibling) out.push_back(i);
    }
    if (past != Past::all) {
        for (int i = parent; i >= 0; i = trace[i].parent) out.push_back(i);
    }
    std::ranges::reverse(out);
    return out;
}

}  // namespace

bool is_counted(const Step& step, const mobb::Trace& trace, int event, const mobb::Tree& a, const mobb::Tree& b) {
    const mobb::Trace::Event test = trace[event];
    switch (step.unit) {
        case Step::Unit::separated:
            return test.outcome == mobb::Outcome::separated;
        case Step::Unit::overlap:
            return test.outcome == mobb::Outcome::overlap;
        case Step::Unit::hit:
            return test.outcome == mobb::Outcome::hit;
        case Step::Unit::depth:
            return test.depth == static_cast<int>(step.value);
        case Step::Unit::leaf: {
            if (!a.is_leaf(test.a) || !b.is_leaf(test.b)) return false;
            if (event + 1 == trace.size()) return true;
            const mobb::Trace::Event next = trace[event + 1];
            return next.a != test.a || next.b != test.b;
        }
        case Step::Unit::avoidable:
        case Step::Unit::event:
        case Step::Unit::percent:
        case Step::Unit::end:
            break;
    }
    return false;
}

int event_of(const Step& step, const mobb::Trace& trace, const FittedScene& fitted, int query) {
    const int last = trace.size() - 1;
    if (last < 0) throw ViewMismatch("step", "the query made no test: it has no steps");
    switch (step.unit) {
        case Step::Unit::end:
            return last;
        case Step::Unit::percent:
            return static_cast<int>(std::lround(step.value / 100 * last));
        case Step::Unit::event:
            if (step.value >= 0 && step.value <= last) return static_cast<int>(step.value);
            throw ViewMismatch("step", "there is no step " + std::to_string(static_cast<long long>(step.value)) +
                                           ": the query's go from 0 to " + std::to_string(last));
        case Step::Unit::separated:
        case Step::Unit::overlap:
        case Step::Unit::hit:
        case Step::Unit::avoidable:
        case Step::Unit::leaf:
        case Step::Unit::depth:
            break;
    }
    const SceneQuery asked = fitted.queries()[static_cast<std::size_t>(query)];
    const mobb::PlacedTree placed_a = fitted.placed(asked.a);
    const mobb::PlacedTree placed_b = fitted.placed(asked.b);
    const int wanted = step.unit == Step::Unit::depth ? 1 : static_cast<int>(step.value);
    int found = 0;
    for (int event = 0; event <= last; ++event) {
        const bool counts = step.unit == Step::Unit::avoidable
                                ? avoidable_overlap(placed_a, placed_b, trace[event]).has_value()
                                : is_counted(step, trace, event, placed_a.tree(), placed_b.tree());
        found += counts ? 1 : 0;
        if (found == wanted) return event;
    }
    const std::string there_is = found == 0 ? "none" : "only " + std::to_string(found);
    throw ViewMismatch("step", "there is no step " + to_string(step) + ": the query has " + there_is);
}

QueryProgress progress_at(const mobb::Trace& trace, int step, Past past) {
    QueryProgress out;
    out.step = step;
    out.event = trace[step];
    if (past == Past::pair) return out;
    std::array<std::map<int, NodeProgress>, 2> known;
    for (const int i : events_of_past(trace, step, past)) {
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
