/// What became of recordings that a motion graph was cut out of, in words.
#pragma once

#include <crowd/graph/build_graph.h>
#include <scene/motion_graph.h>

#include <string>
#include <vector>

namespace mobbscope {

/// "8 hubs, 120 moves"
std::string size_in_words(const MotionGraph& graph);
/// "from 51 recordings, 100 s of 1 rig"
std::string source_in_words(const BuildReport& report);
/// What was found and left out: a sentence each.
std::vector<std::string> in_words(const BuildReport& report);
/// What somebody may want to mend: a sentence each.
std::vector<std::string> warnings_of(const BuildReport& report);
/// Why check_graph has left no move.
std::string why_no_move(const BuildReport& report);

}  // namespace mobbscope
