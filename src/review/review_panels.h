/// The panels of picture tests, and what they share.
#pragma once

#include <app/ui/ui.h>
#include <review/review.h>

#include <glm/vec2.hpp>

#include <optional>
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

void review_list(Ui& ui, const Review& review);                     ///< the cases and what came of them
std::optional<glm::ivec2> review_pictures(Ui& ui, Review& review);  ///< returns the pixel under the mouse
/// What differs, files, what can be done.
void review_facts(Ui& ui, Review& review, const std::optional<glm::ivec2>& pixel);
void review_way_back(Ui& ui);  ///< over the scene of a case

}  // namespace mobbscope::app
