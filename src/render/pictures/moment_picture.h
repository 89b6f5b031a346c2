/// The picture of one moment: the floor in metres with real height above it, and people in their cylinders.
#pragma once

#include <render/pictures/picture.h>

#include <memory>

namespace mobbscope {

/// Of the view's time, or without one of when the first path in it begins. With a query in the view only its two sides
/// are there. It is framed so that nothing moves but the people while time runs; of a run with its walls around it, and
/// the followed agent's `choice` on the floor (null: none). Scene and choice outlive the picture. Throws
/// std::invalid_argument if the scene has nothing to draw, or no such query.
std::unique_ptr<Picture> moment_picture(const FittedScene& fitted, const ViewState& view, const PictureOptions& options,
                                        const FollowedChoice* choice);

}  // namespace mobbscope
