#include <gtest/gtest.h>
#include <mobb/random_motion.h>
#include <mobb/tree.h>

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

namespace mobb {
namespace {

using test::Random;

/// A centre that moves through the origin at w*t = middle, by `velocity` metres per metre of w*t.
struct Drift {
    glm::dvec2 velocity{0};
    double middle = 0;
};
Drift drift_of(const Box& box) { return {box.half.z > 0 ? box.drift / box.half.z : glm::dvec2(0), box.center.z}; }

/// How far the cylinders of a range reach along a unit axis of (x, y, w*t), seen from a moving centre: worked out from
/// the rim, not from the formula.
struct Reach {
    double low = 1e300;
    double high = -1e300;
};
Reach reach_along(const Clip& clip, SampleRange range, glm::dvec3 axis, double w, const Drift& drift = {}) {
    const double in_plane = std::sqrt(axis.x * axis.x + axis.y * axis.y);
    const glm::dvec2 rim = in_plane > 0 ? glm::dvec2{axis.x, axis.y} / in_plane : glm::dvec2{1, 0};
    Reach reach;
    const bool runs = clip.motion() == Motion::linear && clip.count() > 1;
    for (int i = range.first; i < range.end(); ++i) {
        for (const double side : {-1.0, 1.0}) {
            for (const int end : {0, 1}) {
                if (runs && i + end == clip.count()) continue;  // it ends at its last sample
                const Disk d = clip.samples()[static_cast<std::size_t>(runs ? i + end : i)];
                const double wt = w * clip.dt() * (i + end);
                const glm::dvec2 q = -(wt - drift.middle) * drift.velocity;
                const glm::dvec3 p{d.x + side * d.r * rim.x + q.x, d.y + side * d.r * rim.y + q.y, wt};
                const double along = glm::dot(p, axis);
                reach.low = std::min(reach.low, along);
                reach.high = std::max(reach.high, along);
            }
        }
    }
    return reach;
}

/// How far the disk that stands out of it the furthest does, at its begin or its end.
double overhang_of(const Clip& clip, SampleRange range, const Box& box, double w) {
    const bool runs = clip.motion() == Motion::linear && clip.count() > 1;
    double out = -1e300;
    for (int i = range.first; i < range.end(); ++i) {
        for (const int end : {0, 1}) {
            if (runs && i + end == clip.count()) continue;
            const Disk d = clip.samples()[static_cast<std::size_t>(runs ? i + end : i)];
            out = std::max(out, test::overhang(box, {d.x, d.y, w * clip.dt() * (i + end)}, d.r));
        }
    }
    return out;
}

/// Contains every cylinder and touches one with each side, to 1e-6 m; axes are orthonormal.
void expect_tight(const Clip& clip, SampleRange range, const Box& box, double w) {
    const BoxInfo& shape = info(box.kind);
    EXPECT_NEAR(overhang_of(clip, range, box, w), 0, 1e-9);
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec3 axis = box.axes[k];
        EXPECT_NEAR(glm::length(axis), 1, 2e-14);
        EXPECT_NEAR(glm::dot(axis, box.axes[(k + 1) % 3]), 0, 2e-14);
        if (shape.round && k < 2) continue;
        const Reach reach = reach_along(clip, range, axis, w, drift_of(box));
        const double center = glm::dot(box.center, axis);
        const double half = box.half[static_cast<int>(k)];
        EXPECT_GE(half, 0);
        EXPECT_NEAR(center - half, reach.low, 1e-9);
        EXPECT_NEAR(center + half, reach.high, 1e-9);
    }
    if (shape.round) {
        EXPECT_EQ(box.half.x, box.half.y);
    }
    if (shape.axes != BoxAxes::space_time) {
        EXPECT_EQ(box.axes[2], glm::dvec3(0, 0, 1));
        EXPECT_EQ(box.axes[0].z, 0);
    }
    if (shape.axes == BoxAxes::world) {
        EXPECT_EQ(box.axes[0], glm::dvec3(1, 0, 0));
    }
    if (!shape.moves) {
        EXPECT_EQ(box.drift, glm::dvec2(0));
    }
}

TEST(Fit, EveryBoxIsTightAndContainsItsCylinders) {
    Random random(1);
    for (int round = 0; round < 400; ++round) {
        const ClipPtr clip = test::random_motion(random, test::random_clip(random, 300));
        FitOptions options = test::random_fit(random);
        const Tree tree(clip, options);
        for (int i = 0; i < static_cast<int>(tree.nodes().size()); ++i) {
            expect_tight(*clip, {tree.node(i).first, tree.node(i).count}, tree.box(i), options.time_scale);
        }
        if (HasFailure()) FAIL() << "round " << round;
    }
}

TEST(Fit, MobbAxesRunFromFirstToLastSample) {
    const Clip clip(0.1, {{0, 0, 0.5}, {5, -3, 0.2}, {3, 4, 0.4}});
    const Box box = fit(BoxKind::obb2d, clip, {0, 3}, Axes::endpoints, 1);
    EXPECT_NEAR(box.axes[0].x, 0.6, 1e-15);
    EXPECT_NEAR(box.axes[0].y, 0.8, 1e-15);
    EXPECT_NEAR(box.axes[1].x, -0.8, 1e-15);
    EXPECT_NEAR(box.axes[1].y, 0.6, 1e-15);
    EXPECT_NEAR(box.half.z, 0.15, 1e-15);
}

TEST(Fit, UmobbAxesOfTheRootAreThePapers) {
    const Clip clip(0.5, {{0, 0, 0.3}, {1, 0, 0.3}, {2, 2, 0.3}});
    const double w = 2;
    const Box box = fit(BoxKind::obb3d, clip, {0, 3}, Axes::endpoints, w);
    ASSERT_EQ(box.kind, BoxKind::obb3d);
    const glm::dvec3 a0 = glm::normalize(glm::dvec3{2, 2, w * 2 * 0.5});
    const glm::dvec3 a1 = glm::normalize(glm::cross(a0, glm::dvec3{0, 0, 1}));
    const glm::dvec3 a2 = glm::cross(a0, a1);
    EXPECT_NEAR(glm::length(box.axes[0] - a0), 0, 1e-14);
    EXPECT_NEAR(glm::length(box.axes[1] - a1), 0, 1e-14);
    EXPECT_NEAR(glm::length(box.axes[2] - a2), 0, 1e-14);
}

TEST(Fit, OneDiskOnTheAxesOfFigure6) {
    // Two samples give the axes; the extents of the first one alone are those of Eq. "min_0 .. max_2" with a0_t > 0.
    const double r = 0.4, dt = 0.5;
    const Clip clip(dt, {{0, 0, r}, {0.3, 0, 0}});
    const Box box = fit(BoxKind::obb3d, clip, {0, 2}, Axes::endpoints, 1);
    const glm::dvec3 a0 = box.axes[0], a2 = box.axes[2];
    const double low0 = glm::dot(box.center, a0) - box.half.x;
    const double high2 = glm::dot(box.center, a2) + box.half.z;
    EXPECT_NEAR(low0, -r * std::hypot(a0.x, a0.y), 1e-12);
    const double over = std::max(0.0, dt * a2.z);
    EXPECT_NEAR(high2, std::max(r * std::hypot(a2.x, a2.y) + over, 0.3 * a2.x + dt * a2.z + over), 1e-12);
}

TEST(Fit, StandingStillFallsBackToPrincipalAxisThenX) {
    const Clip standing(0.1, {{5, 7, 0.5}, {5, 7, 0.4}, {5, 7, 0.5}});
    EXPECT_EQ(fit(BoxKind::obb2d, standing, {0, 3}, Axes::endpoints, 1).axes[0], glm::dvec3(1, 0, 0));
    const Clip there_and_back(0.1, {{0, 0, 0.5}, {-1, -1, 0.5}, {-2, -2, 0.5}, {-1, -1, 0.5}, {0, 0, 0.5}});
    const Box box = fit(BoxKind::obb2d, there_and_back, {0, 5}, Axes::endpoints, 1);
    EXPECT_NEAR(box.axes[0].x, std::numbers::sqrt2 / 2, 1e-12);
    EXPECT_NEAR(box.axes[0].y, std::numbers::sqrt2 / 2, 1e-12);
}

TEST(Fit, FirstAndLastWithinAMicrometreGiveNoDirection) {
    const Clip clip(0.1, {{0, 0, 0.5}, {3, 4, 0.5}, {0, 5e-7, 0.5}});
    const Box box = fit(BoxKind::obb2d, clip, {0, 3}, Axes::endpoints, 1);
    EXPECT_NEAR(box.axes[0].x, 0.6, 1e-6);
    EXPECT_NEAR(box.axes[0].y, 0.8, 1e-6);
}

TEST(Fit, WhatHasNoPrincipalAxisTakesX) {
    for (const double x : {0.0, 1.1, 3.3, 7.7}) {
        std::vector<Disk> circle;
        for (int i = 0; i <= 36; ++i) {
            const double angle = 2 * std::numbers::pi * (i % 36) / 36;
            circle.push_back({x + 2 * std::cos(angle), x + 2 * std::sin(angle), 0.5});
        }
        circle.pop_back();
        const Clip clip(0.1, circle);
        EXPECT_EQ(fit(BoxKind::obb2d, clip, {0, 36}, Axes::covariance, 1).axes[0], glm::dvec3(1, 0, 0)) << x;
    }
}

TEST(Fit, PrincipalAxisAlongYIsExactAndDoesNotFlip) {
    for (const double shift : {0.0, 1e-18, -1e-18}) {
        const Clip clip(0.1, {{shift, 0, 0.5}, {0, 1, 0.5}, {0, 2, 0.5}, {0, -3, 0.5}});
        EXPECT_EQ(fit(BoxKind::obb2d, clip, {0, 4}, Axes::covariance, 1).axes[0], glm::dvec3(0, 1, 0)) << shift;
    }
}

/// Covariance of the centres in (x, y, w*t), in extended precision.
struct Covariance {
    long double m[3][3] = {};
    long double along(glm::dvec3 u, glm::dvec3 v) const {
        long double sum = 0;
        for (int r = 0; r < 3; ++r) {
            for (int c = 0; c < 3; ++c)
                sum += static_cast<long double>(u[r]) * m[r][c] * static_cast<long double>(v[c]);
        }
        return sum;
    }
};
Covariance covariance(const Clip& clip, double w) {
    long double mean[3] = {};
    const auto point = [&](int i, int k) -> long double {
        const Disk& d = clip.samples()[static_cast<std::size_t>(i)];
        return k == 0 ? d.x : k == 1 ? d.y : static_cast<long double>(w) * clip.dt() * i;
    };
    Covariance c;
    for (int i = 0; i < clip.count(); ++i) {
        for (int k = 0; k < 3; ++k) mean[k] += point(i, k) / clip.count();
    }
    for (int i = 0; i < clip.count(); ++i) {
        for (int r = 0; r < 3; ++r) {
            for (int q = 0; q < 3; ++q) c.m[r][q] += (point(i, r) - mean[r]) * (point(i, q) - mean[q]);
        }
    }
    return c;
}

TEST(Fit, CovarianceAxesDiagonaliseTheCovariance) {
    Random random(5);
    int free_boxes = 0;
    for (int round = 0; round < 400; ++round) {
        std::vector<Disk> path;
        const int n = random.integer(5, 200);
        double x = 0, y = 0, heading = random.real(0, 6);
        for (int i = 0; i < n; ++i) {
            path.push_back({x, y, 0.3});
            heading += random.real(-0.4, 0.4);
            x += 0.05 * std::cos(heading), y += 0.05 * std::sin(heading);
        }
        const Clip clip(1.0 / 30, path);
        const double w = std::pow(10, random.real(-2, 4));
        const Covariance c = covariance(clip, w);
        const Box flat = fit(BoxKind::obb2d, clip, {0, n}, Axes::covariance, w);
        EXPECT_LE(std::abs(c.along(flat.axes[0], flat.axes[1])), 1e-9 * c.along(flat.axes[0], flat.axes[0])) << round;
        EXPECT_GE(c.along(flat.axes[0], flat.axes[0]), c.along(flat.axes[1], flat.axes[1])) << round;

        const Box box = fit(BoxKind::obb3d, clip, {0, n}, Axes::covariance, w);
        free_boxes += box.kind == BoxKind::obb3d;
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3 u = box.axes[k], v = box.axes[(k + 1) % 3];
            EXPECT_LE(std::abs(c.along(u, v)), 1e-4 * std::sqrt(c.along(u, u) * c.along(v, v))) << round << " w " << w;
        }
        EXPECT_GE(c.along(box.axes[0], box.axes[0]), c.along(box.axes[1], box.axes[1]) * 0.999999L) << round;
        EXPECT_GE(c.along(box.axes[1], box.axes[1]), c.along(box.axes[2], box.axes[2]) * 0.999999L) << round;
    }
    EXPECT_GT(free_boxes, 300);
}

