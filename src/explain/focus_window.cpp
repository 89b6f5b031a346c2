#include <explain/focus_window.h>

#include <algorithm>

namespace mobbscope {

InFocus events_in(const Recursion& recursion, const FocusWindow& focus) {
    if (focus.is_all()) return {};
    InFocus out(recursion.pair_of.size());
    for (std::size_t i = 0; i < recursion.pairs.size(); ++i) {
        const RecursionPair& pair = recursion.pairs[i];
        if (focus.branch) {
            const RecursionPair& branch = recursion.pairs[static_cast<std::size_t>(*focus.branch)];
            if (pair.first < branch.first || pair.end > branch.end) continue;
        }
        if (focus.time) {
            const double begin = std::max({pair.time_a.t0, pair.time_b.t0, focus.time->t0});
            if (begin >= std::min({pair.time_a.t1, pair.time_b.t1, focus.time->t1})) continue;
        }
        std::fill(out.begin() + pair.first, out.begin() + pair.last + 1, 1);
    }
    return out;
}

FocusCounts counts_in(const InFocus& focus, const mobb::Trace& trace, const Recursion& recursion, int step) {
    if (focus.empty()) {
        return {trace.counts(step + 1), recursion.avoidable.before(step + 1)};
    }
    FocusCounts out;
    for (int event = 0; event <= step; ++event) {
        if (focus[static_cast<std::size_t>(event)] == 0) continue;
        const mobb::Trace::Event test = trace[event];
        const bool samples = test.test == mobb::TestKind::samples;
        out.tests[test.test] += samples ? static_cast<std::int64_t>(test.pairs.size()) : 1;
        out.avoidable += recursion.avoidable.at(event) ? 1 : 0;
    }
    return out;
}

}  // namespace mobbscope
