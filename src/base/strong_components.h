/// Strongly connected components of a directed graph.
#pragma once

#include <utility>
#include <vector>

namespace mobbscope {

/// For each node the number of its strongly connected component, counted from 0 in the order of their first nodes.
/// `edges`: pairs of nodes in [0, nodes), from and to.
std::vector<int> strong_components(int nodes, const std::vector<std::pair<int, int>>& edges);

}  // namespace mobbscope
