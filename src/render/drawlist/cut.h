/// Cutting what is drawn by level planes.
#pragma once

#include <render/drawlist/draw_list.h>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <optional>
#include <vector>

namespace mobbscope {

/// The lowest and the highest height of a box.
glm::vec2 heights_of(const BoxInstance& box);

/// Whether any of a box is seen. A level sheet is: it is where the picture has it on purpose.
bool is_seen(const std::optional<DrawnSlab>& slab, const BoxInstance& box);
/// Whether no more of a box is seen than lies in the slab.
bool is_cut(const DrawnSlab& slab, const BoxInstance& box);

/// Shortens a line to the part of it in a slab; false: there is none.
bool cut_line(const DrawnSlab& slab, glm::vec3& from, glm::vec3& to);
/// ... the list's lines from `first` on to its slab, if it has one.
void cut_lines(DrawList& list, std::size_t first);

/// The convex polygon in which a box meets the level plane at a height, corner by corner; empty: it does not. The
/// box's lowest height counts as met, its highest does not, as a node holds from its begin to before its end.
std::vector<glm::vec3> level_section(const BoxInstance& box, float height);

}  // namespace mobbscope
