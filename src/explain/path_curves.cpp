#include <explain/path_curves.h>
#include <mobb/predicate.h>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace mobbscope {

namespace {

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

glm::dvec2 way(const mobb::Clip& clip, int from, int to) {
    const mobb::Disk& a = clip.samples()[static_cast<std::size_t>(from)];
    const mobb::Disk& b = clip.samples()[static_cast<std::size_t>(to)];
    return {b.x - a.x, b.y - a.y};
}

/// Degrees from one direction to another, -180..180.
double angle_between(glm::dvec2 from, glm::dvec2 to) {
    return std::atan2(from.x * to.y - from.y * to.x, glm::dot(from, to)) * 180 / std::numbers::pi;
}

PathCurve without_values(const mobb::Clip& clip) {
    return {std::vector<double>(static_cast<std::size_t>(clip.count()), kNoValue)};
}

}  // namespace

const std::array<CurveInfo, kCurveCount>& curve_infos() {
    static constexpr std::array<CurveInfo, kCurveCount> all{
        {{CurveKind::radius, "radius", "Radius", "m", "Radius of the disk"},
         {CurveKind::speed, "speed", "Speed", "m/s", "From each sample to the next", true},
         {CurveKind::turning, "turning", "Turning", "\u00B0/s",
          "To the left above 0, over a quarter of a second before and after; none below 0.1 m/s: too slow to have a "
          "direction",
          false, 1},
         {CurveKind::cost, "cost", "Cost", "%/s",
          "Part of all box tests of a query, for each second of the node of the shown level that holds the sample",
          true}}};
    return all;
}

bool PathCurve::has(int sample) const { return !std::isnan(values[static_cast<std::size_t>(sample)]); }

double PathCurve::at(int sample, double s) const {
    const auto i = static_cast<std::size_t>(sample);
    const bool goes_on = runs && i + 1 < values.size() && !std::isnan(values[i + 1]);
    return goes_on ? std::lerp(values[i], values[i + 1], s) : values[i];
}

PathCurve radius_curve(const mobb::Clip& clip) {
    PathCurve out = without_values(clip);
    out.runs = clip.runs();
    std::ranges::transform(clip.samples(), out.values.begin(), &mobb::Disk::r);
    return out;
}

PathCurve speed_curve(const mobb::Clip& clip) {
    PathCurve out = without_values(clip);
    for (int i = 0; i + 1 < clip.count(); ++i)
        out.values[static_cast<std::size_t>(i)] = glm::length(way(clip, i, i + 1)) / clip.dt();
    return out;
}

PathCurve turn_curve(const mobb::Clip& clip) {
    PathCurve out = without_values(clip);
    const double wanted = std::clamp(std::round(kTurnWindow / clip.dt()), 1.0, static_cast<double>(clip.count()));
    for (int i = 1; i + 1 < clip.count(); ++i) {
        // As wide on both sides, so that a circle turns evenly up to its ends.
        const int reach = std::min({static_cast<int>(wanted), i, clip.count() - 1 - i});
        const glm::dvec2 before = way(clip, i - reach, i), after = way(clip, i, i + reach);
        const double seconds = reach * clip.dt();
        if (std::min(glm::length(before), glm::length(after)) < kLeastTurnSpeed * seconds) continue;
        out.values[static_cast<std::size_t>(i)] = angle_between(before, after) / seconds;
    }
    return out;
}

PathCurve cost_curve(const mobb::Tree& tree, std::span<const double> shares, const LevelRange& levels) {
    PathCurve out = without_values(tree.clip());
    if (shares.empty()) return out;
    for (int i = 0; i < static_cast<int>(tree.nodes().size()); ++i) {
        const int level = tree.level(i);
        const bool is_shown =
            tree.is_leaf(i) ? levels.leaves || level <= levels.last : !levels.leaves && level == levels.last;
        const mobb::Node& node = tree.node(i);
        const double seconds = tree.t1(node) - tree.t0(node);
        if (!is_shown || seconds <= 0) continue;
        const double density = 100 * shares[static_cast<std::size_t>(i)] / seconds;
        std::fill(out.values.begin() + node.first, out.values.begin() + node.end(), density);
    }
    return out;
}

std::vector<ValueColumn> columns_of(const PathCurve& curve, const mobb::PlacedClip& clip, double t0, double t1,
                                    int columns) {
    ValueColumns out(t0, t1, columns);
    for (int i = 0; i < clip.count(); ++i) {
        const double from = clip.time(i), to = clip.time(i + 1);
        if (!curve.has(i) || to <= from) continue;
        out.add(from, to, [&](double begin, double end) {
            const auto value = [&](double time) {
                return curve.at(i, std::clamp((time - from) / (to - from), 0.0, 1.0));
            };
            return std::minmax({value(begin), value(end)});
        });
    }
    return std::move(out).take();
}

std::optional<std::pair<int, double>> value_at(const PathCurve& curve, const mobb::PlacedClip& clip, double time) {
    if (time < clip.time(0) || time > clip.time(clip.count())) return std::nullopt;
    // Rounding may take a time at a border to the sample before it.
    int sample = std::clamp(static_cast<int>((time - clip.time(0)) / clip.dt()), 0, clip.count() - 1);
    if (sample + 1 < clip.count() && clip.time(sample + 1) <= time && clip.time(sample + 2) > time) ++sample;
    if (sample > 0 && clip.time(sample) > time) --sample;
    if (!curve.has(sample)) return std::nullopt;
    const double from = clip.time(sample), to = clip.time(sample + 1);
    return std::pair(sample, curve.at(sample, to > from ? std::clamp((time - from) / (to - from), 0.0, 1.0) : 0));
}

}  // namespace mobbscope
