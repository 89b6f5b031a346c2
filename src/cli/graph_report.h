/// What is in a motion graph, and how continuous motion is where its moves join, printed.
#pragma once

#include <base/json_writer.h>
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

/// A sentence for each of the graph's bounds that what was measured breaks, and for each change that breaks the one
/// that it may promise.
std::vector<std::string> broken_bounds(const Scene& scene, const TransitionMeasures& transitions,
                                       const Continuity& continuity);

/// For people, of a run: two lines, and one of forced plays if there are any.
void print_continuity(std::ostream& out, const RunContinuity& continuity);

/// The member `key`: {"bound", "joins", "measured", "over", "joint_position":{"ratio","across","inside","joint",
/// "before","after","over"}, "heading":{...}, "root_velocity":{...}, "joint_velocity":{...},
/// "foot_slide":{"contacts","median","within":{"metres","joint","clip"},"across":{"metres","joint","before","after"}}}.
/// `bound` is null where nothing is promised; `before`, `after` and `clip` are clips. What was not measured is null.
void write_continuity(JsonWriter& out, const char* key, const Scene& scene, const Continuity& continuity);

/// The member `key`, of forced joins: {"joins","measured","over"}.
void write_forced_continuity(JsonWriter& out, const char* key, const Continuity& continuity);

}  // namespace mobbscope::cli