TEST(Fit, CovarianceOfAStraightWalkTakesTheFloorsDirection) {
    for (double degrees = 3; degrees < 360; degrees += 17) {
        const double angle = degrees * std::numbers::pi / 180;
        std::vector<Disk> path;
        for (int i = 0; i < 30; ++i) path.push_back({0.05 * i * std::cos(angle), 0.05 * i * std::sin(angle), 0.3});
        const Box box = fit(BoxKind::obb3d, Clip(0.1, path), {0, 30}, Axes::covariance, 1);
        ASSERT_EQ(box.kind, BoxKind::obb3d);
        EXPECT_NEAR(std::abs(box.axes[1].x * std::sin(angle) - box.axes[1].y * std::cos(angle)), 1, 1e-9) << degrees;
        EXPECT_NEAR(box.axes[1].z, 0, 1e-12) << degrees;
    }
}

TEST(Fit, FreeBoxAlongTimeIsStoredAs2D) {
    for (const Axes axes : {Axes::endpoints, Axes::covariance, Axes::minarea}) {
        const Clip one(0.1, {{1, 2, 0.5}});
        EXPECT_EQ(fit(BoxKind::obb3d, one, {0, 1}, axes, 1).kind, BoxKind::obb2d);
        const Clip back_again(0.1, {{0, 0, 0.5}, {2, 0, 0.5}, {5e-7, 0, 0.5}});
        EXPECT_EQ(fit(BoxKind::obb3d, back_again, {0, 3}, axes, 1).kind, BoxKind::obb2d);
        const Clip walk(0.1, {{0, 0, 0.01}, {1, 0, 0.01}, {2, 0.1, 0.01}});
        EXPECT_EQ(fit(BoxKind::obb3d, walk, {0, 3}, axes, 1).kind, BoxKind::obb3d);
    }
}

