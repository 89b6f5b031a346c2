// The traversal of two clips' blocks: the only one, for answers, counts and traces alike. Included once for each set of
// instructions, in a namespace MOBB_LANES of mobb in which hn has the operations. Every number that decides what is
// pruned comes from the same operations in the same order on every machine, and none of them is fused.

namespace mobb::MOBB_LANES {

using Paths = Blocks::Paths;

constexpr int kLanes = 8;  // pairs a test: a set of instructions with fewer takes several steps
using Tag = hn::CappedTag<float, kLanes>;

/// The placement of B's blocks against A's, and what their bounds must be apart by.
struct Relation {
    float c, s;    ///< rotation from B's frame to A's
    float ox, oy;  ///< B's origin against A's, in A's frame
    float slack;   ///< metres
};

/// When a pair of blocks shares time, as shares of the blocks' own.
struct Common {
    float begin_a, begin_b;    ///< of each since it began
    float length_a, length_b;  ///< of the time that they share
};

/// Whether paths stay where they are.
enum class Paced { still, moving };
/// Whether all paths last equally long, or as their `lasts` say.
enum class Lasting { alike, as_told };

/// For n <= kLanes pairs (first_a + lane, first_b + lane): a bit is set where two disks may come within the sum of
/// their radii in their common time.
template <Paced paced_a, Paced paced_b, Lasting lasting = Lasting::alike>
MOBB_INLINE unsigned may_meet(const Paths& a, int first_a, const Paths& b, int first_b, int n, const Common& common,
                              const Relation& relation) {
    const Tag d;
    const auto c = hn::Set(d, relation.c), s = hn::Set(d, relation.s);
    const auto ox = hn::Set(d, relation.ox), oy = hn::Set(d, relation.oy);
    const auto slack = hn::Set(d, relation.slack);
    unsigned out = 0;
    for (int lane = 0; lane < n; lane += static_cast<int>(hn::Lanes(d))) {
        const int i = first_a + lane, j = first_b + lane;
        auto ax = hn::LoadU(d, a.x + i), ay = hn::LoadU(d, a.y + i);
        auto bx = hn::LoadU(d, b.x + j), by = hn::LoadU(d, b.y + j);
        const auto reach = hn::Add(hn::Add(hn::LoadU(d, a.r + i), slack), hn::LoadU(d, b.r + j));
        // How far each moves in the common time.
        const auto zero = hn::Set(d, 0.0F);
        auto adx = zero, ady = zero, bdx = zero, bdy = zero;
        auto length_a = hn::Set(d, common.length_a), length_b = hn::Set(d, common.length_b);
        if constexpr (lasting == Lasting::as_told) {
            const auto left_a = hn::Sub(hn::LoadU(d, a.lasts + i), hn::Set(d, common.begin_a));
            const auto left_b = hn::Sub(hn::LoadU(d, b.lasts + j), hn::Set(d, common.begin_b));
            length_a = length_b = hn::Max(hn::Min(hn::Min(left_a, left_b), length_a), zero);
        }
        if constexpr (paced_a == Paced::moving) {
            const auto dx = hn::LoadU(d, a.dx + i), dy = hn::LoadU(d, a.dy + i);
            const auto begin = hn::Set(d, common.begin_a);
            ax = hn::Add(ax, hn::Mul(begin, dx));
            ay = hn::Add(ay, hn::Mul(begin, dy));
            adx = hn::Mul(length_a, dx);
            ady = hn::Mul(length_a, dy);
        }
        if constexpr (paced_b == Paced::moving) {
            const auto dx = hn::LoadU(d, b.dx + j), dy = hn::LoadU(d, b.dy + j);
            const auto begin = hn::Set(d, common.begin_b);
            bx = hn::Add(bx, hn::Mul(begin, dx));
            by = hn::Add(by, hn::Mul(begin, dy));
            const auto mx = hn::Mul(length_b, dx), my = hn::Mul(length_b, dy);
            bdx = hn::Sub(hn::Mul(c, mx), hn::Mul(s, my));
            bdy = hn::Add(hn::Mul(s, mx), hn::Mul(c, my));
        }
        auto px = hn::Sub(hn::Sub(hn::Mul(c, bx), hn::Mul(s, by)), hn::Sub(ax, ox));
        auto py = hn::Sub(hn::Add(hn::Mul(s, bx), hn::Mul(c, by)), hn::Sub(ay, oy));
        if constexpr (paced_a == Paced::moving || paced_b == Paced::moving) {
            // When they are nearest: the way is never 0 here, and where it nearly is, any moment does.
            const auto vx = hn::Sub(bdx, adx), vy = hn::Sub(bdy, ady);
            const auto way2 = hn::Add(hn::Add(hn::Mul(vx, vx), hn::Mul(vy, vy)), hn::Set(d, 1e-30F));
            const auto along = hn::Sub(zero, hn::Add(hn::Mul(px, vx), hn::Mul(py, vy)));
            const auto moment = hn::Min(hn::Max(hn::Div(along, way2), zero), hn::Set(d, 1.0F));
            px = hn::Add(px, hn::Mul(moment, vx));
            py = hn::Add(py, hn::Mul(moment, vy));
        }
        const auto meets = hn::Le(hn::Add(hn::Mul(px, px), hn::Mul(py, py)), hn::Mul(reach, reach));
        std::uint8_t bits[8];
        hn::StoreMaskBits(d, meets, bits);
        out |= static_cast<unsigned>(bits[0]) << lane;
    }
    return out;
}

/// One side of several pairs of blocks, copied side by side: in clips of different dt they do not lie so.
struct Gathered {
    float x[kLanes], y[kLanes], dx[kLanes], dy[kLanes], r[kLanes];

