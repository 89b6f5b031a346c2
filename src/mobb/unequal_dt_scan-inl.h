// The scan of two clips of different dt where nobody watches. Included once for each set of instructions, as
// block_bounds-inl.h is.
#include <mobb/block_bounds-inl.h>

namespace mobb::MOBB_LANES {

/// Parts of a clip, one behind the other, that last equally long; of its last one less may be there. A disk that stands
/// still holds each, in metres relative to Blocks::origin().
struct Units {
    const float* x;
    const float* y;
    const float* r;
};

/// When units of one clip begin, in units of another one, which last as long or longer: unit k at from + k * step.
struct Pace {
    double from, step;
};

/// For units first + lane, lane < kLanes: a bit is set where one may meet the first of the other clip's units that it
/// shares time with or, of two partners, the next. Bits of units that share no time with any mean nothing. `relation`
/// is the others' to these.
template <int partners>
MOBB_INLINE unsigned near_partners(const Units& units, int first, const Units& others, const Pace& pace,
                                   const Relation& relation) {
    const Tag d;
    const auto c = hn::Set(d, relation.c), s = hn::Set(d, relation.s);
    const auto ox = hn::Set(d, relation.ox), oy = hn::Set(d, relation.oy);
    const auto slack = hn::Set(d, relation.slack);
    constexpr int kVector = static_cast<int>(hn::MaxLanes(d));
    // Whether compilers work out several at a time by themselves depends on what is around.
    using Begins [[gnu::vector_size(kVector * sizeof(double))]] = double;
    using Whole [[gnu::vector_size(kVector * sizeof(std::int32_t))]] = std::int32_t;
    Begins steps;
    for (int k = 0; k < kVector; ++k) steps[k] = k * pace.step;
    unsigned out = 0;
    for (int lane = 0; lane < kLanes; lane += kVector) {
        const int i = first + lane;
        // As the others last no shorter, the partners of a vector's units lie within a vector.
        const double at = pace.from + i * pace.step;
        const int j = static_cast<int>(at);
        const Whole apart = __builtin_convertvector(at + steps, Whole) - j;
        std::int32_t partner[kVector];
        for (int k = 0; k < kVector; ++k) partner[k] = std::min(apart[k], kVector - 1);
        const auto index = hn::SetTableIndices(d, partner);
        const auto from_x = hn::Sub(ox, hn::LoadU(d, units.x + i)), from_y = hn::Sub(oy, hn::LoadU(d, units.y + i));
        const auto r = hn::Add(hn::LoadU(d, units.r + i), slack);
        for (int m = 0; m < partners; ++m) {
            const auto bx = hn::TableLookupLanes(hn::LoadU(d, others.x + j + m), index);
            const auto by = hn::TableLookupLanes(hn::LoadU(d, others.y + j + m), index);
            const auto reach = hn::Add(r, hn::TableLookupLanes(hn::LoadU(d, others.r + j + m), index));
            const auto squared = squared_apart(c, s, bx, by, from_x, from_y);
            out |= static_cast<unsigned>(mask_bits(d, hn::Le(squared, hn::Mul(reach, reach)))) << lane;
        }
    }
    return out;
}

/// Two clips of different dt, the fine one's less than the coarse one's, that are timed well, or nearly, and whose
/// roots share time. Nearly timed ones look for partners earlier, by as much as times may be wrong, and for one more.
/// OnHit as BlockTraversal has it.
template <class OnHit, Timed timed>
class UnequalDtScan {
  public:
    UnequalDtScan(const PlacedBlocks& a, const PlacedBlocks& b, const RootsApart& roots, OnHit& on_hit)
        : fine_is_a_(a.dt() < b.dt()),
          fine_(fine_is_a_ ? a : b),
          coarse_(fine_is_a_ ? b : a),
          roots_(fine_is_a_ ? roots : RootsApart(b, a)),
          ratio_(fine_.dt() * coarse_.blocks().per_dt()),
          begin_((fine_.begin_time() - coarse_.begin_time()) * coarse_.blocks().per_dt()),
          unsure_(timed == Timed::well ? 0 : roots.time_error / fine_.dt()),
          relation_(relate(fine_, coarse_, roots_, Shift{})),
          on_hit_(on_hit) {}

    /// Of what A and B have each, the fine clip's.
    template <class T>
    const T& fine(const T& of_a, const T& of_b) const {
        return fine_is_a_ ? of_a : of_b;
    }

