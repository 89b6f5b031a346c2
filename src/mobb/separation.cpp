#include <mobb/separation.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace mobb {

namespace {

/// The predicate of swept disks takes A, B and C, of at most the square of the lengths involved, for less than they are
/// by some ten epsilons: disks that are apart by the root of that, and no less, are seen apart for certain.
constexpr double kSweptSlackFactor = 1e-7;
constexpr double kLeastSweptSlack = 1e-70;  // metres: B^2 is a fourth power

}  // namespace

void RelativeFrame::cover_swept_disks(const PlacedFrame& a, const PlacedFrame& b) {
    const double lengths = std::abs(offset_.x) + std::abs(offset_.y) + a.reach + b.reach;
    slack2d_ += kLeastSweptSlack + kSweptSlackFactor * lengths;
    slack3d_ = slack2d_ + slack_time_;
}

Separation separate_obb3d(const Box& a, const Box& b, const RelativeFrame& frame) {
    const glm::dvec3 axes_b[3] = {frame.direction(b.axes[0]), frame.direction(b.axes[1]), frame.direction(b.axes[2])};
    const glm::dvec3 d = frame.point(b.center) - a.center;
    const double slack = frame.slack3d();

    double r[3][3];  // r[i][j] = A's axis i . B's axis j
    double abs_r[3][3];
    double t[3];  // d along A's axes
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3& axis_a = a.axes[static_cast<std::size_t>(i)];
        for (int j = 0; j < 3; ++j) {
            r[i][j] = glm::dot(axis_a, axes_b[j]);
            abs_r[i][j] = std::abs(r[i][j]);
        }
        t[i] = glm::dot(d, axis_a);
        const double reach_b = b.half[0] * abs_r[i][0] + b.half[1] * abs_r[i][1] + b.half[2] * abs_r[i][2];
        const double gap = std::abs(t[i]) - (a.half[i] + reach_b);
        if (gap > slack) return {i, gap};
    }
    for (int j = 0; j < 3; ++j) {
        const double reach_a = a.half[0] * abs_r[0][j] + a.half[1] * abs_r[1][j] + a.half[2] * abs_r[2][j];
        const double gap = std::abs(glm::dot(d, axes_b[j])) - (b.half[j] + reach_a);
        if (gap > slack) return {3 + j, gap};
    }
    for (int i = 0; i < 3; ++i) {
        const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
        for (int j = 0; j < 3; ++j) {
            const double length_squared = 1 - r[i][j] * r[i][j];
            if (length_squared < kShortestEdgeAxis * kShortestEdgeAxis) continue;
            const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
            const double distance = std::abs(t[i2] * r[i1][j] - t[i1] * r[i2][j]);
            const double reach_a = a.half[i1] * abs_r[i2][j] + a.half[i2] * abs_r[i1][j];
            const double reach_b = b.half[j1] * abs_r[i][j2] + b.half[j2] * abs_r[i][j1];
            // Along the axis as it comes, not yet of unit length: there the rounding errors are those the slack covers.
            const double gap = distance - (reach_a + reach_b);
            if (gap > slack) return {6 + 3 * i + j, gap / std::sqrt(length_squared)};
        }
    }
    return {};
}

Separation separate_moving(const Box& a, const Box& b, const RelativeFrame& frame) {
    const glm::dvec2 u{a.axes[0].x, a.axes[0].y};
    const glm::dvec2 v = frame.direction(glm::dvec2{b.axes[0].x, b.axes[0].y});
    const glm::dvec3 center_b = frame.point(b.center);
    const glm::dvec2 d{center_b.x - a.center.x, center_b.y - a.center.y};
    const double c = std::abs(u.x * v.x + u.y * v.y);
    const double s = std::abs(u.x * v.y - u.y * v.x);

    // Times in w*t, counted from the middle of A's; velocities in metres per that.
    const double middle_b = center_b.z - a.center.z;
    const double begin = std::max(-a.half.z, middle_b - b.half.z);
    const double end = std::min(a.half.z, middle_b + b.half.z);
    const glm::dvec2 velocity_a = a.drift / a.half.z;
    const glm::dvec2 velocity_b = frame.direction(b.drift) / b.half.z;
    const auto between = [&](double time) { return d + velocity_b * (time - middle_b) - velocity_a * time; };
    const glm::dvec2 first = between(begin);
    const glm::dvec2 last = between(end);
    // A drift is at most twice the reach of its clip. Rounded times put a box elsewhere by its velocity.
    const double slack = 4 * frame.slack2d() + frame.slack_time() * (l1_norm(velocity_a) + l1_norm(velocity_b));

    // Centres that change sides are as near as can be.
    const auto distance = [](double from, double to) { return std::max(std::min(from, to), -std::max(from, to)); };
    const auto along = [&](glm::dvec2 w) { return distance(glm::dot(first, w), glm::dot(last, w)); };
    const auto across = [&](glm::dvec2 w) { return along({-w.y, w.x}); };

    const double a0 = along(u) - (a.half.x + b.half.x * c + b.half.y * s);
    if (a0 > slack) return {0, a0};
    const double a1 = across(u) - (a.half.y + b.half.x * s + b.half.y * c);
    if (a1 > slack) return {1, a1};
    const double b0 = along(v) - (b.half.x + a.half.x * c + a.half.y * s);
    if (b0 > slack) return {2, b0};
    const double b1 = across(v) - (b.half.y + a.half.x * s + a.half.y * c);
    if (b1 > slack) return {3, b1};
    return {};
}

Separation separate_aabb(const Rectangle& a, const Rectangle& b, const RelativeFrame& frame) {
    const Rotation& to_world = frame.to_world();
    const TwoDoubles between = frame.point(lanes(b.center)) - lanes(a.center);
    const glm::dvec2 d = to_world({between[0], between[1]});
    const glm::dvec2 reach = half_in_world(a.half, to_world) + half_in_world(b.half, to_world * frame.rotation());
    for (int i = 0; i < 2; ++i) {
        const double gap = std::abs(d[i]) - reach[i];
        if (gap > frame.slack2d()) return {i, gap};
    }
    return {};
}

Separation separate_block(const Box& a, const Box& b, const RelativeFrame& frame) {
    const glm::dvec3 center_b = frame.point(b.center);
    const glm::dvec2 d{center_b.x - a.center.x, center_b.y - a.center.y};
    // Times in w*t, counted from the middle of A's; velocities in metres per that.
    const double middle_b = center_b.z - a.center.z;
    const double begin = std::max(-a.half.z, middle_b - b.half.z);
    const double end = std::max(begin, std::min(a.half.z, middle_b + b.half.z));
    const glm::dvec2 velocity_a = a.drift / a.half.z;
    const glm::dvec2 velocity_b = frame.direction(b.drift) / b.half.z;
    const glm::dvec2 first = d + velocity_b * (begin - middle_b) - velocity_a * begin;
    const glm::dvec2 way = (velocity_b - velocity_a) * (end - begin);
    const double way_squared = glm::dot(way, way);
    const double s = way_squared > 0 ? std::clamp(-glm::dot(first, way) / way_squared, 0.0, 1.0) : 0.0;
    const double gap = glm::length(first + s * way) - (a.half.x + b.half.x);
    const double slack = 4 * frame.slack2d() + frame.slack_time() * (l1_norm(velocity_a) + l1_norm(velocity_b));
    return gap > slack ? Separation{0, gap} : Separation{};
}

}  // namespace mobb
