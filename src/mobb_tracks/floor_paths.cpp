#include <mobb/predicate.h>
#include <mobb/query.h>
#include <mobb_tracks/floor_paths.h>

#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace mobb {

namespace {

constexpr int kLeaf = 8;
constexpr double kShortStep = 1e-3;  // of a range of lags
constexpr int kNarrowings = 45;      // of a range of times: to 1e-9 of it by the golden section, 1e-13 by halves

/// A range of samples and the rectangle that their disks lie in.
struct Range {
    int first = 0;
    int end = 0;
    glm::dvec2 min{std::numeric_limits<double>::max()};
    glm::dvec2 max{std::numeric_limits<double>::lowest()};
    int second = 0;  ///< index of the second half; the first half comes next; 0: none

    bool is_leaf() const { return second == 0; }
};

/// Halves of halves of a path, depth first. Boxes along the axes of the world: all that is asked is a bound.
class Ranges {
  public:
    /// `leaf`: the most samples of a range that is not halved.
    Ranges(const PlacedClip& clip, int leaf) : clip_(clip), leaf_(leaf) {
        disks_.reserve(static_cast<std::size_t>(clip.count()));
        for (int i = 0; i < clip.count(); ++i) disks_.push_back(clip.disk(i));
        build(0, clip.clip().steps());
    }

    const Range& operator[](int i) const { return ranges_[static_cast<std::size_t>(i)]; }
    const Disk& disk(int i) const { return disks_[static_cast<std::size_t>(i)]; }
    double begin(int i) const { return clip_.time(i); }
    double end(int i) const { return clip_.time(i + 1); }
    SweptDisk swept(int i) const { return mobb::swept(clip_, i); }

  private:
    int build(int first, int end) {
        const auto index = ranges_.size();
        ranges_.emplace_back();
        Range range;
        range.first = first;
        range.end = end;
        if (end - first <= leaf_) {
            // One that runs to the next sample lies between the two.
            const int stop = clip_.is_linear() ? std::min(end + 1, clip_.count()) : end;
            const auto at = static_cast<std::size_t>(first);
            for (const Disk& d : std::span(disks_).subspan(at, static_cast<std::size_t>(stop) - at)) {
                range.min = {std::min(range.min.x, d.x - d.r), std::min(range.min.y, d.y - d.r)};
                range.max = {std::max(range.max.x, d.x + d.r), std::max(range.max.y, d.y + d.r)};
            }
        } else {
            const int middle = first + (end - first) / 2;
            const Range one = (*this)[build(first, middle)];
            range.second = build(middle, end);
            const Range& two = (*this)[range.second];
            range.min = {std::min(one.min.x, two.min.x), std::min(one.min.y, two.min.y)};
            range.max = {std::max(one.max.x, two.max.x), std::max(one.max.y, two.max.y)};
        }
        ranges_[index] = range;
        return static_cast<int>(index);
    }

    const PlacedClip& clip_;
    int leaf_;
    std::vector<Disk> disks_;
    std::vector<Range> ranges_;
};

/// Lower bound on what disks of two ranges are apart, 0 if the rectangles overlap.
double apart(const Range& a, const Range& b) {
    const double x = std::max({a.min.x - b.max.x, b.min.x - a.max.x, 0.0});
    const double y = std::max({a.min.y - b.max.y, b.min.y - a.max.y, 0.0});
    return std::sqrt(x * x + y * y);
}

/// The pair of samples with the least value, by branch and bound.
template <class Bound, class Value>
class Least {
  public:
    /// `value_of(i, j, least)`: of two samples, exactly where it is below `least`; else anything that is not.
    Least(const Ranges& a, const Ranges& b, std::int64_t& visits, const Bound& bound, const Value& value_of)
        : a_(a), b_(b), visits_(visits), bound_(bound), value_of_(value_of) {
        visit(0, 0, bound_(a_[0], b_[0]));
    }

    double value = std::numeric_limits<double>::infinity();
    int i = -1;
    int j = -1;

  private:
    void visit(int ia, int ib, double least) {
        if (least >= value || --visits_ < 0) return;
        const Range& a = a_[ia];
        const Range& b = b_[ib];
        if (a.is_leaf() && b.is_leaf()) {
            for (int p = a.first; p < a.end; ++p) {
                for (int q = b.first; q < b.end; ++q) {
                    const double found = value_of_(p, q, value);
                    if (found < value) value = found, i = p, j = q;
                }
            }
            return;
        }
        // The longer of the two is halved, and the more promising half is looked at first.
        const bool halve_a = b.is_leaf() || (!a.is_leaf() && a.end - a.first >= b.end - b.first);
        struct Half {
            int a, b;
            double least;
        };
        std::array<Half, 2> halves{halve_a ? Half{ia + 1, ib, 0} : Half{ia, ib + 1, 0},
                                   halve_a ? Half{a.second, ib, 0} : Half{ia, b.second, 0}};
        for (Half& half : halves) half.least = bound_(a_[half.a], b_[half.b]);
        if (halves[1].least < halves[0].least) std::swap(halves[0], halves[1]);
        for (const Half& half : halves) visit(half.a, half.b, half.least);
    }

    const Ranges& a_;
    const Ranges& b_;
    std::int64_t& visits_;
    const Bound& bound_;
    const Value& value_of_;
};

/// Two samples on the floor, whatever the time: with a lag, B is taken that much later than A.
class LaggedPair {
  public:
    LaggedPair(const SweptDisk& a, const SweptDisk& b)
        : a_(a), b_(b), least_(b.begin - a.end), most_(b.end - a.begin) {}

