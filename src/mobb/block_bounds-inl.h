// Tests of several pairs of bounds at a time. Included once for each set of instructions, in a namespace MOBB_LANES of
// mobb in which hn has the operations. They only rule out: what collides is decided by the predicate, or is sure by far
// more than rounding.

namespace mobb::MOBB_LANES {

using Paths = Blocks::Paths;

constexpr int kLanes = 8;  // pairs a test: a set of instructions with fewer takes several steps
using Tag = hn::CappedTag<float, kLanes>;

/// A bit for each lane, the first one the lowest; kLanes are no more than a byte.
template <class Mask>
MOBB_INLINE std::uint64_t mask_bits(Tag d, Mask mask) {
    std::uint8_t bits[8];
    hn::StoreMaskBits(d, mask, bits);
    return bits[0];
}

/// How B's blocks lie against A's.
struct Relation {
    float c, s;        ///< rotation from B's frame to A's
    float ox, oy;      ///< B's origin against A's, in A's frame
    float slack;       ///< metres by which bounds that stand still must be apart; of nearly timed clips a step more
    float sure_slack;  ///< metres by which disks must overlap to collide for sure
};

/// How well it is known which samples share time.
enum class Timed {
    badly,   ///< unknown
    nearly,  ///< known, except where two samples only touch
    fairly,  ///< all partners are known; whether A's sample shares enough time with the first one is not
    well,    ///< all known
};

/// When B's samples begin against A's, of one dt.
struct Shift {
    static constexpr std::int64_t kOne = std::int64_t{1} << Blocks::kLogParts;
    std::int64_t parts = 0;  ///< of a sample
    Timed timed = Timed::badly;

    /// B's first sample begins so many samples after A's ...
    int whole() const { return static_cast<int>((parts - 1) >> Blocks::kLogParts); }
    /// ... and these parts of one, 0 < rest_parts() <= kOne: A's sample i shares them with B's i - whole() - 1, and the
    /// others with i - whole(), if there are any. Nearly timed it may share a moment with i - whole() - 2, too.
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
        out |= static_cast<unsigned>(mask_bits(d, meets)) << lane;
    }
    return out;
}

/// Of several pairs, a bit each.
struct Nearness {
    std::uint64_t may = 0;   ///< whether some of the samples that are meant may collide
    std::uint64_t sure = 0;  ///< whether the samples at the centres do, if there are both

    /// Whether some may, and none does for sure.
    MOBB_INLINE bool undecided() const {
        // A compiler that sees through this makes two branches of it, the first of which is often mispredicted.
        std::uint64_t open = sure == 0 ? may : 0;
        asm("" : "+r"(open));
        return open != 0;
    }
};

/// Squared distances of B's points (bx, by), turned by (c, s), from A's: B's origin lies at (from_x, from_y) from
/// these.
template <class Lanes>
MOBB_INLINE Lanes squared_apart(Lanes c, Lanes s, Lanes bx, Lanes by, Lanes from_x, Lanes from_y) {
    const Lanes px = hn::NegMulAdd(s, by, hn::MulAdd(c, bx, from_x));
    const Lanes py = hn::MulAdd(c, by, hn::MulAdd(s, bx, from_y));
    return hn::MulAdd(px, px, hn::Mul(py, py));
}

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
        const auto from_x = hn::Sub(ox, hn::LoadU(d, a.x + i)), from_y = hn::Sub(oy, hn::LoadU(d, a.y + i));
        const auto squared = squared_apart(c, s, bx, by, from_x, from_y);
        const auto most = hn::Add(hn::LoadU(d, a.outer + i), hn::Add(slack, hn::LoadU(d, b.outer + j)));
        const auto least = hn::Add(hn::LoadU(d, a.inner + i), hn::Sub(hn::LoadU(d, b.inner + j), sure_slack));
        const auto may = hn::Le(squared, hn::Mul(most, most));
        const auto sure = hn::Lt(squared, hn::Mul(least, hn::Abs(least)));  // never, where that is negative
        out.may |= mask_bits(d, may) << lane;
        out.sure |= mask_bits(d, sure) << lane;
    }
    return out;
}

