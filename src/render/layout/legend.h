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

/// The entries for what is seen in the list's picture. `progress`: of the query in the view, or null. Remarks come
/// last. Needs the projection.
std::vector<LegendEntry> legend_entries(const DrawList& list, std::span<const DrawnAgent> agents, const ViewState& view,
                                        const Emphasis& emphasis, const QueryProgress* progress);

/// The colours of those whose paths are seen. `paths`: all of them; of a run somebody has several. Needs the
/// projection.
std::vector<LegendEntry> agent_entries(const DrawList& list, std::span<const DrawnAgent> agents,
                                       std::span<const DrawnAgent> paths);

/// What lines of a style (at scale 1) stand for.
LegendEntry line_entry(const LineStyle& style, std::string text);

/// What the walls of a proof stand for.
LegendEntry proof_entry(const Palette& palette);

/// How large rows of a legend are, pixels. `text_room`: words longer than that are cut off.
glm::vec2 legend_size(std::span<const LegendEntry> rows, float text_size, float text_room);
/// How high a row is, pixels.
float legend_row(float text_size);
/// Where the words of a row begin: pixels from its left end.
float legend_indent(const LegendEntry& row, float text_size);

/// Adds rows with their upper left corner at a point. Returns whether all their words have room.
bool add_legend(DrawList& list, std::span<const LegendEntry> rows, glm::vec2 corner, float text_size, float text_room);

}  // namespace mobbscope
