#include <mobb/traversal.h>
#include <mobb_tracks/people_conflicts.h>

#include <algorithm>
#include <optional>
#include <tuple>

namespace mobb {

namespace {

/// Whether some samples of two ranges come so close.
bool come_close(const PlacedClip& a, int first_a, int end_a, const PlacedClip& b, int first_b, int end_b,
                double within) {
    NoObserver observer;
    const auto stop = [](int, int) { return true; };
    return visit_sample_pairs(WidenedClip(a, within), first_a, end_a, WidenedClip(b, 0), first_b, end_b, observer, stop)
        .hit;
}

/// The first pieces of two paths that are near each other; they must have such.
std::pair<PathPiece, PathPiece> first_near(const PathPiece& a, const PlacedClip& clip_a, const PathPiece& b,
                                           const PlacedClip& clip_b, double within) {
    PathPiece one = piece_from(clip_a, a.path, 0, within), other = piece_from(clip_b, b.path, 0, within);
    while (!near(one, other)) {
        if (one.t1 < other.t1) {
            one = piece_from(clip_a, a.path, one.end, within);
        } else {
            other = piece_from(clip_b, b.path, other.end, within);
        }
    }
    return {one, other};
}

/// Sorted, with those that touch or overlap put together: a path ends where the next one begins.
std::vector<Interval> joined(std::vector<Interval> intervals) {
    std::ranges::sort(intervals, {}, &Interval::t0);
    std::vector<Interval> out;
    for (const Interval& interval : intervals) {
        if (!out.empty() && interval.t0 <= out.back().t1 + kMinOverlap) {
            out.back().t1 = std::max(out.back().t1, interval.t1);
        } else {
            out.push_back(interval);
        }
    }
    return out;
}

/// One conflict of all those between the paths of two people.
PeopleConflict put_together(int a, int b, std::span<const Conflict> of_paths) {
    std::vector<Interval> intervals;
    for (const Conflict& conflict : of_paths)
        intervals.insert(intervals.end(), conflict.intervals.begin(), conflict.intervals.end());
    const auto depth = [](const Conflict& of) { return std::tuple(of.least_clearance, of.time); };
    const auto deepest = std::ranges::min_element(of_paths, {}, depth);
    PeopleConflict out{a, b, joined(std::move(intervals)), *deepest, {}};
    const double begin = out.worst().t0;
    out.begins = *std::ranges::find_if(of_paths, [begin](const Conflict& of) {
        return std::ranges::find(of.intervals, begin, &Interval::t0) != of.intervals.end();
    });
    return out;
}

double length_of(const Interval& interval) { return interval.t1 - interval.t0; }

}  // namespace

const Interval& PeopleConflict::worst() const {
    // The deepest pair's overlap begins within an interval, or where two were put together.
    const auto begins_later = [this](double t0) { return t0 > deepest.time; };
    const auto after = std::ranges::find_if(intervals, begins_later, &Interval::t0);
    return after == intervals.begin() ? *after : *(after - 1);
}

double PeopleConflict::seconds() const {
    double sum = 0;
    for (const Interval& interval : intervals) sum += length_of(interval);
    return sum;
}

double PeopleConflict::longest() const { return length_of(std::ranges::max(intervals, {}, length_of)); }

PeopleConflicts::PeopleConflicts(std::vector<PlacedClip> crowd, std::span<const int> person_of,
                                 const ConflictSearch& search)
    : crowd_(std::move(crowd)), person_of_(person_of.begin(), person_of.end()), search_(search) {
    search_.direct ? take_all_pairs() : sweep();
    rank();
}

void PeopleConflicts::sweep() {
    const double within = search_.within;
    const bool is_whole = search_.region.is_all();
    // People of several paths may come near each other with several of them.
    std::vector<std::pair<int, int>> near_people;
    const bool is_path_each = people() == crowd_.size();
    const auto on_near = [&](const PathPiece& a, const PathPiece& b, bool first) {
        const PlacedClip &clip_a = clip(a.path), &clip_b = clip(b.path);
        if (first && !is_whole) {
            const auto [one, other] = first_near(a, clip_a, b, clip_b, within);
            if (!search_.region.has(one, other)) return true;
        }
        if (first && is_path_each) ++tested_;
        if (first && !is_path_each) near_people.push_back(people_of({a.path, b.path}));
        // Of a region it is not told where else they meet.
        const bool ask = !search_.trees.empty();
        const bool close = ask || (is_whole ? come_close(clip_a, a.first, a.end, clip_b, b.first, b.end, within)
                                            : come_close(clip_a, 0, clip_a.count(), clip_b, 0, clip_b.count(), within));
        if (close) {
            met_.emplace_back(a.path, b.path);
            spend();
        }
        return close || !is_whole;
    };
    sweep_paths(crowd_, person_of_, within, search_.region, on_near, search_.progress);
    std::ranges::sort(near_people);
    tested_ += static_cast<std::size_t>(std::ranges::unique(near_people).begin() - near_people.begin());
    std::ranges::sort(met_, {}, [this](const Paths& paths) { return std::pair(people_of(paths), paths); });
}

void PeopleConflicts::take_all_pairs() {
    const int paths = static_cast<int>(crowd_.size());
    for (int a = 0; a < paths; ++a) {
        if (search_.progress) search_.progress(static_cast<std::size_t>(a), crowd_.size());
        for (int b = a + 1; b < paths; ++b) {
            if (person_of(a) != person_of(b) &&
                come_close(clip(a), 0, clip(a).count(), clip(b), 0, clip(b).count(), search_.within))
                met_.emplace_back(a, b);
        }
    }
    tested_ = pairs();
}

void PeopleConflicts::rank() {
    for (std::size_t first = 0, end = 0; first < met_.size(); first = end) {
        const auto other = [&](const Paths& paths) { return people_of(paths) != people_of(met_[first]); };
        end = static_cast<std::size_t>(
            std::ranges::find_if(met_.begin() + static_cast<std::ptrdiff_t>(first), met_.end(), other) - met_.begin());
        Ranked ranked{0, 0, 0, first, end};
        const PeopleConflict found = measured(ranked);
        if (found.intervals.empty() || found.longest() < search_.least_seconds) continue;
        ranked.least_clearance = found.deepest.least_clearance;
        ranked.seconds = found.seconds();
        ranked.begin = found.worst().t0;
        ranked_.push_back(ranked);
        spend();
    }
    // Those who met are in the order of people.
    std::ranges::sort(ranked_, {},
                      [](const Ranked& of) { return std::tuple(of.least_clearance, -of.seconds, of.begin, of.first); });
}

Conflict PeopleConflicts::conflict_between(const Paths& paths) const {
    const auto [a, b] = paths;
    const auto tree = [this](int path) { return search_.trees[static_cast<std::size_t>(path)]; };
    Conflict out =
        search_.trees.empty() ? conflict_of(clip(a), clip(b), search_.within) : conflict_of(tree(a), tree(b));
    out.a = a;
    out.b = b;
    return out;
}

PeopleConflict PeopleConflicts::measured(const Ranked& ranked) const {
    std::vector<Conflict> of_paths;
    for (std::size_t i = ranked.first; i < ranked.end; ++i) {
        Conflict conflict = conflict_between(met_[i]);
        if (!conflict.intervals.empty()) of_paths.push_back(std::move(conflict));
    }
    const auto [a, b] = people_of(met_[ranked.first]);
    return of_paths.empty() ? PeopleConflict{a, b, {}, {}, {}} : put_together(a, b, of_paths);
}

void PeopleConflicts::spend() const {
    // While they grow there are two of each.
    if (search_.spend) search_.spend(2 * (met_.size() * sizeof(Paths) + ranked_.size() * sizeof(Ranked)));
}

std::size_t PeopleConflicts::people() const {
    return person_of_.empty() ? 0 : static_cast<std::size_t>(person_of_.back()) + 1;
}

std::size_t PeopleConflicts::pairs() const { return people() < 2 ? 0 : people() * (people() - 1) / 2; }

double PeopleConflicts::seconds() const {
    double sum = 0;
    for (const Ranked& conflict : ranked_) sum += conflict.seconds;
    return sum;
}

}  // namespace mobb
