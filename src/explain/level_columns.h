/// The figures of a tree's levels as `fit`'s table and the window show them.
#pragma once

#include <mobb/level_figures.h>

#include <string>

namespace mobbscope {

/// "volume 1.235 m\u00B2\u00B7s": a figure for people.
std::string level_words(const mobb::LevelColumn& column, const mobb::LevelFigures& figures);

/// Behind a figure, or the name of its column: " m^2*s"; empty for a number without unit.
std::string level_unit(const mobb::LevelColumn& column);

/// A figure in that unit, without it; "-" if the level has none.
std::string level_text(const mobb::LevelColumn& column, const mobb::LevelFigures& figures);

}  // namespace mobbscope
