/// What SUMO writes of who moved where: floating car data, as XML or as a table.
#pragma once

#include <import/tracks/tracks.h>

#include <string>
#include <string_view>

namespace mobbscope {

/// Whether a text begins like that.
bool looks_like_sumo(std::string_view text);

/// `<fcd-export>` with vehicles, persons and containers in its timesteps, or the same as a table, where each kind has
/// columns of its own: vehicle_id, person_x. Throws InputError naming the line.
TrackFile parse_sumo(std::string_view text, const std::string& file);

}  // namespace mobbscope
