/// Space-time above the floor of a crowd: what everybody plays within a few seconds of one time.
#pragma once

#include <render/pictures/picture.h>

#include <cstddef>
#include <memory>

namespace mobbscope {

/// Of a run that scene_at made a scene, in space-time. The plane of the view's time stays where it is while time runs,
/// and the stacks sink through it. `choice`: of the followed agent, or null. Both outlive the picture. Throws
/// std::invalid_argument if the view follows nobody there is, or asks for a query.
std::unique_ptr<Picture> crowd_picture(const FittedScene& fitted, const ViewState& view, const PictureOptions& options,
                                       const FollowedChoice* choice);

/// Boxes of more people would bury everything: those of the followed one are shown alone.
inline constexpr std::size_t kMostCrowdBoxes = 200;

}  // namespace mobbscope
