#include <explain/recursion.h>

#include <algorithm>

namespace mobbscope {

Recursion recursion_of(const mobb::Trace& trace, const mobb::PlacedTree& a, const mobb::PlacedTree& b,
                       std::int64_t most_visits, const Progress& progress) {
    Recursion out;
    out.stopped = trace.stopped();
    out.pair_of.resize(static_cast<std::size_t>(trace.size()));
    for (int step = 0; step < trace.size(); ++step) {
        const mobb::Trace::Event event = trace[step];
        const int parent = event.parent < 0 ? -1 : out.pair_of[static_cast<std::size_t>(event.parent)];
        // A pair's own tests stand together: what it calls comes behind them.
        const bool same = !out.pairs.empty() && out.pairs.back().a == event.a && out.pairs.back().b == event.b &&
                          out.pairs.back().parent == parent && out.pairs.back().depth == event.depth;
        if (!same) {
            const mobb::Node& node_a = a.node(event.a);
            const mobb::Node& node_b = b.node(event.b);
            out.pairs.push_back({.a = event.a,
                                 .b = event.b,
                                 .parent = parent,
                                 .depth = event.depth,
                                 .first = step,
                                 .time_a = {a.begin(node_a), a.end(node_a)},
                                 .time_b = {b.begin(node_b), b.end(node_b)}});
            out.depth = std::max(out.depth, event.depth + 1);
        }
        RecursionPair& pair = out.pairs.back();
        pair.last = step;
        pair.end = step + 1;
        pair.outcome = event.outcome;
        pair.hit = event.outcome == mobb::Outcome::hit;
        out.pair_of[static_cast<std::size_t>(step)] = static_cast<int>(out.pairs.size()) - 1;
    }
    out.pairs.shrink_to_fit();
    for (std::size_t i = out.pairs.size(); i-- > 0;) {
        const RecursionPair& pair = out.pairs[i];
        if (pair.parent < 0) continue;
        RecursionPair& above = out.pairs[static_cast<std::size_t>(pair.parent)];
        above.end = std::max(above.end, pair.end);
        above.hit = above.hit || pair.hit;
    }
    out.avoidable = avoidable_overlaps(trace, a, b, most_visits, progress);
    for (const int event : out.avoidable.events) {
        const int pair = out.pair_of[static_cast<std::size_t>(event)];
        out.pairs[static_cast<std::size_t>(pair)].avoidable = true;
    }
    return out;
}

}  // namespace mobbscope
