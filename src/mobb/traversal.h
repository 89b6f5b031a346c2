/// The traversal of two trees (paper, Section 3.2): the only one, for answers, counts and traces alike.
#pragma once

#include <mobb/observer.h>
#include <mobb/predicate.h>
#include <mobb/sample_pairs.h>
#include <mobb/separation.h>

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <iterator>

namespace mobb {

/// Placed samples: sample i is a disk in the world over [time(i), time(i + 1)). It stays, or runs to disk_at_end(i); of
/// samples that are not linear all stay.
template <class S>
concept PlacedSamples = requires(const S& samples, int i) {
    { samples.disk(i) } -> std::convertible_to<Disk>;
    { samples.disk_at_end(i) } -> std::convertible_to<Disk>;
    { samples.time(i) } -> std::convertible_to<double>;
    { samples.is_linear() } -> std::convertible_to<bool>;
};

/// Placed samples whose disks lie one behind the other in memory.
template <class S>
concept StoredSamples = PlacedSamples<S> && requires(const S& samples) {
    { samples.stored() } -> std::convertible_to<StoredDisks>;
};

/// Sample i as it runs.
template <PlacedSamples S>
SweptDisk swept(const S& samples, int i) {
    return {samples.disk(i), samples.disk_at_end(i), samples.time(i), samples.time(i + 1)};
}

/// Placed samples [first(), end()) that the direct search can run through.
template <class S>
concept SampleSource = PlacedSamples<S> && requires(const S& samples) {
    { samples.first() } -> std::convertible_to<int>;
    { samples.end() } -> std::convertible_to<int>;
    { samples.dt() } -> std::convertible_to<double>;
};

/// What the traversal reads: nodes (children, sample range), their boxes, and the placed samples below them. Node 0 is
/// the root. A node may be a view that the source makes as it is asked for; so may its box.
template <class S>
concept NodeSource = requires(const S& source, int i) {
    { source.node(i).is_leaf() } -> std::convertible_to<bool>;
    { source.node(i).children[0] } -> std::convertible_to<int>;
    { source.node(i).first } -> std::convertible_to<int>;
    { source.node(i).end() } -> std::convertible_to<int>;
    { source.box(source.node(i)) } -> std::convertible_to<const Box&>;
    { source.begin(source.node(i)) } -> std::convertible_to<double>;
    { source.end(source.node(i)) } -> std::convertible_to<double>;
    { source.samples(source.node(i)) } -> StoredSamples;
    { source.samples() } -> SampleSource;
    { source.frame() } -> std::convertible_to<const PlacedFrame&>;
    { source.time_scale() } -> std::convertible_to<double>;
};

/// The first index i in [first, last) with time(i + 1) > t, or last: a binary search on hold intervals.
template <PlacedSamples S>
int first_ending_after(const S& samples, int first, int last, double t) {
    while (first < last) {
        const int middle = first + (last - first) / 2;
        if (samples.time(middle + 1) > t) {
            last = middle;
        } else {
            first = middle + 1;
        }
    }
    return first;
}

/// What became of the pairs of two ranges of samples.
struct PairVisit {
    bool hit = false;      ///< some pair collides
    bool stopped = false;  ///< on_hit asked to stop
};

/// visit_sample_pairs for samples of which none moves (held) or any may (linear).
template <Motion motion, PlacedSamples A, PlacedSamples B, TraversalObserver Observer, class OnHit>
PairVisit visit_pairs(const A& a, int first_a, int end_a, const B& b, int first_b, int end_b,
                      [[maybe_unused]] Observer& observer, OnHit& on_hit) {
    PairVisit visit;
    const double begin = std::max(a.time(first_a), b.time(first_b));
    int i = first_ending_after(a, first_a, end_a, begin);
    int j = first_ending_after(b, first_b, end_b, begin);
    if (i == end_a || j == end_b) return visit;
    // Each sample is placed once, however many partners it has.
    Disk disk_a = a.disk(i), disk_b = b.disk(j);
    double begin_a = a.time(i), until_a = a.time(i + 1);
    double begin_b = b.time(j), until_b = b.time(j + 1);
    const auto measure = [&] {
        if constexpr (motion == Motion::held) {
            if constexpr (Observer::watches) observer.sample_pair(i, j, squared_distance(disk_a, disk_b));
            return collide(disk_a, disk_b);
        } else {
            const Approach approach({disk_a, a.disk_at_end(i), begin_a, until_a},
                                    {disk_b, b.disk_at_end(j), begin_b, until_b});
            if constexpr (Observer::watches) observer.sample_pair(i, j, approach.squared_distance(approach.least()));
            return approach.collides();
        }
    };
    for (;;) {
        if (overlap_in_time(begin_a, until_a, begin_b, until_b) && measure()) {
            visit.hit = true;
            visit.stopped = on_hit(i, j);
            if (visit.stopped) return visit;
        }
        if (until_a < until_b) {
            if (++i == end_a) return visit;
            disk_a = a.disk(i);
            begin_a = until_a;
            until_a = a.time(i + 1);
        } else {
            if (++j == end_b) return visit;
            disk_b = b.disk(j);
            begin_b = until_b;
            until_b = b.time(j + 1);
        }
    }
}

/// Visits, in order of time, every pair (i, j) of samples from [first_a, end_a) x [first_b, end_b) whose hold intervals
/// overlap, measures their distance (where they move, at the earliest time at which they are deepest in each other or
/// nearest, see Approach::least), and calls on_hit(i, j) on those that collide, until it returns true.
template <PlacedSamples A, PlacedSamples B, TraversalObserver Observer, class OnHit>
PairVisit visit_sample_pairs(const A& a, int first_a, int end_a, const B& b, int first_b, int end_b, Observer& observer,
                             OnHit& on_hit) {
    return a.is_linear() || b.is_linear()
               ? visit_pairs<Motion::linear>(a, first_a, end_a, b, first_b, end_b, observer, on_hit)
               : visit_pairs<Motion::held>(a, first_a, end_a, b, first_b, end_b, observer, on_hit);
}

/// Tells the pairs of B's samples [first, end), as if each had been measured.
template <PlacedSamples A, PlacedSamples B, TraversalObserver Observer>
void report_apart(const A& a, const B& b, int first, int end, const SampleShift& shift, Observer& observer) {
    for (int j = first; j < end; ++j) {
        const Disk disk_b = b.disk(j);
        for (int i = j + shift.shift; i < j + shift.shift + shift.partners; ++i) {
            observer.sample_pair(i, j, squared_distance(a.disk(i), disk_b));
        }
    }
}

/// visit_sample_pairs for held samples of equal dt: most pairs are passed over unmeasured, two at a time. `slack`
/// (metres) covers the rounding of the samples' places.
template <StoredSamples A, StoredSamples B, TraversalObserver Observer, class OnHit>
PairVisit visit_shifted_pairs(const SampleShift& shift, double slack, const A& a, int first_a, int end_a, const B& b,
                              int first_b, int end_b, [[maybe_unused]] Observer& observer, OnHit& on_hit) {
    PairVisit visit;
    const auto measure = [&](int i, int j) {
        const Disk disk_a = a.disk(i), disk_b = b.disk(j);
        if constexpr (Observer::watches) observer.sample_pair(i, j, squared_distance(disk_a, disk_b));
        if (!collide(disk_a, disk_b)) return false;
        visit.hit = true;
        visit.stopped = on_hit(i, j);
        return visit.stopped;
    };
    const int next = shift.partners - 1;  // how far the last partner of a sample is behind the first
    int j = std::max(first_b, first_a - shift.shift - next);
    // A sample whose first partner comes before the range may still have its second there; only the last of B can lack
    // its second.
    if (j < end_b && j + shift.shift < first_a) {
        if (measure(j + shift.shift + 1, j)) return visit;
        ++j;
    }
    const int end_whole = std::min(end_b, end_a - shift.shift - next);
    if (j < end_whole) {
        const StoredDisks stored_a = a.stored(), stored_b = b.stored();
        const Rotation to_a = stored_a.rotation.inverse();
        const StoredRelation relation{to_a * stored_b.rotation, to_a(stored_b.translate - stored_a.translate), slack};
        for (;;) {
            const int apart =
                count_apart(stored_a.at(j + shift.shift), stored_b.at(j), end_whole - j, shift.partners, relation);
            if constexpr (Observer::watches) report_apart(a, b, j, j + apart, shift, observer);
            j += apart;
            if (j == end_whole) break;
            if (measure(j + shift.shift, j)) return visit;
            if (next && measure(j + shift.shift + 1, j)) return visit;
            ++j;
        }
    }
    if (j < end_b && j + shift.shift < end_a) measure(j + shift.shift, j);
    return visit;
}

/// How a leaf is tested against the nodes below the other side's inner node.
enum class WalkTests {
    time,            ///< in time only (paper, Fig. 4)
    time_and_boxes,  ///< as two inner nodes are: to measure the paper's claim that this gains nothing
};

/// One traversal of two node sources. OnHit is called with the sample pairs that collide, earliest first, and says
/// whether to stop.
template <NodeSource A, NodeSource B, TraversalObserver Observer, class OnHit, WalkTests walk_tests = WalkTests::time>
class Traversal {
  public:
    Traversal(const A& a, const B& b, Observer& observer, OnHit& on_hit)
        : a_(a),
          b_(b),
          frame_(a.frame(), b.frame(), a.time_scale()),
          same_scale_(a.time_scale() == b.time_scale()),
          shift_(a.frame(), a.samples().dt(), b.frame(), b.samples().dt()),
          observer_(observer),
          on_hit_(on_hit) {}

