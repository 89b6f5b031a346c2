/// The picture of one moment: the floor in metres with real height above it, and people in their cylinders.
#pragma once

#include <render/drawlist/draw_list.h>
#include <render/drawlist/picture_options.h>
#include <scene/fitted_scene.h>

namespace mobbscope {

struct FollowedChoice;  // crowd/simulation/followed.h

/// What build_draw_list makes of a view that shows a moment: its time, or without one when the first path in it begins.
/// With a query in the view only its two sides are there. It is framed so that nothing moves but the people while time
/// runs; of a run with its walls around it, and the followed agent's `choice` on the floor (null: none). Throws
/// std::invalid_argument if the scene has nothing to draw, or no such query.
DrawList build_moment(const FittedScene& fitted, const ViewState& view, const PictureOptions& options,
                      const FollowedChoice* choice = nullptr);

}  // namespace mobbscope
