#include <mobb/traversal.h>
#include <mobb_tracks/conflict.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace mobb {

namespace {

/// Is told of every pair of samples that are so close, in order of time.
class ConflictCollector {
  public:
    ConflictCollector(const PlacedClip& a, const PlacedClip& b, double within)
        : a_(a), b_(b), wide_a_(a, within), wide_b_(b, 0), intervals_{wide_a_, wide_b_, {}} {
        out_.least_clearance = std::numeric_limits<double>::infinity();
    }

    bool operator()(int i, int j) {
        intervals_(i, j);
        const Approach approach = approach_of(a_, i, b_, j);
        const double s = approach.nearest();
        const double clearance = approach.clearance(s);
        if (clearance >= out_.least_clearance) return false;
        out_.least_clearance = clearance;
        out_.time = approach.time(s);
        out_.a_sample = i;
        out_.b_sample = j;
        return false;
    }

    void measure(int first_a, int first_b) {
        NoObserver observer;
        visit_sample_pairs(wide_a_, first_a, a_.count(), wide_b_, first_b, b_.count(), observer, *this);
    }

    Conflict take() {
        out_.intervals = std::move(intervals_.intervals);
        return std::move(out_);
    }

  private:
    const PlacedClip& a_;
    const PlacedClip& b_;
    WidenedClip wide_a_, wide_b_;
    IntervalCollector<WidenedClip, WidenedClip> intervals_;
    Conflict out_;
};

}  // namespace

const Interval& interval_at(std::span<const Interval> intervals, double time) {
    const auto begins_later = [time](double t0) { return t0 > time; };
    const auto after = std::ranges::find_if(intervals, begins_later, &Interval::t0);
    return after == intervals.begin() ? *after : *(after - 1);
}

double seconds_of(std::span<const Interval> intervals) {
    double sum = 0;
    for (const Interval& interval : intervals) sum += interval.t1 - interval.t0;
    return sum;
}

double longest_of(std::span<const Interval> intervals) {
    double most = 0;
    for (const Interval& interval : intervals) most = std::max(most, interval.t1 - interval.t0);
    return most;
}

Conflict conflict_of(const PlacedClip& a, const PlacedClip& b, double within, int first_a, int first_b) {
    ConflictCollector collector(a, b, within);
    collector.measure(first_a, first_b);
    return collector.take();
}

Conflict conflict_of(const PlacedTree& a, const PlacedTree& b) {
    ConflictCollector collector(a.placed_clip(), b.placed_clip(), 0);
    NoObserver observer;
    visit_hits(a, b, observer, collector);
    return collector.take();
}

}  // namespace mobb
