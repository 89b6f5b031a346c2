// The traversal of two clips' blocks, for answers, counts and traces. Included once for each set of instructions, in a
// namespace MOBB_LANES of mobb in which hn has the operations. Where an observer watches, each of A's blocks is tested
// against each of B's that it shares time with (may_meet): what it is told comes from the same operations in the same
// order on every machine, and none of them is fused. Where nobody does and both clips are of one dt, runs of A's
// samples are tested against the windows of B's samples that they share time with (nearness), which is faster and rules
// out more. Either only rules out: what collides is decided by the predicate, or is sure by far more than rounding.

namespace mobb::MOBB_LANES {

using Paths = Blocks::Paths;

constexpr int kLanes = 8;  // pairs a test: a set of instructions with fewer takes several steps
using Tag = hn::CappedTag<float, kLanes>;

/// How B's blocks lie against A's.
struct Relation {
    float c, s;        ///< rotation from B's frame to A's
    float ox, oy;      ///< B's origin against A's, in A's frame
    float slack;       ///< metres by which bounds that stand still must be apart
    float sure_slack;  ///< metres by which disks must overlap to collide for sure
};

/// When B's samples begin against A's, of one dt.
struct Shift {
    static constexpr std::int64_t kOne = std::int64_t{1} << Blocks::kLogParts;
    std::int64_t parts;  ///< of a sample

