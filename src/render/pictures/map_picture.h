/// A placement map as a finished picture: axes, colours and what they mean, and where B stands.
#pragma once

#include <explain/placement_map.h>
#include <render/drawlist/draw_list.h>

#include <string>

namespace mobbscope {

/// Of a whole map. `a`, `b`: names. `scale`: of text and lines; 0: the usual. Throws std::invalid_argument if a picture
/// cannot have the size.
DrawList map_picture(const PlacementMap& map, const std::string& a, const std::string& b, PictureSize size, Theme theme,
                     double scale = 0);

}  // namespace mobbscope
