/// What an event of a trace is shown as, wherever events are shown: told apart by colour, and by shape or words too.
#pragma once

#include <mobb/trace.h>
#include <render/drawlist/draw_list.h>

#include <array>
#include <cstddef>

namespace mobbscope::app {

/// In order of how much it says: where many are drawn on one pixel, the last is on top.
enum class EventMark { shares_time, apart_in_time, separated, overlap, no_hit, hit };
inline constexpr std::size_t kEventMarks = 6;

EventMark mark_of(mobb::TestKind test, mobb::Outcome outcome);

/// The state whose colour and line it has in pictures; a time test that finds common time has none.
BoxState state_of(EventMark mark);

/// "Separated in space"
const char* headline(EventMark mark);

/// How many events of each mark, in the order of EventMark.
using MarkCounts = std::array<int, kEventMarks>;

}  // namespace mobbscope::app
