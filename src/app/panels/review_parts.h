/// What the panels of picture tests share.
#pragma once

#include <app/document/review.h>
#include <app/ui/ui.h>

#include <string>

namespace mobbscope::app {

/// "differs", and with the numbers: "differs, 412 px, up to 184".
std::string outcome_word(const ReviewCase& one);
std::string outcome_words(const ReviewCase& one);
/// Readable as text.
ImU32 outcome_color(const Style& style, const ReviewCase& one);
/// A shape for each outcome, so that none is told by its colour alone: a tick, an unequal sign, an empty circle with a
/// stroke, a cross, a dash; a ring for what waits, a dot for what is not drawn.
void outcome_shape(ImDrawList& list, const Style& style, ImVec2 middle, float side, const ReviewCase& one);

/// "12 passed, 3 different, 2 to draw".
std::string sum_of(const Review& review);

}  // namespace mobbscope::app