double area(const Clip& clip, glm::dvec2 u) {
    const Reach along = reach_along(clip, {0, clip.count()}, {u.x, u.y, 0}, 1);
    const Reach across = reach_along(clip, {0, clip.count()}, {-u.y, u.x, 0}, 1);
    return (along.high - along.low) * (across.high - across.low);
}

TEST(Fit, MinareaIsWithinOnePercentOfTheBestOf1800Angles) {
    Random random(2);
    for (int round = 0; round < 150; ++round) {
        const ClipPtr clip = test::random_motion(random, test::random_clip(random, 200));
        double best = 1e300;
        for (int k = 0; k < 1800; ++k) {
            const double angle = std::numbers::pi * k / 1800;
            best = std::min(best, area(*clip, {std::cos(angle), std::sin(angle)}));
        }
        const SampleRange all{0, clip->count()};
        const auto flat_area = [&](Axes axes) {
            const Box box = fit(BoxKind::obb2d, *clip, all, axes, 1);
            return 4 * box.half.x * box.half.y;
        };
        const double found = flat_area(Axes::minarea);
        EXPECT_LE(found, best * 1.01 + 1e-12) << round;
        EXPECT_LE(found, flat_area(Axes::endpoints)) << round;
        EXPECT_LE(found, flat_area(Axes::covariance)) << round;
    }
}

