/// Separating-axis tests between placed boxes. They can only fail to prune: a pair counts as separated only if the gap
/// exceeds a slack that covers every rounding error made on the way.
#pragma once

#include <mobb/box.h>
#include <mobb/clip.h>
#include <mobb/lanes.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <type_traits>

namespace mobb {

/// The result of a box test. axis < 0: no axis separates the boxes.
struct Separation {
    /// 2D and moving: A0 A1 B0 B1 are 0..3. 3D: A0-2 are 0..2, B0-2 are 3..5, Ai x Bj is 6 + 3i + j. Along the axes:
    /// the world's x and y are 0 and 1. Blocks: the line between the centres is 0.
    int axis = -1;
    double gap = 0;  ///< metres along that unit axis, without slack; moving: the least over the common time

    bool separated() const { return axis >= 0; }
};

/// |x| + |y|.
inline double l1_norm(glm::dvec2 v) { return std::abs(v.x) + std::abs(v.y); }

/// The placement of B's frame in A's, and the slack that a gap must exceed. One per query.
class RelativeFrame {
  public:
    /// `time_scale` w is that of both trees.
    RelativeFrame(const PlacedFrame& a, const PlacedFrame& b, double time_scale)
        : rotation_(a.rotation.inverse() * b.rotation), to_world_(a.rotation) {
        cosines_ = both(rotation_.c);
        sines_ = TwoDoubles{-rotation_.s, rotation_.s};
        const glm::dvec2 between = a.rotation.inverse()(b.translate - a.translate);
        offset_ = {between.x, between.y, time_scale * (b.start - a.start)};
        const double lengths = l1_norm(a.translate) + l1_norm(b.translate) + a.reach + b.reach;
        const double times = std::abs(a.start) + std::abs(b.start) + a.duration + b.duration;
        slack2d_ = kLeastSlack + kSlackFactor * lengths;
        slack_time_ = kSlackFactor * time_scale * times;
        slack3d_ = slack2d_ + slack_time_;
    }

    /// Makes the slack cover the squares that the predicate of swept disks subtracts. `a`, `b`: as above.
    void cover_swept_disks(const PlacedFrame& a, const PlacedFrame& b);

    glm::dvec2 direction(glm::dvec2 v) const { return rotation_(v); }
    glm::dvec3 direction(glm::dvec3 v) const {
        return {rotation_.c * v.x - rotation_.s * v.y, rotation_.s * v.x + rotation_.c * v.y, v.z};
    }
    glm::dvec3 point(glm::dvec3 p) const {
        const glm::dvec3 d = direction(p);
        return {d.x + offset_.x, d.y + offset_.y, d.z + offset_.z};
    }
    /// The same for two numbers in a register.
    TwoDoubles direction(TwoDoubles v) const { return cosines_ * v + sines_ * swapped(v); }
    TwoDoubles point(TwoDoubles p) const { return direction(p) + lanes(offset()); }
    const Rotation& rotation() const { return rotation_; }
    /// B's origin, metres.
    glm::dvec2 offset() const { return {offset_.x, offset_.y}; }
    /// From A's frame to the world's.
    const Rotation& to_world() const { return to_world_; }
    double slack2d() const { return slack2d_; }
    double slack3d() const { return slack3d_; }
    /// Of times, in metres of w*t.
    double slack_time() const { return slack_time_; }

  private:
    /// Fitting, two placements (a chain places twice), the rotation between them and the projections round some sixty
    /// times, each by at most one epsilon of the lengths involved. The rest is margin: it costs nothing that can be
    /// seen.
    static constexpr double kSlackFactor = 256 * std::numeric_limits<double>::epsilon();
    /// Metres. Squares of lengths below 1e-154 underflow in the hit predicate, which then sees disks closer than they
    /// are.
    static constexpr double kLeastSlack = 1e-150;

    TwoDoubles cosines_, sines_;  ///< of rotation_: (c, c) and (-s, s)
    Rotation rotation_;           ///< from B's frame to A's
    Rotation to_world_;
    glm::dvec3 offset_;  ///< B's origin in A's frame, (x, y, w*t)
    double slack2d_;
    double slack3d_;
    double slack_time_;
};

/// Edge-edge axes (cross products of unit axes) shorter than this are skipped.
inline constexpr double kShortestEdgeAxis = 1e-3;

/// The gaps of two rectangles along their axes, metres; below 0: how deep they overlap.
struct FloorGaps {
    TwoDoubles a;  ///< along A0 and A1
    TwoDoubles b;  ///< along B0 and B1

