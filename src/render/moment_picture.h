/// The picture of one moment: the floor in metres with real height above it, and people in their cylinders.
#pragma once

#include <render/draw_list.h>
#include <render/picture_options.h>
#include <scene/fitted_scene.h>

namespace mobbscope {

/// When the picture of a moment is: the view's time, or when the first path in it begins. The scene must have clips.
double moment_in(const FittedScene& fitted, const ViewState& view);

/// What build_draw_list makes of a view that shows a moment. With a query in the view only its two sides are there. It
/// is framed so that nothing moves but the people while time runs. Throws as build_draw_list.
DrawList build_moment(const FittedScene& fitted, const ViewState& view, const PictureOptions& options);

}  // namespace mobbscope
