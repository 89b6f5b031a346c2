#include <mobb/predicate.h>
#include <mobb/traversal.h>
#include <mobb_tracks/encounter.h>
#include <mobb_tracks/floor_paths.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>

namespace mobb {

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kLongest = 1e6;  // seconds: who comes nearer so slowly does it by rounding
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

/// Whether all their disks are points.
bool have_no_width(std::span<const PlacedClip> paths) {
    return std::ranges::all_of(paths, [](const PlacedClip& path) {
        return std::ranges::all_of(path.clip().samples(), [](const Disk& disk) { return disk.r == 0; });
    });
}

SweptDisk widened(SweptDisk disk, double by) {
    disk.from.r += by;
    disk.to.r += by;
    return disk;
}

/// What the disks of a body do in a step, and bounds on it.
class BodyStep {
  public:
    BodyStep(std::span<const PlacedClip> body, int step) {
        for (const PlacedClip& path : body) {
            const SweptDisk& of = disks.emplace_back(swept(path, step));
            const glm::dvec2 way(of.to.x - of.from.x, of.to.y - of.from.y);
            const double seconds = of.end - of.begin, widening = std::abs(of.to.r - of.from.r);
            length_ = std::max(length_, glm::length(way));
            radius_ = std::max({radius_, of.from.r, of.to.r});
            widening_ = std::max(widening_, widening / seconds);
            slowest_ = glm::min(slowest_, way / seconds);
            fastest_ = glm::max(fastest_, way / seconds);
        }
    }

    /// Metres per second: no disk of one comes nearer to one of the other by more.
    friend double most_closing(const BodyStep& a, const BodyStep& b) {
        return glm::length(glm::max(a.fastest_ - b.slowest_, b.fastest_ - a.slowest_)) + a.widening_ + b.widening_;
    }
    /// Metres from centre to centre at the begin of their steps, beyond which disks never come so near each other.
    friend double reach(const BodyStep& a, const BodyStep& b, double near) {
        constexpr double kSlack = 1e-6;  // metres: of rounding
        return a.length_ + b.length_ + a.radius_ + b.radius_ + near + kSlack;
    }

    std::vector<SweptDisk> disks{};

  private:
    double length_ = 0, radius_ = 0, widening_ = 0;
    glm::dvec2 slowest_{std::numeric_limits<double>::max()}, fastest_{std::numeric_limits<double>::lowest()};
};

/// Is told of the steps of two that share time.
template <class OnSteps>
struct StepObserver : ObserverBase {
    const OnSteps& on_steps;
    void sample_pair(int i, int j, double) { on_steps(i, j); }
};

}  // namespace

MaybeSeconds time_to_collision(const Encounter& of) {
    const auto runs = [](const PlacedClip& path) { return path.is_linear(); };
    if (!std::ranges::all_of(of.a, runs) || !std::ranges::all_of(of.b, runs))
        return {.undefined = "a held path has no speed"};
    if (of.least_clearance < 0) return {0, ""};
    double least = kNever;
    const auto take = [&](int i, int j) {
        const BodyStep a(of.a, i), b(of.b, j);
        // Who is farther away is not so near, or takes longer.
        const double most = reach(a, b, std::min(of.within, most_closing(a, b) * std::min(least, kLongest)));
        for (const SweptDisk& one : a.disks) {
            for (const SweptDisk& other : b.disks) {
                if (squared_distance(one.from, other.from) > most * most) continue;
                const Approach approach(one, other);
                const Approach wide(widened(one, of.within), other);
                if (wide.collides()) least = std::min(least, least_time_to_collision(approach, wide.overlap()));
            }
        }
    };
    StepObserver<decltype(take)> steps{{}, take};
    const auto first = [&](const PlacedClip& path) { return first_ending_after(path, 0, path.count() - 1, of.from); };
    const PlacedClip &a = of.a.front(), &b = of.b.front();
    auto go_on = [](int, int) { return false; };
    visit_sample_pairs(a, first(a), a.count(), b, first(b), b.count(), steps, go_on);
    if (least < kNever) return {least, ""};
    if (have_no_width(of.a) && have_no_width(of.b)) return {.undefined = kNoWidth};
    return {.undefined = "they are on no course to collide"};
}

MaybeSeconds post_encroachment_time(const Encounter& of) {
    if (of.least_clearance < 0) return {0, ""};
    if (have_no_width(of.a) && have_no_width(of.b)) return {.undefined = kNoWidth};
    const std::optional<double> gap = least_floor_gap(of.a, of.b);
    if (!gap) return {.undefined = "too many of their samples lie too near each other to tell"};
    if (*gap == kNever) return {.undefined = "their paths share no place"};
    return {std::max(0.0, *gap), ""};
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
