/// Proofs of answers that need no tree: lines on the floor that keep two paths apart, each for some time (contract,
/// "Certificates").
#pragma once

#include <explain/separating_line.h>
#include <mobb/query.h>
#include <mobb/trace.h>
#include <scene/fitted_scene.h>

#include <glm/vec2.hpp>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace mobbscope {

/// The proof of an answer. Of a miss the tiles cover the common time; of a hit the time before its contact.
struct Certificate {
    std::optional<mobb::Contact> contact;
    std::vector<Tile> tiles;  ///< in order of time
};

/// Where a traversal went no deeper: at a pair of boxes that is apart in space, or in a run of measured samples.
struct TraversalEnd {
    double t0 = 0, t1 = 0;  ///< global seconds
    bool is_boxes = false;
    int step = 0;  ///< of its first test
};

/// Each event of a traversal that went no deeper, in order of time. Of a miss they partition the common time; of a hit
/// that before its contact. Pairs that are apart in time decide nothing.
std::vector<TraversalEnd> deciding_events(const mobb::PlacedTree& a, const mobb::PlacedTree& b,
                                          const mobb::Trace& trace);

/// The traversal's own proof: the same with events that measured samples one after the other as one run.
std::vector<TraversalEnd> traversal_ends(const mobb::PlacedTree& a, const mobb::PlacedTree& b,
                                         const mobb::Trace& trace);

/// The proof of a query's answer by the fewest lines: there are never more than its trace has separated pairs of boxes
/// and measured pairs of samples.
Certificate certify(const mobb::PlacedTree& a, const mobb::PlacedTree& b, const RecordedQuery& recorded);

/// Why the certificate does not prove the answer; empty: it does. Looks at the samples alone.
std::string why_not_proven(const mobb::PlacedClip& a, const mobb::PlacedClip& b, const Certificate& certificate);

}  // namespace mobbscope
