/// Proofs of answers in words, beside what the trees needed for the same.
#pragma once

#include <explain/margins.h>
#include <mobb/placed_tree.h>
#include <mobb/trace.h>

#include <span>
#include <string>
#include <vector>

namespace mobbscope {

/// Where a traversal went no deeper: at a pair of boxes that is apart in space, or in a run of measured samples.
struct TraversalEnd {
    double t0 = 0, t1 = 0;  ///< global seconds
    bool is_boxes = false;
    int step = 0;  ///< of its first test
};

/// The traversal's own proof, in order of time. Of a miss the ends partition the common time; of a hit that before its
/// contact. Pairs that are apart in time prove nothing and are not in it.
std::vector<TraversalEnd> traversal_ends(const mobb::PlacedTree& a, const mobb::PlacedTree& b,
                                         const mobb::Trace& trace);

/// "Never closer than 0.183 m. Proof: 2 lines over 12.40 s; the trees needed 5 box pairs and 2 runs of samples."
/// Without `ends` nothing is said of the trees.
std::string proof_words(const Certificate& certificate, std::span<const TraversalEnd> ends);

/// "Both radii may grow by 0.091 m; B may start up to 0.400 s earlier or later." `b`: B's name.
std::string margin_words(const Margins& margins, const std::string& b);

}  // namespace mobbscope
