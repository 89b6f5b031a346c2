/// The picture of a motion graph: its hubs with the moves between them as arrows, and for each hub the floor paths that
/// moves take from it.
#pragma once

#include <render/drawlist/draw_list.h>
#include <scene/scene.h>

namespace mobbscope {

/// What is drawn of the scene's graph. Widths of arrows say how many moves they stand for, colours how fast those are
/// on average; all floor paths have one scale. `scale` as in metrics_of. Throws std::invalid_argument for a size that
/// no picture has, or if the scene has no graph with moves.
DrawList graph_picture(const Scene& scene, PictureSize size, Theme theme, double scale = 0);

}  // namespace mobbscope
