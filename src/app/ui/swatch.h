/// Outcomes as cells: each has its colour and its own filling, so that they are told apart without colour as well.
#pragma once

#include <app/ui/ui.h>
#include <mobb/trace.h>
#include <render/drawlist/draw_list.h>

#include <array>
#include <cstddef>

namespace mobbscope::app {

/// In order of how much it says: where many are drawn on one pixel, the last is on top.
enum class EventMark { shares_time, apart_in_time, separated, overlap, no_hit, avoidable, hit };
inline constexpr std::size_t kEventMarks = 7;

EventMark mark_of(mobb::TestKind test, mobb::Outcome outcome);

/// "Separated in space"
const char* headline(EventMark mark);

/// How many events of each mark, in the order of EventMark.
using MarkCounts = std::array<int, kEventMarks>;

/// Opaque, for lines and fillings. `strength` 1: full; less steps back.
ImU32 mark_color(const Style& style, EventMark mark, float strength = 1);
/// Readable as text.
ImU32 mark_text(const Style& style, EventMark mark);

/// Separated in space: solid. Apart in time: an empty dashed outline. Overlap: hatched.
/// Avoidable overlap: striped across. Hit: solid with a cross in it.
void outcome_cell(ImDrawList& list, const Style& style, ImVec2 min, ImVec2 max, EventMark mark, float strength);

/// A cell of `side` pixels at the cursor, in the middle of a line of text.
void outcome_sign(Ui& ui, EventMark mark, float side);

/// A line in dashes of `on` pixels.
void dashed_line(ImDrawList& list, ImVec2 from, ImVec2 to, ImU32 color, float width, float on);

/// What the cells mean, on as many lines as it takes.
void outcome_legend(Ui& ui);

}  // namespace mobbscope::app
