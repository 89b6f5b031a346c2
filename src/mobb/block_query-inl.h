// The traversal of two clips' blocks, for answers, counts and traces. Included once for each set of instructions, as
// block_bounds-inl.h is. Where an observer watches, each of A's blocks is tested against each of B's that it shares
// time with (may_meet): what it is told comes from the same operations in the same order on every machine, and none of
// them is fused. Where nobody does and both clips are of one dt, runs of A's samples are tested against the windows of
// B's samples that they share time with (nearness), which is faster and rules out more; clips of different dt have
// unequal_dt_scan-inl.h.
#include <mobb/unequal_dt_scan-inl.h>

namespace mobb::MOBB_LANES {

/// A's sample that begins when B's last one ends.
MOBB_INLINE int behind_shared(const Blocks& b, const Shift& shift) { return b.count() + shift.whole() + 1; }
/// Whether those two collide, of two that are nearly timed: a moment that they share comes behind all that is scanned.
inline bool last_pair_collides(const PlacedBlocks& a, const PlacedBlocks& b, const Shift& shift) {
    if (shift.timed != Timed::nearly) return false;
    const int i = behind_shared(b.blocks(), shift);
    return 0 <= i && i < a.blocks().count() && pair_collides(a, a.first() + i, b, b.end() - 1);
}

/// One traversal. OnHit is called with the pairs of samples that collide, earliest first, and says whether to stop; if
/// OnHit::kAny, it may not be called before a traversal stops, as one that collides is as good as the earliest.
template <class Observer, class OnHit, class Unequal = UnequalDtScan<OnHit, Timed::well>>
class BlockTraversal {
  public:
    MOBB_INLINE BlockTraversal(const Related& related, [[maybe_unused]] Observer& observer, OnHit& on_hit,
                               Unequal* unequal = nullptr)
        : a_(related.a),
          b_(related.b),
          blocks_a_(a_.blocks()),
          blocks_b_(b_.blocks()),
          roots_(related.roots),
          relation_(related.relation),
          shift_(related.shift),
          unequal_(unequal),
          observer_(observer),
          on_hit_(on_hit) {}

    /// Of roots that share time and may meet. Returns true if on_hit stopped it.
    bool run() {
        const int top_a = blocks_a_.levels() - 1, top_b = blocks_b_.levels() - 1, top = std::min(top_a, top_b);
        if (!Observer::watches && is_shifted())
            return scan_level(top, shared_samples(blocks_a_, blocks_b_, shift_.whole())) || decide_last();
        if (unequal_ && unequal_->fine(top_a, top_b) == 0)
            return unequal_->scan({0, blocks_a_.count()}, {0, blocks_b_.count()});
        if (blocks_a_.count(0) == 1 && blocks_b_.count(0) == 1) return test_samples(0, 0);
        if (is_shifted()) return visit_shifted(top, 0, blocks_a_.count(top), 0, blocks_b_.count(top));
        return visit_stepped(top_a, 0, blocks_a_.count(top_a), top_b, 0, blocks_b_.count(top_b));
    }

    /// Samples of A against B's that are shifted, where nobody watches: those of a block against the window of B's that
    /// it shares time with, and then what lies below it.
    bool scan_level(int level, const SampleSpan& span) {
        if (level == 0) return scan_windows(span);
        const int log_span = Blocks::log_span(level), end = ((span.end - 1) >> log_span) + 1;
        for (int first = span.first >> log_span; first < end; first += kMostBits) {
            const Pairs pairs = blocks_and_windows(blocks_a_, blocks_b_, level, first, shift_.whole());
            std::uint64_t may = pairs.first(std::min(end - first, kMostBits), relation_).may;
            for (; may != 0; may &= may - 1) {
                const std::int64_t begin = std::int64_t{first + std::countr_zero(may)} << log_span;
                const std::int64_t until = std::min<std::int64_t>(span.end, begin + Blocks::span(level));
                const int from = std::max(span.first, static_cast<int>(begin));
                if (scan_level(level - 1, {from, static_cast<int>(until)})) return true;
            }
        }
        return false;
    }
    MOBB_INLINE bool scan_windows(const SampleSpan& span) {
        const WindowPairs windows(blocks_a_, blocks_b_, span, shift_.whole());
        for (int k = 0; k < windows.count; k += kMostBits) {
            const Nearness some = windows.pairs.from(k).first(std::min(windows.count - k, kMostBits), relation_);
            if constexpr (OnHit::kAny) {
                if (some.sure != 0) return true;
            }
            if (some.may != 0 && test_runs(some.may, windows.first + k * Blocks::kRun, span)) return true;
        }
        return false;
    }

