// Time to collision and post-encroachment time against a look at many moments, and chains of contact.
#include <mobb/body.h>
#include <mobb_tracks/conflict.h>
#include <mobb_tracks/crowds.h>
#include <mobb_tracks/encounter.h>

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace mobb::test {
namespace {

constexpr double kWithin = 2;

Clip walk_of(const std::vector<std::pair<double, double>>& points, Motion motion = Motion::linear) {
    std::vector<Disk> samples;
    for (const auto& [x, y] : points) samples.push_back({x, y, 0.25});
    return {0.5, std::move(samples), motion};
}

/// Two of a path each.
Encounter between(const PlacedClip& a, const PlacedClip& b) {
    const Conflict near = conflict_of(a, b, kWithin);
    return {{&a, 1}, {&b, 1}, kWithin, near.intervals.empty() ? 0 : near.intervals.front().t0, near.least_clearance};
}

/// How long until |d + s v| = r; infinity if never, or if it is over.
double time_until(glm::dvec2 d, glm::dvec2 v, double r) {
    constexpr double kNever = std::numeric_limits<double>::infinity();
    if (glm::length(d) < r) return 0;
    const double speed = glm::dot(v, v), along = glm::dot(d, v);
    const double inside = along * along - speed * (glm::dot(d, d) - r * r);
    return along >= 0 || inside <= 0 ? kNever : (-along - std::sqrt(inside)) / speed;
}

/// Over many moments at which the two are so near.
double looked_at(const PlacedClip& a, const PlacedClip& b) {
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i + 1 < a.count(); ++i) {
        for (int j = 0; j + 1 < b.count(); ++j) {
            const double from = std::max(a.time(i), b.time(j)), to = std::min(a.time(i + 1), b.time(j + 1));
            if (to - from < 1e-9) continue;
            const auto velocity = [](const PlacedClip& clip, int at) {
                const Disk p = clip.disk(at), q = clip.disk(at + 1);
                return glm::dvec2(q.x - p.x, q.y - p.y) / clip.dt();
            };
            constexpr int kMoments = 100;
            for (int k = 0; k <= kMoments; ++k) {
                const double t = from + (to - from) * k / kMoments;
                const Disk p = swept(a, i).at(t), q = swept(b, j).at(t);
                const glm::dvec2 d(p.x - q.x, p.y - q.y);
                if (glm::length(d) - p.r - q.r < kWithin)
                    least = std::min(least, time_until(d, velocity(a, i) - velocity(b, j), p.r + q.r));
            }
        }
    }
    return least;
}

TEST(Encounters, TimeToCollisionIsThatOfManyMoments) {
    Random random(3);
    int defined = 0, undefined = 0, zero = 0;
    for (int round = 0; round < 1200; ++round) {
        const auto points = [&] {
            std::vector<std::pair<double, double>> out{{random.real(-4, 4), random.real(-4, 4)}};
            for (int i = random.integer(1, 8); i > 0; --i)
                out.emplace_back(out.back().first + random.real(-1, 1), out.back().second + random.real(-1, 1));
            return out;
        };
        const Clip one = walk_of(points()), other = walk_of(points());
        const PlacedClip a(one, {{0, 0}, 0, random.real(0, 1)}), b(other, {{0, 0}, 30, random.real(0, 1)});
        if (conflict_of(a, b, kWithin).intervals.empty()) continue;
        const MaybeSeconds found = time_to_collision(between(a, b));
        const double expected = looked_at(a, b);
        if (found.undefined.empty()) {
            // Moments are up to 5 ms apart.
            EXPECT_NEAR(found.seconds, expected, 6e-3) << round;
            ++(found.seconds > 0 ? defined : zero);
        } else {
            EXPECT_TRUE(std::isnan(found.seconds));
            EXPECT_TRUE(std::isinf(expected)) << round;
            ++undefined;
        }
    }
    EXPECT_GT(defined, 30);
    EXPECT_GT(zero, 30);
    EXPECT_GT(undefined, 10);
}

TEST(Encounters, PostEncroachmentTimeIsHowMuchLaterTheOtherComes) {
    // Both come through (2, 0): one at 2 s from the left at 1 m/s, the other at 4 s from below. The first leaves where
    // it and the second fit at once when it is 0.5 m on.
    const Clip one = walk_of({{0, 0}, {0.5, 0}, {1, 0}, {1.5, 0}, {2, 0}, {2.5, 0}, {3, 0}, {3.5, 0}, {4, 0}});
    const Clip other = walk_of({{2, -2}, {2, -1.5}, {2, -1}, {2, -0.5}, {2, 0}, {2, 0.5}});
    const PlacedClip a(one, {}), b(other, {{0, 0}, 0, 2});
    ASSERT_FALSE(conflict_of(a, b, kWithin).intervals.empty());
    ASSERT_GT(between(a, b).least_clearance, 0);
    double least = std::numeric_limits<double>::infinity();
    for (double s = 0; s <= 4; s += 1e-3) {
        for (double t = 2; t <= 4.5; t += 1e-3) {
            const double x = s - 2, y = -2 + (t - 2);
            if (x * x + y * y < 0.5 * 0.5) least = std::min(least, std::abs(t - s));
        }
    }
    EXPECT_NEAR(post_encroachment_time(between(a, b)).seconds, least, 5e-3);

    const PlacedClip through(other, {{0, 0}, 0, 0});
    EXPECT_EQ(post_encroachment_time(between(a, through)).seconds, 0) << "they collide";
    const PlacedClip beside(one, {{0, 1}, 0, 0});
    const MaybeSeconds none = post_encroachment_time(between(a, beside));
    EXPECT_EQ(none.undefined, "their paths share no place");
    EXPECT_TRUE(std::isnan(none.seconds));
}

TEST(Encounters, OfWhoFollowsFarApartInSamplesTheTimeIsFound) {
    constexpr double kSpeed = 1.4, kBehind = 1, kFrame = 0.04;
    for (const double seconds : {60.0, 600.0}) {
        Random random(2);
        std::vector<Disk> walk, sway, stand;
        for (int i = 0; i * kFrame < seconds; ++i) {
            walk.push_back({kSpeed * kFrame * i, 0, 0.25});
            sway.push_back({random.real(-0.1, 0.1), random.real(-0.1, 0.1), 0.25});
            stand.push_back({0.62 + random.real(-0.1, 0.1), random.real(-0.1, 0.1), 0.25});
        }
        const Clip first(kFrame, walk, Motion::linear), one(kFrame, sway, Motion::linear),
            other(kFrame, stand, Motion::linear);
        const PlacedClip a(first, {}), b(first, {{0, 0}, 0, kBehind});
        EXPECT_NEAR(post_encroachment_time(between(a, b)).seconds, kBehind - 0.5 / kSpeed, 1e-6);
        // Two who stand together, and now and then lean to where the other has been.
        const PlacedClip p(one, {}), q(other, {});
        Encounter apart = between(p, q);
        apart.least_clearance = std::max(apart.least_clearance, 0.0);
        const MaybeSeconds found = post_encroachment_time(apart);
        EXPECT_EQ(found.undefined, "") << seconds;
        EXPECT_LT(found.seconds, 1);
    }
}

TEST(Encounters, PointsCollideWithNobody) {
    const Clip walk(0.5, std::vector<Disk>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, Motion::linear);
    const PlacedClip a(walk, {}), b(walk, {{1, 1}, -90, 0});
    EXPECT_EQ(post_encroachment_time(between(a, b)).undefined, "their disks have radius 0, and points do not collide");
    EXPECT_EQ(time_to_collision(between(a, b)).undefined, "their disks have radius 0, and points do not collide");
}

TEST(Encounters, SayWhyThereIsNoTimeToCollision) {
    const Clip walk = walk_of({{0, 0}, {1, 0}, {2, 0}}), held = walk_of({{0, 1}, {1, 1}, {2, 1}}, Motion::held);
    const PlacedClip a(walk, {}), stays(held, {}), beside(walk, {{0, 1}, 0, 0});
    EXPECT_EQ(time_to_collision(between(a, stays)).undefined, "a held path has no speed");
    EXPECT_EQ(time_to_collision(between(a, beside)).undefined, "they are on no course to collide");
}

/// The bodies of two people, as paths of their disks.
struct Paths {
    std::vector<Clip> clips;
    std::vector<PlacedClip> placed;
};

/// A row of disks that drives straight on or turns, sways or stands.
Paths body_on_its_way(Random& random, Motion motion) {
    std::vector<Disk> samples{{random.real(-14, 14), random.real(-14, 14), 0}};
    double heading = random.real(-180, 180);
    const double turn = random.chance(0.5) ? 0 : random.real(-20, 20),
                 step = random.chance(0.1) ? 0 : random.real(0.2, 2);
    for (int i = random.integer(3, 25); i > 0; --i) {
        heading += turn;
        const glm::dvec2 next = Rotation::from_degrees(heading)({step, random.real(-0.1, 0.1)});
        samples.push_back({samples.back().x + next.x, samples.back().y + next.y, 0});
    }
    const Clip centre(random.chance(0.5) ? 0.5 : random.real(0.2, 0.6), samples, motion);
    const std::vector<BodyDisk> body = rectangle_body(random.real(1, 6), random.real(0.5, 1.5));
    Paths out;
    for (const BodyDisk& disk : body) out.clips.push_back(member_of(centre, headings_of(centre, body), disk));
    const double start = random.real(0, 4);
    for (const Clip& clip : out.clips) out.placed.emplace_back(clip, Placement{{0, 0}, 0, start});
    return out;
}

TEST(Encounters, OfBodiesAreTheLeastOverAllPairsOfTheirDisks) {
    Random random(11);
    int courses = 0, gaps = 0, none = 0;
    for (int round = 0; round < 1500; ++round) {
        const Motion motion = random.chance(0.2) ? Motion::held : Motion::linear;
        const Paths one = body_on_its_way(random, motion), other = body_on_its_way(random, motion);
        Encounter whole{one.placed, other.placed, kWithin, 1e9, 1e9};
        double course = std::numeric_limits<double>::infinity(), gap = course;
        const auto lower = [](double& least, const MaybeSeconds& of) {
            if (of.undefined.empty()) least = std::min(least, of.seconds);
        };
        for (const PlacedClip& a : one.placed) {
            for (const PlacedClip& b : other.placed) {
                const Encounter members = between(a, b);
                lower(gap, post_encroachment_time(members));
                whole.least_clearance = std::min(whole.least_clearance, members.least_clearance);
                if (conflict_of(a, b, kWithin).intervals.empty()) continue;
                whole.from = std::min(whole.from, members.from);
                lower(course, time_to_collision(members));
            }
        }
        const MaybeSeconds found_gap = post_encroachment_time(whole);
        EXPECT_EQ(found_gap.undefined.empty(), std::isfinite(gap)) << round << ' ' << found_gap.undefined;
        if (std::isfinite(gap)) {
            EXPECT_NEAR(found_gap.seconds, gap, 1e-9) << round;
        }
        if (whole.from == 1e9) continue;
        const MaybeSeconds found_course = time_to_collision(whole);
        EXPECT_EQ(found_course.undefined.empty(), std::isfinite(course)) << round << ' ' << found_course.undefined;
        if (std::isfinite(course)) {
            EXPECT_NEAR(found_course.seconds, course, 1e-9) << round;
        }
        courses += std::isfinite(course) && course > 0;
        gaps += std::isfinite(gap) && gap > 0;
        none += std::isinf(gap);
    }
    EXPECT_GT(courses, 15);
    EXPECT_GT(gaps, 50);
    EXPECT_GT(none, 30);
}

TEST(Encounters, OfTheSameLastAtLeastSoLong) {
    Random random(8);
    const Crowd crowd = random_crowd(random, 40, 60, 4);
    const PeopleConflicts all = crowd.conflicts();
    ConflictSearch search;
    search.least_seconds = 0.5;
    std::vector<std::pair<int, int>> expected, found;
    for (const PeopleConflict& conflict : all_of(all)) {
        const auto lasts = [](const Interval& of) { return of.t1 - of.t0 >= 0.5; };
        if (std::ranges::any_of(conflict.intervals, lasts)) expected.emplace_back(conflict.a, conflict.b);
    }
    for (const PeopleConflict& conflict : all_of(crowd.conflicts(search))) found.emplace_back(conflict.a, conflict.b);
    EXPECT_EQ(found, expected);
    EXPECT_LT(found.size(), all.size());
    EXPECT_FALSE(found.empty());
}

TEST(ContactChains, AreWhoIsConnected) {
    const std::vector<std::pair<int, int>> contacts{{1, 2}, {7, 8}, {2, 5}, {0, 9}, {5, 1}, {8, 9}, {3, 4}};
    EXPECT_EQ(contact_chains(11, contacts), (std::vector<std::vector<int>>{{0, 7, 8, 9}, {1, 2, 5}, {3, 4}}));
    EXPECT_TRUE(contact_chains(0, {}).empty());
    EXPECT_TRUE(contact_chains(3, {}).empty());
}

}  // namespace
}  // namespace mobb::test
