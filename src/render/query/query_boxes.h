/// A query at a step: the pair under test, and the nodes tested before it.
#pragma once

#include <explain/query_progress.h>
#include <mobb/trace.h>
#include <render/drawlist/draw_list.h>
#include <render/parts/floor_and_axes.h>
#include <scene/drawn_agent.h>

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace mobbscope {

/// What a pair's boxes become by the outcome of a test.
BoxState box_state(mobb::Outcome outcome);
/// ... and those of the pair under test.
BoxState state_found(const QueryProgress& progress);

/// Colour and line of an outcome, at scale 1.
LineStyle outcome_style(BoxState state, const Palette& palette);

/// How the boxes of the pair under test are outlined.
enum class PairOutline {
    owner,    ///< in their agents' colours: the outcomes' are those of the pairs before it
    outcome,  ///< by how its test ended: there are no others (Past::pair)
};
PairOutline pair_outline(const ViewState& view);
/// `found`: by the test. Of one side's box, whose faces always have the agent's colour.
LineStyle pair_style(PairOutline outline, const DrawnAgent& side, BoxState found, const Palette& palette);

/// Those of the pair under test and of the nodes that the progress tells of. `sides`: A and B. `scale`: of line widths.
void add_query_boxes(DrawList& list, std::span<const DrawnAgent> sides, const QueryProgress& progress,
                     PairOutline outline, float scale);

/// A bar for each side in its colour, and where they are apart in time the gap between them, dashed as that outcome is.
/// Nothing where the time axis is seen end on. Needs the projection. `sides`: A and B.
void add_time_intervals(DrawList& list, const FloorExtent& floor_extent, std::span<const DrawnAgent> sides,
                        const mobb::Trace::Event& event, float scale);

struct Emphasis {
    std::optional<double> cursor;               ///< global seconds, where the time cursor is drawn
    std::vector<std::optional<int>> at_cursor;  ///< by agent: the sample that holds then
    std::optional<std::array<int, 2>> hits;     ///< samples of A and B that collide
    double hit_time = 0;                        ///< global seconds: when they begin to
    bool dims = false;                          ///< disks outside the nodes under test step back
};

/// `begin`, `end`: of the paths. `progress`: of the query in the view, or null.
Emphasis emphasis_of(const ViewState& view, std::span<const DrawnAgent> agents, double begin, double end,
                     const QueryProgress* progress);

}  // namespace mobbscope