TEST(Fit, AMovingBoxMovesFromTheFirstCentreToTheLast) {
    const Clip clip(0.5, {{9, 9, 1}, {0, 0, 0.3}, {1, 3, 0.3}, {4, 2, 0.3}});
    const Box box = fit(BoxKind::moving, clip, {1, 3}, Axes::endpoints, 2);
    EXPECT_EQ(box.kind, BoxKind::moving);
    // 4 m and 2 m in one second, over 1.5 s: half of that on either side of the middle.
    EXPECT_NEAR(glm::length(box.drift - glm::dvec2(3, 1.5)), 0, 1e-14);
    EXPECT_NEAR(glm::length(box.axes[0] - glm::normalize(glm::dvec3(4, 2, 0))), 0, 1e-14);
    EXPECT_NEAR(box.half.z, 2 * 0.75, 1e-14);
    EXPECT_EQ(fit(BoxKind::moving, clip, {0, 1}, Axes::endpoints, 1).drift, glm::dvec2(0)) << "one sample stands still";
}

TEST(Fit, OfALinearClipHoldsTheDiskThatTheLastOneRunsTo) {
    const Clip clip(1, {{0, 0, 0.5}, {2, 0, 0.5}, {4, 6, 1}}, Motion::linear);
    const Box first = fit(BoxKind::obb2d, clip, {0, 2}, Axes::endpoints, 1);
    EXPECT_EQ(first.axes[0], glm::dvec3(1, 0, 0)) << "the way of its own samples";
    EXPECT_DOUBLE_EQ(first.half.x, 5.5 / 2);
    EXPECT_DOUBLE_EQ(first.half.y, 7.5 / 2);
    EXPECT_EQ(fit(BoxKind::obb3d, clip, {1, 1}, Axes::endpoints, 1).kind, BoxKind::obb2d) << "one sample of its own";
    // Walking straight, a box that moves along has nothing to make up for.
    const Clip walk(1, {{0, 0, 0.5}, {1, 0, 0.5}, {2, 0, 0.5}, {3, 0, 0.5}}, Motion::linear);
    EXPECT_DOUBLE_EQ(fit(BoxKind::moving, walk, {0, 3}, Axes::endpoints, 1).half.x, 0.5);
    EXPECT_DOUBLE_EQ(fit(BoxKind::moving, walk, {0, 4}, Axes::endpoints, 1).half.x, 0.5);
}

