/// The traversal of two trees (paper, Section 3.2): the only one, for answers, counts and traces alike.
#pragma once

#include <mobb/observer.h>
#include <mobb/predicate.h>
#include <mobb/production.h>
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
};

/// What the traversal reads: nodes (children, sample range), their boxes, and the placed samples below them. Node 0 is
/// the root. A node may be a view that the source makes as it is asked for; so may its box.
template <class S>
concept NodeSource = requires(const S& source, int i) {
    { source.is_leaf(source.node(i)) } -> std::convertible_to<bool>;
    { source.has_blocks(source.node(i)) } -> std::convertible_to<bool>;
    { source.node(i).children[0] } -> std::convertible_to<int>;
    { source.node(i).first } -> std::convertible_to<int>;
    { source.node(i).end() } -> std::convertible_to<int>;
    { source.box(source.node(i)) } -> std::convertible_to<const Box&>;
    { source.begin(source.node(i)) } -> std::convertible_to<double>;
    { source.end(source.node(i)) } -> std::convertible_to<double>;
    { source.samples(source.node(i)) } -> PlacedSamples;
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

/// Whether samples i and j share time and collide then.
template <PlacedSamples A, PlacedSamples B>
bool pair_collides(const A& a, int i, const B& b, int j) {
    if (!overlap_in_time(a.time(i), a.time(i + 1), b.time(j), b.time(j + 1))) return false;
    if (!a.is_linear() && !b.is_linear()) return collide(a.disk(i), b.disk(j));
    return Approach(swept(a, i), swept(b, j)).collides();
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

/// How a leaf is tested against the nodes below the other side's inner node.
enum class WalkTests {
    time,            ///< in time only (paper, Fig. 4)
    time_and_boxes,  ///< as two inner nodes are: to measure the paper's claim that this gains nothing
};

/// Tells an observer of the blocks below two nodes: their roots are these nodes, the others follow in number.
template <TraversalObserver Observer>
class BlocksOfNodes final : public BlockObserver {
  public:
    BlocksOfNodes(Observer& observer, int a, int b) : observer_(observer), a_(a), b_(b) {}

    void enter(int a, int b) override { observer_.enter(a_ + a, b_ + b); }
    void leave() override { observer_.leave(); }
    void time_test(bool overlap) override { observer_.time_test(overlap); }
    void box_test(BoxKind test, const Separation& separation) override { observer_.box_test(test, separation); }
    void sample_pair(int i, int j, double squared_distance) override { observer_.sample_pair(i, j, squared_distance); }
    void sample_test(bool hit) override { observer_.sample_test(hit); }

  private:
    Observer& observer_;
    int a_, b_;
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
            if (a_.is_leaf(na)) {
                stop = b_.is_leaf(nb) ? test_leaves<motion>(ia, na, ib, nb) : walk<motion, Side::b>(ia, nb);
            } else if (b_.is_leaf(nb)) {
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
                    stop = a_.is_leaf(na) ? test_leaves<motion>(ia, na, ib, nb) : walk<motion, Side::a>(leaf, na);
                } else {
                    stop = b_.is_leaf(nb) ? test_leaves<motion>(ia, na, ib, nb) : walk<motion, Side::b>(leaf, nb);
                }
            }
            if constexpr (Observer::watches) observer_.leave();
            if (stop) return true;
        }
        return false;
    }

    bool may_meet_in_time(const auto& na, const auto& nb) {
        const bool overlap = overlap_in_time(a_.begin(na), a_.end(na), b_.begin(nb), b_.end(nb));
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

    /// Two leaves: their blocks if both have some, else their samples.
    template <Motion motion>
    bool test_leaves(int ia, const auto& na, int ib, const auto& nb) {
        if (a_.has_blocks(na) && b_.has_blocks(nb)) return test_blocks(ia, na, ib, nb);
        const PairVisit pairs = visit_pairs<motion>(a_.samples(na), na.first, na.end(), b_.samples(nb), nb.first,
                                                    nb.end(), observer_, on_hit_);
        if constexpr (Observer::watches) observer_.sample_test(pairs.hit);
        return pairs.stopped;
    }

    bool test_blocks([[maybe_unused]] int ia, const auto& na, [[maybe_unused]] int ib, const auto& nb) {
        LinkPlace place_a, place_b;
        const PlacedBlocks blocks_a = a_.blocks(na, place_a), blocks_b = b_.blocks(nb, place_b);
        const HitSink sink{[](void* receiver, int i, int j) -> bool { return (*static_cast<OnHit*>(receiver))(i, j); },
                           &on_hit_};
        if constexpr (Observer::watches) {
            BlocksOfNodes<Observer> blocks(observer_, ia, ib);
            return for_each_hit_below_roots(blocks_a, blocks_b, sink, &blocks);
        } else {
            return for_each_hit_below_roots(blocks_a, blocks_b, sink, nullptr);
        }
    }

    const A& a_;
    const B& b_;
    RelativeFrame frame_;
    bool same_scale_;
    Observer& observer_;
    OnHit& on_hit_;
};

}  // namespace mobb
