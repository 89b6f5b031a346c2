/// The traversal of two trees (paper, Section 3.2): the only one, for answers, counts and traces alike.
#pragma once

#include <mobb/blocks.h>
#include <mobb/lanes.h>
#include <mobb/observer.h>
#include <mobb/predicate.h>
#include <mobb/sample_pairs.h>
#include <mobb/separation.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <concepts>
#include <cstddef>
#include <iterator>
#include <type_traits>

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

/// Placed samples whose disks lie one behind the other in memory: all in the source's own frame, or each range in its
/// own.
template <class S>
concept StoredSamples = PlacedSamples<S> && requires(const S& samples) {
    { samples.stored() } -> std::convertible_to<StoredDisks>;
    { samples.kStoredInFrame } -> std::convertible_to<bool>;
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

/// What the traversal reads: nodes (kind, sample range), their children and boxes, and the placed samples below them.
/// Node 0 is the root. A node may be a view that the source makes as it is asked for; so may its rectangle or box.
template <class S>
concept NodeSource = requires(const S& source, int i) {
    { source.node(i).is_leaf() } -> std::convertible_to<bool>;
    { source.node(i).kind } -> std::convertible_to<BoxKind>;
    { source.has_blocks(source.node(i)) } -> std::convertible_to<bool>;
    { source.node(i).first } -> std::convertible_to<int>;
    { source.node(i).end() } -> std::convertible_to<int>;
    { source.children(i, source.node(i)) } -> std::convertible_to<std::array<int, 2>>;
    { source.rectangle(source.node(i)) } -> std::convertible_to<const Rectangle&>;
    { source.box(i, source.node(i)) } -> std::convertible_to<const Box&>;
    { source.stored_box(i, source.node(i)) } -> std::convertible_to<const Box&>;
    { source.begin(source.node(i)) } -> std::convertible_to<double>;
    { source.end(source.node(i)) } -> std::convertible_to<double>;
    { source.begin_time() } -> std::convertible_to<double>;
    { source.end_time() } -> std::convertible_to<double>;
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

/// Measures the held pair (i, j). Returns whether to stop.
template <PlacedSamples A, PlacedSamples B, TraversalObserver Observer, class OnHit>
bool measure_pair(const A& a, int i, const B& b, int j, [[maybe_unused]] Observer& observer, OnHit& on_hit,
                  PairVisit& visit) {
    const Disk disk_a = a.disk(i), disk_b = b.disk(j);
    if constexpr (Observer::watches) observer.sample_pair(i, j, squared_distance(disk_a, disk_b));
    if (!collide(disk_a, disk_b)) return false;
    visit.hit = true;
    visit.stopped = on_hit(i, j);
    return visit.stopped;
}

/// Tells the pairs of B's samples [first, end), as if each had been measured.
template <PlacedSamples A, PlacedSamples B, TraversalObserver Observer>
void report_apart(const A& a, const B& b, int first, int end, const SampleShift& shift, Observer& observer) {
    // What is derived from it may want each of them.
    if constexpr (std::is_same_v<Observer, Statistics>) {
        observer.tests[TestKind::samples] += (end - first) * shift.partners;
        return;
    }
    for (int j = first; j < end; ++j) {
        const Disk disk_b = b.disk(j);
        for (int i = j + shift.shift; i < j + shift.shift + shift.partners; ++i) {
            observer.sample_pair(i, j, squared_distance(a.disk(i), disk_b));
        }
    }
}

/// visit_sample_pairs for held samples of equal dt: most pairs are skipped unmeasured, two at a time.
/// `relation` is that of the two as they are stored.
template <StoredSamples A, StoredSamples B, TraversalObserver Observer, class OnHit>
[[gnu::noinline]] PairVisit visit_shifted_pairs(const SampleShift& shift, const StoredRelation& relation, const A& a,
                                                int first_a, int end_a, const B& b, int first_b, int end_b,
                                                [[maybe_unused]] Observer& observer, OnHit& on_hit) {
    PairVisit visit;
    const int next = shift.partners - 1;  // how far the last partner of a sample is behind the first
    int j = std::max(first_b, first_a - shift.shift - next);
    // A sample whose first partner comes before the range may still have its second there; only the last of B can lack
    // its second.
    if (j < end_b && j + shift.shift < first_a) {
        if (measure_pair(a, j + shift.shift + 1, b, j, observer, on_hit, visit)) return visit;
        ++j;
    }
    const int end_whole = std::min(end_b, end_a - shift.shift - next);
    if (j < end_whole) {
        const StoredDisks stored_a = a.stored(), stored_b = b.stored();
        for (;;) {
            const int apart =
                count_apart(stored_a.at(j + shift.shift), stored_b.at(j), end_whole - j, shift.partners, relation);
            if constexpr (Observer::watches) report_apart(a, b, j, j + apart, shift, observer);
            j += apart;
            if (j == end_whole) break;
            if (measure_pair(a, j + shift.shift, b, j, observer, on_hit, visit)) return visit;
            if (next && measure_pair(a, j + shift.shift + 1, b, j, observer, on_hit, visit)) return visit;
            ++j;
        }
    }
    if (j < end_b && j + shift.shift < end_a) measure_pair(a, j + shift.shift, b, j, observer, on_hit, visit);
    return visit;
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

    BlockObserver* observer() { return this; }
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

template <>
class BlocksOfNodes<NoObserver> {
  public:
    BlocksOfNodes(NoObserver&, int, int) {}
    BlockObserver* observer() { return nullptr; }
};

/// One traversal of two node sources. OnHit is called with the sample pairs that collide, earliest first, and says
/// whether to stop.
template <NodeSource A, NodeSource B, TraversalObserver Observer, class OnHit, WalkTests walk_tests = WalkTests::time>
class Traversal {
  public:
    /// Of two that share time: visit_hits tests that, and tells the observer of the roots.
    Traversal(const A& a, const B& b, Observer& observer, OnHit& on_hit)
        : a_(a),
          b_(b),
          frame_(a.frame(), b.frame(), a.time_scale()),
          same_scale_(a.time_scale() == b.time_scale()),
          shift_(a.frame(), a.samples().dt(), b.frame(), b.samples().dt()),
          observer_(observer),
          on_hit_(on_hit) {
        assert(overlap_in_time(a.begin_time(), a.end_time(), b.begin_time(), b.end_time()));
    }

    /// Returns true if on_hit stopped it.
    bool run() {
        const auto& na = a_.node(0);
        const auto& nb = b_.node(0);
        const bool linear = a_.samples().is_linear() || b_.samples().is_linear();
        if (linear) [[unlikely]]
            frame_.cover_swept_disks(a_.frame(), b_.frame());
        if (!may_meet_in_space(0, na, 0, nb)) return false;
        if (linear) [[unlikely]]
            return visit_below<Mode::linear>(0, na, 0, nb);
        return shift_.is_known() ? visit_below<Mode::shifted>(0, na, 0, nb) : visit_below<Mode::held>(0, na, 0, nb);
    }

  private:
    static constexpr bool kBlocks = requires(const A& a, const B& b, LinkPlace& place) {
        a.blocks(a.node(0), place);
        b.blocks(b.node(0), place);
    };
    enum class Side { a, b };
    /// How times and samples are compared: of held samples of which a shift is known, of others, of linear ones.
    enum class Mode { shifted, held, linear };

    /// What lies below two nodes whose boxes meet.
    template <Mode mode>
    bool visit_below(int ia, const auto& na, int ib, const auto& nb) {
        if (na.is_leaf()) return nb.is_leaf() ? test_leaves<mode>(ia, na, ib, nb) : walk<mode, Side::b>(ia, na, ib, nb);
        if (nb.is_leaf()) return walk<mode, Side::a>(ib, nb, ia, na);
        return visit_children<mode>(ia, na, ib, nb);
    }

    /// The children of two inner nodes, each of one with each of the other.
    template <Mode mode>
    bool visit_children(int ia, const auto& na, int ib, const auto& nb) {
        const std::array<int, 2> children_a = a_.children(ia, na), children_b = b_.children(ib, nb);
        const auto& a0 = a_.node(children_a[0]);
        const auto& a1 = a_.node(children_a[1]);
        const auto& b0 = b_.node(children_b[0]);
        const auto& b1 = b_.node(children_b[1]);
        // In this order the traversal runs forward in time: one of the two mixed pairs is always apart in time.
        const unsigned meet = (meet_in_time<mode>(a0, b0) ? 1u : 0u) | (meet_in_time<mode>(a0, b1) ? 2u : 0u) |
                              (meet_in_time<mode>(a1, b0) ? 4u : 0u) | (meet_in_time<mode>(a1, b1) ? 8u : 0u);
        for (unsigned k = 0; k < 4; ++k) {
            const bool meet_in_time = (meet >> k & 1) != 0;
            const auto& child_a = k < 2 ? a0 : a1;
            const auto& child_b = k % 2 == 0 ? b0 : b1;
            const int index_a = children_a[k / 2], index_b = children_b[k % 2];
            if constexpr (Observer::watches) observer_.enter(index_a, index_b);
            if constexpr (Observer::watches) observer_.time_test(meet_in_time);
            const bool stop = meet_in_time && may_meet_in_space(index_a, child_a, index_b, child_b) &&
                              visit_below<mode>(index_a, child_a, index_b, child_b);
            if constexpr (Observer::watches) observer_.leave();
            if (stop) return true;
        }
        return false;
    }

    /// A leaf against the children of the other side's inner node (Fig. 4).
    template <Mode mode, Side inner_side>
    bool walk(int leaf_index, const auto& leaf, int inner_index, const auto& inner) {
        if constexpr (inner_side == Side::a) {
            for (const int ia : a_.children(inner_index, inner)) {
                if (walk_pair<mode, inner_side>(ia, a_.node(ia), leaf_index, leaf)) return true;
            }
        } else {
            for (const int ib : b_.children(inner_index, inner)) {
                if (walk_pair<mode, inner_side>(leaf_index, leaf, ib, b_.node(ib))) return true;
            }
        }
        return false;
    }

    template <Mode mode, Side inner_side>
    bool walk_pair(int ia, const auto& na, int ib, const auto& nb) {
        if constexpr (Observer::watches) observer_.enter(ia, ib);
        bool stop = false;
        if (may_meet_in_time<mode>(na, nb) && (walk_tests == WalkTests::time || may_meet_in_space(ia, na, ib, nb))) {
            if constexpr (inner_side == Side::a) {
                stop = na.is_leaf() ? test_leaves<mode>(ia, na, ib, nb) : walk<mode, inner_side>(ib, nb, ia, na);
            } else {
                stop = nb.is_leaf() ? test_leaves<mode>(ia, na, ib, nb) : walk<mode, inner_side>(ia, na, ib, nb);
            }
        }
        if constexpr (Observer::watches) observer_.leave();
        return stop;
    }

    template <Mode mode>
    bool meet_in_time(const auto& na, const auto& nb) const {
        if constexpr (mode == Mode::shifted) return shift_.overlap(na.first, na.end(), nb.first, nb.end());
        return overlap_in_time(a_.begin(na), a_.end(na), b_.begin(nb), b_.end(nb));
    }

    template <Mode mode>
    bool may_meet_in_time(const auto& na, const auto& nb) {
        const bool overlap = meet_in_time<mode>(na, nb);
        if constexpr (Observer::watches) observer_.time_test(overlap);
        return overlap;
    }

    /// Looks the test of two kinds up in kPairTests, unrolled at compile time: each is called directly.
    template <std::size_t i = 0>
    bool may_meet_in_space(int ia, const auto& na, int ib, const auto& nb) {
        if constexpr (i < std::size(kPairTests)) {
            constexpr PairTest pair = kPairTests[i];
            if (na.kind != pair.a || nb.kind != pair.b) return may_meet_in_space<i + 1>(ia, na, ib, nb);
            if (pair.mixes_time && !same_scale_) return true;
            if constexpr (pair.test == BoxKind::obb2d) return may_meet_on_floor(a_.rectangle(na), b_.rectangle(nb));
            const Separation separation = separate<i>(ia, na, ib, nb);
            if constexpr (Observer::watches) observer_.box_test(pair.test, separation);
            return !separation.separated();
        } else {
            return true;
        }
    }

    /// All four axes are tried at once: a branch would cost more than the rest of them.
    bool may_meet_on_floor(const Rectangle& a, const Rectangle& b) {
        const FloorGaps gaps(a, b, frame_);
        if constexpr (Observer::watches) observer_.box_test(BoxKind::obb2d, gaps.first_above(frame_.slack2d()));
        return !gaps.separated(frame_.slack2d());
    }

    template <std::size_t i>
    Separation separate(int ia, const auto& na, int ib, const auto& nb) {
        constexpr PairTest pair = kPairTests[i];
        if constexpr (is_upright(pair.a) && is_upright(pair.b)) {
            return pair.rectangles(a_.rectangle(na), b_.rectangle(nb), frame_);
        } else {
            return pair.boxes(box<pair.a>(a_, ia, na), box<pair.b>(b_, ib, nb), frame_);
        }
    }

    template <BoxKind kind>
    static decltype(auto) box(const auto& source, int i, const auto& node) {
        if constexpr (is_upright(kind)) {
            return source.box(i, node);
        } else {
            return source.stored_box(i, node);
        }
    }

    /// Two leaves: their blocks if both have some, else their samples.
    template <Mode mode>
    bool test_leaves(int ia, const auto& na, int ib, const auto& nb) {
        if constexpr (kBlocks) {
            if (a_.has_blocks(na) && b_.has_blocks(nb)) [[unlikely]]
                return test_blocks(ia, na, ib, nb);
        }
        const PairVisit pairs =
            visit_samples<mode>(a_.samples(na), na.first, na.end(), b_.samples(nb), nb.first, nb.end());
        if constexpr (Observer::watches) observer_.sample_test(pairs.hit);
        return pairs.stopped;
    }

    /// Out of line, so that trees without blocks keep no registers for it.
    [[gnu::noinline]] bool test_blocks(int ia, const auto& na, int ib, const auto& nb) {
        LinkPlace place_a, place_b;
        const PlacedBlocks blocks_a = a_.blocks(na, place_a), blocks_b = b_.blocks(nb, place_b);
        const HitSink sink{[](void* receiver, int i, int j) -> bool { return (*static_cast<OnHit*>(receiver))(i, j); },
                           &on_hit_};
        BlocksOfNodes<Observer> watched(observer_, ia, ib);
        return detail::for_each_hit(blocks_a, blocks_b, RootsApart(blocks_a, blocks_b), sink, watched.observer());
    }

    template <StoredSamples SamplesA, StoredSamples SamplesB>
    StoredRelation relation_of(const SamplesA& a, const SamplesB& b) const {
        if constexpr (SamplesA::kStoredInFrame && SamplesB::kStoredInFrame) {
            return {frame_.rotation(), frame_.offset(), frame_.slack2d()};
        } else {
            const StoredDisks stored_a = a.stored(), stored_b = b.stored();
            const Rotation to_a = stored_a.rotation.inverse();
            return {to_a * stored_b.rotation, to_a(stored_b.translate - stored_a.translate), frame_.slack2d()};
        }
    }

    template <Mode mode>
    PairVisit visit_samples(const auto& a, int first_a, int end_a, const auto& b, int first_b, int end_b) {
        if constexpr (mode == Mode::shifted) {
            return visit_shifted_pairs(shift_, relation_of(a, b), a, first_a, end_a, b, first_b, end_b, observer_,
                                       on_hit_);
        } else {
            constexpr Motion motion = mode == Mode::linear ? Motion::linear : Motion::held;
            return visit_pairs<motion>(a, first_a, end_a, b, first_b, end_b, observer_, on_hit_);
        }
    }

    const A& a_;
    const B& b_;
    RelativeFrame frame_;
    bool same_scale_;
    SampleShift shift_;
    Observer& observer_;
    OnHit& on_hit_;
};

/// Calls on_hit with the sample pairs of two node sources that collide, earliest first, until it returns true: then it
/// returns true.
template <WalkTests walk_tests = WalkTests::time, NodeSource A, NodeSource B, TraversalObserver Observer, class OnHit>
bool visit_hits(const A& a, const B& b, Observer& observer, OnHit& on_hit) {
    if constexpr (Observer::watches) observer.enter(0, 0);
    // The cheapest test comes before anything else is worked out or read.
    const bool overlap = overlap_in_time(a.begin_time(), a.end_time(), b.begin_time(), b.end_time());
    if constexpr (Observer::watches) observer.time_test(overlap);
    const bool stopped = overlap && Traversal<A, B, Observer, OnHit, walk_tests>(a, b, observer, on_hit).run();
    if constexpr (Observer::watches) observer.leave();
    return stopped;
}

}  // namespace mobb
