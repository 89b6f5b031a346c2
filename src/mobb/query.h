/// Do two placed clips ever collide? (paper, Section 3.2)
#pragma once

#include <mobb/observer.h>
#include <mobb/placed_tree.h>
#include <mobb/traversal.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace mobb {

/// The earliest pair of samples that collide.
struct Contact {
    double time = 0;  ///< global seconds: the start of the pair's overlap
    int a_sample = 0;
    int b_sample = 0;
    double distance = 0;  ///< metres between the centres
    double radii = 0;     ///< sum of the two radii, metres; distance < radii

    friend bool operator==(const Contact&, const Contact&) = default;
};

/// A maximal interval of global time, [t0, t1) in seconds, over which two clips collide.
struct Interval {
    double t0 = 0;
    double t1 = 0;

    friend bool operator==(const Interval&, const Interval&) = default;
};

/// What is known of the pair (i, j), which must overlap in time.
template <PlacedSamples A, PlacedSamples B>
Contact contact_of(const A& a, int i, const B& b, int j) {
    const Disk disk_a = a.disk(i);
    const Disk disk_b = b.disk(j);
    return {std::max(a.time(i), b.time(j)), i, j, std::sqrt(squared_distance(disk_a, disk_b)), disk_a.r + disk_b.r};
}

/// Collects hits that come in order of time into maximal intervals.
template <PlacedSamples A, PlacedSamples B>
struct IntervalCollector {
    const A& a;
    const B& b;
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

template <class A, class B>
IntervalCollector(const A&, const B&, std::vector<Interval>) -> IntervalCollector<A, B>;

/// The earliest contact of two trees or chains, or none. The answer does not depend on the trees' kinds, only on the
/// clips; it is that of direct_search bit for bit. Trees of different time scales may be asked; their 3D boxes then
/// prune nothing.
template <NodeSource A, NodeSource B, TraversalObserver Observer>
std::optional<Contact> query(const A& a, const B& b, Observer& observer) {
    std::optional<Contact> contact;
    auto on_hit = [&](int i, int j) {
        contact = contact_of(a.samples(), i, b.samples(), j);
        return true;
    };
    Traversal(a, b, observer, on_hit).run();
    return contact;
}
template <NodeSource A, NodeSource B>
std::optional<Contact> query(const A& a, const B& b) {
    NoObserver observer;
    return query(a, b, observer);
}

/// All intervals of contact, earliest first.
template <NodeSource A, NodeSource B>
std::vector<Interval> contact_intervals(const A& a, const B& b) {
    NoObserver observer;
    IntervalCollector collector{a.samples(), b.samples(), {}};
    Traversal(a, b, observer, collector).run();
    return std::move(collector.intervals);
}

/// The answer without a tree: every pair of samples that overlap in time is measured, in order of time, up to the first
/// hit.
template <SampleSource A, SampleSource B, TraversalObserver Observer>
std::optional<Contact> direct_search(const A& a, const B& b, Observer& observer) {
    std::optional<Contact> contact;
    auto on_hit = [&](int i, int j) {
        contact = contact_of(a, i, b, j);
        return true;
    };
    if constexpr (Observer::watches) observer.enter(0, 0);
    [[maybe_unused]] const PairVisit visit =
        visit_sample_pairs(a, a.first(), a.end(), b, b.first(), b.end(), observer, on_hit);
    if constexpr (Observer::watches) {
        observer.sample_test(visit.hit);
        observer.leave();
    }
    return contact;
}
template <SampleSource A, SampleSource B>
std::optional<Contact> direct_search(const A& a, const B& b) {
    NoObserver observer;
    return direct_search(a, b, observer);
}
template <SampleSource A, SampleSource B>
std::vector<Interval> direct_contact_intervals(const A& a, const B& b) {
    NoObserver observer;
    IntervalCollector collector{a, b, {}};
    visit_sample_pairs(a, a.first(), a.end(), b, b.first(), b.end(), observer, collector);
    return std::move(collector.intervals);
}

}  // namespace mobb
