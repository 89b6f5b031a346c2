/// Caption, legend and map of the floor: panels over the scene, each in a corner of its own that it keeps whatever the
/// step, the level or the camera is.
#pragma once

#include <render/drawlist/draw_list.h>
#include <render/drawlist/picture_options.h>
#include <render/layout/caption.h>
#include <render/layout/color_bar.h>
#include <scene/view_state.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace mobbscope {

/// What a picture says beside its labels.
struct OverlayContents {
    Caption caption;                  ///< without headlines there is none
    std::vector<LegendEntry> legend;  ///< empty: none
    std::vector<ColorBar> bars;       ///< above its rows
    std::string map_title;
    glm::vec2 map{0};  ///< size of the floor's map, pixels; 0: none
};

/// Rows of a legend that are shown where the view does not ask for the whole of it; the rest is counted.
inline constexpr std::size_t kLegendRows = 6;

/// How much of a picture unfolded overlays may cover, but for a legend that is asked for as a whole.
inline constexpr float kMostCovered = 0.35f;

/// Adds the caption at the upper left, the map at the upper right and the legend at the lower left. What the view
/// folds, and what has no room beside those before it in the order caption, legend, map, is there as its header.
/// `controls`: with what folds them. Returns where the map's lines go; none where it is folded.
std::optional<Rect> add_overlays(DrawList& list, const OverlayContents& contents, const ViewState& view,
                                 const Metrics& metrics, bool controls);

/// What the panels that add_overlays adds cover.
std::vector<Rect> overlay_rects(PictureSize size, const OverlayContents& contents, const ViewState& view,
                                const Metrics& metrics, bool controls);

}  // namespace mobbscope
