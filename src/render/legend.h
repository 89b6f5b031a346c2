/// The legend: what every colour and line of the picture stands for.
#pragma once

#include <render/draw_list.h>
#include <render/emphasis.h>
#include <render/query_progress.h>
#include <render/subject.h>

#include <span>

namespace mobbscope {

/// The entries for what the list shows. `progress`: of the query in the view, or null. Remarks come last.
std::vector<LegendEntry> legend_entries(const DrawList& list, std::span<const Subject> subjects, const ViewState& view,
                                        const Emphasis& emphasis, const QueryProgress* progress);

/// The colours of the first few, and how many more there are.
std::vector<LegendEntry> agent_entries(std::span<const Subject> subjects);

/// How large the legend is, pixels.
glm::vec2 legend_size(std::span<const LegendEntry> entries, float text_size);

/// Adds it with its upper left corner at a point.
void add_legend(DrawList& list, glm::vec2 corner, float text_size);

}  // namespace mobbscope
