/// How continuous motion is where moves join, printed.
#pragma once

#include <base/json_writer.h>
#include <crowd/graph/continuity.h>
#include <scene/scene.h>

#include <ostream>
#include <string>
#include <vector>

namespace mobbscope::cli {

/// For people, of a graph: a line for each change and one for the feet.
void print_continuity(std::ostream& out, const Scene& scene, const Continuity& continuity);

/// For people, of a run: two lines, and one of forced plays if there are any.
void print_continuity(std::ostream& out, const RunContinuity& continuity);

/// The member `key`: {"bound", "joins", "measured", "over", "joint_position":{"ratio","across","inside","joint",
/// "before","after","over"}, "heading":{...}, "root_velocity":{...}, "joint_velocity":{...},
/// "foot_slide":{"contacts","median","within":{"metres","joint","clip"},"across":{"metres","joint","before","after"}}}.
/// `bound` is null where nothing is promised; `before`, `after` and `clip` are clips. What was not measured is null.
void write_continuity(JsonWriter& out, const char* key, const Scene& scene, const Continuity& continuity);

/// The member `key`, of forced joins: {"joins","measured","over"}.
void write_forced_continuity(JsonWriter& out, const char* key, const Continuity& continuity);

/// A sentence for each change that breaks the bound, if the scene's graph promises one.
std::vector<std::string> broken_continuity(const Scene& scene, const Continuity& continuity);

}  // namespace mobbscope::cli
