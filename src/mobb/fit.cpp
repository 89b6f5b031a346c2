#include <mobb/blocks.h>
#include <mobb/fit.h>
#include <mobb/fitting.h>
#include <mobb/lanes.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

namespace mobb {

namespace {

using Axes3 = std::array<glm::dvec3, 3>;

std::span<const Disk> disks(const Clip& clip, SampleRange range) {
    return clip.samples().subspan(static_cast<std::size_t>(range.first), static_cast<std::size_t>(range.count));
}

Rectangle rectangle_around(const BoundedDisks& bounded, glm::dvec2 u) {
    const std::array<Extent, 2> e = bounded.extents(u);
    return {e[0].center() * u + e[1].center() * perpendicular(u), u, {e[0].half(), e[1].half()}};
}

/// Over the time of the range.
Box box_over_time(BoxKind kind, const Clip& clip, SampleRange range, const Rectangle& rectangle, double w) {
    return over_time(kind, rectangle, w * clip.time(range.first), w * clip.time(range.end()));
}

/// Extents of the cylinders along one axis of space-time. A cylinder spans p.a -/+ r*|a_xy|, and its height w*dt shifts
/// one side by w*dt*a_t: Fig. 6, whose signs hold for one orientation only. A slanted one lies between the disks at its
/// ends.
Extent extent_in_order(const Clip& clip, SampleRange range, double height, glm::dvec3 a) {
    const double in_plane = std::hypot(a.x, a.y);
    const double below = clip.runs() ? 0 : std::min(0.0, height * a.z);
    const double above = clip.runs() ? 0 : std::max(0.0, height * a.z);
    Extent e;
    int i = range.first;
    for (const Disk& d : swept_disks(clip, range)) {
        const double p = d.x * a.x + d.y * a.y + (height * i) * a.z;
        e.add(p - d.r * in_plane + below, p + d.r * in_plane + above);
        ++i;
    }
    return e;
}

/// extent_in_order along two axes at once, of which none may come out as zero.
class TwoExtents {
  public:
    /// Of disks that each stay for so long, in w*t.
    TwoExtents(double height, glm::dvec3 a, glm::dvec3 b)
        : x_{a.x, b.x},
          y_{a.y, b.y},
          z_{a.z, b.z},
          in_plane_{std::hypot(a.x, a.y), std::hypot(b.x, b.y)},
          below_(least(height * z_, both(0))),
          above_(greatest(height * z_, both(0))) {}

    /// A disk at a time in w*t.
    void add(const Disk& d, double time) {
        const TwoDoubles p = d.x * x_ + d.y * y_ + time * z_;
        const TwoDoubles reach = d.r * in_plane_;
        low_ = least(p - reach + below_, low_);
        high_ = greatest(p + reach + above_, high_);
    }
    Extent operator[](int i) const { return {low_[i], high_[i]}; }

