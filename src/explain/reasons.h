/// From a place to its reasons: the pairs of a recursion that decided about a moment or a sample.
#pragma once

#include <explain/recursion.h>
#include <mobb/tree.h>
#include <scene/drawn_agent.h>

#include <span>
#include <string>
#include <vector>

namespace mobbscope {

/// The pairs whose nodes hold a moment of A and one of B, from the root on: indices into Recursion::pairs. A node holds
/// [begin, end); the root its end too. With two equal moments this is the chain that decided about that moment; it ends
/// early where a hit ended the search.
std::vector<int> pairs_at(const Recursion& recursion, double time_a, double time_b);

/// The pairs without others below them whose node of that side (0: A, 1: B) covers a sample of its clip, in order.
/// `tree`: of that side.
std::vector<int> end_pairs_of_sample(const Recursion& recursion, const mobb::Tree& tree, int side, int sample);

/// The pairs that a pair called, in order.
std::vector<int> children_of(const Recursion& recursion, int pair);

/// How a pair with children ended: "none of its 4 met", "2 of its 4 met, without a hit", "a hit in number 3 of 4".
/// Empty for a pair without.
std::string how_it_ended(const Recursion& recursion, int pair);

/// The pairs with children that end with an event, the innermost first.
std::vector<int> pairs_ended_at(const Recursion& recursion, int event);
/// ... each in words: "A 2.1 against B 2.3: none of its 4 met". `sides`: A and B.
std::vector<std::string> ended_words(std::span<const DrawnAgent> sides, const Recursion& recursion, int event);

}  // namespace mobbscope
