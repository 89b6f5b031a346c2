/// Where legend and floor map stand: in corners, clear of each other and, if possible, of the scene.
#pragma once

#include <render/drawlist/draw_list.h>

#include <optional>
#include <span>

namespace mobbscope {

struct Blocks {
    std::optional<Rect> legend;
    std::optional<Rect> map;
    bool covers = false;  ///< one of them lies over some of the scene
};

/// Corners of `area` for blocks of these sizes (0: there is none). The two never overlap: where no corner is left the
/// map is dropped, and a block larger than the area is. `busy`: what they had better not cover.
Blocks place_blocks(const Rect& area, glm::vec2 legend, glm::vec2 map, std::span<const Rect> busy);

}  // namespace mobbscope
