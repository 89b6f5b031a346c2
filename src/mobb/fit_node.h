/// Fitting a node of a tree. Internal to the library's sources.
#pragma once

#include <mobb/tree.h>

#include <span>

namespace mobb {

/// fit() of a node's samples to the last bit, of an upright kind, where all nodes below it have their boxes and these
/// are upright too: most samples are not looked at. `nodes`: the tree's, as far as they are built.
Rectangle fit_node(BoxKind kind, const Clip& clip, std::span<const Node> nodes, int node, Axes axes);

}  // namespace mobb
