/// The `fit` of a scene file: every key is optional and has FitOptions' name for it.
///
///     {"tree": "mobb", "leaf": 10, "levels": 0, "axes": "endpoints", "time_scale": 1}
#pragma once

#include <base/json.h>
#include <base/json_writer.h>
#include <mobb/level_figures.h>
#include <mobb/tree.h>

#include <string>

namespace mobbscope {

/// What the keys say, over `base`: a key that is not there keeps its value. Throws InputError.
mobb::FitOptions read_fit(const JsonPlace& place, mobb::FitOptions base = {});

/// A figure for people, without its unit; "-" if the level has none.
std::string level_text(const mobb::LevelColumn& column, const mobb::LevelFigures& figures);

/// Per-level figures and every node of the tree over the clip of that name.
void write_tree(JsonWriter& out, const std::string& clip, const mobb::Tree& tree);

}  // namespace mobbscope
