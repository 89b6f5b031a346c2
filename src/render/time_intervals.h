/// When the two nodes under test take place, as bars beside the time axis.
#pragma once

#include <render/draw_list.h>
#include <render/subject.h>
#include <render/surroundings.h>

#include <mobb/trace.h>

#include <span>

namespace mobbscope {

/// A bar for each side in its colour, and where they are apart in time the gap between them, dashed as that outcome is.
/// Nothing where the time axis is seen end on. Needs the lens. `sides`: A and B.
void add_time_intervals(DrawList& list, const Stage& stage, std::span<const Subject> sides,
                        const mobb::Trace::Event& event, float scale);

}  // namespace mobbscope