/// Of kLanes samples of A from `first_a` on, each against two of B's, one behind the other from `first_b` on: whether
/// one of them may collide. The first one's is sure where Relation says that it shares enough.
MOBB_INLINE Nearness nearness_to_both(const Blocks::Rings& a, std::ptrdiff_t first_a, const Blocks::Rings& b,
                                      std::ptrdiff_t first_b, const Relation& relation) {
    const Tag d;
    const auto c = hn::Set(d, relation.c), s = hn::Set(d, relation.s);
    const auto ox = hn::Set(d, relation.ox), oy = hn::Set(d, relation.oy);
    const auto slack = hn::Set(d, relation.slack), sure_slack = hn::Set(d, relation.sure_slack);
    Nearness out;
    for (int lane = 0; lane < kLanes; lane += static_cast<int>(hn::Lanes(d))) {
        const std::ptrdiff_t i = first_a + lane, j = first_b + lane;
        const auto from_x = hn::Sub(ox, hn::LoadU(d, a.x + i)), from_y = hn::Sub(oy, hn::LoadU(d, a.y + i));
        const auto radius = hn::LoadU(d, a.inner + i), wide = hn::Add(radius, slack);
        const auto first = squared_apart(c, s, hn::LoadU(d, b.x + j), hn::LoadU(d, b.y + j), from_x, from_y);
        const auto next = squared_apart(c, s, hn::LoadU(d, b.x + j + 1), hn::LoadU(d, b.y + j + 1), from_x, from_y);
        const auto radius_first = hn::LoadU(d, b.inner + j);
        const auto most_first = hn::Add(wide, radius_first), most_next = hn::Add(wide, hn::LoadU(d, b.inner + j + 1));
        const auto least = hn::Add(radius, hn::Sub(radius_first, sure_slack));
        // Never, where a sum is negative: a sample is missing, or nothing is sure.
        const auto may = hn::Or(hn::Le(first, hn::Mul(most_first, hn::Abs(most_first))),
                                hn::Le(next, hn::Mul(most_next, hn::Abs(most_next))));
        const auto sure = hn::Lt(first, hn::Mul(least, hn::Abs(least)));
        out.may |= mask_bits(d, may) << lane;
        out.sure |= mask_bits(d, sure) << lane;
    }
    return out;
}

/// The lowest `count` bits, 0 < count <= 64.
MOBB_INLINE std::uint64_t some_low_bits(int count) { return ~std::uint64_t{0} >> (64 - count); }
/// Likewise; none if there are fewer than none.
MOBB_INLINE std::uint64_t low_bits(int count) { return count > 0 ? some_low_bits(count) : 0; }

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

/// Metres by which bounds that stand still must be apart.
MOBB_INLINE float slack_of(const PlacedBlocks& a, const PlacedBlocks& b, const RootsApart& roots) {
    return rounded_up(roots.rounding) + a.blocks().slack() + b.blocks().slack();
}
MOBB_INLINE Relation relate(const PlacedBlocks& a, const PlacedBlocks& b, const RootsApart& roots, Shift shift) {
    glm::dvec2 offset = roots.between;
    if (a.blocks().is_short() || b.blocks().is_short())
        offset +=
            roots.turn(b.blocks().origin() - b.blocks().root_begin()) - (a.blocks().origin() - a.blocks().root_begin());
    const float slack = slack_of(a, b, roots);
    const float room = shift.timed == Timed::nearly ? slack + b.blocks().step() : slack;
    const bool tells = shift.rest_parts() >= std::max(a.blocks().sure_parts(), b.blocks().sure_parts());
    return {static_cast<float>(roots.turn.c),
            static_cast<float>(roots.turn.s),
            static_cast<float>(offset.x),
            static_cast<float>(offset.y),
            room,
            tells ? slack : Blocks::kNever};
}

