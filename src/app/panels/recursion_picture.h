/// A recursion in pixels: what is too small to be seen apart is put together, and nothing that says more is lost.
#pragma once

#include <app/document/query_look.h>
#include <app/ui/swatch.h>
#include <explain/recursion.h>

#include <vector>

namespace mobbscope::app {

/// The events [first, end) that stand in one column of a strip, or a single event.
struct StripCell {
    int first = 0;
    int end = 0;
    float x0 = 0;  ///< pixels from the left
    float x1 = 0;
    MarkCounts marks{};
};

/// Which events are shown.
struct ShownEvents {
    EventRange range;                ///< not empty
    const InFocus* focus = nullptr;  ///< null or empty: all of them

    bool has(int event) const { return !focus || focus->empty() || (*focus)[static_cast<std::size_t>(event)] != 0; }
};

/// Events of a trace side by side in `width` >= 1 pixels. No cell is narrower than a pixel, so a long trace has at most
/// `width` of them. A cell has no marks of events out of focus.
std::vector<StripCell> strip_cells(const mobb::Trace& trace, const Recursion& recursion, const ShownEvents& shown,
                                   int width);

/// A pair of nodes as a rectangle, or several that fall on the same pixels.
struct PairCell {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;  ///< pixels, [x0, x1) x [y0, y1), y downwards
    int pair = 0;                        ///< the first of those whose outcome says most
    int merged = 1;                      ///< how many pairs it stands for
};

/// Pairs as A's time (to the right) by B's (upwards), a and b over the whole picture; pairs with children come before
/// these. Sizes >= 1.
std::vector<PairCell> square_cells(const Recursion& recursion, mobb::Interval a, mobb::Interval b, int width,
                                   int height);

/// Pixels of a row of an icicle so high and deep, at a scale: not too low to be clicked, even if not all fit. High
/// enough for labels where an event is wide enough for them.
int icicle_row(float height, int depth, float scale, float event_width);
/// Pairs as the events of them and below them (to the right) by depth (downwards); rows of `row` pixels.
std::vector<PairCell> icicle_cells(const Recursion& recursion, const ShownEvents& shown, int width, int row);

/// How a pair's outcome is shown, and an event's.
EventMark mark_of(const RecursionPair& pair);
EventMark mark_of(const mobb::Trace& trace, const Recursion& recursion, int event);

}  // namespace mobbscope::app
