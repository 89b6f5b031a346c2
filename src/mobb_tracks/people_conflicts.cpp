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

/// The first pieces of two paths that are near each other; none if they never are.
std::optional<std::pair<PathPiece, PathPiece>> first_near(const PlacedClip& a, const PlacedClip& b, double within) {
    PathPiece one = piece_from(a, 0, 0, within), other = piece_from(b, 1, 0, within);
    while (!near(one, other)) {
        const bool is_one = one.t1 < other.t1;
        PathPiece& next = is_one ? one : other;
        const PlacedClip& clip = is_one ? a : b;
        if (next.end >= clip.clip().steps()) return std::nullopt;
        next = piece_from(clip, next.path, next.end, within);
    }
    return std::pair(one, other);
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
    : crowd_(std::move(crowd)),
      person_of_(person_of.begin(), person_of.end()),
      floor_of_(search.floor_of.begin(), search.floor_of.end()),
      search_(search) {
    search_.direct ? take_all_pairs() : sweep();
    rank();
}

void PeopleConflicts::sweep() {
    const double within = search_.within;
    const bool is_whole = search_.region.is_all();
    const bool is_path_each = people() == crowd_.size();
    // People of several paths may come near each other with several of them.
    std::vector<std::pair<int, int>> near_people;
    const auto on_near = [&](const PathPiece& a, const PathPiece& b, bool first) {
        const int person = person_of(a.path), other = person_of(b.path);
        if (are_apart(person, other)) return true;
        if (first && !is_path_each) near_people.emplace_back(person, other);
        if (first && is_path_each && (is_whole || is_found_in_region(person, other))) {
            ++tested_;
            if (!is_whole) take_pair(person, other);
        }
        // Of a region it is not told where else they meet: they are looked at as a whole.
        if (!is_whole) return true;
        std::optional<SamplePair> close = SamplePair{0, 0};
        if (search_.trees.empty())
            close = first_close(clip(a.path), a.first, a.end, clip(b.path), b.first, b.end, within);
        if (close) meet({a.path, b.path, close->a, close->b});
        return close.has_value();
    };
    sweep_paths(crowd_, person_of_, within, search_.region, on_near, search_.progress);
    std::ranges::sort(near_people);
    near_people.erase(std::unique(near_people.begin(), near_people.end()), near_people.end());
    for (const auto& [person, other] : near_people) {
        if (!is_whole && !is_found_in_region(person, other)) continue;
        ++tested_;
        if (!is_whole) take_pair(person, other);
    }
}

/// Of their paths that ever come near each other the first two tell, by where they do so first.
bool PeopleConflicts::is_found_in_region(int person, int other) const {
    const auto [first_a, end_a] = paths_of(person);
    const auto [first_b, end_b] = paths_of(other);
    for (int a = first_a; a < end_a; ++a) {
        for (int b = first_b; b < end_b; ++b) {
            const auto near = first_near(clip(a), clip(b), search_.within);
            if (near) return search_.region.has(near->first, near->second);
        }
    }
    return false;
}

/// Those of their paths that meet.
void PeopleConflicts::take_pair(int person, int other) {
    const auto [first_a, end_a] = paths_of(person);
    const auto [first_b, end_b] = paths_of(other);
    for (int a = first_a; a < end_a; ++a) {
        for (int b = first_b; b < end_b; ++b) {
            std::optional<SamplePair> close = SamplePair{0, 0};
            if (search_.trees.empty())
                close = first_close(clip(a), 0, clip(a).count(), clip(b), 0, clip(b).count(), search_.within);
            if (close) meet({a, b, close->a, close->b});
        }
    }
}

void PeopleConflicts::take_all_pairs() {
    const int persons = static_cast<int>(people());
    for (int person = 0; person < persons; ++person) {
        if (search_.progress) search_.progress(static_cast<std::size_t>(person), people());
        for (int other = person + 1; other < persons; ++other) {
            if (!are_apart(person, other)) take_pair(person, other);
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

std::size_t PeopleConflicts::pairs() const {
    const auto pairs_of = [](std::size_t count) { return count < 2 ? 0 : count * (count - 1) / 2; };
    std::vector<int> floors = floor_of_;
    std::erase(floors, 0);
    std::ranges::sort(floors);
    std::size_t apart = pairs_of(floors.size());
    for (auto first = floors.begin(); first != floors.end();) {
        const auto end = std::upper_bound(first, floors.end(), *first);
        apart -= pairs_of(static_cast<std::size_t>(end - first));
        first = end;
    }
    return pairs_of(people()) - apart;
}

std::pair<int, int> PeopleConflicts::paths_of(int person) const {
    const auto [first, end] = std::equal_range(person_of_.begin(), person_of_.end(), person);
    return {static_cast<int>(first - person_of_.begin()), static_cast<int>(end - person_of_.begin())};
}

bool PeopleConflicts::are_apart(int person, int other) const {
    if (floor_of_.empty()) return false;
    const int one = floor_of_[static_cast<std::size_t>(person)], two = floor_of_[static_cast<std::size_t>(other)];
    return one != two && one != 0 && two != 0;
}

double PeopleConflicts::seconds() const {
    double sum = 0;
    for (const Ranked& conflict : ranked_) sum += conflict.seconds;
    return sum;
}

}  // namespace mobb
