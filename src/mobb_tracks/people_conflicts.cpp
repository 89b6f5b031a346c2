#include <mobb/traversal.h>
#include <mobb_tracks/people_conflicts.h>

#include <algorithm>
#include <optional>
#include <tuple>

namespace mobb {

namespace {

/// The first samples of two ranges that come so close.
std::optional<SamplePair> first_close(const PlacedClip& a, int first_a, int end_a, const PlacedClip& b, int first_b,
                                      int end_b, double within) {
    std::optional<SamplePair> found;
    NoObserver observer;
    const auto stop = [&](int i, int j) {
        found = {i, j};
        return true;
    };
    visit_sample_pairs(WidenedClip(a, within), first_a, end_a, WidenedClip(b, 0), first_b, end_b, observer, stop);
    return found;
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

}  // namespace

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
        if (first && !is_path_each) near_people.emplace_back(person_of(a.path), person_of(b.path));
        std::optional<SamplePair> close = SamplePair{0, 0};
        if (search_.trees.empty()) {
            // Of a region it is not told where else they meet.
            close = is_whole ? first_close(clip_a, a.first, a.end, clip_b, b.first, b.end, within)
                             : first_close(clip_a, 0, clip_a.count(), clip_b, 0, clip_b.count(), within);
        }
        if (close) meet({a.path, b.path, close->a, close->b});
        return close || !is_whole;
    };
    sweep_paths(crowd_, person_of_, within, search_.region, on_near, search_.progress);
    std::ranges::sort(near_people);
    tested_ += static_cast<std::size_t>(std::unique(near_people.begin(), near_people.end()) - near_people.begin());
}

void PeopleConflicts::take_all_pairs() {
    const int paths = static_cast<int>(crowd_.size());
    for (int a = 0; a < paths; ++a) {
        if (search_.progress) search_.progress(static_cast<std::size_t>(a), crowd_.size());
        for (int b = a + 1; b < paths; ++b) {
            if (person_of(a) == person_of(b)) continue;
            const auto close = first_close(clip(a), 0, clip(a).count(), clip(b), 0, clip(b).count(), search_.within);
            if (close) meet({a, b, close->a, close->b});
        }
    }
    tested_ = pairs();
}

void PeopleConflicts::meet(const Meeting& met) {
    met_.push_back(met);
    spend();
}

void PeopleConflicts::rank() {
    const auto rank = [this](const Conflict& deepest, std::span<const Interval> intervals, std::size_t first,
                             std::size_t end) {
        if (intervals.empty() || longest_of(intervals) < search_.least_seconds) return;
        ranked_.push_back(
            {deepest.least_clearance, seconds_of(intervals), interval_at(intervals, deepest.time).t0, first, end});
        spend();
    };
    std::ranges::sort(met_, {}, [this](const Meeting& met) { return std::tuple(people_of(met), met.a, met.b); });
    for (std::size_t first = 0, end = 0; first < met_.size(); first = end) {
        while (end < met_.size() && people_of(met_[end]) == people_of(met_[first])) ++end;
        if (end == first + 1) {
            const Conflict found = conflict_between(met_[first]);
            rank(found, found.intervals, first, end);
        } else {
            const PeopleConflict found = measured({0, 0, 0, first, end});
            rank(found.deepest, found.intervals, first, end);
        }
    }
    // Those who met are in the order of people.
    std::ranges::sort(ranked_, {},
                      [](const Ranked& of) { return std::tuple(of.least_clearance, -of.seconds, of.begin, of.first); });
}

Conflict PeopleConflicts::conflict_between(const Meeting& met) const {
    const auto tree = [this](int path) { return search_.trees[static_cast<std::size_t>(path)]; };
    Conflict out = search_.trees.empty()
                       ? conflict_of(clip(met.a), clip(met.b), search_.within, met.a_sample, met.b_sample)
                       : conflict_of(tree(met.a), tree(met.b));
    out.a = met.a;
    out.b = met.b;
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
    if (search_.spend) search_.spend(2 * (met_.size() * sizeof(Meeting) + ranked_.size() * sizeof(Ranked)));
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