    /// What single precision tells of the samples of runs: sample k of each in bit k.
    MOBB_INLINE Nearness samples_of_runs(std::uint64_t runs, int first, const SampleSpan& span) const {
        Nearness out;
        for (; runs != 0; runs &= runs - 1) {
            const Nearness some = samples_of_run(first + std::countr_zero(runs) * Blocks::kRun, span);
            out.may |= some.may;
            out.sure |= some.sure;
        }
        return out;
    }
    /// The samples of A's runs that are set, of which bit 0 begins with sample `first`.
    MOBB_INLINE bool test_runs(std::uint64_t runs, int first, const SampleSpan& span) {
        for (; runs != 0; runs &= runs - 1) {
            if (test_run(first + std::countr_zero(runs) * Blocks::kRun, span)) return true;
        }
        return false;
    }

  private:
    bool is_shifted() const { return shift_.timed != Timed::badly; }

    /// Blocks at which B's are shifted against A's by a constant: pair (i, i - whole + k) shares time,
    /// first <= k < first + count.
    struct Shifts {
        int whole;
        double rest;  ///< samples: with k, B's block begins k blocks and so much after A's
        int first, count;
    };

    /// Seconds by which what two samples share may be more or less than it is told: times are rounded, those of one dt
    /// to whole parts of a sample.
    double time_slack() const { return roots_.time_error + a_.dt() / Shift::kOne; }
    /// Pairs that share less than this many samples are not tested ...
    double least_common() const { return (kMinOverlap - time_slack()) * blocks_a_.per_dt(); }
    /// ... and those that share more are, for sure.
    double sure_common() const { return (kMinOverlap + time_slack()) * blocks_a_.per_dt(); }
    /// Metres by which bounds that move must be apart.
    float moving_slack() const {
        return relation_.slack + static_cast<float>(time_slack()) * (blocks_a_.speed() + blocks_b_.speed());
    }

    /// Which blocks of 2^log_span samples share time: with k they share span - |k * span + rest| samples.
    Shifts shifts_of(int log_span) const {
        const int span = 1 << log_span;
        const double rest = (shift_.whole() & (span - 1)) + shift_.rest();
        const int first = rest > least_common() ? -1 : 0, last = span - rest > least_common() ? 0 : -1;
        return {shift_.whole() >> log_span, rest, first, last - first + 1};
    }
    /// When those of `k` do, if B's begins `rest` samples later for k = 0.
    static Common common_of(double rest, int k, double span) {
        const double begin = k * span + rest;
        const double from = std::max(begin, 0.0);
        return {static_cast<float>(from / span), static_cast<float>((from - begin) / span),
                static_cast<float>(std::max(std::min(begin + span, span) - from, 0.0) / span)};
    }