    MOBB_INLINE void set(int lane, const Paths& from, int i, double begin, double length) {
        const auto share = static_cast<float>(begin), part = static_cast<float>(length);
        const float all_x = from.dx ? from.dx[i] : 0, all_y = from.dy ? from.dy[i] : 0;
        x[lane] = from.x[i] + share * all_x;
        y[lane] = from.y[i] + share * all_y;
        r[lane] = from.r[i];
        dx[lane] = part * all_x;
        dy[lane] = part * all_y;
    }
    Paths paths() const { return {x, y, r, dx, dy, nullptr}; }
};

// What rounding adds at most, as a share of the numbers that go in, with a wide margin.
constexpr double kSingle = 0x1p-17, kDouble = 0x1p-44;

/// One traversal. OnHit is called with the pairs of samples that collide, earliest first, and says whether to stop.
template <class Observer, class OnHit>
class BlockTraversal {
  public:
    MOBB_INLINE BlockTraversal(const PlacedBlocks& a, const PlacedBlocks& b, [[maybe_unused]] Observer& observer,
                               OnHit& on_hit)
        : a_(a), b_(b), blocks_a_(a.blocks()), blocks_b_(b.blocks()), observer_(observer), on_hit_(on_hit) {}

    /// Of roots that share time and may meet. Returns true if on_hit stopped it.
    bool run() {
        relate();
        if (blocks_a_.count(0) == 1 && blocks_b_.count(0) == 1) return test_samples(0, 0);
        const int top_a = blocks_a_.levels() - 1, top_b = blocks_b_.levels() - 1;
        if (shifted_) {
            const int level = std::min(top_a, top_b);
            return visit_shifted(level, 0, blocks_a_.count(level), 0, blocks_b_.count(level));
        }
        return visit_stepped(top_a, 0, blocks_a_.count(top_a), top_b, 0, blocks_b_.count(top_b));
    }

  private:
    /// Blocks (or samples) at which B's are shifted against A's by a constant: pair (i, i - whole + k) shares time,
    /// first <= k < first + count.
    struct Shifts {
        int whole;
        double rest;  ///< samples: with k, B's block begins k blocks and so much after A's
        int first, count;
    };
    static constexpr int kMostShifts = 4;

    /// Relates B's blocks to A's.
    MOBB_INLINE void relate() {
        const Rotation to_a = a_.rotation().inverse();
        const Rotation turn = to_a * b_.rotation();
        const glm::dvec2 offset = to_a(b_.center() - a_.center());
        // Single precision is about the lengths that remain.
        const double lengths = std::abs(offset.x) + std::abs(offset.y) + blocks_a_.extent() + blocks_b_.extent();
        const double time_error = kDouble * (a_.largest_time() + b_.largest_time());
        const double slack =
            a_.rounding() + b_.rounding() + kSingle * lengths + time_error * (blocks_a_.speed() + blocks_b_.speed());
        relation_ = {static_cast<float>(turn.c), static_cast<float>(turn.s), static_cast<float>(offset.x),
                     static_cast<float>(offset.y), static_cast<float>(slack)};
        const double per_dt = blocks_a_.per_dt();
        // Less than this many samples in common are not tested; rounded times may overlap where exact ones do not.
        least_common_ = (kMinOverlap - time_error) * per_dt;
        constexpr double kMostError = 0.125;
        shifted_ = a_.dt() == b_.dt() && time_error * per_dt < kMostError;
        if (!shifted_) return;
        // Of roots that share time it fits into an int.
        const double shift = (b_.begin() - a_.begin()) * per_dt;
        whole_ = static_cast<int>(shift);
        if (shift < whole_) --whole_;
        rest_ = shift - whole_;
    }