/// Whether times are exact enough to tell by parts of a sample which of two clips' samples share enough of it.
MOBB_INLINE bool have_parts(const PlacedBlocks& a, const PlacedBlocks& b, const RootsApart& roots) {
    return roots.time_error + 2 * std::max(a.dt(), b.dt()) / static_cast<double>(Shift::kOne) < kMinOverlap / 2;
}
/// How well two are timed that have no parts.
MOBB_INLINE Timed timed_to(const PlacedBlocks& a, const PlacedBlocks& b, const RootsApart& roots) {
    if (roots.time_error < kMinOverlap / 2) return Timed::well;
    return roots.time_error < std::min(a.dt(), b.dt()) / 8 ? Timed::nearly : Timed::badly;
}
/// By the difference of their starts, of two that have no parts.
[[gnu::noinline]] inline Shift shift_by_difference(const PlacedBlocks& a, const PlacedBlocks& b,
                                                   const RootsApart& roots) {
    const double error = roots.time_error;
    const Timed timed = timed_to(a, b, roots);
    if (timed == Timed::badly) return {};
    const double per_dt = a.blocks().per_dt();
    const double later = (b.start() - a.start()) * per_dt + (b.first() - a.first());
    const double up = std::ceil(later), left = up - later;
    const std::int64_t whole = static_cast<std::int64_t>(up) * Shift::kOne;
    if (timed == Timed::well) {
        // In step: what rounding leaves is less than samples must share.
        if (left >= 1 - error * per_dt) return {whole - Shift::kOne, Timed::well};
    } else {
        // The sum of a start and a clip's time is rounded, but a later one never to less: samples share time only if
        // they do by these sums, in which the start cancels.
        const double unsure = RootsApart::kTimeError * (a.end() + b.end());
        if (left <= unsure) return {whole, Timed::nearly};
        if (left >= 1 - unsure) return {whole - Shift::kOne, Timed::nearly};
        // More than a moment, but perhaps less than they must share.
        if (left >= 1 - (kMinOverlap + error) * per_dt) return {whole - Shift::kOne + 1, Timed::fairly};
    }
    // Cut off to parts it is still less than a sample, and what is shared more than nothing.
    return {whole - static_cast<std::int64_t>(left * static_cast<double>(Shift::kOne)), Timed::well};
}
/// Of two whose roots share time: so samples fit into an int. Badly timed where they share it by no constant shift, of
/// clips of different dt, or where rounding hides it.
MOBB_INLINE Shift shift_of(const PlacedBlocks& a, const PlacedBlocks& b, const RootsApart& roots) {
    if (a.dt() != b.dt()) return {};
    if (!have_parts(a, b, roots)) [[unlikely]]
        return shift_by_difference(a, b, roots);
    const double parts = (b.begin_time() - a.begin_time()) * (a.blocks().per_dt() * static_cast<double>(Shift::kOne));
    return {static_cast<std::int64_t>(parts + (parts < 0 ? -0.5 : 0.5)), Timed::well};
}

/// Two whose roots share time and may meet, and what follows from where they are placed: worked out once a query.
struct Related {
    const PlacedBlocks& a;
    const PlacedBlocks& b;
    const RootsApart& roots;
    const Shift shift;
    const Relation relation;

    MOBB_INLINE Related(const PlacedBlocks& of_a, const PlacedBlocks& of_b, const RootsApart& apart)
        : Related(of_a, of_b, apart, shift_of(of_a, of_b, apart)) {}
    MOBB_INLINE Related(const PlacedBlocks& of_a, const PlacedBlocks& of_b, const RootsApart& apart,
                        const Shift& shifted)
        : a(of_a), b(of_b), roots(apart), shift(shifted), relation(relate(a, b, roots, shift)) {}
};

constexpr int kMostBits = 64;

/// Samples [first, end) of a clip.
struct SampleSpan {
    int first, end;
};
MOBB_INLINE SampleSpan samples_of_block(const Blocks& blocks, int level, int block) {
    const int first = block * Blocks::span(level);
    return {first, std::min(blocks.count(), first + Blocks::span(level))};
}
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

}  // namespace mobb::MOBB_LANES
