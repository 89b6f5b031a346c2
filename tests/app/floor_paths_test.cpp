/// Paths on the floor against a look at all pairs of samples.
#include <explain/clearance.h>
#include <gtest/gtest.h>
#include <mobb/predicate.h>

#include <cmath>
#include <limits>

#include "mobb/random_motion.h"

namespace mobbscope::app {
namespace {

using mobb::ClipPtr;
using mobb::PlacedClip;
using mobb::Placement;
using mobb::test::Random;

TEST(FloorPaths, AreThoseOfAllPairs) {
    Random random(3);
    int meetings = 0;
    int apart = 0;
    for (int round = 0; round < 500; ++round) {
        const ClipPtr a = mobb::test::random_clip(random, 100);
        const ClipPtr b = mobb::test::random_partner(random, *a, 100);
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
                const mobb::Disk da = pa.disk(i), db = pb.disk(j);
                distance = std::min(distance, std::hypot(da.x - db.x, da.y - db.y) - da.r - db.r);
                if (!mobb::collide(da, db)) continue;
                gap = std::min(gap, std::max(pb.time(j) - pa.time(i + 1), pa.time(i) - pb.time(j + 1)));
            }
        }
        const FloorPaths found = floor_paths(pa, pb);
        ASSERT_TRUE(found.known);
        ASSERT_EQ(found.meeting.has_value(), gap < std::numeric_limits<double>::infinity()) << round;
        if (found.meeting) {
            ++meetings;
            EXPECT_EQ(found.meeting->gap, gap) << round;
            EXPECT_TRUE(mobb::collide(pa.disk(found.meeting->a_sample), pb.disk(found.meeting->b_sample)));
            EXPECT_EQ(found.apart, 0);
        } else {
            ++apart;
            EXPECT_NEAR(found.apart, distance, 1e-9) << round;
        }
    }
    EXPECT_GT(meetings, 100);
    EXPECT_GT(apart, 50);
}

TEST(FloorPaths, SayThatTheyGaveUpRatherThanAnythingElse) {
    std::vector<mobb::Disk> jitter;
    Random random(4);
    for (int i = 0; i < 3000; ++i) jitter.push_back({random.real(0, 10), random.real(0, 10), 0});
    const mobb::Clip a(0.1, jitter);
    for (mobb::Disk& d : jitter) d.x += 0.001;
    const mobb::Clip b(0.1, jitter);
    const FloorPaths found = floor_paths(PlacedClip(a, {}), PlacedClip(b, {}), 10'000);
    EXPECT_FALSE(found.known);
    EXPECT_FALSE(found.meeting.has_value());
}

}  // namespace
}  // namespace mobbscope::app
