/// What the panels of a shot draw.
#pragma once

#include <picture_tests/shot.h>
#include <render/drawlist/draw_list.h>

#include <vector>

namespace mobbscope::picture_tests {

/// By panel, each at its size in the picture. Panels that are seen in the same way by a camera that frames the scene
/// by itself share one that sees all of them. Throws InputError if a view cannot be drawn. The shot has no window.
std::vector<DrawList> panel_lists(const Shot& shot);

}  // namespace mobbscope::picture_tests