    /// False only if they overlap at no lag that is nearer to 0 than this.
    bool may_overlap(double lag) const {
        const double low = std::max(least_, -lag), high = std::min(most_, lag);
        if (low >= high) return false;
        const double at_low = apart(low), at_high = apart(high);
        if (at_low < 0 || at_high < 0) return true;
        // What is least over the times of A is convex in the lag, as the clearance is in both times: it is nowhere less
        // than at an end from which it does not fall.
        const double step = kShortStep * (high - low);
        return apart(low + step) < at_low && apart(high - step) < at_high;
    }

    /// Before what follows is asked.
    void narrow() {
        constexpr double kGolden = 0.61803398874989485;
        double low = least_, high = most_;
        double one = high - kGolden * (high - low), two = low + kGolden * (high - low);
        double at_one = apart(one), at_two = apart(two);
        for (int i = 0; i < kNarrowings; ++i) {
            if (at_one <= at_two) {
                high = std::exchange(two, one);
                at_two = std::exchange(at_one, apart(one = high - kGolden * (high - low)));
            } else {
                low = std::exchange(one, two);
                at_one = std::exchange(at_two, apart(two = low + kGolden * (high - low)));
            }
        }
        nearest_ = at_one <= at_two ? one : two;
        apart_ = std::min(at_one, at_two);
    }

    /// Metres between the two at the times at which they are nearest on the floor; < 0: how deep they overlap.
    double apart() const { return apart_; }
    /// The lag nearest to 0 at which they overlap, of two that do so at some lag and not at 0, seconds.
    double lag() const {
        double outside = std::clamp(0.0, least_, most_);
        if (apart(outside) < 0) return outside;
        double inside = nearest_;
        for (int i = 0; i < kNarrowings; ++i) {
            const double middle = 0.5 * (outside + inside);
            (apart(middle) < 0 ? inside : outside) = middle;
        }
        return inside;
    }

  private:
    double apart(double lag) const {
        const Approach approach(a_, {b_.from, b_.to, b_.begin - lag, b_.end - lag});
        return approach.clearance(approach.nearest());
    }

    SweptDisk a_, b_;
    double least_, most_;  ///< lags at which they share time
    double nearest_ = 0;
    double apart_ = 0;
};

}  // namespace

FloorPaths floor_paths(const PlacedClip& clip_a, const PlacedClip& clip_b, std::int64_t most_visits,
                       bool meeting_alone) {
    const bool runs = clip_a.is_linear() || clip_b.is_linear();
    const Ranges a(clip_a, runs ? 1 : kLeaf);
    const Ranges b(clip_b, runs ? 1 : kLeaf);
    std::int64_t visits = most_visits;
    constexpr double kApart = std::numeric_limits<double>::infinity();
    const auto gap = [](double begin_a, double end_a, double begin_b, double end_b) {
        return std::max(begin_b - end_a, begin_a - end_b);
    };
    const auto gap_bound = [&](const Range& ra, const Range& rb) {
        if (apart(ra, rb) > 0) return kApart;
        const double between = gap(a.begin(ra.first), a.end(ra.end - 1), b.begin(rb.first), b.end(rb.end - 1));
        // In ranges that share time there may be samples that share any of it.
        return between > 0 ? between : runs ? 0 : -kApart;
    };
    const auto narrowed = [&](LaggedPair pair) {
        visits -= kRunningPair;
        pair.narrow();
        return pair;
    };
    const auto gap_value = [&](int i, int j, double least) {
        if (runs) {
            visits -= kLookedAtPair;
            const LaggedPair pair(a.swept(i), b.swept(j));
            if (!pair.may_overlap(least)) return kApart;
            const LaggedPair nearest = narrowed(pair);
            return nearest.apart() < 0 ? std::abs(nearest.lag()) : kApart;
        }
        --visits;
        return collide(a.disk(i), b.disk(j)) ? gap(a.begin(i), a.end(i), b.begin(j), b.end(j)) : kApart;
    };
    const Least meeting(a, b, visits, gap_bound, gap_value);
    if (visits < 0) return {};
    FloorPaths out;
    out.known = true;
    if (meeting.i >= 0) {
        // Samples that run may share time, and the one that begins later be there first.
        const double lag = runs ? narrowed({a.swept(meeting.i), b.swept(meeting.j)}).lag() : 0;
        const bool a_first = lag != 0 ? lag > 0 : a.begin(meeting.i) < b.begin(meeting.j);
        out.meeting = {meeting.i, meeting.j, meeting.value, a_first};
        return out;
    }
    if (meeting_alone) return out;
    const auto distance_bound = [](const Range& ra, const Range& rb) { return apart(ra, rb); };
    const auto distance = [&](int i, int j, double) {
        if (runs) return std::max(0.0, narrowed({a.swept(i), b.swept(j)}).apart());
        --visits;
        const Disk& da = a.disk(i);
        const Disk& db = b.disk(j);
        return std::max(0.0, std::sqrt(squared_distance(da, db)) - (da.r + db.r));
    };
    const Least nearest(a, b, visits, distance_bound, distance);
    if (visits < 0) return {};
    out.apart = nearest.value;
    return out;
}

}  // namespace mobb