    /// Which blocks of 2^log_span samples share time: with k they share span - |k * span + rest| samples.
    MOBB_INLINE Shifts shifts_of(int log_span) const {
        const int span = 1 << log_span;
        const double rest = (whole_ & (span - 1)) + rest_;
        // As a rule -1 and 0; the others share time only by rounding.
        const int first = rest - span > least_common_ ? -2 : rest > least_common_ ? -1 : 0;
        const int last = -rest > least_common_ ? 1 : span - rest > least_common_ ? 0 : -1;
        return {whole_ >> log_span, rest, first, last - first + 1};
    }
    /// When those of `k` do.
    MOBB_INLINE Common common_of(const Shifts& shifts, int k, int log_span) const {
        const double span = 1 << log_span;
        const double begin = k * span + shifts.rest;
        const double from = std::max(begin, 0.0);
        const auto length = static_cast<float>(std::max(std::min(begin + span, span) - from, 0.0) / span);
        return {static_cast<float>(from / span), static_cast<float>((from - begin) / span), length, length};
    }

    /// Calls visit(i, j, k, meet) for the pairs of [first_a, end_a) x [first_b, end_b) that may meet, in order of
    /// time, until it returns true; if `all`, for all that share time. Everything comes by value: what is referred to
    /// would lie in memory. Compiled for the numbers of shifts that are usual.
    template <bool all, Paced paced_a, Paced paced_b, Lasting lasting, class Visit>
    MOBB_INLINE bool for_each_shifted(Shifts shifts, int log_span, Paths a, int first_a, int end_a, Paths b,
                                      int first_b, int end_b, Visit visit) {
        if (shifts.count == 2) {
            return scan<2, all, paced_a, paced_b, lasting>(shifts, log_span, a, first_a, end_a, b, first_b, end_b,
                                                           visit);
        }
        if (shifts.count == 1) {
            return scan<1, all, paced_a, paced_b, lasting>(shifts, log_span, a, first_a, end_a, b, first_b, end_b,
                                                           visit);
        }
        return scan_any<all, paced_a, paced_b, lasting>(shifts, log_span, a, first_a, end_a, b, first_b, end_b, visit);
    }
    template <bool all, Paced paced_a, Paced paced_b, Lasting lasting, class Visit>
    [[gnu::noinline]] bool scan_any(Shifts shifts, int log_span, Paths a, int first_a, int end_a, Paths b, int first_b,
                                    int end_b, Visit visit) {
        return shifts.count > 0 && scan<kMostShifts, all, paced_a, paced_b, lasting>(shifts, log_span, a, first_a,
                                                                                     end_a, b, first_b, end_b, visit);
    }
    template <int most, bool all, Paced paced_a, Paced paced_b, Lasting lasting, class Visit>
    MOBB_INLINE bool scan(Shifts shifts, int log_span, Paths a, int first_a, int end_a, Paths b, int first_b, int end_b,
                          Visit visit) {
        constexpr bool still = paced_a == Paced::still && paced_b == Paced::still;
        const int count = most < kMostShifts ? most : shifts.count;
        Common common[kMostShifts] = {};
        for (int m = 0; m < count && !still; ++m) common[m] = common_of(shifts, shifts.first + m, log_span);
        const int to_b = shifts.first - shifts.whole;  // from i to its first partner
        const int from = std::max(first_a, first_b - to_b - (count - 1));
        const int to = std::min(end_a, end_b - to_b);
        for (int i = from; i < to; i += kLanes) {
            const int n = std::min(kLanes, to - i);
            unsigned there[kMostShifts], meet[kMostShifts];
            unsigned any = 0;
            for (int m = 0; m < count; ++m) {
                const int j = i + to_b + m;
                const int low = std::max(0, first_b - j), high = std::max(0, std::min(n, end_b - j));
                there[m] = ((1U << high) - 1) & (~0U << low);
                meet[m] = there[m] & may_meet<paced_a, paced_b, lasting>(a, i, b, j, n, common[m], relation_);
                any |= all ? there[m] : meet[m];
            }
            for (; any != 0; any &= any - 1) {
                const int lane = std::countr_zero(any);
                for (int m = 0; m < count; ++m) {
                    const bool is_meeting = ((meet[m] >> lane) & 1U) != 0;
                    if (!(all ? ((there[m] >> lane) & 1U) != 0 : is_meeting)) continue;
                    if (visit(i + lane, i + lane + to_b + m, shifts.first + m, is_meeting)) return true;
                }
            }
        }
        return false;
    }

