/// Clearance over time against a direct computation.
#include <explain/clearance.h>
#include <gtest/gtest.h>
#include <mobb/query.h>

#include <cmath>

#include "mobb/random_motion.h"

namespace mobbscope {
namespace {

using mobb::Clip;
using mobb::ClipPtr;
using mobb::PlacedClip;
using mobb::Placement;
using mobb::test::Random;

struct Pair {
    double t0, t1, clearance;
    int a_sample, b_sample;
};

/// By halving the time: the clearance is convex.
double least_clearance(const mobb::SweptDisk& a, const mobb::SweptDisk& b, double t0, double t1) {
    const auto at = [&](double t) {
        const mobb::Disk p = a.at(t), q = b.at(t);
        return std::hypot(p.x - q.x, p.y - q.y) - p.r - q.r;
    };
    for (int i = 0; i < 100; ++i) {
        const double first = t0 + (t1 - t0) / 3;
        const double second = t1 - (t1 - t0) / 3;
        (at(first) <= at(second) ? t1 : t0) = at(first) <= at(second) ? second : first;
    }
    return at(0.5 * (t0 + t1));
}

/// All pairs that share time, by looking at all pairs there are.
std::vector<Pair> by_all_pairs(const PlacedClip& a, const PlacedClip& b) {
    std::vector<Pair> out;
    for (int i = 0; i < a.count(); ++i) {
        for (int j = 0; j < b.count(); ++j) {
            if (!mobb::overlap_in_time(a.time(i), a.time(i + 1), b.time(j), b.time(j + 1))) continue;
            const double t0 = std::max(a.time(i), b.time(j));
            const double t1 = std::min(a.time(i + 1), b.time(j + 1));
            out.push_back({t0, t1, least_clearance(mobb::swept(a, i), mobb::swept(b, j), t0, t1), i, j});
        }
    }
    std::stable_sort(out.begin(), out.end(), [](const auto& p, const auto& q) { return p.t0 < q.t0; });
    return out;
}

TEST(Clearance, IsThatOfAllPairsThatShareTime) {
    Random random(1);
    int with_contact = 0;
    int without_time = 0;
    for (int round = 0; round < 400; ++round) {
        const ClipPtr a = mobb::test::random_motion(random, mobb::test::random_clip(random, 120));
        const ClipPtr b = mobb::test::random_motion(random, mobb::test::random_partner(random, *a, 120));
        Placement place_a, place_b;
        mobb::test::random_placements(random, *a, *b, place_a, place_b);
        const PlacedClip pa(*a, place_a), pb(*b, place_b);
        const Clearance found = clearance_over_time(pa, pb);
        const auto expected = by_all_pairs(pa, pb);
        ASSERT_EQ(found.pieces.size(), expected.size()) << round;
        double least = std::numeric_limits<double>::max();
        for (std::size_t k = 0; k < expected.size(); ++k) {
            EXPECT_EQ(found.pieces[k].a_sample, expected[k].a_sample);
            EXPECT_EQ(found.pieces[k].b_sample, expected[k].b_sample);
            EXPECT_EQ(found.pieces[k].t0, expected[k].t0);
            EXPECT_EQ(found.pieces[k].t1, expected[k].t1);
            EXPECT_NEAR(found.pieces[k].clearance, expected[k].clearance, 1e-7);
            EXPECT_NEAR(clearance_at(found.pieces[k], found.pieces[k].least_at), found.pieces[k].clearance, 1e-9);
            least = std::min(least, found.pieces[k].clearance);
        }
        EXPECT_EQ(found.least.has_value(), !expected.empty());
        if (found.least) {
            EXPECT_EQ(found.pieces[*found.least].clearance, least);
        }
        without_time += expected.empty();

        // Contact: where the query says, and nowhere else.
        const auto contact = mobb::direct_search(pa, pb);
        ASSERT_EQ(found.contact.has_value(), contact.has_value()) << round;
        for (const ClearancePiece& piece : found.pieces) {
            EXPECT_EQ(piece.clearance < 0, piece.approach.collides());
        }
        if (!contact) continue;
        ++with_contact;
        const ClearancePiece& first = found.pieces[*found.contact];
        EXPECT_EQ(found.contact_time, contact->time);
        EXPECT_EQ(first.a_sample, contact->a_sample);
        EXPECT_EQ(first.b_sample, contact->b_sample);
    }
    EXPECT_GT(with_contact, 50);
    EXPECT_GT(without_time, 5);
}

TEST(Clearance, HowDeepTwoOverlapIsThatOfWhereTheyAreDeepest) {
    // They pass 0.3 m apart; contact begins by touching.
    const Clip a(1, {{0, 0, 0.4}, {2, 0, 0.4}}, mobb::Motion::linear);
    const Clip b(1, {{2, 0.3, 0.4}, {0, 0.3, 0.4}}, mobb::Motion::linear);
    const PlacedClip pa(a, {}), pb(b, {});
    const auto contact = mobb::direct_search(pa, pb);
    ASSERT_TRUE(contact);
    EXPECT_NEAR(contact->distance, contact->radii, 1e-12);
    EXPECT_NEAR(most_overlap(pa, pb, contact->a_sample, contact->b_sample), 0.5, 1e-12);
    EXPECT_NEAR(measured_radii(pa, pb, 0, 0), 0.8, 1e-12);
}

TEST(Clearance, ColumnsLoseNoMinimum) {
    Random random(2);
    for (int round = 0; round < 200; ++round) {
        const ClipPtr a = mobb::test::random_motion(random, mobb::test::random_clip(random, 300));
        const ClipPtr b = mobb::test::random_motion(random, mobb::test::random_partner(random, *a, 300));
        Placement place_a, place_b;
        mobb::test::random_placements(random, *a, *b, place_a, place_b);
        const PlacedClip pa(*a, place_a), pb(*b, place_b);
        const Clearance found = clearance_over_time(pa, pb);
        if (found.pieces.empty()) continue;
        const double t0 = std::min(pa.time(0), pb.time(0));
        const double t1 = std::max(pa.time(pa.count()), pb.time(pb.count()));
        const int count = random.integer(1, 200);
        const auto columns = columns_of(found, t0, t1, count);
        ASSERT_EQ(columns.size(), static_cast<std::size_t>(count));
        double least = std::numeric_limits<double>::max();
        bool gap_seen = false;
        bool begun = false;
        for (const ValueColumn& column : columns) {
            if (!column.any) {
                gap_seen = gap_seen || begun;
                continue;
            }
            EXPECT_FALSE(gap_seen) << "the common time is one interval";
            begun = true;
            EXPECT_LE(column.least, column.most);
            least = std::min(least, column.least);
        }
        EXPECT_EQ(least, found.pieces[*found.least].clearance);
        // Every piece lies between the least and the most of the column that its middle is in.
        for (const ClearancePiece& piece : found.pieces) {
            const double middle = 0.5 * (piece.t0 + piece.t1);
            const auto k = static_cast<std::size_t>(std::clamp((middle - t0) / (t1 - t0) * count, 0.0, count - 1.0));
            EXPECT_LE(columns[k].least, clearance_at(piece, middle) + 1e-9);
            EXPECT_GE(columns[k].most, clearance_at(piece, middle) - 1e-9);
        }
    }
}

}  // namespace
}  // namespace mobbscope
