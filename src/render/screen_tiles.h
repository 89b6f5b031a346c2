/// The part of the picture that boxes cover, roughly: what is done for each of its pixels need not be done for all.
#pragma once

#include <render/draw_list.h>

#include <span>
#include <vector>

namespace mobbscope {

/// Disjoint rectangles in whole pixels, inside the picture, that together cover all these boxes.
std::vector<Rect> covering_tiles(std::span<const BoxInstance> boxes, const Lens& lens);

}  // namespace mobbscope
