#include <mobb/body.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

namespace mobb {

namespace {

/// Of the shorter side: how far disks may stand out at the longer ones.
constexpr double kMostExcess = 0.05;
/// Metres: shorter moves may be noise, and have no direction.
constexpr double kLeastMove = 0.1;

struct Row {
    std::size_t disks = 1;
    double r = 0;
};

/// Each disk covers an equal piece of the longer side.
Row row_over(double length, double width) {
    const double longer = std::max(length, width), shorter = std::min(length, width);
    const auto radius = [&](std::size_t disks) {
        return std::hypot(longer / static_cast<double>(2 * disks), shorter / 2);
    };
    std::size_t disks = 1;
    while (disks < kMaxBodyDisks && radius(disks) > shorter * (0.5 + kMostExcess)) ++disks;
    return {disks, radius(disks)};
}

glm::dvec2 way(const Clip& clip, std::size_t from, std::size_t to) {
    const Disk &a = clip.samples()[from], &b = clip.samples()[to];
    return {b.x - a.x, b.y - a.y};
}

bool is_move(const glm::dvec2& way) { return std::hypot(way.x, way.y) >= kLeastMove; }

/// Whether the disks are the same when the body is turned by 180 degrees.
bool is_same_backwards(std::span<const BodyDisk> body) {
    constexpr double kSame = 1e-9;  // metres
    return std::ranges::all_of(body, [&](const BodyDisk& disk) {
        return std::ranges::any_of(body, [&](const BodyDisk& other) {
            return std::abs(disk.forward + other.forward) <= kSame && std::abs(disk.left + other.left) <= kSame &&
                   std::abs(disk.r - other.r) <= kSame;
        });
    });
}

}  // namespace

std::vector<BodyDisk> rectangle_body(double length, double width) {
    const auto [disks, r] = row_over(length, width);
    const double longer = std::max(length, width);
    std::vector<BodyDisk> out;
    for (std::size_t i = 0; i < disks; ++i) {
        const double along = longer * ((static_cast<double>(i) + 0.5) / static_cast<double>(disks) - 0.5);
        out.push_back(length >= width ? BodyDisk{along, 0, r} : BodyDisk{0, along, r});
    }
    return out;
}

double rectangle_excess(double length, double width) { return row_over(length, width).r - std::min(length, width) / 2; }

double body_reach(std::span<const BodyDisk> body) {
    double out = 0;
    for (const BodyDisk& disk : body) out = std::max(out, std::hypot(disk.forward, disk.left) + disk.r);
    return out;
}

bool has_direction(const Clip& clip) {
    for (std::size_t i = 1; i < clip.samples().size(); ++i) {
        if (is_move(way(clip, 0, i))) return true;
    }
    return false;
}

std::vector<double> headings_of(const Clip& clip, std::span<const BodyDisk> body) {
    const bool may_reverse = !body.empty() && is_same_backwards(body);
    std::vector<double> out(clip.samples().size(), 0);
    std::optional<double> heading;
    std::size_t from = 0;  // where the last move ended
    for (std::size_t to = 1; to < out.size(); ++to) {
        const glm::dvec2 move = way(clip, from, to);
        if (!is_move(move)) continue;
        double next = std::atan2(move.y, move.x) * (180 / std::numbers::pi);
        const double before = heading.value_or(next);
        if (may_reverse && std::abs(std::remainder(next - before, 360)) > 90) next = std::remainder(next + 180, 360);
        bool stands = true;
        for (; from < to; ++from) {
            stands = stands && way(clip, from, from + 1) == glm::dvec2(0, 0);
            out[from] = stands ? before : next;
        }
        heading = next;
    }
    if (heading) std::fill(out.begin() + static_cast<std::ptrdiff_t>(from), out.end(), *heading);
    return out;
}

Clip member_of(const Clip& clip, std::span<const double> headings, const BodyDisk& disk) {
    if (headings.size() != clip.samples().size()) throw std::invalid_argument("a body needs a heading for each sample");
    std::vector<Disk> samples(clip.samples().begin(), clip.samples().end());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const glm::dvec2 away = Rotation::from_degrees(headings[i])({disk.forward, disk.left});
        samples[i] = {samples[i].x + away.x, samples[i].y + away.y, disk.r};
    }
    return {clip.dt(), std::move(samples), clip.motion()};
}

}  // namespace mobb
