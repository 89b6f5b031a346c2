/// (scene, view state, size) -> draw list: all decisions about a picture, in numbers, without OpenGL.
#pragma once

#include <render/draw_list.h>
#include <render/metrics.h>
#include <render/picture_options.h>
#include <scene/fitted_scene.h>
#include <scene/view_state.h>

namespace mobbscope {

/// `scale`: of text and lines, kLeastScale..kMostScale (1 suits 1280x720); 0: what suits the size. Throws
/// std::invalid_argument, saying what is allowed, if the scale is another, the view names a query or a step that there
/// is not, or the scene has nothing to draw.
DrawList build_draw_list(const FittedScene& fitted, const ViewState& view, PictureSize size, double scale = 0);

/// The same with a background: an opaque one replaces the palette's. The samples are the renderer's.
DrawList build_draw_list(const FittedScene& fitted, const ViewState& view, const PictureOptions& options);

}  // namespace mobbscope
