/// What colours the boxes of levels that a view shows, where a figure does: one scale for the picture, its legend, the
/// panel with its histogram, and the pictures beside it.
#pragma once

#include <explain/scene_figures.h>
#include <render/drawlist/color_scale.h>
#include <scene/fitted_scene.h>
#include <scene/view_state.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace mobbscope {

struct BoxColors {
    std::vector<double> values;  ///< of the boxes; NaN is none
    /// What the colours are spread over if nobody has chosen their ends: those, all that there could be, and what
    /// pictures beside have.
    std::vector<double> range;
    ColorScale scale{};
    std::string unknown{};  ///< where there is no value: why
};

/// Those of a view, with a scale for its picture alone; none: no figure colours its boxes. `fitted`: of a run what it
/// is at the view's time (fitted_at). A run has the same scale at all times: that of the boxes of all its moves. Throws
/// ViewMismatch as drawn_agents does.
std::optional<BoxColors> box_colors(SceneFigures& figures, const std::shared_ptr<const FittedScene>& fitted,
                                    const ViewState& view);

/// Whether two views of one scene have the same figures and scale.
bool are_colored_alike(const ViewState& a, const ViewState& b);

/// Of pictures side by side, null where one has none: those that have colours by one figure get one scale, but for
/// those whose ends somebody has chosen.
void share_scale(const std::vector<BoxColors*>& beside);

}  // namespace mobbscope
