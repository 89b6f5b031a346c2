/// The tabs of the panel below the picture.
#pragma once

#include <app/panels/level_strip.h>
#include <app/ui/data_table.h>
#include <app/ui/ui.h>

namespace mobbscope::app {

/// The tab that is shown. Without tests of a query there is no list of events.
BottomTab shown_tab(const Ui& ui);
/// Whether that one has lists or charts, for which the panel is higher.
bool is_high(BottomTab tab);
/// On one line.
void bottom_tabs(Ui& ui);

/// The nodes of the tree in focus as a table, and above it, where there is room, its levels on the timeline's axis.
void node_list(Ui& ui, DataTable& table, LevelStrip& levels, const ChartAxis& time);

}  // namespace mobbscope::app
