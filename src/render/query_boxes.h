/// A query at a step: the pair under test, and the nodes tested before it.
#pragma once

#include <render/draw_list.h>
#include <render/query_progress.h>
#include <render/subject.h>

#include <span>

namespace mobbscope {

/// Colour and line of an outcome.
struct OutcomeStyle {
    Rgba color;
    Dash dash = kSolid;
    float width = 1;  ///< pixels at scale 1
};
OutcomeStyle outcome_style(BoxState state, const Palette& palette);

/// `sides`: A and B. `scale`: of line widths.
void add_query_boxes(DrawList& list, std::span<const Subject> sides, const QueryProgress& progress, float scale);

}  // namespace mobbscope