    /// Returns true if on_hit stopped it.
    bool run() {
        if (a_.samples().is_linear() || b_.samples().is_linear()) [[unlikely]] {
            frame_.cover_swept_disks(a_.frame(), b_.frame());
            return visit<Motion::linear>(0, 0);
        }
        return visit<Motion::held>(0, 0);
    }

  private:
    enum class Side { a, b };

    template <Motion motion>
    bool visit(int ia, int ib) {
        const auto& na = a_.node(ia);
        const auto& nb = b_.node(ib);
        if constexpr (Observer::watches) observer_.enter(ia, ib);
        bool stop = false;
        if (may_meet_in_time(na, nb) && may_meet_in_space(a_.box(na), b_.box(nb))) {
            if (na.is_leaf()) {
                stop = nb.is_leaf() ? test_samples<motion>(na, nb) : walk<motion, Side::b>(ia, nb);
            } else if (nb.is_leaf()) {
                stop = walk<motion, Side::a>(ib, na);
            } else {
                // In this order the traversal runs forward in time: one of the two mixed pairs is always apart in time.
                stop = visit<motion>(na.children[0], nb.children[0]) || visit<motion>(na.children[0], nb.children[1]) ||
                       visit<motion>(na.children[1], nb.children[0]) || visit<motion>(na.children[1], nb.children[1]);
            }
        }
        if constexpr (Observer::watches) observer_.leave();
        return stop;
    }

