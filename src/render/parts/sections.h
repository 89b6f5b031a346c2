/// Slabs of time, and where boxes meet a moment.
#pragma once

#include <render/drawlist/draw_list.h>
#include <render/parts/floor_and_axes.h>
#include <render/text/labels.h>
#include <scene/view_state.h>

#include <optional>
#include <span>
#include <vector>

namespace mobbscope {

/// The slab of a view in space-time; none: it has none.
std::optional<DrawnSlab> slab_of_view(const ViewState& view, const DrawnSpace& space);

/// The outlines of its two planes, of those that lie within the extent, and around what they cut of boxes.
void add_slab_planes(DrawList& list, const FloorExtent& floor_extent, const ValueRange& slab, float scale);
/// Their times.
std::vector<LabelRequest> slab_labels(const DrawList& list, const FloorExtent& floor_extent, const ValueRange& slab,
                                      float size);

/// The sections of boxes with the level plane at a height, drawn at another one: filled, with outlines that are seen
/// through all.
void add_sections(DrawList& list, std::span<const BoxInstance> boxes, float height, float drawn_at, float scale);

}  // namespace mobbscope
