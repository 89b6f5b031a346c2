/// How many words a picture has room for: caption, legend and floor map share a part of it, the scene has the rest.
#pragma once

#include <render/drawlist/draw_list.h>
#include <render/drawlist/metrics.h>
#include <render/layout/caption.h>

#include <vector>

namespace mobbscope {

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
