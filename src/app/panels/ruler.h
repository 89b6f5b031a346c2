/// Numbers along charts.
#pragma once

#include <app/ui/widgets.h>

namespace mobbscope::app {

/// Labelled ticks below a chart, as many as have room, all with the same decimals.
void ruler(const Ui& ui, const ImFont& font, const ChartAxis& axis, float y, const char* unit);

}  // namespace mobbscope::app
