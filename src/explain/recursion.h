/// The recursion of a query as pairs of nodes: what the recursion square, the icicle and the counters show.
#pragma once

#include <explain/avoidable.h>
#include <mobb/placed_tree.h>
#include <mobb/query.h>
#include <mobb/trace.h>

#include <cstddef>
#include <vector>

namespace mobbscope {

/// A pair of nodes that was tested: a rectangle of A's time by B's, and a range of the trace.
struct RecursionPair {
    int a = 0;  ///< node indices
    int b = 0;
    int parent = -1;  ///< index of the pair that called it; -1 at the root
    int depth = 0;
    int first = 0;  ///< its own tests are the events first .. last
    int last = 0;
    int end = 0;                                     ///< it and all below it are the events first .. end - 1
    mobb::Outcome outcome = mobb::Outcome::overlap;  ///< of its last test
    bool hit = false;                                ///< a hit was found in it or below it
    bool avoidable = false;                          ///< its boxes overlap, which is avoidable (explain/avoidable.h)
    mobb::Interval time_a{};                         ///< of the nodes, global seconds
    mobb::Interval time_b{};

    bool has_children() const { return end > last + 1; }
};

struct Recursion {
    std::vector<RecursionPair> pairs;  ///< in the order of their first tests: parents before children
    std::vector<int> pair_of;          ///< by event: index of its pair
    AvoidableOverlaps avoidable;
    int depth = 0;         ///< number of levels; 0 for an empty trace
    bool stopped = false;  ///< recording stopped before the end: pairs may be open still

    const RecursionPair& pair_at(int event) const {
        return pairs[static_cast<std::size_t>(pair_of[static_cast<std::size_t>(event)])];
    }
    std::size_t bytes() const {
        return pairs.capacity() * sizeof(pairs[0]) + pair_of.capacity() * sizeof(int) +
               avoidable.events.capacity() * sizeof(int) + avoidable.found.capacity() * sizeof(AvoidableOverlap);
    }
};

/// `trace` must be that of a query of these two. Takes time linear in the trace, and what judging overlaps takes
/// (avoidable_overlaps).
Recursion recursion_of(const mobb::Trace& trace, const mobb::PlacedTree& a, const mobb::PlacedTree& b,
                       std::int64_t most_visits = kVisitsWhileDragging, const Progress& progress = {});

}  // namespace mobbscope
