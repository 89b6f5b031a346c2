/// Where nodes stand in their tree, for going about it.
#pragma once

#include <mobb/tree.h>

#include <string_view>

namespace mobbscope::app {

/// The node of an index ("12"), or of a level and a place in it, counted from 0 in order of time ("2.1"). Throws
/// std::invalid_argument, saying what there is, if there is none.
int node_at(const mobb::Tree& tree, std::string_view text);

/// The leaf that holds a sample of the tree's clip.
int leaf_of_sample(const mobb::Tree& tree, int sample);

/// The next node of the same level in the direction of time (1) or against it (-1); -1 if there is none.
int neighbour_on_level(const mobb::Tree& tree, int node, int direction);

}  // namespace mobbscope::app
