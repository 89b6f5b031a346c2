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

/// How the boxes of the pair under test are outlined.
enum class PairOutline {
    owner,    ///< in their agents' colours: the outcomes' are those of the pairs before it
    outcome,  ///< by how its test ended: there are no others
};
PairOutline pair_outline(const ViewState& view);
/// Of one side's box, whose faces always have the agent's colour.
OutcomeStyle pair_style(PairOutline outline, const Subject& side, mobb::Outcome outcome, const Palette& palette);

/// `sides`: A and B. With PairOutline::outcome only the pair's. `scale`: of line widths.
void add_query_boxes(DrawList& list, std::span<const Subject> sides, const QueryProgress& progress, PairOutline outline,
                     float scale);

}  // namespace mobbscope
