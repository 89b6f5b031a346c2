#include <mobb/query.h>

#include <algorithm>
#include <utility>

namespace mobb {

namespace {

/// Collects hits that come in order of time into maximal intervals.
struct IntervalCollector {
    const PlacedClip& a;
    const PlacedClip& b;
    std::vector<Interval> intervals;

    bool operator()(int i, int j) {
        const double t0 = std::max(a.time(i), b.time(j));
        const double t1 = std::min(a.time(i + 1), b.time(j + 1));
        // Pairs that share less than kMinOverlap are never tested: such a crack does not end a contact.
        if (!intervals.empty() && t0 - intervals.back().t1 <= kMinOverlap) {
            intervals.back().t1 = t1;
        } else {
            intervals.push_back({t0, t1});
        }
        return false;
    }
};

}  // namespace

std::optional<Contact> query(const PlacedTree& a, const PlacedTree& b) {
    NoObserver observer;
    return query(a, b, observer);
}

std::vector<Interval> contact_intervals(const PlacedTree& a, const PlacedTree& b) {
    NoObserver observer;
    IntervalCollector collector{a.placed_clip(), b.placed_clip(), {}};
    Traversal(a, b, observer, collector).run();
    return std::move(collector.intervals);
}

std::optional<Contact> direct_search(const PlacedClip& a, const PlacedClip& b) {
    NoObserver observer;
    return direct_search(a, b, observer);
}

std::vector<Interval> direct_contact_intervals(const PlacedClip& a, const PlacedClip& b) {
    NoObserver observer;
    IntervalCollector collector{a, b, {}};
    visit_sample_pairs(a, 0, a.count(), b, 0, b.count(), observer, collector);
    return std::move(collector.intervals);
}

}  // namespace mobb
