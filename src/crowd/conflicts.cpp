#include <crowd/conflicts.h>
#include <crowd/near_pairs.h>
#include <mobb/traversal.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace mobbscope {

namespace {

/// Told of every pair of samples that collides, in order of time; keeps the one that overlaps deepest.
struct DeepestPair {
    const mobb::PlacedClip& a;
    const mobb::PlacedClip& b;
    Conflict& conflict;

    bool operator()(int i, int j) {
        const mobb::Contact contact = mobb::contact_of(a, i, b, j);
        const double clearance = contact.distance - contact.radii;
        if (clearance >= conflict.least_clearance) return false;
        conflict.least_clearance = clearance;
        conflict.time = contact.time;
        conflict.a_sample = i;
        conflict.b_sample = j;
        return false;
    }
};

/// The pair's conflict; without intervals if there is none. Where two collide the least clearance is that of a pair of
/// samples that collides: no other is measured for it.
Conflict conflict_of(const mobb::PlacedTree& a, const mobb::PlacedTree& b, Search search) {
    const bool direct = search == Search::direct;
    Conflict conflict;
    conflict.intervals =
        direct ? mobb::direct_contact_intervals(a.placed_clip(), b.placed_clip()) : mobb::contact_intervals(a, b);
    if (conflict.intervals.empty()) return conflict;
    conflict.least_clearance = std::numeric_limits<double>::infinity();
    mobb::NoObserver observer;
    DeepestPair deepest{a.placed_clip(), b.placed_clip(), conflict};
    if (direct) {
        mobb::visit_sample_pairs(deepest.a, 0, deepest.a.count(), deepest.b, 0, deepest.b.count(), observer, deepest);
    } else {
        mobb::Traversal(a, b, observer, deepest).run();
    }
    return conflict;
}

}  // namespace

Conflicts find_conflicts(std::span<const mobb::PlacedTree> crowd, Search search, const Progress& progress) {
    Conflicts out;
    const auto test = [&](std::size_t a, std::size_t b, std::size_t pairs) {
        if (progress) progress(static_cast<std::size_t>(out.pairs_tested), pairs);
        ++out.pairs_tested;
        Conflict conflict = conflict_of(crowd[a], crowd[b], search);
        if (conflict.intervals.empty()) return;
        conflict.a = static_cast<int>(a);
        conflict.b = static_cast<int>(b);
        out.found.push_back(std::move(conflict));
    };
    if (search == Search::trees) {
        const std::vector<std::pair<int, int>> pairs = near_pairs(crowd);
        for (const auto& [a, b] : pairs) test(static_cast<std::size_t>(a), static_cast<std::size_t>(b), pairs.size());
        return out;
    }
    for (std::size_t a = 0; a < crowd.size(); ++a) {
        for (std::size_t b = a + 1; b < crowd.size(); ++b) test(a, b, crowd.size() * (crowd.size() - 1) / 2);
    }
    return out;
}

}  // namespace mobbscope
