/// Where legend and floor map stand: in corners, clear of each other and, if possible, of the scene.
#pragma once

#include <render/drawlist/draw_list.h>
#include <render/drawlist/picture_options.h>
#include <render/layout/caption.h>
#include <render/parts/floor_and_axes.h>

#include <optional>
#include <span>
#include <vector>

namespace mobbscope {

struct Blocks {
    std::optional<Rect> legend;
    std::optional<Rect> map;
    bool covers = false;  ///< one of them lies over some of the scene
};

/// Corners of `area` for blocks of these sizes (0: there is none). The two never overlap: where no corner is left the
/// map is dropped, and a block larger than the area is. `busy`: what they had better not cover.
Blocks place_blocks(const Rect& area, glm::vec2 legend, glm::vec2 map, std::span<const Rect> busy);

/// Where the scene's paths, boxes and the labels around it are, as small rectangles. Needs the projection.
std::vector<Rect> occupied(const DrawList& list, const FloorExtent& floor_extent, const ViewState& view,
                           const Metrics& metrics);

/// How much of a picture words may cover.
inline constexpr float kMostWords = 0.35f;

struct TextBudget {
    CaptionLines caption;
    std::vector<LegendEntry> legend;  ///< empty: none
    glm::vec2 map{0};                 ///< pixels; 0: none
};

/// Drops, until the rest takes no more than kMostWords: the legend's remarks, the map, the legend, the detail, then the
/// headline's second line, and the headline.
TextBudget fit_to_budget(const Caption& caption, std::vector<LegendEntry> legend, glm::vec2 map, PictureSize size,
                         const Metrics& metrics);

}  // namespace mobbscope
