#include <mobb/traversal.h>
#include <mobb_tracks/encounter.h>
#include <mobb_tracks/floor_paths.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numeric>

namespace mobb {

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kLongest = 1e6;  // seconds: who comes nearer so slowly does it by rounding
constexpr std::int64_t kMostVisits = 1'000'000;
constexpr std::string_view kNoWidth = "their disks have radius 0, and points do not collide";

/// The least over [begin, end] of s, in seconds.
double least_time_to_collision(const Approach& approach, Approach::Range over) {
    const double per_s = approach.t1 - approach.t0;
    const double A = approach.A, B = approach.B, C = approach.C;
    const auto f = [&](double s) { return (A * s + B) * s + C; };
    if (f(over.begin) < 0) return 0;
    // The first s behind at which f falls below 0.
    double falls = kNever;
    if (A == 0) {
        if (B < 0) falls = -C / B;
    } else if (const double square = B * B - 4 * A * C; square > 0) {
        const double q = -0.5 * (B + std::copysign(std::sqrt(square), B));
        const double one = q / A, other = q != 0 ? C / q : one;
        // Of a parabola that opens upwards f falls at the first root, of the other at the second.
        falls = A > 0 ? std::min(one, other) : std::max(one, other);
    }
    if (falls < over.begin || falls == kNever) return kNever;
    const double seconds = std::max(0.0, falls - over.end) * per_s;
    return seconds <= kLongest ? seconds : kNever;
}

/// Whether all its disks are points.
bool has_no_width(const PlacedClip& clip) {
    return std::ranges::all_of(clip.clip().samples(), [](const Disk& disk) { return disk.r == 0; });
}

}  // namespace

MaybeSeconds time_to_collision(const PlacedClip& a, const PlacedClip& b, const Conflict& conflict, double within) {
    if (!a.is_linear() || !b.is_linear()) return {.undefined = "a held path has no speed"};
    const WidenedClip wide_a(a, within), wide_b(b, 0);
    double least = kNever;
    auto take = [&](int i, int j) {
        const auto over = approach_of(wide_a, i, wide_b, j).overlap();
        least = std::min(least, least_time_to_collision(approach_of(a, i, b, j), over));
        return least == 0;
    };
    NoObserver observer;
    // Where the first interval begins nobody was so close before.
    const double begin = conflict.intervals.front().t0;
    const auto from = [begin](const PlacedClip& clip) { return first_ending_after(clip, 0, clip.count() - 1, begin); };
    visit_sample_pairs(wide_a, from(a), a.count(), wide_b, from(b), b.count(), observer, take);
    if (least == kNever && has_no_width(a) && has_no_width(b)) return {.undefined = kNoWidth};
    if (least == kNever) return {.undefined = "they are on no course to collide"};
    return {least, ""};
}

MaybeSeconds post_encroachment_time(const PlacedClip& a, const PlacedClip& b, const Conflict& conflict) {
    if (conflict.least_clearance < 0) return {0, ""};
    if (has_no_width(a) && has_no_width(b)) return {.undefined = kNoWidth};
    const FloorPaths paths = floor_paths(a, b, kMostVisits, true);
    if (!paths.known) return {.undefined = "too many of their samples lie too near each other to tell"};
    if (!paths.meeting) return {.undefined = "their paths share no place"};
    return {std::max(0.0, paths.meeting->gap), ""};
}

std::vector<std::vector<int>> contact_chains(std::size_t people, std::span<const std::pair<int, int>> contacts) {
    std::vector<int> leads(people);  // to somebody of the same group with a lower number, or to oneself
    std::iota(leads.begin(), leads.end(), 0);
    const auto lead = [&](int person) -> int& { return leads[static_cast<std::size_t>(person)]; };
    const auto first_of = [&](int person) {
        while (lead(person) != person) person = lead(person) = lead(lead(person));
        return person;
    };
    for (const auto& [a, b] : contacts) {
        const int one = first_of(a), other = first_of(b);
        lead(std::max(one, other)) = std::min(one, other);
    }
    std::vector<std::vector<int>> groups(people);
    for (std::size_t i = 0; i < people; ++i) {
        const int person = static_cast<int>(i);
        groups[static_cast<std::size_t>(first_of(person))].push_back(person);
    }
    std::erase_if(groups, [](const std::vector<int>& group) { return group.size() < 2; });
    std::ranges::stable_sort(groups, std::greater<>(), &std::vector<int>::size);
    return groups;
}

}  // namespace mobb
