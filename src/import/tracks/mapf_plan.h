/// Plans of multi-agent path finding: what their readers share, and those that are plain text. The reader of YAML,
/// parse_mapf_plan, stands in tracks.h.
#pragma once

#include <import/tracks/tracks.h>

#include <string>
#include <string_view>
#include <vector>

namespace mobbscope {

/// The plan that tracks make: whoever is in it is where it begins from step 0 on, and where it ended until the plan's
/// last step. Tracks get points for that, and for steps that are missing between others; `from` is not empty. Throws
/// InputError as TrackCollector::take_sorted does, and if that makes far more points than the file has, more than
/// kMaxSamples, or more than the budget.
TrackFile plan_of(TrackCollector& from, const std::string& file);

/// Whether a text, or its first lines, is a plan that parse_mapf_text_plan reads, or refuses with a hint.
bool looks_like_mapf_text_plan(std::string_view text);

/// Plans in text: a line a step, "3:(1,2),(4,4),", as LaCAM and PIBT write below "solution=", cells as (x, y); or a
/// line an agent, "Agent 0: (2,1)->(2,2)->", as EECBS, CBSH2-RTC and MAPF-LNS2 do, cells as (row, column). Throws
/// InputError naming the line.
TrackFile parse_mapf_text_plan(std::string_view text, const std::string& file);

/// Whether a text begins like a plan of Robot Runners; likewise like a log, or a task, of Continuous-CBS.
bool looks_like_robot_runners(std::string_view text);
bool looks_like_ccbs_plan(std::string_view text);

/// Whether a text begins like a table of the MAPF tracker's.
bool looks_like_mapf_tracker(std::string_view text);

/// A plan of the MAPF tracker: a table with one row, whose column `solution_plan` or `path` has a line of moves an
/// agent; they start where the scenario beside it says. Throws InputError.
TrackFile parse_mapf_tracker(std::string_view text, const std::string& file);

/// Plans of Robot Runners: JSON with `start`, a list of [row, column, heading], and `actualPaths`, of actions "F,R,W".
/// Throws InputError.
TrackFile parse_robot_runners(std::string_view text, const std::string& file);

/// Logs of Continuous-CBS: XML with sections of a path, each with its duration. Throws InputError.
TrackFile parse_ccbs_plan(std::string_view text, const std::string& file);

}  // namespace mobbscope
