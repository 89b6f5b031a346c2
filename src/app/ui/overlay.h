/// What a picture has over its world, drawn into a panel.
#pragma once

#include <app/ui/ui.h>

namespace mobbscope::app {

/// Panels, lines, marks and texts of a picture whose upper left corner is at `corner`, in the fonts of the panels.
void draw_overlay(Ui& ui, const DrawnOverlay& overlay, ImVec2 corner);

}  // namespace mobbscope::app
