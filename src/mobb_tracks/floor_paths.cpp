#include <mobb/halves_search.h>
#include <mobb/predicate.h>
#include <mobb/query.h>
#include <mobb_tracks/floor_paths.h>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace mobb {

namespace {

constexpr int kLeaf = 8;
constexpr double kShortStep = 1e-3;  // of a range of lags
constexpr int kNarrowings = 45;      // of a range of times: to 1e-9 of it by the golden section, 1e-13 by halves

/// The octagon with sides along x, y and their diagonals around disks: how far these reach along each.
class Octagon {
  public:
    void cover(const Disk& disk) {
        const Sides at{disk.x, disk.y, kDiagonal * (disk.x + disk.y), kDiagonal * (disk.x - disk.y)};
        for (std::size_t i = 0; i < at.size(); ++i) {
            min_[i] = std::min(min_[i], at[i] - disk.r);
            max_[i] = std::max(max_[i], at[i] + disk.r);
        }
    }
    void cover(const Octagon& other) {
        for (std::size_t i = 0; i < min_.size(); ++i) {
            min_[i] = std::min(min_[i], other.min_[i]);
            max_[i] = std::max(max_[i], other.max_[i]);
        }
    }

    /// Lower bound on what disks of two are apart, 0 if the octagons overlap along all sides.
    friend double apart(const Octagon& a, const Octagon& b) {
        Sides gap;
        for (std::size_t i = 0; i < gap.size(); ++i)
            gap[i] = std::max({a.min_[i] - b.max_[i], b.min_[i] - a.max_[i], 0.0});
        return std::max(std::sqrt(gap[0] * gap[0] + gap[1] * gap[1]), std::sqrt(gap[2] * gap[2] + gap[3] * gap[3]));
    }

  private:
    using Sides = std::array<double, 4>;
    static constexpr double kDiagonal = 0.70710678118654752;
    static constexpr Sides all(double value) { return {value, value, value, value}; }

    Sides min_ = all(std::numeric_limits<double>::max());
    Sides max_ = all(std::numeric_limits<double>::lowest());
};

/// A range of samples and what their disks lie in.
struct Range {
    int first = 0;
    int end = 0;
    int second = 0;  ///< index of the second half; the first half comes next; 0: none
    Octagon around{};

    bool is_leaf() const { return second == 0; }
};

/// Halves of halves of a path, depth first.
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
            for (const Disk& disk : std::span(disks_).subspan(at, static_cast<std::size_t>(stop) - at))
                range.around.cover(disk);
        } else {
            const int middle = first + (end - first) / 2;
            range.around = (*this)[build(first, middle)].around;
            range.second = build(middle, end);
            range.around.cover((*this)[range.second].around);
        }
        ranges_[index] = range;
        return static_cast<int>(index);
    }

    const PlacedClip& clip_;
    int leaf_;
    std::vector<Disk> disks_;
    std::vector<Range> ranges_;
};

/// Squared metres from a point to a segment.
double squared_distance(const Disk& point, const Disk& from, const Disk& to) {
    const glm::dvec2 along(to.x - from.x, to.y - from.y), away(point.x - from.x, point.y - from.y);
    const double length = glm::dot(along, along);
    const double share = length > 0 ? std::clamp(glm::dot(away, along) / length, 0.0, 1.0) : 0;
    const glm::dvec2 aside = away - share * along;
    return glm::dot(aside, aside);
}

bool are_on_both_sides(const Disk& a, const Disk& b, const Disk& from, const Disk& to) {
    const auto side = [&](const Disk& of) {
        return (to.x - from.x) * (of.y - from.y) - (to.y - from.y) * (of.x - from.x);
    };
    return side(a) * side(b) < 0;
}

/// Whether the ways of two samples are so far apart that their disks are in no common place.
bool are_far_apart(const SweptDisk& a, const SweptDisk& b) {
    constexpr double kSlack = 1e-6;  // metres: who touches is measured
    const double reach = std::max(a.from.r, a.to.r) + std::max(b.from.r, b.to.r) + kSlack;
    const double squared = std::min({squared_distance(a.from, b.from, b.to), squared_distance(a.to, b.from, b.to),
                                     squared_distance(b.from, a.from, a.to), squared_distance(b.to, a.from, a.to)});
    if (squared <= reach * reach) return false;
    return !are_on_both_sides(a.from, a.to, b.from, b.to) || !are_on_both_sides(b.from, b.to, a.from, a.to);
}

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

constexpr double kNone = std::numeric_limits<double>::infinity();

/// Of two paths.
class FloorSearch {
  public:
    /// Refers to the paths. They are halved down to the samples where any of them runs.
    FloorSearch(const Ranges& a, const Ranges& b, bool runs, std::int64_t most_visits)
        : a_(a), b_(b), runs_(runs), visits_(most_visits) {}

    /// Whether what was asked for was not found in so many visits.
    bool gave_up() const { return visits_ < 0; }

    /// The meeting with the least gap, if one is less than this.
    std::optional<FloorMeeting> meeting(double less_than) {
        const auto bound = [this](const Range& a, const Range& b) {
            if (apart(a.around, b.around) > 0) return kNone;
            const double between = gap(a.first, a.end - 1, b.first, b.end - 1);
            // In ranges that share time there may be samples that share any of it.
            return between > 0 ? between : runs_ ? 0 : -kNone;
        };
        const auto found = least(less_than, bound, [this](int i, int j, double least) { return gap_of(i, j, least); });
        if (!found || gave_up()) return std::nullopt;
        double lag = 0;
        if (runs_) {
            // They may share time, and the one that begins later be there first.
            LaggedPair pair(a_.swept(found->i), b_.swept(found->j));
            pair.narrow();
            lag = pair.lag();
        }
        const bool a_first = lag != 0 ? lag > 0 : a_.begin(found->i) < b_.begin(found->j);
        return FloorMeeting{found->i, found->j, found->value, a_first};
    }