    /// Pairs of blocks of one level of clips of one dt, in order of time, where somebody watches.
    bool visit_shifted(int level, int first_a, int end_a, int first_b, int end_b) {
        if (level > 0) return scan_pairs<Paced::moving>(level, first_a, end_a, first_b, end_b);
        return scan_pairs<Paced::still>(level, first_a, end_a, first_b, end_b);
    }
    template <Paced paced>
    bool scan_pairs(int level, int first_a, int end_a, int first_b, int end_b) {
        const int log_span = Blocks::log_span(level), span = Blocks::span(level);
        const Paths a = blocks_a_.paths(level), b = blocks_b_.paths(level);
        const int last_a = blocks_a_.count(level) - 1, last_b = blocks_b_.count(level) - 1;
        const Shifts shifts = shifts_of(log_span);
        const float slack = paced == Paced::still ? relation_.slack : moving_slack();
        constexpr int kMostShifts = 2;
        Common common[kMostShifts] = {};
        for (int m = 0; m < shifts.count; ++m) common[m] = common_of(shifts.rest, shifts.first + m, span);
        const int to_b = shifts.first - shifts.whole;  // from i to its first partner
        const int from = std::max(first_a, first_b - to_b - (shifts.count - 1));
        const int to = std::min(end_a, end_b - to_b);
        for (int i = from; i < to; i += kLanes) {
            const int n = std::min(kLanes, to - i);
            unsigned there[kMostShifts], meet[kMostShifts];
            unsigned any = 0;
            for (int m = 0; m < shifts.count; ++m) {
                const int j = i + to_b + m;
                const int low = std::max(0, first_b - j), high = std::max(0, std::min(n, end_b - j));
                there[m] = ((1U << high) - 1) & (~0U << low);
                meet[m] = there[m] & may_meet<paced>(a, i, b, j, n, common[m], relation_, slack);
                any |= there[m];
            }
            for (; any != 0; any &= any - 1) {
                const int lane = std::countr_zero(any);
                for (int m = 0; m < shifts.count; ++m) {
                    if (((there[m] >> lane) & 1U) == 0) continue;
                    const int block_a = i + lane, block_b = block_a + to_b + m;
                    // The last block of a clip may last for less than others, and share no time then.
                    const double begin_b = (shifts.first + m) * span + shifts.rest;
                    if ((block_a == last_a || block_b == last_b) && !share_time(level, block_a, block_b, begin_b)) {
                        continue;
                    }
                    if (visit_pair(level, block_a, level, block_b, ((meet[m] >> lane) & 1U) != 0)) return true;
                }
            }
        }
        return false;
    }

    /// Whether blocks i and j do, where B's begins so many samples after A's.
    bool share_time(int level, int i, int j, double begin_b) const {
        const int size = Blocks::span(level);
        const double until_a = blocks_a_.steps(i * size, size);
        const double until_b = begin_b + blocks_b_.steps(j * size, size);
        return std::min(until_a, until_b) - std::max(begin_b, 0.0) > least_common();
    }

    MOBB_INLINE bool visit_pair(int level_a, int i, int level_b, int j, bool meet) {
        if constexpr (Observer::watches) {
            const Separation apart = separation(level_a, i, level_b, j, meet);
            // The root of a clip of one block is told of in its place, and is a little larger.
            meet = !apart.separated();
            observer_.enter(blocks_a_.node_of(level_a, i), blocks_b_.node_of(level_b, j));
            observer_.box_test(BoxKind::block, apart);
        }
        const bool stop = meet && below(level_a, i, level_b, j);
        if constexpr (Observer::watches) observer_.leave();
        return stop;
    }

    MOBB_INLINE bool below(int level_a, int i, int level_b, int j) {
        if (level_a == 0 && level_b == 0) return test_samples(i, j);
        if (unequal_ && unequal_->fine(level_a, level_b) <= 1)
            return unequal_->scan(samples_of_block(blocks_a_, level_a, i), samples_of_block(blocks_b_, level_b, j));
        // Blocks that last about as long descend together; else the longer one, if it can.
        constexpr double kAlike = 3;
        const double seconds_a = Blocks::span(level_a) * a_.dt(), seconds_b = Blocks::span(level_b) * b_.dt();
        const bool down_a = level_a > 0 && (level_b == 0 || seconds_a * kAlike >= seconds_b);
        const bool down_b = level_b > 0 && (level_a == 0 || seconds_b * kAlike >= seconds_a);
        const auto children = [](const Blocks& blocks, int level, int block, bool down, int& first, int& end) {
            first = down ? block * Blocks::kFanOut : block;
            end = down ? std::min(blocks.count(level - 1), first + Blocks::kFanOut) : block + 1;
        };
        int first_a, end_a, first_b, end_b;
        children(blocks_a_, level_a, i, down_a, first_a, end_a);
        children(blocks_b_, level_b, j, down_b, first_b, end_b);
        if (is_shifted()) return visit_shifted(level_a - 1, first_a, end_a, first_b, end_b);
        return visit_stepped(level_a - (down_a ? 1 : 0), first_a, end_a, level_b - (down_b ? 1 : 0), first_b, end_b);
    }

