/// Boxes of nodes, where they stand in the world and in the picture.
#pragma once

#include <render/draw_list.h>
#include <render/subject.h>

namespace mobbscope {

/// A node's box in world (x, y, w*t), global time. An aabb is wrapped again along the world's x and y.
mobb::Box world_box(const mobb::PlacedTree& tree, int node);

/// A node's box as it is drawn, with its place in the order and its id; the style is left to the caller.
BoxInstance node_box(const Subject& subject, int node, const DrawnSpace& space);

}  // namespace mobbscope
