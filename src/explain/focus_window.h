/// The part of a query that lists and counts are restricted to.
#pragma once

#include <explain/recursion.h>
#include <mobb/trace.h>

#include <optional>
#include <vector>

namespace mobbscope {

/// All of the query, unless one of them is set.
struct FocusWindow {
    std::optional<mobb::Interval> time;  ///< global seconds: pairs whose nodes both have a part in it
    std::optional<int> branch;           ///< a pair, by its index: it and those below it

    bool is_all() const { return !time && !branch; }
    friend bool operator==(const FocusWindow& a, const FocusWindow& b) {
        const auto same_time = [](const auto& x, const auto& y) {
            return x.has_value() == y.has_value() && (!x || (x->t0 == y->t0 && x->t1 == y->t1));
        };
        return a.branch == b.branch && same_time(a.time, b.time);
    }
};

/// By event: whether it is in the focus; empty where all are.
using InFocus = std::vector<char>;
InFocus events_in(const Recursion& recursion, const FocusWindow& focus);

struct FocusCounts {
    mobb::TestCounts tests;
    std::int64_t avoidable = 0;  ///< overlaps, of those that were judged
};
/// What had been counted in the focus after an event.
FocusCounts counts_in(const InFocus& focus, const mobb::Trace& trace, const Recursion& recursion, int step);

}  // namespace mobbscope
