/// What SUMO writes of who moved where: floating car data as XML; as a table it is one like others (text_rows.h).
#pragma once

#include <import/tracks/tracks.h>

#include <string>
#include <string_view>

namespace mobbscope {

/// Whether a text begins like that.
bool looks_like_sumo(std::string_view text);

/// `<fcd-export>` with vehicles, persons and containers in its timesteps. Throws InputError naming the line.
TrackFile parse_sumo(std::string_view text, const std::string& file);

}  // namespace mobbscope