TEST(Fit, ALinearClipEndsAtItsLastSample) {
    const Clip clip(0.5, {{0, 0, 0.5}, {2, 0, 0.5}, {4, 6, 1}}, Motion::linear);
    EXPECT_EQ(clip.duration(), 1);
    EXPECT_EQ(clip.until_next(), 1.5);
    for (const BoxKind kind : kBoxKinds) {
        if (info(kind).axes == BoxAxes::space_time) continue;
        const Box whole = fit(kind, clip, {0, 3}, Axes::endpoints, 2);
        EXPECT_DOUBLE_EQ(whole.half.z, 1) << "w*t";
        EXPECT_DOUBLE_EQ(whole.center.z, 1);
        const Box last = fit(kind, clip, {2, 1}, Axes::endpoints, 2);
        EXPECT_EQ(last.half.z, 0);
        EXPECT_EQ(last.center, glm::dvec3(4, 6, 2));
        EXPECT_EQ(last.half.x, 1);
        EXPECT_EQ(last.drift, glm::dvec2(0));
    }
    const Clip one(0.5, {{0, 0, 0.5}}, Motion::linear);
    EXPECT_EQ(one.duration(), 0.5) << "a single sample holds for dt";
    EXPECT_EQ(fit(BoxKind::obb2d, one, {0, 1}, Axes::endpoints, 1).half.z, 0.25);
}