    [[gnu::always_inline]] FloorGaps(const Rectangle& of_a, const Rectangle& of_b, const RelativeFrame& frame) {
        const TwoDoubles u = lanes(of_a.axis), v = frame.direction(lanes(of_b.axis));
        const TwoDoubles d = frame.point(lanes(of_b.center)) - lanes(of_a.center);
        const TwoDoubles u_x = both(u[0]), u_y{u[1], -u[1]}, v_x = both(v[0]), v_y{v[1], -v[1]};
        const TwoDoubles half_a = lanes(of_a.half), half_b = lanes(of_b.half);
        // The cosine and the sine of the angle between the two.
        const TwoDoubles cs = magnitude(u_x * v + u_y * swapped(v)), sc = swapped(cs);
        a = magnitude(u_x * d + u_y * swapped(d)) - (half_a + half_b[0] * cs + half_b[1] * sc);
        b = magnitude(v_x * d + v_y * swapped(d)) - (half_b + half_a[0] * cs + half_a[1] * sc);
    }

    bool separated(double slack) const { return any((a > slack) | (b > slack)); }
    Separation first_above(double slack) const {
        for (int i = 0; i < 2; ++i) {
            if (a[i] > slack) return {i, a[i]};
        }
        for (int i = 0; i < 2; ++i) {
            if (b[i] > slack) return {2 + i, b[i]};
        }
        return {};
    }
};

/// Two obb2d: four axes (paper, Section 3.2).
inline Separation separate_obb2d(const Rectangle& a, const Rectangle& b, const RelativeFrame& frame) {
    return FloorGaps(a, b, frame).first_above(frame.slack2d());
}

/// Any two boxes as 3D boxes: fifteen axes at most (Gottschalk et al. 1996, the paper's [8]). An edge-edge axis shorter
/// than kShortestEdgeAxis is skipped: its direction is poorly known and the face axes next to it decide almost the
/// same.
Separation separate_obb3d(const Box& a, const Box& b, const RelativeFrame& frame);

/// Two moving boxes: four axes. Separated along one if, at both ends of their common time, one box lies on the same
/// side of the other: conservative, as between the ends the gap is linear in time. Both of one time scale.
Separation separate_moving(const Box& a, const Box& b, const RelativeFrame& frame);

/// Two boxes along x and y of their clips, each wrapped again along x and y of the world: two axes.
Separation separate_aabb(const Rectangle& a, const Rectangle& b, const RelativeFrame& frame);

/// Two blocks: one axis, from centre to centre where they are nearest in their common time. Both of one time scale.
Separation separate_block(const Box& a, const Box& b, const RelativeFrame& frame);

/// The test that two kinds of boxes get, in this order, and the kind it is counted as.
struct PairTest {
    BoxKind a;
    BoxKind b;
    BoxKind test;
    bool mixes_time;  ///< boxes of trees of different time scales live in different spaces: they are not compared
    /// One of these: of upright boxes it is what their rectangles need.
    Separation (*rectangles)(const Rectangle&, const Rectangle&, const RelativeFrame&) = nullptr;
    Separation (*boxes)(const Box&, const Box&, const RelativeFrame&) = nullptr;

    Separation separate(const Box& of_a, const Box& of_b, const RelativeFrame& frame) const {
        return rectangles ? rectangles(rectangle_of(of_a), rectangle_of(of_b), frame) : boxes(of_a, of_b, frame);
    }
};

/// A pair that is not here has no test in common: it counts as overlapping.
inline constexpr PairTest kPairTests[] = {
    {BoxKind::obb2d, BoxKind::obb2d, BoxKind::obb2d, false, separate_obb2d},
    {BoxKind::obb3d, BoxKind::obb3d, BoxKind::obb3d, true, nullptr, separate_obb3d},
    {BoxKind::obb2d, BoxKind::obb3d, BoxKind::obb3d, true, nullptr, separate_obb3d},
    {BoxKind::obb3d, BoxKind::obb2d, BoxKind::obb3d, true, nullptr, separate_obb3d},
    {BoxKind::moving, BoxKind::moving, BoxKind::moving, true, nullptr, separate_moving},
    {BoxKind::aabb, BoxKind::aabb, BoxKind::aabb, false, separate_aabb},
    {BoxKind::block, BoxKind::block, BoxKind::block, true, nullptr, separate_block},
};

static_assert(std::ranges::all_of(kBoxKinds,
                                  [](BoxKind kind) {
                                      return std::ranges::any_of(kPairTests, [=](const PairTest& test) {
                                          return test.a == kind && test.b == kind;
                                      });
                                  }),
              "a kind of box has no test against itself");

/// Half extents along the world's x and y of a rectangle along x and y of a frame that `to_world` turns.
inline glm::dvec2 half_in_world(glm::dvec2 half, const Rotation& to_world) {
    const double c = std::abs(to_world.c);
    const double s = std::abs(to_world.s);
    return {c * half.x + s * half.y, s * half.x + c * half.y};
}

}  // namespace mobb