    /// A leaf against the children of the other side's inner node (Fig. 4).
    template <Motion motion, Side inner_side>
    bool walk(int leaf, const auto& inner) {
        for (const int child : inner.children) {
            const int ia = inner_side == Side::a ? child : leaf;
            const int ib = inner_side == Side::a ? leaf : child;
            const auto& na = a_.node(ia);
            const auto& nb = b_.node(ib);
            if constexpr (Observer::watches) observer_.enter(ia, ib);
            bool stop = false;
            if (may_meet_in_time(na, nb) &&
                (walk_tests == WalkTests::time || may_meet_in_space(a_.box(na), b_.box(nb)))) {
                if constexpr (inner_side == Side::a) {
                    stop = na.is_leaf() ? test_samples<motion>(na, nb) : walk<motion, Side::a>(leaf, na);
                } else {
                    stop = nb.is_leaf() ? test_samples<motion>(na, nb) : walk<motion, Side::b>(leaf, nb);
                }
            }
            if constexpr (Observer::watches) observer_.leave();
            if (stop) return true;
        }
        return false;
    }

    bool may_meet_in_time(const auto& na, const auto& nb) {
        const bool overlap = shift_.is_known() ? shift_.overlap(na.first, na.end(), nb.first, nb.end())
                                               : overlap_in_time(a_.begin(na), a_.end(na), b_.begin(nb), b_.end(nb));
        if constexpr (Observer::watches) observer_.time_test(overlap);
        return overlap;
    }

    /// Looks the test of two kinds up in kPairTests, unrolled at compile time: each is called directly.
    template <std::size_t i = 0>
    bool may_meet_in_space(const Box& a, const Box& b) {
        if constexpr (i < std::size(kPairTests)) {
            constexpr PairTest pair = kPairTests[i];
            if (a.kind != pair.a || b.kind != pair.b) return may_meet_in_space<i + 1>(a, b);
            if (pair.mixes_time && !same_scale_) return true;
            const Separation separation = pair.separate(a, b, frame_);
            if constexpr (Observer::watches) observer_.box_test(pair.test, separation);
            return !separation.separated();
        } else {
            return true;
        }
    }

    template <Motion motion>
    bool test_samples(const auto& na, const auto& nb) {
        const auto& samples_a = a_.samples(na);
        const auto& samples_b = b_.samples(nb);
        const PairVisit pairs =
            motion == Motion::held && shift_.is_known()
                ? visit_shifted_pairs(shift_, frame_.slack2d(), samples_a, na.first, na.end(), samples_b, nb.first,
                                      nb.end(), observer_, on_hit_)
                : visit_pairs<motion>(samples_a, na.first, na.end(), samples_b, nb.first, nb.end(), observer_, on_hit_);
        if constexpr (Observer::watches) observer_.sample_test(pairs.hit);
        return pairs.stopped;
    }

    const A& a_;
    const B& b_;
    RelativeFrame frame_;
    bool same_scale_;
    SampleShift shift_;
    Observer& observer_;
    OnHit& on_hit_;
};

}  // namespace mobb
