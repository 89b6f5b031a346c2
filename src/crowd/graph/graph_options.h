/// The options of a motion graph that is cut out of recordings, as the command line, the window and scripts have them.
#pragma once

#include <base/number_options.h>
#include <crowd/graph/hub_choice.h>

#include <span>

namespace mobbscope {

/// Those that are numbers, those first that matter most.
std::span<const NumberOption<GraphOptions>> graph_options();

/// What GraphOptions::whole means, for help.
inline constexpr std::string_view kWholeHelp = "Takes clips whole, from one hub to itself, and bounds nothing";

}  // namespace mobbscope
