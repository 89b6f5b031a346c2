/// What --play goes through.
#pragma once

#include <scene/view_state.h>

namespace mobbscope {

/// Whether it is the steps of the view's query; else the motion.
inline bool plays_steps(const ViewState& view) { return view.query && view.show == Show::space_time; }

/// Pictures a second of a film: of steps so few that the sentence of each can be read.
inline constexpr double kUsualRate = 30;
inline constexpr double kUsualRateOfSteps = 2;
/// Seconds that the last step stays on.
inline constexpr double kLastStepHeld = 2;

}  // namespace mobbscope
