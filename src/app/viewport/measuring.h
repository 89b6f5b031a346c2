/// Measuring in the picture: what a click takes as an end, and how it is shown.
#pragma once

#include <app/document/measuring.h>
#include <app/ui/ui.h>
#include <app/viewport/agent_handles.h>

#include <glm/vec2.hpp>

#include <optional>

namespace mobbscope::app {

/// What a click on a pixel of the picture takes as an end: near a disk's centre or rim, or a box's corner, that; else
/// where a disk or the floor is under the pixel. None: there is nothing. `reach`: pixels that are near.
std::optional<MeasuredEnd> end_at(const Workspace& workspace, const DrawList& list, glm::vec2 pixel, float reach);

/// Which end of the measured line is at the mouse.
enum class LineEnd { none, from, to };
LineEnd line_end_at(const Ui& ui, const ShownPicture& picture);

/// Draws the measured line's numbers beside it, which copy themselves, and its ends; and while ends are picked the one
/// that a click would take, with what there is. Whether the mouse is on a number: a click is for that. The last item is
/// the picture.
bool draw_measuring(Ui& ui, const ShownPicture& picture, const std::optional<MeasuredEnd>& next);

}  // namespace mobbscope::app