    /// B's first sample begins so many samples after A's ...
    int whole() const { return static_cast<int>((parts - 1) >> Blocks::kLogParts); }
    /// ... and these parts of one, 0 < rest_parts() <= kOne: A's sample i shares them with B's i - whole() - 1, and the
    /// others with i - whole(), if there are any.
    std::int64_t rest_parts() const { return ((parts - 1) & (kOne - 1)) + 1; }
    double rest() const { return static_cast<double>(rest_parts()) / kOne; }
};

/// When a pair of blocks shares time, as shares of a whole block's.
struct Common {
    float begin_a = 0, begin_b = 0;  ///< of each since it began
    float length = 0;                ///< of the time that they share
};

/// Whether bounds stand still; move, for as long as `lasts` says; or move for all of the common time.
enum class Paced { still, moving, moving_alike };

/// For n <= kLanes pairs (first_a + lane, first_b + lane): a bit is set where two disks may come within the sum of
/// their radii, and `room` metres, in their common time. Bits from n on mean nothing.
template <Paced paced>
MOBB_INLINE unsigned may_meet(const Paths& a, int first_a, const Paths& b, int first_b, int n, const Common& common,
                              const Relation& relation, float room) {
    const Tag d;
    const auto c = hn::Set(d, relation.c), s = hn::Set(d, relation.s);
    const auto ox = hn::Set(d, relation.ox), oy = hn::Set(d, relation.oy);
    const auto slack = hn::Set(d, room);
    unsigned out = 0;
    for (int lane = 0; lane < n; lane += static_cast<int>(hn::Lanes(d))) {
        const int i = first_a + lane, j = first_b + lane;
        auto ax = hn::LoadU(d, a.x() + i), ay = hn::LoadU(d, a.y() + i);
        auto bx = hn::LoadU(d, b.x() + j), by = hn::LoadU(d, b.y() + j);
        const auto reach = hn::Add(hn::Add(hn::LoadU(d, a.r() + i), slack), hn::LoadU(d, b.r() + j));
        const auto zero = hn::Set(d, 0.0F);
        auto vx = zero, vy = zero;  // what B moves by in the common time, as A sees it
        if constexpr (paced != Paced::still) {
            const auto begin_a = hn::Set(d, common.begin_a), begin_b = hn::Set(d, common.begin_b);
            auto length = hn::Set(d, common.length);
            if constexpr (paced == Paced::moving) {
                const auto left_a = hn::Sub(hn::LoadU(d, a.lasts() + i), begin_a);
                const auto left_b = hn::Sub(hn::LoadU(d, b.lasts() + j), begin_b);
                length = hn::Max(hn::Min(hn::Min(left_a, left_b), length), zero);
            }
            const auto adx = hn::LoadU(d, a.dx() + i), ady = hn::LoadU(d, a.dy() + i);
            const auto bdx = hn::LoadU(d, b.dx() + j), bdy = hn::LoadU(d, b.dy() + j);
            ax = hn::Add(ax, hn::Mul(begin_a, adx));
            ay = hn::Add(ay, hn::Mul(begin_a, ady));
            bx = hn::Add(bx, hn::Mul(begin_b, bdx));
            by = hn::Add(by, hn::Mul(begin_b, bdy));
            const auto mx = hn::Mul(length, bdx), my = hn::Mul(length, bdy);
            vx = hn::Sub(hn::Sub(hn::Mul(c, mx), hn::Mul(s, my)), hn::Mul(length, adx));
            vy = hn::Sub(hn::Add(hn::Mul(s, mx), hn::Mul(c, my)), hn::Mul(length, ady));
        }
        auto px = hn::Sub(hn::Sub(hn::Mul(c, bx), hn::Mul(s, by)), hn::Sub(ax, ox));
        auto py = hn::Sub(hn::Add(hn::Mul(s, bx), hn::Mul(c, by)), hn::Sub(ay, oy));
        if constexpr (paced != Paced::still) {
            // When they are nearest: the way is never 0 here, and where it nearly is, any moment does.
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

/// Of several pairs, a bit each.
struct Nearness {
    std::uint64_t may = 0;   ///< whether some of the samples that are meant may collide
    std::uint64_t sure = 0;  ///< whether the samples at the centres do, if there are both
};

/// Of kLanes pairs (first_a + lane, first_b + lane). The samples at the centres share what Shift says of the first
/// partner.
MOBB_INLINE Nearness nearness(const Blocks::Rings& a, std::ptrdiff_t first_a, const Blocks::Rings& b,
                              std::ptrdiff_t first_b, const Relation& relation) {
    const Tag d;
    const auto c = hn::Set(d, relation.c), s = hn::Set(d, relation.s);
    const auto ox = hn::Set(d, relation.ox), oy = hn::Set(d, relation.oy);
    const auto slack = hn::Set(d, relation.slack), sure_slack = hn::Set(d, relation.sure_slack);
    Nearness out;
    for (int lane = 0; lane < kLanes; lane += static_cast<int>(hn::Lanes(d))) {
        const std::ptrdiff_t i = first_a + lane, j = first_b + lane;
        const auto bx = hn::LoadU(d, b.x + j), by = hn::LoadU(d, b.y + j);
        const auto px = hn::NegMulAdd(s, by, hn::MulAdd(c, bx, hn::Sub(ox, hn::LoadU(d, a.x + i))));
        const auto py = hn::MulAdd(c, by, hn::MulAdd(s, bx, hn::Sub(oy, hn::LoadU(d, a.y + i))));
        const auto squared = hn::MulAdd(px, px, hn::Mul(py, py));
        const auto most = hn::Add(hn::LoadU(d, a.outer + i), hn::Add(slack, hn::LoadU(d, b.outer + j)));
        const auto least = hn::Add(hn::LoadU(d, a.inner + i), hn::Sub(hn::LoadU(d, b.inner + j), sure_slack));
        const auto may = hn::Le(squared, hn::Mul(most, most));
        const auto sure = hn::Lt(squared, hn::Mul(least, hn::Abs(least)));  // never, where that is negative
        std::uint8_t bits[8];
        hn::StoreMaskBits(d, may, bits);
        out.may |= std::uint64_t{bits[0]} << lane;
        hn::StoreMaskBits(d, sure, bits);
        out.sure |= std::uint64_t{bits[0]} << lane;
    }
    return out;
}

/// The lowest `count` bits, none if there are fewer than none. count <= 64.
MOBB_INLINE std::uint64_t low_bits(int count) { return count > 0 ? ~std::uint64_t{0} >> (64 - count) : 0; }

/// One side of several pairs of blocks, copied side by side: in clips of different dt they do not lie so.
struct Gathered {
    float values[5 * kLanes];

    MOBB_INLINE void set(int lane, const Paths& from, bool moves, int i, double begin, double length) {
        const auto share = static_cast<float>(begin), part = static_cast<float>(length);
        const float dx = moves ? from.dx()[i] : 0, dy = moves ? from.dy()[i] : 0;
        values[lane] = from.x()[i] + share * dx;
        values[kLanes + lane] = from.y()[i] + share * dy;
        values[2 * kLanes + lane] = from.r()[i];
        values[3 * kLanes + lane] = part * dx;
        values[4 * kLanes + lane] = part * dy;
    }
    Paths paths() const { return {values, kLanes}; }
};

MOBB_INLINE Relation relate(const PlacedBlocks& a, const PlacedBlocks& b, Shift shift) {
    const float ca = a.cosine(), sa = a.sine(), cb = b.cosine(), sb = b.sine();
    const glm::dvec2 between = b.center() - a.center();
    const auto x = static_cast<float>(between.x), y = static_cast<float>(between.y);
    const float slack = a.slack() + b.slack();
    const bool tells = shift.rest_parts() >= std::max(a.blocks().sure_parts(), b.blocks().sure_parts());
    return {
        ca * cb + sa * sb, ca * sb - sa * cb, ca * x + sa * y, ca * y - sa * x, slack, tells ? slack : Blocks::kNever};
}

/// Seconds by which times of either may be wrong, from rounding.
MOBB_INLINE float time_error(const PlacedBlocks& a, const PlacedBlocks& b) {
    return static_cast<float>(PlacedBlocks::kTimeError * (a.largest_time() + b.largest_time()));
}

/// Whether samples of the two share time by a constant shift: of one dt, and not so late that it is too inexact to tell
/// which do.
MOBB_INLINE bool are_shifted(const PlacedBlocks& a, const PlacedBlocks& b) {
    return a.dt() == b.dt() && a.begin_parts() != PlacedBlocks::kNoParts && b.begin_parts() != PlacedBlocks::kNoParts;
}

/// Of two that are shifted and whose roots share time: so samples fit into an int.
MOBB_INLINE Shift shift_of(const PlacedBlocks& a, const PlacedBlocks& b) { return {b.begin_parts() - a.begin_parts()}; }

constexpr int kMostBits = 64;

/// Samples [first, end) of A.
struct SampleSpan {
    int first, end;
};
/// Those that share time with B, where both are of one dt.
MOBB_INLINE SampleSpan shared_samples(const Blocks& a, const Blocks& b, int whole) {
    return {std::max(0, whole), std::min(a.count() - 1, b.count() + whole) + 1};
}

/// Pairs (from_a + k, from_b + k).
struct Pairs {
    Blocks::Rings a, b;
    std::ptrdiff_t from_a, from_b;

    /// kLanes of them from the k-th on.
    MOBB_INLINE Nearness at(int k, const Relation& relation) const {
        return nearness(a, from_a + k, b, from_b + k, relation);
    }
    MOBB_INLINE Pairs from(int k) const { return {a, b, from_a + k, from_b + k}; }
    /// The first n of them, n <= kMostBits.
    MOBB_INLINE Nearness first(int n, const Relation& relation) const {
        Nearness out;
        for (int k = 0; k < n; k += kLanes) {
            const Nearness some = at(k, relation);
            out.may |= some.may << k;
            out.sure |= some.sure << k;
        }
        const std::uint64_t there = low_bits(n);
        return {out.may & there, out.sure & there};
    }
};

/// Runs of kRun samples of A, one behind the other, that have all samples of a span between them: the first and the
/// last one may reach over its ends. And the windows of B's samples that they share time with.
struct WindowPairs {
    Pairs pairs;
    int first;  ///< sample of A with which the first run begins
    int count;

    MOBB_INLINE WindowPairs(const Blocks& a, const Blocks& b, const SampleSpan& span, int whole) {
        constexpr int kLog = Blocks::kLogRun;
        const Blocks::PhasePair phases = Blocks::phases_apart(whole + 1);
        const int to_place = Blocks::kRun - phases.a;  // with it, a sample's place times kRun
        const int place = (span.first + to_place) >> kLog;
        first = (place << kLog) - to_place;
        count = ((span.end - 1 + to_place) >> kLog) + 1 - place;
        const int samples = phases.a - phases.b - (whole + 1);  // from A's places to B's: whole runs
        pairs = {a.windows(phases.index_a), b.windows(phases.index_b), place, place + (samples >> kLog)};
    }
};
/// A's blocks of a level above 0 from `first` on, and the windows of B's samples that they share time with.
MOBB_INLINE Pairs blocks_and_windows(const Blocks& a, const Blocks& b, int level, int first, int whole) {
    const int log_unit = Blocks::log_span(level - 1), log_span = Blocks::log_span(level);
    const int middle = (first << log_span) + (1 << (log_span - 1));
    const int nearest_b = (middle - whole - 1) + (1 << (log_unit - 1));
    const int number_a = middle >> log_unit, number_b = nearest_b >> log_unit;
    return {a.windows(level, number_a), b.windows(level, number_b), Blocks::place_of_number(number_a),
            Blocks::place_of_number(number_b)};
}
/// A's samples from i on, and B's from j on.
MOBB_INLINE Pairs samples_of(const Blocks& blocks_a, int i, const Blocks& blocks_b, int j) {
    const Blocks::Rings a = blocks_a.samples();
    return {{a.x, a.y, a.inner, a.inner}, blocks_b.samples(), i, j};
}

/// One traversal. OnHit is called with the pairs of samples that collide, earliest first, and says whether to stop; if
/// OnHit::kAny, it may not be called before a traversal stops, as one that collides is as good as the earliest.
template <class Observer, class OnHit>
class BlockTraversal {
  public:
    MOBB_INLINE BlockTraversal(const PlacedBlocks& a, const PlacedBlocks& b, const Relation& relation,
                               const Shift* shift, [[maybe_unused]] Observer& observer, OnHit& on_hit)
        : a_(a),
          b_(b),
          blocks_a_(a.blocks()),
          blocks_b_(b.blocks()),
          relation_(relation),
          shifted_(shift != nullptr),
          shift_(shift ? *shift : Shift{0}),
          observer_(observer),
          on_hit_(on_hit) {}

    /// Of roots that share time and may meet. Returns true if on_hit stopped it.
    bool run() {
        const int top_a = blocks_a_.levels() - 1, top_b = blocks_b_.levels() - 1, top = std::min(top_a, top_b);
        if (!Observer::watches && shifted_)
            return scan_level(top, shared_samples(blocks_a_, blocks_b_, shift_.whole()));
        if (blocks_a_.count(0) == 1 && blocks_b_.count(0) == 1) return test_samples(0, 0);
        if (shifted_) return visit_shifted(top, 0, blocks_a_.count(top), 0, blocks_b_.count(top));
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

    /// The samples of A's runs that are set, of which bit 0 begins with sample `first`.
    MOBB_INLINE bool test_runs(std::uint64_t runs, int first, const SampleSpan& span) {
        for (; runs != 0; runs &= runs - 1) {
            if (test_run(first + std::countr_zero(runs) * Blocks::kRun, span)) return true;
        }
        return false;
    }

  private:
    /// Blocks at which B's are shifted against A's by a constant: pair (i, i - whole + k) shares time,
    /// first <= k < first + count.
    struct Shifts {
        int whole;
        double rest;  ///< samples: with k, B's block begins k blocks and so much after A's
        int first, count;
    };

    /// Seconds by which what two samples share may be more or less than it is told: times are rounded, those of one dt
    /// to whole parts of a sample.
    double time_slack() const { return static_cast<double>(time_error(a_, b_)) + a_.dt() / Shift::kOne; }
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
                    // The last block of a clip may have fewer samples than others, and share no time then.
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
        const double until_a = std::min(size, blocks_a_.count() - i * size);
        const double until_b = begin_b + std::min(size, blocks_b_.count() - j * size);
        return std::min(until_a, until_b) - std::max(begin_b, 0.0) > least_common();
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
        const int first_a = i * Blocks::kSamples, end_a = std::min(blocks_a_.count(), first_a + Blocks::kSamples);
        const int first_b = j * Blocks::kSamples, end_b = std::min(blocks_b_.count(), first_b + Blocks::kSamples);
        const int from_a = a_.first(), from_b = b_.first();
        const PairVisit pairs = visit_sample_pairs(a_, from_a + first_a, from_a + end_a, b_, from_b + first_b,
                                                   from_b + end_b, observer_, on_hit_);
        if constexpr (Observer::watches) observer_.sample_test(pairs.hit);
        return pairs.stopped;
    }

    /// A run from sample i of A on, as far as it lies in the span: each against both of B's that it shares time with.
    MOBB_INLINE bool test_run(int i, const SampleSpan& span) {
        const Nearness samples =
            samples_of(blocks_a_, i, blocks_b_, i - shift_.whole() - 1).first(Blocks::kRun, relation_);
        const std::uint64_t there = low_bits(std::min(span.end - i, Blocks::kRun)) & ~low_bits(span.first - i);
        if constexpr (OnHit::kAny) {
            if ((samples.sure & there) != 0) return true;
        }
        return (samples.may & there) != 0 && test_near(i, samples.may & there);
    }
    /// A's samples that are set, of which bit 0 is `first`.
    [[gnu::noinline]] bool test_near(int first, std::uint64_t samples) {
        const bool held = !a_.is_linear() && !b_.is_linear();
        for (; samples != 0; samples &= samples - 1) {
            const int i = first + std::countr_zero(samples);
            const int j = i - shift_.whole();
            if (0 < j && j <= blocks_b_.count() && decide(i, j - 1, held, shift_.rest())) return true;
            if (0 <= j && j < blocks_b_.count() && decide(i, j, held, 1 - shift_.rest())) return true;
        }
        return false;
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
            const float most = radii + relation_.slack, least = radii - relation_.slack;
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
            return box_around(node.bound, node.first * blocks.dt(), (node.first + node.count) * blocks.dt());
        };
        return separate_block(box(blocks_a_, level_a, i), box(blocks_b_, level_b, j),
                              RelativeFrame(a_.frame(), b_.frame(), 1));
    }

    const PlacedBlocks& a_;
    const PlacedBlocks& b_;
    const Blocks& blocks_a_;
    const Blocks& blocks_b_;
    const Relation relation_;
    const bool shifted_;
    const Shift shift_;  ///< if so
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

/// Of roots that share time and may meet. Returns true if on_hit stopped it.
template <class Observer, class OnHit>
MOBB_INLINE bool traverse(const PlacedBlocks& a, const PlacedBlocks& b, Observer& observer, OnHit& on_hit) {
    if (!are_shifted(a, b)) [[unlikely]]
        return BlockTraversal(a, b, relate(a, b, Shift{0}), nullptr, observer, on_hit).run();
    const Shift shift = shift_of(a, b);
    return BlockTraversal(a, b, relate(a, b, shift), &shift, observer, on_hit).run();
}

inline bool first_hit_below_roots(const PlacedBlocks& a, const PlacedBlocks& b, SamplePair& pair) {
    NoObserver observer;
    KeepFirst keep;
    const bool hit = traverse(a, b, observer, keep);
    pair = keep.pair;
    return hit;
}

/// Whether a first look can be had: of two that are shifted, one of which has few enough blocks for one level.
MOBB_INLINE bool can_look(const PlacedBlocks& a, const PlacedBlocks& b) {
    return are_shifted(a, b) && std::min(a.blocks().levels(), b.blocks().levels()) == 1;
}
/// What their windows tell of two whose roots meet. The same work for all, without a branch but for the number of
/// steps.
struct FirstLook {
    SampleSpan span;
    int first, count;  ///< of runs, as WindowPairs says
    Nearness near;     ///< of run k of A in bit k modulo kMostBits

    FirstLook() = default;
    MOBB_INLINE FirstLook(const PlacedBlocks& a, const PlacedBlocks& b) {
        const Shift shift = shift_of(a, b);
        const Relation relation = relate(a, b, shift);
        span = shared_samples(a.blocks(), b.blocks(), shift.whole());
        const WindowPairs windows(a.blocks(), b.blocks(), span, shift.whole());
        first = windows.first;
        count = windows.count;
        // The last step goes over some a second time rather than beyond them.
        const int last = std::max(count - kLanes, 0);
        for (int k = 0;; k = std::min(k + kLanes, last)) {
            const Nearness some = windows.pairs.at(k, relation);
            near.may |= std::rotl(some.may, k);
            near.sure |= some.sure;
            if (k == last) break;
        }
        near.may &= low_bits(std::min(count, kMostBits));
        near.sure &= low_bits(std::min(count, kLanes));
    }
    MOBB_INLINE bool collides() const { return near.sure != 0; }
    MOBB_INLINE bool undecided() const {
        return static_cast<bool>(static_cast<unsigned>(near.sure == 0) & static_cast<unsigned>(near.may != 0));
    }
};

/// Of two that are left undecided by the first look. Out of line, so that it keeps no registers for it.
[[gnu::noinline]] inline bool any_sample_hits(const PlacedBlocks& a, const PlacedBlocks& b, const FirstLook& look) {
    NoObserver observer;
    AnyHit any;
    const Shift shift = shift_of(a, b);
    BlockTraversal traversal(a, b, relate(a, b, shift), &shift, observer, any);
    if (look.count > kMostBits) return traversal.scan_windows(look.span);
    return traversal.test_runs(look.near.may, look.first, look.span);
}
/// Of any two whose roots meet.
[[gnu::noinline]] inline bool any_hit_below_roots(const PlacedBlocks& a, const PlacedBlocks& b) {
    NoObserver observer;
    AnyHit any;
    return traverse(a, b, observer, any);
}

inline bool intersects_below_roots(const PlacedBlocks& a, const PlacedBlocks& b) {
    if (!can_look(a, b)) return any_hit_below_roots(a, b);
    const FirstLook look(a, b);
    // One branch, as it is easier to foretell than which of the two is known.
    return look.undecided() ? any_sample_hits(a, b, look) : look.collides();
}

inline bool for_each_hit_below_roots(const PlacedBlocks& a, const PlacedBlocks& b, HitSink sink,
                                     BlockObserver* observer) {
    if (observer) return traverse(a, b, *observer, sink);
    NoObserver nobody;
    return traverse(a, b, nobody, sink);
}

/// Calls found(i, collides) for pairs i of `count`, until stop(i) says that this one and those behind it need not be
/// asked; of the others it is not called if they do not collide. Of some number of pairs at a time times go first, then
/// roots, windows, and samples: what ends soon costs hardly a mispredicted branch. So they come in no order, but each
/// number of pairs behind the one before.
template <class PairAt, class Found, class Stop>
void find_colliding(std::size_t count, const PairAt& pair_at, const Found& found, const Stop& stop) {
    constexpr std::size_t kAtATime = 64;
    std::size_t together[kAtATime], below_roots[kAtATime];
    struct {
        std::size_t index;
        FirstLook look;
    } undecided[kAtATime];
    for (std::size_t first = 0; first < count && !stop(first); first += kAtATime) {
        const std::size_t end = std::min(count, first + kAtATime);
        std::size_t pairs = 0;
        for (std::size_t i = first; i < end; ++i) {
            // Placements lie anywhere in memory: they are fetched a few pairs ahead.
            constexpr std::size_t kAhead = 12;
            if (i + kAhead < count) {
                const auto [next_a, next_b] = pair_at(i + kAhead);
                __builtin_prefetch(next_a);
                __builtin_prefetch(next_b);
            }
            const auto [a, b] = pair_at(i);
            together[pairs] = i;
            pairs +=
                overlap_in_time(a->begin(), a->end_time(), b->begin(), b->end_time()) ? std::size_t{1} : std::size_t{0};
        }
        std::size_t roots = 0;
        for (std::size_t k = 0; k < pairs; ++k) {
            const auto [a, b] = pair_at(together[k]);
            below_roots[roots] = together[k];
            roots += roots_meet(*a, *b) ? std::size_t{1} : std::size_t{0};
        }
        std::size_t open = 0;
        for (std::size_t k = 0; k < roots; ++k) {
            const std::size_t i = below_roots[k];
            const auto [a, b] = pair_at(i);
            if (!can_look(*a, *b)) [[unlikely]] {
                found(i, !stop(i) && any_hit_below_roots(*a, *b));
                continue;
            }
            const FirstLook look(*a, *b);
            found(i, look.collides());
            undecided[open] = {i, look};
            open += look.undecided() ? std::size_t{1} : std::size_t{0};
        }
        for (std::size_t k = 0; k < open && !stop(undecided[k].index); ++k) {
            const auto& pair = undecided[k];
            const auto [a, b] = pair_at(pair.index);
            found(pair.index, any_sample_hits(*a, *b, pair.look));
        }
    }
}

inline std::size_t first_colliding(const PlacedBlocks& a, const PlacedBlocks* const* others, std::size_t count) {
    std::size_t out = count;
    find_colliding(
        count,
        [&](std::size_t i) {
            return BlocksPair{&a, others[i]};
        },
        [&](std::size_t i, bool collides) { out = std::min(out, collides ? i : count); },
        [&](std::size_t i) { return out <= i; });
    return out;
}

inline void intersects_each(const BlocksPair* pairs, std::size_t count, bool* answers) {
    std::fill_n(answers, count, false);
    find_colliding(
        count, [&](std::size_t i) { return pairs[i]; }, [&](std::size_t i, bool collides) { answers[i] = collides; },
        [](std::size_t) { return false; });
}

inline const BlockQueries* queries() {
    static constexpr BlockQueries all{first_hit_below_roots, intersects_below_roots, for_each_hit_below_roots,
                                      first_colliding, intersects_each};
    return &all;
}

}  // namespace mobb::MOBB_LANES