TEST(Fit, AMovingBoxIsAsNarrowAsAStraightWalk) {
    // Along the way a disk falls behind by one step within its hold interval, and no more.
    std::vector<Disk> walk;
    for (int i = 0; i < 100; ++i) walk.push_back({0.03 * i, 0.04 * i, 0.4});
    const Clip clip(0.1, walk);
    for (const Axes axes : {Axes::endpoints, Axes::covariance, Axes::minarea}) {
        const Box box = fit(BoxKind::moving, clip, {0, 100}, axes, 1);
        EXPECT_NEAR(box.half.x, 0.4 + 0.05 / 2, 1e-12) << name(axes);
        EXPECT_NEAR(box.half.y, 0.4, 1e-12) << name(axes);
    }
}

TEST(Fit, MinareaOfMovingBoxesIsNeverLooserThanTheOthers) {
    Random random(6);
    for (int round = 0; round < 200; ++round) {
        const ClipPtr clip = test::random_motion(random, test::random_clip(random, 200));
        const auto size = [&](Axes axes) {
            return volume(fit(BoxKind::moving, *clip, {0, clip->count()}, axes, 1), 1);
        };
        EXPECT_LE(size(Axes::minarea), size(Axes::endpoints)) << round;
        EXPECT_LE(size(Axes::minarea), size(Axes::covariance)) << round;
    }
}

TEST(Fit, MinareaFindsANarrowOptimum) {
    // Round a long thin rectangle, with a rest at one corner that pulls the principal axis off its sides.
    for (const double degrees : {0.0, 11.37, 33.33, 58.02, 77.7}) {
        const double angle = degrees * std::numbers::pi / 180;
        const glm::dvec2 along{std::cos(angle), std::sin(angle)}, across{-along.y, along.x};
        std::vector<Disk> path;
        const auto add = [&](double u, double v) {
            const glm::dvec2 p = u * along + v * across;
            path.push_back({p.x, p.y, 0.02});
        };
        for (int i = 0; i <= 20; ++i) add(i, 0);
        for (int i = 0; i < 60; ++i) add(20, 1);
        for (int i = 20; i >= 3; --i) add(i, 1);
        const Clip clip(0.1, path);
        const Box box = fit(BoxKind::obb2d, clip, {0, clip.count()}, Axes::minarea, 1);
        EXPECT_LE(4 * box.half.x * box.half.y, 1.01 * 20.04 * 1.04) << degrees;
    }
}

TEST(Fit, MinareaInSpaceTimeBeatsBothOthersWhereTheyAreLoose) {
    // A walk that rests first: the way from first to last and the principal axis both cut across the bend.
    std::vector<Disk> bend;
    for (int i = 0; i < 30; ++i) bend.push_back({i < 10 ? 0 : 0.1 * (i - 10), 0.02 * ((i * 7) % 3), 0.05});
    const Clip clip(0.1, bend);
    const SampleRange all{0, 30};
    const auto size = [&](Axes axes) { return volume(fit(BoxKind::obb3d, clip, all, axes, 1), 1); };
    EXPECT_LT(size(Axes::minarea), 0.97 * std::min(size(Axes::endpoints), size(Axes::covariance)));
    EXPECT_LT(size(Axes::minarea), volume(fit(BoxKind::obb2d, clip, all, Axes::minarea, 1), 1));
}

TEST(Fit, MinareaInSpaceTimeIsNeverLooserThanTheOthers) {
    Random random(3);
    for (int round = 0; round < 200; ++round) {
        const ClipPtr clip = test::random_motion(random, test::random_clip(random, 200));
        const SampleRange all{0, clip->count()};
        const double w = random.real(0.2, 5);
        const double found = volume(fit(BoxKind::obb3d, *clip, all, Axes::minarea, w), w);
        EXPECT_LE(found, volume(fit(BoxKind::obb3d, *clip, all, Axes::endpoints, w), w)) << round;
        EXPECT_LE(found, volume(fit(BoxKind::obb3d, *clip, all, Axes::covariance, w), w)) << round;
        EXPECT_LE(found, volume(fit(BoxKind::obb2d, *clip, all, Axes::minarea, w), w)) << round;
    }
}

}  // namespace
}  // namespace mobb
