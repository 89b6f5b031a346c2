/// The legend: what every colour and line of the picture stands for.
#pragma once

#include <explain/query_progress.h>
#include <render/drawlist/draw_list.h>
#include <render/query/query_boxes.h>
#include <scene/drawn_agent.h>

#include <span>
#include <string>
#include <vector>

namespace mobbscope {

/// The entries for what the list shows. `progress`: of the query in the view, or null. Remarks come last.
std::vector<LegendEntry> legend_entries(const DrawList& list, std::span<const DrawnAgent> agents, const ViewState& view,
                                        const Emphasis& emphasis, const QueryProgress* progress);

/// The colours of the first few, and how many more there are.
std::vector<LegendEntry> agent_entries(std::span<const DrawnAgent> agents);

/// What lines of a style (at scale 1) stand for.
LegendEntry line_entry(const LineStyle& style, std::string text);

/// How large the legend is, pixels.
glm::vec2 legend_size(std::span<const LegendEntry> entries, float text_size);

/// Adds it with its upper left corner at a point.
void add_legend(DrawList& list, glm::vec2 corner, float text_size);

}  // namespace mobbscope
