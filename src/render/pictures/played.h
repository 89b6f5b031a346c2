/// What --play goes through.
#pragma once

#include <scene/view_state.h>

namespace mobbscope {

/// Whether it is the steps of the view's query; else the motion.
inline bool plays_steps(const ViewState& view) { return view.query && view.show == Show::space_time; }

/// Pictures a second: of steps those that can be read as they pass.
inline constexpr double kUsualRate = 30;
inline constexpr double kUsualRateOfSteps = 10;

}  // namespace mobbscope
