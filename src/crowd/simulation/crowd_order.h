/// A crowd that is asked for: its options, as the command line, the window and scripts have them, and what became of it
/// in words.
#pragma once

#include <base/number_options.h>
#include <crowd/simulation/move_set.h>
#include <crowd/simulation/simulate.h>
#include <scene/scene.h>

#include <span>
#include <string>

namespace mobbscope {

struct CrowdOrder {
    SimulateOptions options;
    double turn_rate = kDefaultTurnRate;  ///< as in CrowdRun
};

/// Those that are numbers, those first that matter most.
std::span<const NumberOption<CrowdOrder>> crowd_options();

/// What of a scene a crowd plays: its clips and its graph, without the agents, queries and run that it may have.
Scene played_part(Scene scene);

/// "100 agents for 120 s: 4800 plays, 4700 choices"
std::string in_words(const SimulationCounts& counts);

}  // namespace mobbscope