    /// Pairs of blocks of clips of any dt.
    bool visit_stepped(int level_a, int i, int end_a, int level_b, int j, int end_b) {
        const Paths paths_a = blocks_a_.paths(level_a), paths_b = blocks_b_.paths(level_b);
        const auto time_of = [](const PlacedBlocks& placed, int level, int block) {
            const std::int64_t sample = std::int64_t{block} * Blocks::span(level);
            return placed.time(static_cast<int>(std::min<std::int64_t>(placed.first() + sample, placed.end())));
        };
        const double per_a = 1 / (Blocks::span(level_a) * a_.dt()), per_b = 1 / (Blocks::span(level_b) * b_.dt());
        double begin_a = time_of(a_, level_a, i), until_a = time_of(a_, level_a, i + 1);
        double begin_b = time_of(b_, level_b, j), until_b = time_of(b_, level_b, j + 1);
        const float slack = moving_slack();
        Gathered a, b;
        int is[kLanes], js[kLanes];
        int n = 0;
        for (bool more = true; more;) {
            if (overlap_in_time(begin_a, until_a, begin_b, until_b)) {
                const double begin = std::max(begin_a, begin_b), length = std::min(until_a, until_b) - begin;
                a.set(n, paths_a, level_a > 0, i, (begin - begin_a) * per_a, length * per_a);
                b.set(n, paths_b, level_b > 0, j, (begin - begin_b) * per_b, length * per_b);
                is[n] = i;
                js[n] = j;
                ++n;
            }
            if (until_a < until_b) {
                more = ++i < end_a;
                begin_a = until_a;
                if (more) until_a = time_of(a_, level_a, i + 1);
            } else {
                more = ++j < end_b;
                begin_b = until_b;
                if (more) until_b = time_of(b_, level_b, j + 1);
            }
            if (n < kLanes && more) continue;
            const unsigned meet =
                may_meet<Paced::moving_alike>(a.paths(), 0, b.paths(), 0, n, {0, 0, 1}, relation_, slack);
            for (int k = 0; k < n; ++k) {
                const bool is_meeting = ((meet >> k) & 1U) != 0;
                if (!Observer::watches && !is_meeting) continue;
                if (visit_pair(level_a, is[k], level_b, js[k], is_meeting)) return true;
            }
            n = 0;
        }
        return false;
    }

    /// The samples of two blocks of level 0.
    bool test_samples(int i, int j) {
        const SampleSpan a = samples_of_block(blocks_a_, 0, i), b = samples_of_block(blocks_b_, 0, j);
        const int from_a = a_.first(), from_b = b_.first();
        const PairVisit pairs = visit_sample_pairs(a_, from_a + a.first, from_a + a.end, b_, from_b + b.first,
                                                   from_b + b.end, observer_, on_hit_);
        if constexpr (Observer::watches) observer_.sample_test(pairs.hit);
        return pairs.stopped;
    }

    /// Of a run from sample i of A on, as far as it lies in the span: each against both of B's that it shares time
    /// with.
    MOBB_INLINE Nearness samples_of_run(int i, const SampleSpan& span) const {
        const Blocks::Rings a = blocks_a_.samples(), b = blocks_b_.samples();
        Nearness samples;
        for (int k = 0; k < Blocks::kRun; k += kLanes) {
            const Nearness some = nearness_to_both(a, i + k, b, i + k - shift_.whole() - 1, relation_);
            samples.may |= some.may << k;
            samples.sure |= some.sure << k;
        }
        const std::uint64_t there = low_bits(std::min(span.end - i, Blocks::kRun)) & ~low_bits(span.first - i);
        return {samples.may & there, samples.sure & there};
    }
    MOBB_INLINE bool test_run(int i, const SampleSpan& span) {
        const Nearness samples = samples_of_run(i, span);
        if constexpr (OnHit::kAny) {
            if (samples.sure != 0) return true;
        }
        return samples.may != 0 && test_near(i, samples.may);
    }
    /// A's samples that are set, of which bit 0 is `first`.
    [[gnu::noinline]] bool test_near(int first, std::uint64_t samples) {
        const bool held = !a_.is_linear() && !b_.is_linear();
        for (; samples != 0; samples &= samples - 1) {
            const int i = first + std::countr_zero(samples);
            const int j = i - shift_.whole();
            if (shift_.timed == Timed::nearly && 1 < j && decide(i, j - 2, held, 0)) return true;
            if (0 < j && j <= blocks_b_.count() && decide(i, j - 1, held, shift_.rest())) return true;
            if (0 <= j && j < blocks_b_.count() && decide(i, j, held, 1 - shift_.rest())) return true;
        }
        return false;
    }

    bool decide_last() {
        return last_pair_collides(a_, b_, shift_) &&
               on_hit_(a_.first() + behind_shared(blocks_b_, shift_), b_.end() - 1);
    }

