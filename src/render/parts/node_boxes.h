/// The boxes of a range of levels.
#pragma once

#include <render/drawlist/color_scale.h>
#include <render/drawlist/draw_list.h>
#include <scene/drawn_agent.h>

#include <span>
#include <vector>

namespace mobbscope {

/// The nodes of `tree` that a range of levels shows: those on its levels and the leaves above the first.
std::vector<int> shown_nodes(const mobb::Tree& tree, const LevelRange& levels);
/// The same of an agent; where a part of its tree is shown alone those within it, or the part's own node if there is
/// none.
std::vector<int> shown_nodes(const DrawnAgent& agent, const LevelRange& levels);

/// Whether a node is `top`, or below it.
bool is_within(const mobb::Tree& tree, int node, int top);

/// The boxes of those nodes in their agents' colours; where several levels are shown, finer ones are brighter, fuller
/// and heavier.
void add_level_boxes(DrawList& list, std::span<const DrawnAgent> agents, const LevelRange& levels, float scale);

/// The figures that the list's boxes of levels have: by their agent, of its tree's nodes.
using BoxFigures = std::span<const std::span<const double>>;
/// Gives these boxes the colours of their figures. Those outside a range that somebody has chosen step back.
void color_boxes(DrawList& list, BoxFigures figures, const ColorScale& scale);

/// How the boxes of one level look.
struct LevelStyle {
    float face = 0;       ///< opacity
    float edge = 1;       ///< opacity
    float width = 1;      ///< pixels at scale 1
    float bright = 0.5f;  ///< of a range: 0 on the coarsest level, 1 on the finest; of a single one neither
};
LevelStyle level_style(int level, int first, int last);

/// An agent's colour, or any other, on a level of a range: from dim to bright, so that levels are told apart.
Rgba level_tint(Rgba color, const LevelStyle& style, const Palette& palette);

/// Makes boxes of levels finer where they are small in the picture, and fainter where many lie over one another, as
/// they would bury what is inside. Needs the projection. `scale`: of line widths.
void refine_crowded_boxes(DrawList& list, float scale);

/// The last level that there is to show in a tree.
int last_shown_level(const mobb::Tree& tree, const LevelRange& levels);

/// A node's box as it is drawn, with its place in the order and its id; the style is left to the caller.
BoxInstance node_box(const DrawnAgent& agent, int node, const DrawnSpace& space);

}  // namespace mobbscope