    /// Tests a span of A's samples against one of B's, in order of time. Returns true if on_hit stopped it.
    bool scan(const SampleSpan& a, const SampleSpan& b) {
        const SampleSpan& coarse = fine_is_a_ ? b : a;
        const SampleSpan shared = sharing(fine(a, b), coarse);
        const int first = shared.first >> Blocks::kLogSamples, end = ((shared.end - 1) >> Blocks::kLogSamples) + 1;
        const auto test_run = [&](int k) {
            const int begin = k * Blocks::kSamples;
            return test_samples({std::max(shared.first, begin), std::min(shared.end, begin + Blocks::kSamples)},
                                coarse);
        };
        constexpr double kPerBlock = 1.0 / Blocks::kSamples;
        // Blocks that last much longer than what they are tested against rule out little.
        constexpr double kAlike = 3 * kPerBlock;
        if (ratio_ >= kAlike) {
            const Pace pace{from_coarse(0) * kPerBlock, ratio_};
            return scan_units<2 + kMore>(blocks_of(fine_), first, end, blocks_of(coarse_), pace, relation_, test_run);
        }
        if (ratio_ <= kPerBlock) {
            const Pace pace{from_coarse(0), ratio_ * Blocks::kSamples};
            return scan_units<1 + kMore>(blocks_of(fine_), first, end, pairs_of(coarse_), pace, relation_, test_run);
        }
        const int from = std::max(coarse.first, static_cast<int>(from_coarse(shared.first)));
        const int to = std::min(coarse.end, static_cast<int>(until_coarse(shared.end)) + 1);
        const Pace pace{from_fine(0) * kPerBlock, kPerBlock / ratio_};
        return scan_units<2 + kMore>(samples_of(coarse_), from, to, blocks_of(fine_), pace,
                                     relate(coarse_, fine_, RootsApart(coarse_, fine_), Shift{}), [&](int j) {
                                         const SampleSpan one{j, j + 1};
                                         return test_samples(sharing(shared, one), one);
                                     });
    }

  private:
    static constexpr int kMore = timed == Timed::well ? 0 : 1;  // partners
    /// By how much times may be wrong, in samples of the fine clip, if that matters.
    double unsure() const { return timed == Timed::well ? 0 : unsure_; }

    static Units blocks_of(const PlacedBlocks& placed) {
        const Paths paths = placed.blocks().paths(0);
        return {paths.x(), paths.y(), paths.r()};
    }
    static Units samples_of(const PlacedBlocks& placed) {
        const Blocks::Rings samples = placed.blocks().samples();
        return {samples.x, samples.y, samples.inner};
    }
    /// Samples, each with the one behind it.
    static Units pairs_of(const PlacedBlocks& placed) {
        const Blocks::Rings samples = placed.blocks().samples();
        return {samples.x, samples.y, samples.outer};
    }

    /// Where the fine clip's sample i begins, at the earliest and at the latest, in samples of the coarse one; and the
    /// other way round.
    double from_coarse(int i) const { return begin_ + (i - unsure()) * ratio_; }
    double until_coarse(int i) const { return begin_ + (i + unsure()) * ratio_; }
    double from_fine(int j) const { return (j - begin_) / ratio_ - unsure(); }
    double until_fine(int j) const { return (j - begin_) / ratio_ + unsure(); }

    /// Those of the fine clip's samples of a span that share time with the coarse one's of another, and perhaps one
    /// more at either end.
    SampleSpan sharing(const SampleSpan& fine, const SampleSpan& coarse) const {
        const auto within = [&](double i) { return static_cast<int>(std::clamp<double>(i, fine.first, fine.end)); };
        return {within(std::floor(from_fine(coarse.first))), within(std::floor(until_fine(coarse.end)) + 1)};
    }

    /// visit(k) of each unit, first <= k < end, that may meet one of its partners, until one returns true.
    template <int partners, class Visit>
    static bool scan_units(const Units& units, int first, int end, const Units& others, const Pace& pace,
                           const Relation& relation, const Visit& visit) {
        for (int k = first; k < end; k += kLanes) {
            std::uint64_t near = near_partners<partners>(units, k, others, pace, relation);
            near &= low_bits(std::min(end - k, kLanes));
            for (; near != 0; near &= near - 1) {
                if (visit(k + std::countr_zero(near))) return true;
            }
        }
        return false;
    }

    bool test_samples(const SampleSpan& fine, const SampleSpan& coarse) {
        const Pace pace{from_coarse(0), ratio_};
        return scan_units<1 + kMore>(samples_of(fine_), fine.first, fine.end, pairs_of(coarse_), pace, relation_,
                                     [&](int i) {
                                         const int j = static_cast<int>(std::floor(from_coarse(i)));
                                         for (int partner = std::max(coarse.first, j);
                                              partner < std::min(coarse.end, j + 2 + kMore); ++partner) {
                                             const int sample = fine_.first() + i, other = coarse_.first() + partner;
                                             if (!pair_collides(fine_, sample, coarse_, other)) continue;
                                             if (fine_is_a_ ? on_hit_(sample, other) : on_hit_(other, sample))
                                                 return true;
                                         }
                                         return false;
                                     });
    }

    const bool fine_is_a_;
    const PlacedBlocks& fine_;
    const PlacedBlocks& coarse_;
    const RootsApart roots_;  ///< of the coarse clip against the fine one
    const double ratio_;      ///< of their dt, < 1
    const double begin_;      ///< where the fine clip begins, in samples of the coarse one
    const double unsure_;     ///< see unsure()
    const Relation relation_;
    OnHit& on_hit_;
};

}  // namespace mobb::MOBB_LANES