    /// Whether samples i and j collide, which share such a part of a sample's time, and on_hit stops: in double, unless
    /// single precision leaves no doubt.
    MOBB_INLINE bool decide(int i, int j, bool held, double common) {
        const int sample_a = a_.first() + i, sample_b = b_.first() + j;
        if (held) {
            const Blocks::Rings a = blocks_a_.samples(), b = blocks_b_.samples();
            const float bx = b.x[j], by = b.y[j];
            const float x = (relation_.c * bx - relation_.s * by) - (a.x[i] - relation_.ox);
            const float y = (relation_.s * bx + relation_.c * by) - (a.y[i] - relation_.oy);
            const float squared = x * x + y * y, radii = a.inner[i] + b.inner[j];
            const float slack = slack_of(a_, b_, roots_), most = radii + slack, least = radii - slack;
            if (squared > most * most) return false;
            if (least > 0 && squared < least * least && common > sure_common()) return on_hit_(sample_a, sample_b);
        }
        return pair_collides(a_, sample_a, b_, sample_b) && on_hit_(sample_a, sample_b);
    }

    /// In double, from the stored bounds: what is apart in single precision is so by far more than that test's slack.
    Separation separation(int level_a, int i, int level_b, int j, bool meet) const {
        if (meet) return {};
        const auto box = [](const Blocks& blocks, int level, int block) {
            const Blocks::Node node = blocks.node(blocks.node_of(level, block));
            const Clip& clip = blocks.clip();
            return box_around(node.bound, clip.time(node.first), clip.time(node.first + node.count));
        };
        return separate_block(box(blocks_a_, level_a, i), box(blocks_b_, level_b, j),
                              RelativeFrame(a_.frame(), b_.frame(), 1));
    }

