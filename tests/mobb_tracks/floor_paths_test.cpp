/// Paths on the floor against a look at all pairs of samples.
#include <gtest/gtest.h>
#include <mobb/predicate.h>
#include <mobb/query.h>
#include <mobb_tracks/floor_paths.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

#include "mobb/random_motion.h"

namespace mobb::test {
namespace {

TEST(FloorPaths, AreThoseOfAllPairs) {
    Random random(3);
    int meetings = 0;
    int apart = 0;
    for (int round = 0; round < 500; ++round) {
        const ClipPtr a = random_clip(random, 100);
        const ClipPtr b = random_partner(random, *a, 100);
        Placement place_a, place_b;
        place_a.start = random.real(-3, 3);
        place_b.translate = a->reach() > 1e3 || b->reach() > 1e3 ? glm::dvec2(a->samples()[0].x - b->samples()[0].x,
                                                                              a->samples()[0].y - b->samples()[0].y)
                                                                 : glm::dvec2(random.real(-4, 4), random.real(-4, 4));
        const PlacedClip pa(*a, place_a), pb(*b, place_b);
        double gap = std::numeric_limits<double>::infinity();
        double distance = std::numeric_limits<double>::infinity();
        for (int i = 0; i < pa.count(); ++i) {
            for (int j = 0; j < pb.count(); ++j) {
                const Disk da = pa.disk(i), db = pb.disk(j);
                distance = std::min(distance, std::hypot(da.x - db.x, da.y - db.y) - da.r - db.r);
                if (!collide(da, db)) continue;
                gap = std::min(gap, std::max(pb.time(j) - pa.time(i + 1), pa.time(i) - pb.time(j + 1)));
            }
        }
        const FloorPaths found = floor_paths(pa, pb);
        ASSERT_TRUE(found.known);
        ASSERT_EQ(found.meeting.has_value(), gap < std::numeric_limits<double>::infinity()) << round;
        if (found.meeting) {
            ++meetings;
            EXPECT_EQ(found.meeting->gap, gap) << round;
            EXPECT_TRUE(collide(pa.disk(found.meeting->a_sample), pb.disk(found.meeting->b_sample)));
            EXPECT_EQ(found.apart, 0);
        } else {
            ++apart;
            EXPECT_NEAR(found.apart, distance, 1e-9) << round;
        }
    }
    EXPECT_GT(meetings, 100);
    EXPECT_GT(apart, 50);
}

/// Of clips that run: nothing nearer is found at many times of every sample, and what is found is there.
TEST(FloorPaths, OfDisksThatRunAreThoseOfAllTimes) {
    Random random(5);
    int meetings = 0;
    int apart = 0;
    for (int round = 0; round < 500; ++round) {
        const auto clip = [&] {
            std::vector<Disk> disks;
            glm::dvec2 at(0);
            for (int i = random.integer(1, 6); i > 0; --i) {
                disks.push_back({at.x, at.y, random.real(0, 0.5)});
                at += glm::dvec2(random.real(-1, 1.5), random.real(-1, 1));
            }
            return Clip(random.real(0.2, 0.6), disks, random.integer(0, 3) > 0 ? Motion::linear : Motion::held);
        };
        const Clip a = clip(), b = clip();
        Placement place_b;
        place_b.translate = {random.real(-2, 2), random.real(-3, 3)};
        place_b.start = random.real(-3, 3);
        const PlacedClip pa(a, {}), pb(b, place_b);
        if ((!pa.is_linear() && !pb.is_linear()) || direct_search(pa, pb)) continue;
        const FloorPaths found = floor_paths(pa, pb);
        ASSERT_TRUE(found.known) << round;
        constexpr int kSteps = 24;
        double gap = std::numeric_limits<double>::infinity();
        double distance = std::numeric_limits<double>::infinity();
        for (int i = 0; i < a.steps() * kSteps; ++i) {
            const double ta = pa.time(0) + a.dt() * (i + 0.5) / kSteps;
            const Disk da = swept(pa, i / kSteps).at(ta);
            for (int j = 0; j < b.steps() * kSteps; ++j) {
                const double tb = pb.time(0) + b.dt() * (j + 0.5) / kSteps;
                const Disk db = swept(pb, j / kSteps).at(tb);
                const double clear = std::hypot(da.x - db.x, da.y - db.y) - da.r - db.r;
                distance = std::min(distance, clear);
                if (clear < 0) gap = std::min(gap, std::abs(ta - tb));
            }
        }
        if (!found.meeting) {
            ++apart;
            EXPECT_GE(distance, found.apart - 1e-9) << round;
            EXPECT_LE(distance, found.apart + 0.2) << round;
            continue;
        }
        ++meetings;
        const FloorMeeting& meeting = *found.meeting;
        EXPECT_GE(gap, meeting.gap - 1e-9) << round;
        // With that lag the two are in one place.
        const SweptDisk sa = swept(pa, meeting.a_sample), sb = swept(pb, meeting.b_sample);
        const auto least = [&](double gap_of) {
            const double lag = meeting.a_first ? gap_of : -gap_of;
            const Approach approach(sa, {sb.from, sb.to, sb.begin - lag, sb.end - lag});
            return approach.clearance(approach.nearest());
        };
        EXPECT_LT(least(meeting.gap), 1e-6) << round;
    }
    EXPECT_GT(meetings, 50);
    EXPECT_GT(apart, 20);
}

TEST(FloorPaths, SayThatTheyGaveUpRatherThanAnythingElse) {
    std::vector<Disk> jitter;
    Random random(4);
    for (int i = 0; i < 3000; ++i) jitter.push_back({random.real(0, 10), random.real(0, 10), 0});
    const Clip a(0.1, jitter);
    for (Disk& d : jitter) d.x += 0.001;
    const Clip b(0.1, jitter);
    const FloorPaths found = floor_paths(PlacedClip(a, {}), PlacedClip(b, {}), 10'000);
    EXPECT_FALSE(found.known);
    EXPECT_FALSE(found.meeting.has_value());
    // Whatever the last visit was for.
    const Clip here(0.1, {{0, 0, 0.1}, {1, 0, 0.1}}), there(0.1, {{5, 0, 0.1}, {6, 0, 0.1}});
    int known = 0;
    for (int visits = 0; visits < 20; ++visits) {
        const FloorPaths paths = floor_paths(PlacedClip(here, {}), PlacedClip(there, {}), visits);
        known += paths.known ? 1 : 0;
        EXPECT_EQ(paths.apart, paths.known ? 3.8 : 0) << visits;
    }
    EXPECT_GT(known, 0);
    EXPECT_LT(known, 20);
}

}  // namespace
}  // namespace mobb::test
