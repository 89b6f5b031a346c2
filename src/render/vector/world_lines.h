/// Lines within the world, as they are seen in the picture.
#pragma once

#include <render/drawlist/draw_list.h>
#include <render/gl/renderer.h>
#include <render/vector/vector_canvas.h>

#include <vector>

namespace mobbscope {

/// The lines of the world and the edges of boxes, in drawing order: what disks hide of them first, as faint as a
/// picture has it, then what is seen. `depths`: of the
/// disks; null: there are none.
std::vector<VectorStroke> world_lines(const DrawList& list, const DepthImage* depths);

/// The lines that point something out.
std::vector<VectorStroke> highlight_lines(const DrawList& list);

}  // namespace mobbscope
