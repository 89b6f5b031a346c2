#include <gtest/gtest.h>
#include <mobb/level_figures.h>
#include <mobb/query.h>
#include <mobb/random_motion.h>
#include <mobb/trace.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace mobb {
namespace {

using test::query_budget;
using test::Random;

/// Nasty ones: still, points, ones that end at the origin, run along each other, shrink and grow fast.
Disk random_disk(Random& random, double far) {
    const double r = random.chance(0.2) ? 0 : random.chance(0.2) ? random.real(0, 5) : random.real(0, 0.5);
    if (random.chance(0.1)) return {0, 0, r};
    if (random.chance(0.2))
        return {static_cast<double>(random.integer(-2, 2)), static_cast<double>(random.integer(-2, 2)), r};
    return {random.real(-far, far), random.real(-far, far), r};
}

SweptDisk random_swept(Random& random, double far) {
    SweptDisk out{random_disk(random, far), random_disk(random, far), 0, 0};
    if (random.chance(0.2)) out.to = out.from;
    if (random.chance(0.2)) out.to.r = out.from.r;
    out.begin = random.chance(0.5) ? 0 : random.real(-0.5, 0.5);
    out.end = out.begin + (random.chance(0.5) ? 1 : random.real(0.01, 2));
    return out;
}

/// The distance of two disks at a time by itself, in metres; < 0 where they overlap.
long double clearance_at(const SweptDisk& a, const SweptDisk& b, long double t) {
    const auto at = [t](const SweptDisk& d) {
        const long double s = (t - d.begin) / (static_cast<long double>(d.end) - d.begin);
        return std::array<long double, 3>{d.from.x + s * (static_cast<long double>(d.to.x) - d.from.x),
                                          d.from.y + s * (static_cast<long double>(d.to.y) - d.from.y),
                                          d.from.r + s * (static_cast<long double>(d.to.r) - d.from.r)};
    };
    const auto pa = at(a), pb = at(b);
    return std::hypot(pa[0] - pb[0], pa[1] - pb[1]) - (pa[2] + pb[2]);
}

/// The least clearance over the common time, by trisection: the clearance of disks that run straight is convex.
std::pair<long double, long double> nearest(const SweptDisk& a, const SweptDisk& b) {
    long double low = std::max(a.begin, b.begin), high = std::min(a.end, b.end);
    for (int i = 0; i < 120; ++i) {
        const long double first = low + (high - low) / 3, second = high - (high - low) / 3;
        (clearance_at(a, b, first) <= clearance_at(a, b, second) ? high : low) =
            clearance_at(a, b, first) <= clearance_at(a, b, second) ? second : first;
    }
    const long double t = (low + high) / 2;
    return {t, clearance_at(a, b, t)};
}

TEST(Approach, HeldDisksCollideByTheHeldFormulaBitForBit) {
    Random random(50);
    int hits = 0;
    for (int round = 0; round < 200000; ++round) {
        const Disk a = random_disk(random, 2);
        Disk b = random_disk(random, 2);
        if (random.chance(0.3)) {
            const double angle = random.real(0, 7), reach = (a.r + b.r) * (1 + random.integer(-2, 2) * 0x1p-52);
            b.x = a.x + reach * std::cos(angle), b.y = a.y + reach * std::sin(angle);
        }
        const Approach approach({a, a, 0, 1}, {b, b, 0.5, 2});
        ASSERT_EQ(approach.collides(), collide(a, b)) << round;
        hits += collide(a, b);
        if (!collide(a, b)) continue;
        const auto [begin, end] = approach.overlap();
        ASSERT_EQ(approach.time(begin), 0.5);
        ASSERT_EQ(approach.time(end), 1);
        ASSERT_EQ(approach.squared_distance(begin), squared_distance(a, b));
    }
    EXPECT_GT(hits, 20000);
}

TEST(Approach, DecidesAsTheLeastClearanceDoes) {
    Random random(51);
    int hits = 0, clear = 0;
    const int rounds = query_budget() / 10;
    for (int round = 0; round < rounds; ++round) {
        const double far = random.chance(0.2) ? 100 : 2;
        const SweptDisk a = random_swept(random, far), b = random_swept(random, far);
        if (!overlap_in_time(a.begin, a.end, b.begin, b.end)) continue;
        const Approach approach(a, b);
        const auto [t, least] = nearest(a, b);
        ASSERT_EQ(approach.collides(), Approach(b, a).collides());
        if (std::abs(least) < 1e-6L) continue;
        ++clear;
        hits += least < 0;
        ASSERT_EQ(approach.collides(), least < 0) << round << ": " << static_cast<double>(least);
        const double s = approach.least();
        EXPECT_LE(approach.squared_distance(s) - approach.radii(s) * approach.radii(s),
                  std::min(approach.C, approach.at_end) + 1e-14 * far * far + 1e-13);
    }
    EXPECT_GT(hits, rounds / 5);
    EXPECT_GT(clear - hits, rounds / 5);
}

TEST(Approach, OverlapIsWhereTheDisksOverlap) {
    Random random(52);
    int hits = 0, growing = 0;
    for (int round = 0; round < 30000; ++round) {
        const SweptDisk a = random_swept(random, 2), b = random_swept(random, 2);
        if (!overlap_in_time(a.begin, a.end, b.begin, b.end)) continue;
        const Approach approach(a, b);
        if (!approach.collides()) continue;
        const auto [begin, end] = approach.overlap();
        ASSERT_LE(0, begin);
        ASSERT_LE(begin, end);
        ASSERT_LE(end, 1);
        ++hits;
        growing += approach.A < 0;
        for (int k = 0; k <= 64; ++k) {
            const double s = k / 64.0;
            const long double clearance =
                clearance_at(a, b, approach.t0 + static_cast<long double>(s) * (approach.t1 - approach.t0));
            if (std::abs(clearance) < 1e-5L) continue;
            ASSERT_EQ(begin <= s && s <= end, clearance < 0) << round << " at " << s;
        }
    }
    EXPECT_GT(hits, 5000);
    EXPECT_GT(growing, 500) << "radii that change faster than the centres";
}

TEST(Approach, ContactOfTwoWhoWalkTowardsEachOther) {
    // 4 m apart at 2 m/s each, radii of 0.5: they touch after 0.75 s.
    const Clip a(1, {{0, 0, 0.5}, {2, 0, 0.5}}, Motion::linear), b(1, {{4, 0, 0.5}, {2, 0, 0.5}}, Motion::linear);
    const PlacedClip placed_a(a, {}), placed_b(b, {.start = 0});
    const std::optional<Contact> contact = direct_search(placed_a, placed_b);
    ASSERT_TRUE(contact);
    EXPECT_NEAR(contact->time, 0.75, 1e-15);
    EXPECT_NEAR(contact->distance, 1, 1e-15);
    EXPECT_NEAR(contact->radii, 1, 1e-15);
    const Clip held_a(1, {{0, 0, 0.5}, {2, 0, 0.5}}), held_b(1, {{4, 0, 0.5}, {2, 0, 0.5}});
    EXPECT_EQ(direct_search(PlacedClip(held_a, {}), PlacedClip(held_b, {}))->time, 1) << "held ones jump";
    // Two that swap places, and are never near at a sample.
    const Clip left(1, {{0, 0, 0.2}, {3, 0, 0.2}, {3, 0, 0.2}}, Motion::linear);
    const Clip right(1, {{3, 0, 0.2}, {0, 0, 0.2}, {0, 0, 0.2}}, Motion::linear);
    const std::vector<Interval> intervals = direct_contact_intervals(PlacedClip(left, {}), PlacedClip(right, {}));
    ASSERT_EQ(intervals.size(), 1u);
    EXPECT_NEAR(intervals[0].t0, 0.5 - 0.2 / 3, 1e-15);
    EXPECT_NEAR(intervals[0].t1, 0.5 + 0.2 / 3, 1e-15);
}

TEST(Approach, TouchingIsNotColliding) {
    const SweptDisk still{{0, 0, 0.5}, {0, 0, 0.5}, 0, 1};
    EXPECT_FALSE(Approach(still, {{-2, 1, 0.5}, {2, 1, 0.5}, 0, 1}).collides()) << "in passing";
    EXPECT_TRUE(Approach(still, {{-2, 1 - 1e-9, 0.5}, {2, 1 - 1e-9, 0.5}, 0, 1}).collides());
    EXPECT_FALSE(Approach(still, {{3, 0, 0.5}, {1, 0, 0.5}, 0, 1}).collides()) << "at the end";
    EXPECT_FALSE(Approach(still, {{1, 0, 0.5}, {3, 0, 0.5}, 0, 1}).collides()) << "at the beginning";
    EXPECT_FALSE(Approach({{0, 0, 0}, {0, 0, 0}, 0, 1}, {{-1, 0, 0}, {1, 0, 0}, 0, 1}).collides())
        << "points have no inside";
    // A radius that grows by as much as the centres part: they touch all the time.
    EXPECT_FALSE(Approach({{0, 0, 1}, {0, 0, 2}, 0, 1}, {{1, 0, 0}, {2, 0, 0}, 0, 1}).collides());
}

TEST(Approach, TheTraceHasTheDistanceOfTheEarliestLeast) {
    const Clip a(1, {{0, 0, 0.1}, {4, 0, 0.1}}, Motion::linear), b(1, {{2, 1, 0.1}, {2, 1, 0.1}}, Motion::linear);
    TraceRecorder recorder;
    EXPECT_FALSE(direct_search(PlacedClip(a, {}), PlacedClip(b, {}), recorder));
    const Trace& trace = recorder.trace();
    const Trace::Event last = trace[trace.size() - 1];
    ASSERT_EQ(last.test, TestKind::samples);
    ASSERT_EQ(last.pairs.size(), 1u) << "nobody is there after the last sample";
    EXPECT_DOUBLE_EQ(last.pairs[0].distance, 1) << "half-way";
}

TEST(Approach, CylindersThatRunHaveTheVolumeOfAFrustum) {
    const std::vector<Disk> samples{{0, 0, 1}, {5, 0, 2}, {5, 1, 2}};
    EXPECT_DOUBLE_EQ(cylinder_volume(Clip(0.5, samples), {0, 3}), 0.5 * std::numbers::pi * (1 + 4 + 4));
    EXPECT_DOUBLE_EQ(cylinder_volume(Clip(0.5, samples, Motion::linear), {0, 3}),
                     0.5 * std::numbers::pi * (7.0 / 3 + 4));
    EXPECT_DOUBLE_EQ(cylinder_volume(Clip(0.5, samples, Motion::linear), {1, 2}), 0.5 * std::numbers::pi * 4);
    EXPECT_EQ(cylinder_volume(Clip(0.5, samples, Motion::linear), {2, 1}), 0);
    EXPECT_DOUBLE_EQ(cylinder_volume(Clip(0.5, {{0, 0, 1}}, Motion::linear), {0, 1}), 0.5 * std::numbers::pi);
}

TEST(Approach, NobodyIsThereAfterTheLastSample) {
    // Two in file at one speed: the second comes to where the first was last seen.
    const auto leader =
        std::make_shared<const Clip>(0.4, std::vector<Disk>{{0, 0, 0.2}, {0.5, 0, 0.2}, {1, 0, 0.2}}, Motion::linear);
    const auto follower = std::make_shared<const Clip>(
        0.4, std::vector<Disk>{{-0.75, 0, 0.2}, {-0.25, 0, 0.2}, {0.25, 0, 0.2}, {0.75, 0, 0.2}}, Motion::linear);
    const auto meet = [](const ClipPtr& a, const ClipPtr& b, TreeKind kind) {
        const Tree tree_a(a, {.tree = kind}), tree_b(b, {.tree = kind});
        const PlacedTree placed_a(tree_a, {}), placed_b(tree_b, {});
        EXPECT_EQ(query(placed_a, placed_b), direct_search(placed_a.placed_clip(), placed_b.placed_clip()));
        return query(placed_a, placed_b).has_value();
    };
    const auto held =
        std::make_shared<const Clip>(0.4, std::vector<Disk>(leader->samples().begin(), leader->samples().end()));
    for (const TreeKind kind : kTreeKinds) {
        EXPECT_FALSE(meet(leader, follower, kind)) << name(kind);
        EXPECT_TRUE(meet(held, follower, kind)) << name(kind) << ": a held one is there for a dt more";
        // Whoever comes at the very moment at which another is last seen shares no time with it.
        const Clip other(0.4, {{1, 0, 0.2}, {1, 0, 0.2}}, Motion::linear);
        const Tree a(leader, {.tree = kind}), b(std::make_shared<const Clip>(other), {.tree = kind});
        EXPECT_FALSE(query(PlacedTree(a, {}), PlacedTree(b, {.start = leader->duration()}))) << name(kind);
        EXPECT_TRUE(query(PlacedTree(a, {}), PlacedTree(b, {.start = leader->duration() - 0.01}))) << name(kind);
    }
}

TEST(Approach, ASingleSampleHoldsForDt) {
    const auto one = std::make_shared<const Clip>(0.4, std::vector<Disk>{{0, 0, 0.2}}, Motion::linear);
    for (const TreeKind kind : kTreeKinds) {
        const Tree a(one, {.tree = kind}), b(one, {.tree = kind});
        EXPECT_TRUE(query(PlacedTree(a, {}), PlacedTree(b, {.start = 0.39}))) << name(kind);
        EXPECT_FALSE(query(PlacedTree(a, {}), PlacedTree(b, {.start = 0.4}))) << name(kind);
    }
}

/// So near each other the squares of the predicate cannot tell points apart: no box test may, either.
TEST(Approach, TreesAgreeOnPointsThatPassByAHair) {
    Random random(54);
    int false_hits = 0;
    for (int round = 0; round < 3000; ++round) {
        const double length = std::pow(10, random.real(-2, 3));
        const double hair = length * std::pow(10, random.real(-11, -7));
        const auto walk = [&](double y, double from, double to) {
            std::vector<Disk> out;
            for (int i = 0; i <= 3; ++i) out.push_back({from + (to - from) * i / 3, y, 0});
            return std::make_shared<const Clip>(1, out, Motion::linear);
        };
        FitOptions fit = test::random_fit(random);
        const Tree a(walk(0, -length * random.real(0, 1), length), fit),
            b(walk(hair, length * random.real(0, 1), -length), fit);
        const Placement place{.rotate_deg = random.chance(0.5) ? 0 : random.real(0, 360)};
        const PlacedTree placed_a(a, place), placed_b(b, place);
        const auto expected = direct_search(placed_a.placed_clip(), placed_b.placed_clip());
        ASSERT_EQ(query(placed_a, placed_b), expected) << round << ", " << name(fit.tree);
        false_hits += expected.has_value();
    }
    EXPECT_GT(false_hits, 20) << "else nothing was tried";
}

/// Steps so fine that what holds between them hardly matters see what runs, and nothing else.
TEST(Approach, OfWholeClipsFindsWhatFineStepsFind) {
    Random random(53);
    constexpr int kSteps = 64;
    const auto fine = [](const Clip& clip) {
        std::vector<Disk> out;
        const PlacedClip placed(clip, {});
        for (int i = 0; i < clip.steps(); ++i) {
            const SweptDisk runs = swept(placed, i);
            for (int k = 0; k < kSteps; ++k) out.push_back(runs.at(runs.begin + (runs.end - runs.begin) * k / kSteps));
        }
        return Clip(clip.dt() / kSteps, out);
    };
    // The farthest that anything goes in a step.
    const auto step = [](const Clip& clip) {
        double most = 0;
        for (std::size_t i = 0; i + 1 < clip.samples().size(); ++i) {
            most = std::max(most, std::sqrt(squared_distance(clip.samples()[i], clip.samples()[i + 1])) +
                                      std::abs(clip.samples()[i].r - clip.samples()[i + 1].r));
        }
        return most;
    };
    int hits = 0, missed_by_holding = 0;
    for (int round = 0; round < 1500; ++round) {
        const ClipPtr held_a = test::random_clip(random, 40), held_b = test::random_partner(random, *held_a, 40);
        const auto running = [](const Clip& clip, double wider) {
            std::vector<Disk> samples(clip.samples().begin(), clip.samples().end());
            for (Disk& d : samples) d.r += wider;
            return Clip(clip.dt(), std::move(samples), Motion::linear);
        };
        Placement place_a, place_b;
        test::random_placements(random, *held_a, *held_b, place_a, place_b);
        const Clip a = running(*held_a, 0), b = running(*held_b, 0);
        const Clip fine_a = fine(a), fine_b = fine(b);
        const double slop = (step(a) + step(b)) / kSteps + 1e-9;
        const bool found = direct_search(PlacedClip(a, place_a), PlacedClip(b, place_b)).has_value();
        const bool stepped = direct_search(PlacedClip(fine_a, place_a), PlacedClip(fine_b, place_b)).has_value();
        if (stepped) {
            const Clip wider = running(a, slop);
            ASSERT_TRUE(direct_search(PlacedClip(wider, place_a), PlacedClip(b, place_b))) << round;
        }
        if (found) {
            std::vector<Disk> samples(fine_a.samples().begin(), fine_a.samples().end());
            for (Disk& d : samples) d.r += slop;
            const Clip wider(fine_a.dt(), std::move(samples));
            ASSERT_TRUE(direct_search(PlacedClip(wider, place_a), PlacedClip(fine_b, place_b))) << round;
        }
        hits += found;
        missed_by_holding += found && !direct_search(PlacedClip(*held_a, place_a), PlacedClip(*held_b, place_b));
    }
    EXPECT_GT(hits, 300);
    EXPECT_GT(missed_by_holding, 10);
}

}  // namespace
}  // namespace mobb
