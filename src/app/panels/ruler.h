/// Axes of charts: numbers along them, and the mouse and keys on those of time.
#pragma once

#include <app/ui/widgets.h>
#include <render/image/rect.h>

#include <optional>
#include <string>

namespace mobbscope::app {

/// Labelled ticks below a chart, as many as have room, all with the same decimals.
void ruler(const Ui& ui, const ImFont& font, const ChartAxis& axis, float y, const char* unit);

/// Round values along the height of a chart, as faint lines; their numbers stand left of it, or inside over the lines.
/// `left_out`: a value that has a line of its own.
void height_lines(const Ui& ui, const Rect& area, const ChartAxis& values, const std::string& unit, bool beside,
                  std::optional<double> left_out = {});

/// Words that stay inside a chart, on a ground that keeps them readable over curves.
void text_over(const Ui& ui, const Rect& area, ImVec2 at, ImU32 color, const std::string& text);

/// Left and Right on a chart of this mark move the time cursor by a sample.
void time_keys(const Ui& ui, const std::string& mark);
/// The time cursor follows the mouse.
void scrub_to(const Ui& ui, double time);

}  // namespace mobbscope::app