    /// Metres between two paths that do not meet; none: it gave up before any two samples were measured.
    std::optional<double> distance() {
        const auto bound = [](const Range& a, const Range& b) { return apart(a.around, b.around); };
        const auto distance = [this](int i, int j, double) {
            if (runs_) return std::max(0.0, narrowed({a_.swept(i), b_.swept(j)}).apart());
            --visits_;
            const Disk &a = a_.disk(i), &b = b_.disk(j);
            return std::max(0.0, std::sqrt(squared_distance(a, b)) - (a.r + b.r));
        };
        const auto found = least(kNone, bound, distance);
        return found ? std::optional(found->value) : std::nullopt;
    }

  private:
    struct Found {
        double value;
        int i, j;
    };

    /// The two samples with the least value below one. `value_of(i, j, least)`: exactly where it is below `least`; else
    /// anything that is not.
    template <class Bound, class Value>
    std::optional<Found> least(double below, const Bound& bound_of, const Value& value_of) {
        std::optional<Found> found;
        const auto bound = [&](int i, int j) { return --visits_ < 0 ? kNone : bound_of(a_[i], b_[j]); };
        const auto leaves = [&](const Range& a, const Range& b) {
            for (int i = a.first; i < a.end; ++i) {
                for (int j = b.first; j < b.end; ++j) {
                    const double value = value_of(i, j, below);
                    if (value < below) found = {below = value, i, j};
                }
            }
        };
        HalvesSearch(a_, b_, bound, leaves, below).run();
        return found;
    }

    /// Seconds from the end of the earlier samples to the beginning of the later ones.
    double gap(int first_a, int last_a, int first_b, int last_b) const {
        return std::max(b_.begin(first_b) - a_.end(last_a), a_.begin(first_a) - b_.end(last_b));
    }

    double gap_of(int i, int j, double least) {
        if (!runs_) {
            --visits_;
            return collide(a_.disk(i), b_.disk(j)) ? gap(i, i, j, j) : kNone;
        }
        visits_ -= kLookedAtPair;
        const SweptDisk a = a_.swept(i), b = b_.swept(j);
        if (are_far_apart(a, b)) return kNone;
        const LaggedPair pair(a, b);
        if (!pair.may_overlap(least)) return kNone;
        const LaggedPair nearest = narrowed(pair);
        return nearest.apart() < 0 ? std::abs(nearest.lag()) : kNone;
    }

    LaggedPair narrowed(LaggedPair pair) {
        visits_ -= kRunningPair;
        pair.narrow();
        return pair;
    }

    const Ranges& a_;
    const Ranges& b_;
    bool runs_;
    std::int64_t visits_;
};

/// Whether any of the paths runs, and so has to be halved down to its samples.
bool any_runs(std::span<const PlacedClip> a, std::span<const PlacedClip> b) {
    return std::ranges::any_of(a, &PlacedClip::is_linear) || std::ranges::any_of(b, &PlacedClip::is_linear);
}

}  // namespace

FloorPaths floor_paths(const PlacedClip& clip_a, const PlacedClip& clip_b, std::int64_t most_visits) {
    const bool runs = any_runs({&clip_a, 1}, {&clip_b, 1});
    const Ranges a(clip_a, runs ? 1 : kLeaf), b(clip_b, runs ? 1 : kLeaf);
    FloorSearch search(a, b, runs, most_visits);
    FloorPaths out;
    out.meeting = search.meeting(kNone);
    if (!out.meeting && !search.gave_up()) out.apart = search.distance().value_or(0);
    if (search.gave_up()) return {};
    out.known = true;
    return out;
}

std::optional<double> least_floor_gap(std::span<const PlacedClip> clips_a, std::span<const PlacedClip> clips_b,
                                      std::int64_t most_visits) {
    const bool runs = any_runs(clips_a, clips_b);
    std::deque<Ranges> all_a, all_b;
    for (const PlacedClip& clip : clips_a) all_a.emplace_back(clip, runs ? 1 : kLeaf);
    for (const PlacedClip& clip : clips_b) all_b.emplace_back(clip, runs ? 1 : kLeaf);
    struct Pair {
        double squared;
        const Ranges *a, *b;
    };
    std::vector<Pair> pairs;
    for (const Ranges& a : all_a) {
        for (const Ranges& b : all_b) pairs.push_back({squared_distance(a.disk(0), b.disk(0)), &a, &b});
    }
    // A small gap that is known early passes over most of the others: of who follows, those of the disks that are next
    // to each other.
    std::ranges::sort(pairs, {}, &Pair::squared);
    double least = kNone;
    bool gave_up = false;
    for (const Pair& pair : pairs) {
        FloorSearch search(*pair.a, *pair.b, runs, most_visits);
        const std::optional<FloorMeeting> meeting = search.meeting(least);
        if (meeting) least = meeting->gap;
        if (least <= 0) return least;
        gave_up = gave_up || search.gave_up();
    }
    return gave_up ? std::nullopt : std::optional(least);
}

}  // namespace mobb