    /// Pairs of blocks of one level of clips of one dt.
    bool visit_shifted(int level, int first_a, int end_a, int first_b, int end_b) {
        return level == 0 ? visit_shifted<Paced::still>(0, first_a, end_a, first_b, end_b)
                          : visit_shifted<Paced::moving>(level, first_a, end_a, first_b, end_b);
    }
    template <Paced paced>
    bool visit_shifted(int level_above_0, int first_a, int end_a, int first_b, int end_b) {
        constexpr bool still = paced == Paced::still;
        const int level = still ? 0 : level_above_0;
        const int log_span = Blocks::log_span(level);
        const int last_a = blocks_a_.count(level) - 1, last_b = blocks_b_.count(level) - 1;
        const Shifts shifts = shifts_of(log_span);
        constexpr Lasting lasting = still ? Lasting::alike : Lasting::as_told;
        const auto visit = [=, this](int i, int j, int k, bool meet) {
            // The last block of a clip may have fewer samples than others, and share no time then.
            const double begin_b = k * Blocks::span(level) + shifts.rest;
            if ((i == last_a || j == last_b) && !share_time(level, i, j, begin_b)) return false;
            return visit_pair(level, i, level, j, meet);
        };
        return for_each_shifted<Observer::watches, paced, paced, lasting>(
            shifts, log_span, blocks_a_.paths(level), first_a, end_a, blocks_b_.paths(level), first_b, end_b, visit);
    }

    /// Whether blocks i and j do, where B's begins so many samples after A's.
    bool share_time(int level, int i, int j, double begin_b) const {
        const int size = Blocks::span(level);
        const double until_a = std::min(size, blocks_a_.count() - i * size);
        const double until_b = begin_b + std::min(size, blocks_b_.count() - j * size);
        return std::min(until_a, until_b) - std::max(begin_b, 0.0) > least_common_;
    }

    MOBB_INLINE bool visit_pair(int level_a, int i, int level_b, int j, bool meet) {
        if constexpr (Observer::watches) observer_.enter(blocks_a_.node_of(level_a, i), blocks_b_.node_of(level_b, j));
        if constexpr (Observer::watches) observer_.box_test(BoxKind::block, separation(level_a, i, level_b, j, meet));
        const bool stop = meet && below(level_a, i, level_b, j);
        if constexpr (Observer::watches) observer_.leave();
        return stop;
    }

