/// Moves that differ: of those that take the same way in the same time, one is enough.
#pragma once

#include <crowd/graph/cut_search.h>
#include <crowd/graph/hub_choice.h>

#include <cstddef>
#include <vector>

namespace mobbscope {

/// Picks pieces that differ, all of which join the same two hubs, at most `most`. The first is the one that is most
/// like its hubs; each next one differs most from those before (farthest-first traversal: Gonzalez 1985). Two are alike
/// if, laid upon each other at their begin, their paths stay within 0.15 m of each other, their headings end within 10
/// degrees and their durations are within 0.15 s. Gives indices into `pieces`, ascending.
std::vector<std::size_t> different_pieces(const std::vector<Recording>& recordings, const std::vector<Piece>& pieces,
                                          std::size_t most);

}  // namespace mobbscope
