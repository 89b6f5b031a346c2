/// (scene, view state, size) -> draw list: all decisions about a picture, in numbers, without OpenGL.
#pragma once

#include <render/draw_list.h>
#include <scene/fitted_scene.h>
#include <scene/view_state.h>

namespace mobbscope {

/// Throws std::invalid_argument, saying what is allowed, if the view names a query or a step that there is not, or the
/// scene has nothing to draw.
DrawList build_draw_list(const FittedScene& fitted, const ViewState& view, PictureSize size);

}  // namespace mobbscope