    const PlacedBlocks& a_;
    const PlacedBlocks& b_;
    const Blocks& blocks_a_;
    const Blocks& blocks_b_;
    const RootsApart& roots_;
    const Relation relation_;
    const Shift shift_;
    Unequal* const unequal_;  ///< of clips of different dt, where nobody watches
    Observer& observer_;
    OnHit& on_hit_;
};

struct KeepFirst {
    static constexpr bool kAny = false;
    SamplePair pair;
    bool operator()(int i, int j) {
        pair = {i, j};
        return true;
    }
};
struct AnyHit {
    static constexpr bool kAny = true;
    bool operator()(int, int) { return true; }
};

/// Returns true if on_hit stopped it.
template <class Observer, class OnHit>
MOBB_INLINE bool traverse(const Related& related, Observer& observer, OnHit& on_hit) {
    const auto& [a, b, roots, shift, relation] = related;
    const bool parts = have_parts(a, b, roots);
    if (shift.timed != Timed::badly && (parts || !Observer::watches)) [[likely]]
        return BlockTraversal(related, observer, on_hit).run();
    const Related unshifted(a, b, roots, Shift{});
    if constexpr (!Observer::watches) {
        const Timed timed = parts ? Timed::well : timed_to(a, b, roots);
        if (timed == Timed::well) {
            UnequalDtScan<OnHit, Timed::well> unequal(a, b, roots, on_hit);
            return BlockTraversal(unshifted, observer, on_hit, &unequal).run();
        }
        if (timed == Timed::nearly) {
            UnequalDtScan<OnHit, Timed::nearly> unequal(a, b, roots, on_hit);
            return BlockTraversal(unshifted, observer, on_hit, &unequal).run();
        }
    }
    return BlockTraversal(unshifted, observer, on_hit).run();
}

inline bool first_hit(const PlacedBlocks& a, const PlacedBlocks& b, const RootsApart& roots, SamplePair& pair) {
    NoObserver observer;
    KeepFirst keep;
    const bool hit = traverse(Related(a, b, roots), observer, keep);
    pair = keep.pair;
    return hit;
}

/// Whether one of the two has few enough blocks for one level.
MOBB_INLINE bool is_shallow(const Related& related) {
    return std::min(related.a.blocks().levels(), related.b.blocks().levels()) == 1;
}
/// True if the window test alone decides every pair that is not close.
MOBB_INLINE bool can_look(const Related& related) { return related.shift.timed == Timed::well && is_shallow(related); }
/// What their windows tell of two, one of which is shallow, with some samples to be scanned: of run k of A, as
/// WindowPairs says, in bit k modulo kMostBits; which of them are sure means nothing. The same work for all, without a
/// branch but for the number of steps.
MOBB_INLINE Nearness first_look(const Related& related) {
    const Blocks &a = related.a.blocks(), &b = related.b.blocks();
    const int whole = related.shift.whole();
    const WindowPairs windows(a, b, shared_samples(a, b, whole), whole);
    // The last step goes over some a second time rather than beyond them.
    const int count = windows.count, last = std::max(count - kLanes, 0);
    Nearness near;
    for (int k = 0;; k = std::min(k + kLanes, last)) {
        const Nearness some = windows.pairs.at(k, related.relation);
        near.may |= std::rotl(some.may, k);
        near.sure |= some.sure;
        if (k == last) break;
    }
    near.may &= some_low_bits(std::min(count, kMostBits));
    near.sure &= some_low_bits(std::min(count, kLanes));
    return near;
}

/// Of two that are left undecided by the first look, with what it says of runs that may. Out of line, so that it keeps
/// no registers for it.
[[gnu::noinline]] inline bool any_sample_hits(const Related& related, std::uint64_t runs) {
    NoObserver observer;
    AnyHit any;
    BlockTraversal traversal(related, observer, any);
    const Blocks &a = related.a.blocks(), &b = related.b.blocks();
    const int whole = related.shift.whole();
    const SampleSpan span = shared_samples(a, b, whole);
    const WindowPairs windows(a, b, span, whole);
    if (windows.count > kMostBits) return traversal.scan_windows(span);
    const Nearness samples = traversal.samples_of_runs(runs, windows.first, span);
    return samples.undecided() ? traversal.test_runs(runs, windows.first, span) : samples.sure != 0;
}
MOBB_INLINE bool look_for_hit(const Related& related) {
    const Nearness near = first_look(related);
    // One branch, as it is easier to foretell than which of the two is known.
    return near.undecided() ? any_sample_hits(related, near.may) : near.sure != 0;
}
[[gnu::noinline]] inline bool any_hit(const Related& related) {
    NoObserver observer;
    AnyHit any;
    return traverse(related, observer, any);
}
/// Of those that are not timed well.
[[gnu::noinline]] inline bool any_late_hit(const Related& related) {
    const auto& [a, b, roots, shift, relation] = related;
    if (is_shallow(related)) {
        if (shift.timed == Timed::fairly) {
            // The other way round the first partner is the one with which more is shared.
            const RootsApart other_way(b, a);
            const Related turned(b, a, other_way);
            if (turned.shift.timed == Timed::well) return look_for_hit(turned);
        }
        if (shift.timed == Timed::nearly && behind_shared(b.blocks(), shift) > 0)
            return look_for_hit(related) || last_pair_collides(a, b, shift);
    }
    return any_hit(related);
}

inline bool intersects(const PlacedBlocks& a, const PlacedBlocks& b, const RootsApart& roots) {
    const Related related(a, b, roots);
    if (can_look(related)) return look_for_hit(related);
    return have_parts(a, b, roots) ? any_hit(related) : any_late_hit(related);
}

inline bool for_each_hit(const PlacedBlocks& a, const PlacedBlocks& b, const RootsApart& roots, HitSink sink,
                         BlockObserver* observer) {
    const Related related(a, b, roots);
    if (observer) return traverse(related, *observer, sink);
    NoObserver nobody;
    return traverse(related, nobody, sink);
}

inline void intersects_each(const BlocksPair* pairs, std::size_t count, bool* answers) {
    // Placements lie anywhere in memory: they are fetched a few pairs ahead.
    constexpr std::size_t kAhead = 12;
    for (std::size_t i = 0; i < count; ++i) {
        const BlocksPair& ahead = pairs[std::min(i + kAhead, count - 1)];
        __builtin_prefetch(ahead.a);
        __builtin_prefetch(ahead.b);
        const RootsApart roots(*pairs[i].a, *pairs[i].b);
        answers[i] = roots.meet && MOBB_LANES::intersects(*pairs[i].a, *pairs[i].b, roots);
    }
}

inline const BlockQueries* queries() {
    static constexpr BlockQueries all{first_hit, intersects, for_each_hit, intersects_each};
    return &all;
}

}  // namespace mobb::MOBB_LANES
