/// How the query in view is looked at, beside its step. Another query begins anew.
#pragma once

#include <explain/focus_window.h>

#include <optional>

namespace mobbscope::app {

/// The events first .. end - 1.
struct EventRange {
    int first = 0;
    int end = 0;

    int size() const { return end - first; }
    friend bool operator==(const EventRange&, const EventRange&) = default;
};

struct QueryLook {
    FocusWindow focus;
    std::optional<EventRange> zoom;  ///< of strip and icicle; none: all events

    struct Sample {
        int side = 0;  ///< 0: A, 1: B
        int index = 0;
    };
    struct Point {
        double time_a = 0, time_b = 0;
    };
    // Whose reasons are listed: of one of these, else of the moment of the time cursor.
    std::optional<Sample> sample;
    std::optional<Point> point;
};

}  // namespace mobbscope::app