  private:
    TwoDoubles x_, y_, z_, in_plane_, below_, above_;
    TwoDoubles low_ = both(std::numeric_limits<double>::infinity());
    TwoDoubles high_ = both(-std::numeric_limits<double>::infinity());
};

/// Along three axes in one pass.
std::array<Extent, 3> extents_3d(const Clip& clip, SampleRange range, double height, const Axes3& axes) {
    const double stays = clip.runs() ? 0 : height;
    TwoExtents first_two(stays, axes[0], axes[1]), third(stays, axes[2], axes[2]);
    int i = range.first;
    for (const Disk& d : swept_disks(clip, range)) {
        const double time = height * i++;
        first_two.add(d, time);
        third.add(d, time);
    }
    std::array<Extent, 3> e{first_two[0], first_two[1], third[0]};
    for (std::size_t k = 0; k < 3; ++k) {
        if (has_zero(e[k])) e[k] = extent_in_order(clip, range, height, axes[k]);
    }
    return e;
}

/// The box along given axes.
Box box_along(const Clip& clip, SampleRange range, const Axes3& axes, double w) {
    const std::array<Extent, 3> e = extents_3d(clip, range, w * clip.dt(), axes);
    Box box;
    box.kind = BoxKind::obb3d;
    box.axes = axes;
    box.center = {0, 0, 0};
    for (int k = 0; k < 3; ++k) {
        const auto i = static_cast<std::size_t>(k);
        box.center += e[i].center() * axes[i];
        box.half[k] = e[i].half();
    }
    return box;
}

/// Of the two opposite directions, the one with the positive first component that is not zero.
glm::dvec2 positive(glm::dvec2 u) { return u.x < 0 || (u.x == 0 && u.y < 0) ? -u : u; }

glm::dvec2 travel(std::span<const Disk> disks) {
    return {disks.back().x - disks.front().x, disks.back().y - disks.front().y};
}

/// From the first centre to the last; where they coincide (standing still, a closed loop) the principal axis.
glm::dvec2 travel_axis(std::span<const Disk> disks) {
    const double length = glm::length(travel(disks));
    return length > kStandingStill ? travel(disks) / length : principal_axis(disks);
}

/// The direction of the smallest rectangle around the disks, over 1,800 angles in a quarter turn and the two other
/// axes, `along` and `principal`.
glm::dvec2 smallest_rectangle_axis(const BoundedDisks& bounded, glm::dvec2 along, glm::dvec2 principal) {
    constexpr int kCells = 90;
    constexpr int kAnglesPerCell = 20;
    constexpr double kCellAngle = std::numbers::pi / 2 / kCells;

    const auto sides = [&](glm::dvec2 u) {
        const std::array<Extent, 2> e = bounded.extents(u);
        return glm::dvec2{e[0].length(), e[1].length()};
    };
    const auto direction = [](double angle) { return glm::dvec2{std::cos(angle), std::sin(angle)}; };

    glm::dvec2 best = along;
    double best_area = std::numeric_limits<double>::infinity();
    const auto consider = [&](glm::dvec2 u, glm::dvec2 side) {
        if (side.x * side.y < best_area) {
            best_area = side.x * side.y;
            best = u;
        }
    };
    consider(best, sides(best));
    consider(principal, sides(principal));

    // A side changes by at most the diameter of the centres per radian: a whole cell of angles can be ruled out at
    // once.
    const std::span<const Disk> disks = bounded.disks();
    double reach = 0;
    for (const Disk& d : disks) reach = std::max(reach, std::hypot(d.x - disks[0].x, d.y - disks[0].y));
    const double most_change = 2 * reach * kCellAngle / 2;

    std::array<glm::dvec2, kCells> cell_sides;
    for (int cell = 0; cell < kCells; ++cell) {
        const glm::dvec2 u = direction((cell + 0.5) * kCellAngle);
        cell_sides[static_cast<std::size_t>(cell)] = sides(u);
        consider(u, cell_sides[static_cast<std::size_t>(cell)]);
    }
    for (int cell = 0; cell < kCells; ++cell) {
        const glm::dvec2 side = cell_sides[static_cast<std::size_t>(cell)];
        const double least = std::max(0.0, side.x - most_change) * std::max(0.0, side.y - most_change);
        if (least >= best_area) continue;
        for (int i = 0; i < kAnglesPerCell; ++i) {
            const glm::dvec2 u = direction((cell + static_cast<double>(i) / kAnglesPerCell) * kCellAngle);
            consider(u, sides(u));
        }
    }
    return best;
}

/// Of a rectangle around `bounded`, the disks of a walk along `along` and the one that it runs to, if any.
glm::dvec2 axis_2d(std::span<const Disk> disks, const BoundedDisks& bounded, glm::dvec2 along, Axes axes) {
    switch (axes) {
        case Axes::endpoints:
            return along;
        case Axes::covariance:
            return principal_axis(disks);
        case Axes::minarea:
            return smallest_rectangle_axis(bounded, along, principal_axis(disks));
    }
    return {1, 0};
}

/// How far the centre of a moving box gets in one hold interval, metres.
glm::dvec2 drift_per_sample(std::span<const Disk> disks) {
    return disks.size() == 1 ? glm::dvec2(0) : travel(disks) / static_cast<double>(disks.size() - 1);
}

/// Where the disks are against a centre that drifts so and passes the origin in the middle of their time: each at the
/// beginning and at the end of its hold interval, over which it stands still and so falls behind. Those of a linear
/// clip run straight from one to the next: the range's own come first.
std::vector<Disk> drifting(const Clip& clip, SampleRange range, glm::dvec2 per_sample) {
    std::vector<Disk> out;
    out.reserve(2 * static_cast<std::size_t>(range.count));
    int i = range.first;
    const double middle = 0.5 * clip.steps(range.first, range.end());
    const auto add = [&](const Disk& d, int at) {
        const double samples = at - range.first - middle;
        out.push_back({d.x - samples * per_sample.x, d.y - samples * per_sample.y, d.r});
    };
    for (const Disk& d : swept_disks(clip, range)) {
        add(d, i);
        if (!clip.runs()) add(d, i + 1);
        ++i;
    }
    return out;
}

bool is_along_time(glm::dvec3 a) { return std::hypot(a.x, a.y) < 1e-12; }

/// a1 lies in the floor, across a0; a2 completes the frame (paper, Section 4). a0 must not be along time.
Axes3 frame_around(glm::dvec3 a0) {
    const glm::dvec3 a1 = glm::normalize(glm::dvec3{a0.y, -a0.x, 0});
    return {a0, a1, glm::cross(a0, a1)};
}

Axes3 travel_axes(const Clip& clip, SampleRange range, double w) {
    return frame_around(glm::normalize(glm::dvec3{travel(disks(clip, range)), w * (range.count - 1) * clip.dt()}));
}

/// Principal axes of the centres in (x, y, w*t).
Axes3 covariance_axes(const Clip& clip, SampleRange range, double w) {
    const PrincipalAxes principal = principal_axes(disks(clip, range), w * clip.dt());
    // A straight walk has no second direction: take the floor's.
    return principal.is_line && !is_along_time(principal.axes[0]) ? frame_around(principal.axes[0]) : principal.axes;
}

/// Turns two axes of a frame into each other.
void turn(glm::dvec3& a, glm::dvec3& b, double c, double s) {
    const glm::dvec3 turned = c * a + s * b;
    b = c * b - s * a;
    a = turned;
}

/// The box along axes of which one may turn out to be time's.
Box box_along_or_upright(const Clip& clip, SampleRange range, const Axes3& axes, double w) {
    for (std::size_t k = 0; k < 3; ++k) {
        if (!is_along_time(axes[k])) continue;
        const glm::dvec3 u = axes[(k + 1) % 3];
        const glm::dvec2 axis = positive(glm::normalize(glm::dvec2{u.x, u.y}));
        const BoundedDisks bounded(swept_disks(clip, range));
        return box_over_time(BoxKind::obb2d, clip, range, rectangle_around(bounded, axis), w);
    }
    return box_along(clip, range, axes, w);
}

/// Turns the box about its own axes by ever smaller steps for as long as its volume shrinks.
Box shrink_by_turning(const Clip& clip, SampleRange range, Box best, double w) {
    constexpr double kFirstStep = 0.2;  // radians
    constexpr int kHalvings = 7;        // down to 0.003: finer steps change the volume by less than a per mille
    constexpr int kMostTurnsPerStep = 32;
    double least = volume(best, w);
    for (int halving = 0; halving < kHalvings; ++halving) {
        const double step = std::ldexp(kFirstStep, -halving);
        const double c = std::cos(step);
        const double s = std::sin(step);
        bool improved = true;
        for (int turns = 0; improved && turns < kMostTurnsPerStep; ++turns) {
            improved = false;
            for (std::size_t k = 0; k < 3; ++k) {
                for (const double sign : {1.0, -1.0}) {
                    Axes3 axes = best.axes;
                    turn(axes[k], axes[(k + 1) % 3], c, sign * s);
                    const Box turned = box_along_or_upright(clip, range, axes, w);
                    if (volume(turned, w) < least) {
                        least = volume(turned, w);
                        best = turned;
                        improved = true;
                    }
                }
            }
        }
    }
    return best;
}

Box smallest_box(const Clip& clip, SampleRange range, double w) {
    Box best = fit(BoxKind::obb3d, clip, range, Axes::endpoints, w);
    for (const Box& box :
         {fit(BoxKind::obb3d, clip, range, Axes::covariance, w), fit(BoxKind::obb2d, clip, range, Axes::minarea, w)}) {
        if (volume(box, w) < volume(best, w)) best = box;
    }
    return shrink_by_turning(clip, range, best, w);
}

Rectangle rectangle_along(std::span<const Disk> own, const BoundedDisks& bounded, Axes axes) {
    return rectangle_around(bounded, axis_2d(own, bounded, travel_axis(own), axes));
}

Box fit_obb3d(const Clip& clip, SampleRange range, Axes axes, double time_scale) {
    const bool along_time = range.count == 1 || glm::length(travel(disks(clip, range))) <= kStandingStill;
    if (along_time) return fit(BoxKind::obb2d, clip, range, axes, time_scale);
    switch (axes) {
        case Axes::endpoints:
            return box_along_or_upright(clip, range, travel_axes(clip, range, time_scale), time_scale);
        case Axes::covariance:
            return box_along_or_upright(clip, range, covariance_axes(clip, range, time_scale), time_scale);
        case Axes::minarea:
            return smallest_box(clip, range, time_scale);
    }
    return {};
}

Box fit_moving(const Clip& clip, SampleRange range, Axes axes, double time_scale) {
    const std::span<const Disk> all = disks(clip, range);
    const glm::dvec2 per_sample = drift_per_sample(all);
    const std::vector<Disk> seen = drifting(clip, range, per_sample);
    const std::span<const Disk> own = clip.runs() ? std::span(seen).first(all.size()) : std::span(seen);
    const BoundedDisks bounded{seen};
    const Rectangle rectangle = rectangle_around(bounded, axis_2d(own, bounded, travel_axis(all), axes));
    Box box = box_over_time(BoxKind::moving, clip, range, rectangle, time_scale);
    box.drift = 0.5 * clip.steps(range.first, range.end()) * per_sample;
    return box;
}

Box fit_block(const Clip& clip, SampleRange range, Axes /*axes*/, double time_scale) {
    return box_around(bounding_disk(clip, range.first, range.end()), time_scale * clip.time(range.first),
                      time_scale * clip.time(range.end()));
}

/// How a box of a kind is fitted: an upright one by what it is on the floor.
struct BoxFit {
    BoxKind kind;
    Rectangle (*on_floor)(std::span<const Disk> own, const BoundedDisks& bounded, Axes axes) = nullptr;
    Box (*in_time)(const Clip& clip, SampleRange range, Axes axes, double time_scale) = nullptr;
};

Rectangle aabb_around(std::span<const Disk> /*own*/, const BoundedDisks& bounded, Axes /*axes*/) {
    return rectangle_around(bounded, {1, 0});
}

constexpr BoxFit kFits[] = {
    {BoxKind::obb2d, rectangle_along}, {BoxKind::obb3d, nullptr, fit_obb3d}, {BoxKind::moving, nullptr, fit_moving},
    {BoxKind::aabb, aabb_around},      {BoxKind::block, nullptr, fit_block},
};
static_assert(std::ranges::equal(kFits, kBoxKinds, {}, &BoxFit::kind), "each kind of box has its fit, in their order");
static_assert(std::ranges::all_of(kFits,
                                  [](const BoxFit& row) {
                                      return (row.on_floor != nullptr) == is_upright(row.kind) &&
                                             (row.in_time != nullptr) != is_upright(row.kind);
                                  }),
              "an upright kind is fitted on the floor, another one in time");

constexpr const BoxFit& fit_of(BoxKind kind) { return kFits[static_cast<std::size_t>(kind)]; }

}  // namespace

Box fit(BoxKind kind, const Clip& clip, SampleRange range, Axes axes, double time_scale) {
    assert(range.first >= 0 && range.count >= 1 && range.end() <= clip.count() && time_scale > 0);
    const BoxFit& by = fit_of(kind);
    if (by.in_time) return by.in_time(clip, range, axes, time_scale);
    const BoundedDisks bounded(swept_disks(clip, range));
    return box_over_time(kind, clip, range, by.on_floor(disks(clip, range), bounded, axes), time_scale);
}

Rectangle fit_node(BoxKind kind, const Clip& clip, std::span<const Node> nodes, int node, Axes axes) {
    assert(is_upright(kind));
    const Node& n = nodes[static_cast<std::size_t>(node)];
    return fit_of(kind).on_floor(disks(clip, {n.first, n.count}), BoundedDisks(clip, nodes, node), axes);
}

}  // namespace mobb
