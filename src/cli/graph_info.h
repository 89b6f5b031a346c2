/// What is in a motion graph, printed.
#pragma once

#include <crowd/graph/continuity.h>
#include <crowd/graph/graph_figures.h>
#include <scene/scene.h>

#include <ostream>
#include <string>
#include <vector>

namespace mobbscope::cli {

/// For people.
void print_graph_info(std::ostream& out, const Scene& scene, const GraphFigures& figures,
                      const TransitionMeasures& transitions, const Continuity& continuity);

/// {"file", "hubs":[{"name","begin","end","speed"}], "moves", "seconds", "bounds":{"pose_distance","root_speed"},
/// "joints":{"count","pose_distance":{"count","median","largest","before","after"},"root_speed":{...}},
/// "continuity":{...} (write_continuity), "choices", "seconds_between_choices",
/// "components":[{"hubs","moves","seconds"}], "dead_ends":[...], "rigs":[{"moves","joints"}],
/// "sources":[{"file","moves","seconds"}], "holds"}. `before` and `after` are clips, null where nothing was measured;
/// hubs are indices; joints are the names of those that count.
void write_graph_info(std::ostream& out, const Scene& scene, const GraphFigures& figures,
                      const TransitionMeasures& transitions, const Continuity& continuity);

/// A sentence for each of the graph's bounds that what was measured breaks.
std::vector<std::string> broken_bounds(const Scene& scene, const TransitionMeasures& transitions,
                                       const Continuity& continuity);

}  // namespace mobbscope::cli
