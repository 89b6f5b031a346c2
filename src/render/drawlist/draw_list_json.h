/// A draw list as JSON, for exact checks of what a picture shows: every disk, box, line and text with its numbers.
///
///     {"size": [w, h],
///      "background": "#RRGGBBAA",
///      "participants": ["A", ...],
///      "camera": {"eye", "right", "up", "back", "perspective", "clip_from_world": [16, by column]},
///      "slab": [low, high],   with "cuts_boxes" only where a slab in time is shown
///      "cuts_boxes": whether boxes are cut at its planes; else those that reach into it are whole
///      "disks": [{"id", "participant", "sample", "base", "radius", "height", "color", "on_screen", "pixels"}],
///      "boxes": [{"id", "participant", "node", "level", "state", "center", "extents", "triangle", "fill", "edge",
///                 "width", "dash", "on_screen", "pixels"}],
///      "lines": [{"layer", "from", "to", "color", "width", "dash", "cap", "hidden", "on_screen"}],
///      "highlights": [{"role", "from", "to", "color", "width", "dash", "on_screen"}],   only where there are any
///      "headline": "...",
///      "legend": [{"mark", "color", "text"}],
///      "overlays": [{"name", "min", "max", "folded", "no_room"}],
///      "panels": [{"min", "max", "radius", "fill", "border", "border_width"}],
///      "overlay_lines": [{"from", "to", "color", "width", "dash"}],
///      "marks": [as panels],
///      "texts": [{"text", "role", "at", "size", "face", "color", "on_screen"}]}
///
/// A disk that leans has "top" and "top_radius" too; a box has "triangle" only where it is half of a sheet. Disks and
/// boxes that a slab cuts away are listed too, as they stay in the renderer's buffers; lines are cut.
///
/// Positions are in drawn metres, places on the screen in pixels from the upper left corner, colours "#RRGGBBAA";
/// numbers have six significant digits. Disks and boxes are sorted by what they stand for and lines by their place in
/// the order of drawing, so that the order of the list does not show; what is over the scene stays in its order, the
/// last on top.
///
/// `id` is the number that a pixel of the id picture has: red * 65536 + green * 256 + blue. Numbers go from 1, by
/// participant, disks before boxes, index; 0 is nothing. `id` and `participant` of a box that stands for no node are 0
/// and null, likewise `node`. `on_screen` is false for what lies wholly beside the picture or nearer than anything is
/// drawn. `pixels`, with an id picture only, is how many of its pixels the object has: 0 is hidden, null is in no id
/// picture. `role` is what a text is: label (of a diagram), tick, name, note, caption, legend, header (of a folded
/// panel) or map.
#pragma once

#include <render/drawlist/draw_list.h>

#include <ostream>

namespace mobbscope {

/// `ids`: the id picture of the list, or null.
void write_draw_list(std::ostream& out, const DrawList& list, const IdImage* ids = nullptr);

/// The id picture as a picture: each pixel's number in its colour, opaque. Throws std::invalid_argument if the list has
/// 2^24 objects or more.
Image id_picture(const DrawList& list, const IdImage& ids);

}  // namespace mobbscope