    MOBB_INLINE bool below(int level_a, int i, int level_b, int j) {
        if (level_a == 0 && level_b == 0) return test_samples(i, j);
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
        if (shifted_) return visit_shifted(level_a - 1, first_a, end_a, first_b, end_b);
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
        Gathered a, b;
        int is[kLanes], js[kLanes];
        int n = 0;
        for (bool more = true; more;) {
            if (overlap_in_time(begin_a, until_a, begin_b, until_b)) {
                const double begin = std::max(begin_a, begin_b), length = std::min(until_a, until_b) - begin;
                a.set(n, paths_a, i, (begin - begin_a) * per_a, length * per_a);
                b.set(n, paths_b, j, (begin - begin_b) * per_b, length * per_b);
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
                may_meet<Paced::moving, Paced::moving>(a.paths(), 0, b.paths(), 0, n, {0, 0, 1, 1}, relation_);
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
        const int first_a = i * Blocks::kSamples, end_a = std::min(blocks_a_.count(), first_a + Blocks::kSamples);
        const int first_b = j * Blocks::kSamples, end_b = std::min(blocks_b_.count(), first_b + Blocks::kSamples);
        if (Observer::watches || !shifted_) {
            const int from_a = a_.first(), from_b = b_.first();
            const PairVisit pairs = visit_sample_pairs(a_, from_a + first_a, from_a + end_a, b_, from_b + first_b,
                                                       from_b + end_b, observer_, on_hit_);
            if constexpr (Observer::watches) observer_.sample_test(pairs.hit);
            return pairs.stopped;
        }
        if (a_.is_linear()) {
            return b_.is_linear() ? test_shifted<Paced::moving, Paced::moving>(first_a, end_a, first_b, end_b)
                                  : test_shifted<Paced::moving, Paced::still>(first_a, end_a, first_b, end_b);
        }
        return b_.is_linear() ? test_shifted<Paced::still, Paced::moving>(first_a, end_a, first_b, end_b)
                              : test_shifted<Paced::still, Paced::still>(first_a, end_a, first_b, end_b);
    }

    template <Paced paced_a, Paced paced_b>
    bool test_shifted(int first_a, int end_a, int first_b, int end_b) {
        return for_each_shifted<false, paced_a, paced_b, Lasting::alike>(
            shifts_of(0), 0, blocks_a_.sample_paths(), first_a, end_a, blocks_b_.sample_paths(), first_b, end_b,
            [this](int i, int j, int, bool) { return decide(i, j); });
    }

    /// In double: what is near enough is not yet a hit.
    bool decide(int i, int j) {
        i += a_.first();
        j += b_.first();
        return pair_collides(a_, i, b_, j) && on_hit_(i, j);
    }

    /// In double, from the stored bounds: what is apart in single precision is so by far more than that test's slack.
    Separation separation(int level_a, int i, int level_b, int j, bool meet) const {
        if (meet) return {};
        const auto box = [](const Blocks& blocks, int level, int block) {
            const Blocks::Node node = blocks.node(blocks.node_of(level, block));
            return box_around(node.bound, node.first * blocks.dt(), (node.first + node.count) * blocks.dt());
        };
        return separate_block(box(blocks_a_, level_a, i), box(blocks_b_, level_b, j),
                              RelativeFrame(a_.frame(), b_.frame(), 1));
    }

    const PlacedBlocks& a_;
    const PlacedBlocks& b_;
    const Blocks& blocks_a_;
    const Blocks& blocks_b_;
    Relation relation_;
    int whole_ = 0;        ///< if shifted, B's first sample begins so many samples after A's ...
    double rest_ = 0;      ///< ... and this part of one
    double least_common_;  ///< samples
    bool shifted_;         ///< by a constant: of one dt
    Observer& observer_;
    OnHit& on_hit_;
};

struct KeepFirst {
    SamplePair pair;
    bool operator()(int i, int j) {
        pair = {i, j};
        return true;
    }
};

inline bool first_hit_below_roots(const PlacedBlocks& a, const PlacedBlocks& b, SamplePair& pair) {
    NoObserver observer;
    KeepFirst keep;
    const bool hit = BlockTraversal(a, b, observer, keep).run();
    pair = keep.pair;
    return hit;
}

inline bool for_each_hit_below_roots(const PlacedBlocks& a, const PlacedBlocks& b, HitSink sink,
                                     BlockObserver* observer) {
    if (observer) return BlockTraversal(a, b, *observer, sink).run();
    NoObserver nobody;
    return BlockTraversal(a, b, nobody, sink).run();
}

/// Calls visit(i, collides) for the pairs i of `count` whose roots meet, in order, until it returns true. Roots go
/// first, many at a time: what ends there costs no mispredicted branch.
template <class PairAt, class Visit>
void visit_pairs_in_turn(std::size_t count, const PairAt& pair_at, const Visit& visit) {
    constexpr std::size_t kAtATime = 64;
    for (std::size_t first = 0; first < count; first += kAtATime) {
        const std::size_t end = std::min(count, first + kAtATime);
        std::size_t left[kAtATime];
        std::size_t n = 0;
        for (std::size_t i = first; i < end; ++i) {
            // Placements lie anywhere in memory: they are fetched a few pairs ahead.
            constexpr std::size_t kAhead = 12;
            if (i + kAhead < count) {
                const auto [next_a, next_b] = pair_at(i + kAhead);
                __builtin_prefetch(next_a);
                __builtin_prefetch(next_b);
            }
            const auto [a, b] = pair_at(i);
            left[n] = i;
            n += roots_meet(*a, *b) ? std::size_t{1} : std::size_t{0};
        }
        for (std::size_t k = 0; k < n; ++k) {
            const auto [a, b] = pair_at(left[k]);
            NoObserver observer;
            KeepFirst keep;
            if (visit(left[k], BlockTraversal(*a, *b, observer, keep).run())) return;
        }
    }
}

inline std::size_t first_colliding(const PlacedBlocks& a, const PlacedBlocks* const* others, std::size_t count) {
    std::size_t out = count;
    visit_pairs_in_turn(
        count,
        [&](std::size_t i) {
            return BlocksPair{&a, others[i]};
        },
        [&](std::size_t i, bool hit) {
            if (hit) out = i;
            return hit;
        });
    return out;
}

inline void intersects_each(const BlocksPair* pairs, std::size_t count, bool* answers) {
    std::fill_n(answers, count, false);
    visit_pairs_in_turn(
        count, [&](std::size_t i) { return pairs[i]; },
        [&](std::size_t i, bool hit) {
            answers[i] = hit;
            return false;
        });
}

inline const BlockQueries* queries() {
    static constexpr BlockQueries all{first_hit_below_roots, for_each_hit_below_roots, first_colliding,
                                      intersects_each};
    return &all;
}

}  // namespace mobb::MOBB_LANES
