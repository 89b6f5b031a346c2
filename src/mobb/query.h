/// Do two placed clips ever collide? (paper, Section 3.2)
#pragma once

#include <mobb/blocks.h>
#include <mobb/observer.h>
#include <mobb/placed_tree.h>
#include <mobb/traversal.h>
#include <mobb/whole.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace mobb {

/// The earliest pair of samples that collide.
struct Contact {
    double time = 0;  ///< global seconds: when the two begin to overlap
    int a_sample = 0;
    int b_sample = 0;
    /// Then, metres: between the centres, and the sum of the radii. distance < radii, unless the contact begins by
    /// touching: then they are equal but for rounding.
    double distance = 0;
    double radii = 0;

    friend bool operator==(const Contact&, const Contact&) = default;
};

/// A maximal interval of global time, [t0, t1) in seconds, over which two clips collide.
struct Interval {
    double t0 = 0;
    double t1 = 0;

    friend bool operator==(const Interval&, const Interval&) = default;
};

/// Sorted, with those that touch or overlap put together.
inline std::vector<Interval> joined(std::vector<Interval> intervals) {
    std::ranges::sort(intervals, {}, &Interval::t0);
    std::vector<Interval> out;
    for (const Interval& interval : intervals) {
        if (!out.empty() && interval.t0 <= out.back().t1 + kMinOverlap) {
            out.back().t1 = std::max(out.back().t1, interval.t1);
        } else {
            out.push_back(interval);
        }
    }
    return out;
}

/// The pair (i, j) over the time that it shares; it must share some.
template <PlacedSamples A, PlacedSamples B>
Approach approach_of(const A& a, int i, const B& b, int j) {
    return {swept(a, i), swept(b, j)};
}

/// What is known of the pair (i, j), which must collide.
template <PlacedSamples A, PlacedSamples B>
Contact contact_of(const A& a, int i, const B& b, int j) {
    if (!a.is_linear() && !b.is_linear()) {
        // The same, at less cost: many hits are asked for their contact.
        const Disk disk_a = a.disk(i);
        const Disk disk_b = b.disk(j);
        return {std::max(a.time(i), b.time(j)), i, j, std::sqrt(squared_distance(disk_a, disk_b)), disk_a.r + disk_b.r};
    }
    const Approach approach = approach_of(a, i, b, j);
    const double s = approach.overlap().begin;
    return {approach.time(s), i, j, std::sqrt(approach.squared_distance(s)), approach.radii(s)};
}

/// Collects hits that come in order of time into maximal intervals.
template <PlacedSamples A, PlacedSamples B>
struct IntervalCollector {
    const A& a;
    const B& b;
    std::vector<Interval> intervals;

    bool operator()(int i, int j) {
        const Interval next = interval_of(i, j);
        // Pairs that share less than kMinOverlap are never tested: such a crack does not end a contact.
        if (!intervals.empty() && next.t0 - intervals.back().t1 <= kMinOverlap) {
            intervals.back().t1 = next.t1;
        } else {
            intervals.push_back(next);
        }
        return false;
    }

    Interval interval_of(int i, int j) const {
        // The same, at less cost: held disks that collide do so for as long as they share.
        if (!a.is_linear() && !b.is_linear())
            return {std::max(a.time(i), b.time(j)), std::min(a.time(i + 1), b.time(j + 1))};
        const Approach approach = approach_of(a, i, b, j);
        const auto [begin, end] = approach.overlap();
        return {approach.time(begin), approach.time(end)};
    }
};

template <class A, class B>
IntervalCollector(const A&, const B&, std::vector<Interval>) -> IntervalCollector<A, B>;

/// What is asked is traversed by its nodes; what has no tree is one leaf. The samples of either are of what is placed.
template <NodeSource S>
const S& nodes_of(const S& placed) {
    return placed;
}
inline Whole<PlacedClip> nodes_of(const PlacedClip& placed) { return Whole(placed); }
inline Whole<PlacedBlocks> nodes_of(const PlacedBlocks& placed) { return Whole(placed); }

/// What may be asked against each other: PlacedTree, PlacedBlocks, PlacedChain and PlacedClip, in any pairing.
template <class S>
concept Askable = requires(const S& placed) {
    nodes_of(placed);
};

namespace detail {
/// on_hit as visit_hits has it, with the placed samples of both.
template <Askable A, Askable B, TraversalObserver Observer, class OnHit>
bool visit_hits_of(const A& a, const B& b, Observer& observer, OnHit& on_hit) {
    // What is one leaf has no boxes to be tested below its own: that is tested against every node of a tree.
    constexpr WalkTests walk = NodeSource<A> && NodeSource<B> ? WalkTests::time : WalkTests::time_and_boxes;
    return visit_hits<walk>(nodes_of(a), nodes_of(b), observer, on_hit);
}
}  // namespace detail

/// The earliest contact of any two, or none. The answer does not depend on what they are, only on the clips; it is that
/// of direct_search bit for bit. Trees of different time scales may be asked; their 3D boxes then prune nothing.
template <Askable A, Askable B, TraversalObserver Observer>
std::optional<Contact> query(const A& a, const B& b, Observer& observer) {
    std::optional<Contact> contact;
    auto on_hit = [&](int i, int j) {
        contact = contact_of(nodes_of(a).samples(), i, nodes_of(b).samples(), j);
        return true;
    };
    detail::visit_hits_of(a, b, observer, on_hit);
    return contact;
}
template <Askable A, Askable B>
std::optional<Contact> query(const A& a, const B& b) {
    NoObserver observer;
    return query(a, b, observer);
}

/// Whether any two ever collide.
template <Askable A, Askable B>
bool intersects(const A& a, const B& b) {
    NoObserver observer;
    auto on_hit = [](int, int) { return true; };
    return detail::visit_hits_of(a, b, observer, on_hit);
}

/// All intervals of contact, earliest first.
template <Askable A, Askable B>
std::vector<Interval> contact_intervals(const A& a, const B& b) {
    NoObserver observer;
    IntervalCollector collector{nodes_of(a).samples(), nodes_of(b).samples(), {}};
    detail::visit_hits_of(a, b, observer, collector);
    return std::move(collector.intervals);
}

/// The earliest contact of two clips by their blocks, or none: bit for bit that of trees and of direct_search.
inline std::optional<Contact> query(const PlacedBlocks& a, const PlacedBlocks& b) {
    const RootsApart roots(a, b);
    if (!roots.meet) return std::nullopt;
    const std::optional<SamplePair> hit = detail::first_hit(a, b, roots);
    return hit ? std::optional(contact_of(a, hit->a, b, hit->b)) : std::nullopt;
}

/// All intervals of contact, earliest first.
inline std::vector<Interval> contact_intervals(const PlacedBlocks& a, const PlacedBlocks& b) {
    using Collector = IntervalCollector<PlacedBlocks, PlacedBlocks>;
    Collector collector{a, b, {}};
    for_each_hit(a, b,
                 {[](void* receiver, int i, int j) { return (*static_cast<Collector*>(receiver))(i, j); }, &collector});
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
