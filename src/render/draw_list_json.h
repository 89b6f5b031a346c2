/// A draw list as JSON, for exact checks of what a picture shows: every disk, box, line and text with its numbers.
///
///     {"size": [w, h], "participants": ["A", ...],
///      "camera": {"eye", "right", "up", "back", "perspective", "clip_from_world": [16, by column]},
///      "disks":  [{"id", "participant", "sample", "base", "radius", "height", "color", "on_screen"}],
///      "boxes":  [{"id", "participant", "node", "level", "state", "center", "extents", "fill", "edge", "width",
///      "dash",
///                  "pickable", "on_screen"}],
///      "lines":  [{"from", "to", "color", "width", "dash", "hidden", "on_screen"}],
///      "headline", "legend": [{"mark", "color", "text"}], "texts": [{"text", "at", "size", "color", "on_screen"}],
///      "panels": [...], "overlay_lines": [...], "marks": [...]}
///
/// Positions are in drawn metres, places on the screen in pixels from the upper left corner, colours "#RRGGBBAA".
/// `id` is the number that a pixel of the id picture has: red * 65536 + green * 256 + blue; 0 is nothing. `pixels`,
/// with an id picture, is how many pixels of it the object has: 0 is hidden. Items are sorted by what they stand for,
/// not by the order of the list.
#pragma once

#include <render/draw_list.h>
#include <render/object_id.h>

#include <optional>
#include <ostream>
#include <string>
#include <string_view>

namespace mobbscope {

/// `ids`: the id picture of the list, or null.
void write_draw_list(std::ostream& out, const DrawList& list, const IdImage* ids = nullptr);

/// The id picture as a picture: each pixel's number in its colour, opaque. Throws std::invalid_argument if the list has
/// 2^24 objects or more.
Image id_picture(const DrawList& list, const IdImage& ids);

/// The first difference of two draw lists as JSON texts, "/boxes/3/extents/0: 1.02 instead of 1", or nothing. Numbers
/// agree within 1e-4 of their size or 1e-4. Throws InputError if a text is no JSON; the names stand for the files.
std::optional<std::string> first_difference(std::string_view actual, const std::string& actual_name,
                                            std::string_view golden, const std::string& golden_name);

}  // namespace mobbscope
