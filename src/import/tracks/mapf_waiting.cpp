// Agents of a plan stay where they are before their first step and after their last one.
#include <import/clip/sampling.h>
#include <import/tracks/mapf_plan.h>
#include <import/tracks/track_steps.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>

namespace mobbscope {

namespace {

// A damaged step number would have everybody wait for ages: a plan may become so many times as many points as its
// agents would have if all had as many as the one with most.
constexpr double kMostFilling = 100;
constexpr double kAlwaysFilledInPlan = 10'000;
// Steps of a plan may be fractions: an agent's are looked for down to such a part of the plan's.
constexpr int kFinestPart = 100;
constexpr double kWholeStep = 1e-6;
// Bytes of memory of a point, with the sample that is made of it.
constexpr std::size_t kOfWaiting = sizeof(TrackPoint) + sizeof(mobb::Disk);

bool is_whole(double number) { return std::abs(number - std::round(number)) <= kWholeStep; }

/// The longest step that all points of a plan are whole ones from 0, where their steps are whole numbers; else the most
/// frequent one.
double step_of_plan(std::span<const Track> tracks) {
    std::uint64_t step = 0;
    for (const Track& track : tracks) {
        for (const TrackPoint& point : track.points) {
            if (point.frame != std::floor(point.frame)) return most_frequent_step(tracks).value_or(1);
            if (step != 1) step = std::gcd(step, static_cast<std::uint64_t>(std::abs(point.frame)));
        }
    }
    return step == 0 ? 1 : static_cast<double>(step);
}

/// From when to when a plan lasts, in frames.
struct PlanSpan {
    double first = 0;
    double last = 0;
};

/// The longest part of the plan's step that a track's points, and the ends of the plan, are whole ones of; none if they
/// are no whole ones of any.
std::optional<double> step_of_agent(const Track& track, const PlanSpan& plan, double usual) {
    for (int part = 1; part <= kFinestPart; ++part) {
        const auto is_in_step = [&](double frame) { return is_whole((frame - plan.first) / usual * part); };
        if (is_in_step(plan.last) && std::ranges::all_of(track.points, is_in_step, &TrackPoint::frame))
            return usual / part;
    }
    return std::nullopt;
}

/// How many points a track has with those for waiting and for missing steps.
double points_with_waiting(const Track& track, const PlanSpan& plan, const std::optional<double>& step) {
    return step ? std::round((plan.last - plan.first) / *step) + 1 : static_cast<double>(track.points.size() + 2);
}

void fill(Track& track, const PlanSpan& plan, const std::optional<double>& step) {
    const auto at = [](TrackPoint point, double frame) {
        point.frame = frame;
        return point;
    };
    std::vector<TrackPoint> stored = std::move(track.points);
    if (stored.front().frame > plan.first) stored.insert(stored.begin(), at(stored.front(), plan.first));
    if (stored.back().frame < plan.last) stored.push_back(at(stored.back(), plan.last));
    if (!step) {
        track.points = std::move(stored);
        return;
    }
    const auto count = static_cast<std::size_t>(points_with_waiting(track, plan, step));
    if (stored.size() == count) {
        track.points = std::move(stored);
        return;
    }
    track.points.clear();
    track.points.reserve(count);
    for (std::size_t i = 0; i < stored.size(); ++i) {
        track.points.push_back(stored[i]);
        if (i + 1 == stored.size()) break;
        const TrackPoint& a = stored[i];
        const TrackPoint& b = stored[i + 1];
        const std::int64_t steps = std::llround((b.frame - a.frame) / *step);  // fewer than `count`
        for (std::int64_t k = 1; k < steps; ++k) {
            const double share = static_cast<double>(k) / static_cast<double>(steps);
            TrackPoint between = a;
            between.frame = a.frame + static_cast<double>(k) * *step;
            if (b.x != a.x) between.x = (1 - share) * a.x + share * b.x;
            if (b.y != a.y) between.y = (1 - share) * a.y + share * b.y;
            track.points.push_back(between);
        }
    }
}

}  // namespace

TrackFile plan_of(TrackCollector& from, const std::string& file) {
    std::vector<Track> tracks = from.take_sorted();
    Spent spent = from.take_spent();
    PlanSpan plan;
    const TrackPoint* latest = &tracks.front().points.back();
    std::size_t longest = 0;
    for (const Track& track : tracks) {
        plan.first = std::min(plan.first, track.points.front().frame);
        if (track.points.back().frame > latest->frame) latest = &track.points.back();
        longest = std::max(longest, track.points.size());
    }
    plan.last = std::max(latest->frame, 0.0);
    const double usual = step_of_plan(tracks);
    std::vector<std::optional<double>> steps;
    double points = 0;
    for (const Track& track : tracks) {
        steps.push_back(step_of_agent(track, plan, usual));
        points += points_with_waiting(track, plan, steps.back());
    }
    const double most = std::min(static_cast<double>(kMaxSamples),
                                 kMostFilling * static_cast<double>(tracks.size() * longest) + kAlwaysFilledInPlan);
    if (points > most) {
        throw InputError(file, at_line(latest->line),
                         "agents stay where they are until the plan's last step, t = " + format_double(latest->frame) +
                             ", which makes " + formatted("%.0f", points) + " points of its " +
                             counted(tracks.size(), "agent", "agents") + ", over " + formatted("%.0f", most) +
                             "; check t, or split the plan");
    }
    spent.cover(static_cast<std::size_t>(points) * kOfWaiting, "waiting until the plan's last step", file);
    for (std::size_t i = 0; i < tracks.size(); ++i) fill(tracks[i], plan, steps[i]);

    TrackFile out;
    out.format = "mapf";
    out.tracks = std::move(tracks);
    out.details = from.take_details();
    out.spent = std::move(spent);
    out.rate_assumption = "a step of the plan counts as one second; give dt (seconds a step) if that is wrong";
    out.unit_assumption = "a cell of the plan counts as one metre; give unit (metres a cell) if that is wrong";
    return out;
}

}  // namespace mobbscope
