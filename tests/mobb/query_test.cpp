#include <gtest/gtest.h>
#include <mobb/query.h>
#include <mobb/random_motion.h>

#include <cstdlib>

namespace mobb {
namespace {

using test::Random;

/// How many random queries the suite asks; MOBBSCOPE_QUERIES gives longer or shorter runs.
int query_budget() {
    const char* text = std::getenv("MOBBSCOPE_QUERIES");
    return text ? std::atoi(text) : 1'000'000;
}

/// Eq. 1 as it stands: every pair of samples, no order and no search.
std::optional<Contact> all_pairs(const PlacedClip& a, const PlacedClip& b) {
    std::optional<Contact> earliest;
    for (int i = 0; i < a.count(); ++i) {
        for (int j = 0; j < b.count(); ++j) {
            const double overlap = std::min(a.time(i + 1), b.time(j + 1)) - std::max(a.time(i), b.time(j));
            if (!(overlap > 1e-9)) continue;
            const double dx = a.disk(i).x - b.disk(j).x, dy = a.disk(i).y - b.disk(j).y;
            const double reach = a.disk(i).r + b.disk(j).r;
            if (!(dx * dx + dy * dy < reach * reach)) continue;
            const double time = std::max(a.time(i), b.time(j));
            if (!earliest || time < earliest->time) {
                earliest = Contact{time, i, j, std::sqrt(dx * dx + dy * dy), reach};
            }
        }
    }
    return earliest;
}

TEST(DirectSearch, EqualsAllPairs) {
    Random random(10);
    int hits = 0;
    for (int round = 0; round < 4000; ++round) {
        const ClipPtr a = test::random_clip(random, 60), b = test::random_clip(random, 60);
        Placement place_a, place_b;
        test::random_placements(random, *a, *b, place_a, place_b);
        const PlacedClip placed_a(*a, place_a), placed_b(*b, place_b);
        const std::optional<Contact> expected = all_pairs(placed_a, placed_b);
        ASSERT_EQ(direct_search(placed_a, placed_b), expected) << round;
        hits += expected.has_value();
    }
    EXPECT_GT(hits, 800);
    EXPECT_LT(hits, 3200);
}

TEST(Query, EveryTreeGivesTheDirectSearchsAnswerAndContact) {
    const int budget = query_budget();
    Random random(11);
    int asked = 0, hits = 0;
    while (asked < budget) {
        const ClipPtr a = test::random_clip(random), b = test::random_clip(random);
        const FitOptions fit_a = test::random_fit(random), fit_b = test::random_fit(random);
        const Tree tree_a(a, fit_a), tree_b(b, fit_b);
        for (int k = 0; k < 250; ++k, ++asked) {
            Placement place_a, place_b;
            test::random_placements(random, *a, *b, place_a, place_b);
            const PlacedTree placed_a(tree_a, place_a), placed_b(tree_b, place_b);
            const std::optional<Contact> expected = direct_search(placed_a.placed_clip(), placed_b.placed_clip());
            const std::optional<Contact> found = query(placed_a, placed_b);
            ASSERT_EQ(found, expected) << "query " << asked << ", " << name(fit_a.tree) << " leaf " << fit_a.leaf
                                       << " levels " << fit_a.levels << " axes " << name(fit_a.axes);
            hits += expected.has_value();
        }
    }
    EXPECT_GT(hits, asked / 10);
    EXPECT_LT(hits, asked * 9 / 10);
}

TEST(Query, EveryLeafSizeFrom1To50) {
    Random random(12);
    for (int leaf = 1; leaf <= 50; ++leaf) {
        for (int kind = 0; kind < 4; ++kind) {
            const ClipPtr a = test::random_clip(random, 300), b = test::random_clip(random, 300);
            const FitOptions fit{.tree = static_cast<TreeKind>(kind), .leaf = leaf};
            const Tree tree_a(a, fit), tree_b(b, fit);
            for (int k = 0; k < 50; ++k) {
                Placement place_a, place_b;
                test::random_placements(random, *a, *b, place_a, place_b);
                const PlacedTree placed_a(tree_a, place_a), placed_b(tree_b, place_b);
                ASSERT_EQ(query(placed_a, placed_b), direct_search(placed_a.placed_clip(), placed_b.placed_clip()));
            }
        }
    }
}

TEST(Query, DoesNotDependOnWhoIsAsked) {
    Random random(13);
    for (int round = 0; round < 500; ++round) {
        const ClipPtr a = test::random_clip(random, 200), b = test::random_clip(random, 200);
        const FitOptions fit = test::random_fit(random);
        const Tree tree_a(a, fit), tree_b(b, fit);
        for (int k = 0; k < 40; ++k) {
            Placement place_a, place_b;
            test::random_placements(random, *a, *b, place_a, place_b);
            const PlacedTree placed_a(tree_a, place_a), placed_b(tree_b, place_b);
            const std::optional<Contact> forward = query(placed_a, placed_b);
            std::optional<Contact> backward = query(placed_b, placed_a);
            if (backward) std::swap(backward->a_sample, backward->b_sample);
            ASSERT_EQ(forward, backward) << round;
        }
    }
}

/// The least |distance - radii| and the least overlap in time over all pairs that share time.
struct Margins {
    double clearance = 1e300;
    double overlap = 1e300;
};
Margins margins(const PlacedClip& a, const PlacedClip& b) {
    Margins m;
    for (int i = 0; i < a.count(); ++i) {
        for (int j = 0; j < b.count(); ++j) {
            const double overlap = std::min(a.time(i + 1), b.time(j + 1)) - std::max(a.time(i), b.time(j));
            if (overlap <= -1e-6) continue;
            m.overlap = std::min(m.overlap, std::abs(overlap));
            const double distance = std::sqrt(squared_distance(a.disk(i), b.disk(j)));
            m.clearance = std::min(m.clearance, std::abs(distance - (a.disk(i).r + b.disk(j).r)));
        }
    }
    return m;
}

TEST(Query, MovingTheSceneFarAwayChangesNoClearAnswer) {
    Random random(14);
    int clear = 0, hits = 0;
    for (int round = 0; round < 6000; ++round) {
        const ClipPtr a = test::random_clip(random, 80), b = test::random_clip(random, 80);
        const FitOptions fit = test::random_fit(random);
        const Tree tree_a(a, fit), tree_b(b, fit);
        Placement place_a, place_b;
        test::random_placements(random, *a, *b, place_a, place_b);
        const std::optional<Contact> here = query(PlacedTree(tree_a, place_a), PlacedTree(tree_b, place_b));
        const Margins m = margins({*a, place_a}, {*b, place_b});
        const bool is_clear = m.clearance > 1e-6 && m.overlap > 1e-6;
        for (Placement* place : {&place_a, &place_b}) {
            place->translate += glm::dvec2{1e4, -1e4};
            place->start += 1e5;
        }
        const PlacedTree far_a(tree_a, place_a), far_b(tree_b, place_b);
        const std::optional<Contact> there = query(far_a, far_b);
        ASSERT_EQ(there, direct_search(far_a.placed_clip(), far_b.placed_clip())) << round;
        if (!is_clear) continue;
        ++clear;
        hits += here.has_value();
        ASSERT_EQ(here.has_value(), there.has_value()) << round;
        if (here) {
            EXPECT_EQ(here->a_sample, there->a_sample);
            EXPECT_EQ(here->b_sample, there->b_sample);
        }
    }
    EXPECT_GT(clear, 500);
    EXPECT_GT(hits, 50);
}

TEST(Query, MixedTimeScalesStillGiveTheAnswer) {
    Random random(15);
    for (int round = 0; round < 3000; ++round) {
        const ClipPtr a = test::random_clip(random, 200), b = test::random_clip(random, 200);
        FitOptions fit_a = test::random_fit(random), fit_b = test::random_fit(random);
        fit_a.time_scale = random.real(0.01, 50);
        fit_b.time_scale = random.chance(0.5) ? fit_a.time_scale : random.real(0.01, 50);
        const Tree tree_a(a, fit_a), tree_b(b, fit_b);
        Placement place_a, place_b;
        test::random_placements(random, *a, *b, place_a, place_b);
        const PlacedTree placed_a(tree_a, place_a), placed_b(tree_b, place_b);
        ASSERT_EQ(query(placed_a, placed_b), direct_search(placed_a.placed_clip(), placed_b.placed_clip())) << round;
    }
}

TEST(Query, WalksSideBySideThatOverlapByAHairAreHits) {
    // The free boxes' sides lie flush against each other: only the slack keeps them from counting as separated.
    Random random(17);
    int hits = 0;
    for (int round = 0; round < 20000; ++round) {
        const double speed = random.real(0.3, 3), r = random.real(0.1, 0.6), heading = random.real(0, 360);
        std::vector<Disk> path;
        for (int i = 0; i < 24; ++i) path.push_back({speed * i / 30, 0, r});
        const auto clip = std::make_shared<const Clip>(1.0 / 30, path);
        FitOptions fit = test::random_fit(random);
        fit.tree = random.chance(0.7) ? TreeKind::umobb : TreeKind::hybrid1;
        const Tree tree(clip, fit);
        const Rotation turn = Rotation::from_degrees(heading);
        const double apart = 2 * r * (1 - random.integer(0, 4) * 1e-16);
        const bool far_away = random.chance(0.3);
        const glm::dvec2 origin = far_away ? glm::dvec2{1e4, 1e4} : glm::dvec2{0, 0};
        const double start = far_away ? 1e5 : 0;
        const PlacedTree a(tree, {.translate = origin, .rotate_deg = heading, .start = start});
        const PlacedTree b(tree, {.translate = origin + turn({0, apart}), .rotate_deg = heading, .start = start});
        const std::optional<Contact> expected = direct_search(a.placed_clip(), b.placed_clip());
        ASSERT_EQ(query(a, b), expected) << round;
        hits += expected.has_value();
    }
    EXPECT_GT(hits, 2000);
}

/// Maximal runs of colliding pairs, from all pairs.
std::vector<Interval> all_intervals(const PlacedClip& a, const PlacedClip& b) {
    std::vector<Interval> raw;
    for (int i = 0; i < a.count(); ++i) {
        for (int j = 0; j < b.count(); ++j) {
            const double t0 = std::max(a.time(i), b.time(j)), t1 = std::min(a.time(i + 1), b.time(j + 1));
            if (t1 - t0 > 1e-9 && collide(a.disk(i), b.disk(j))) raw.push_back({t0, t1});
        }
    }
    std::sort(raw.begin(), raw.end(), [](const Interval& x, const Interval& y) { return x.t0 < y.t0; });
    std::vector<Interval> merged;
    for (const Interval& r : raw) {
        if (!merged.empty() && r.t0 <= merged.back().t1 + 1e-9) {
            merged.back().t1 = r.t1;
        } else {
            merged.push_back(r);
        }
    }
    return merged;
}

TEST(Contacts, AllIntervalsAreFoundAndMaximal) {
    Random random(16);
    int several = 0;
    for (int round = 0; round < 4000; ++round) {
        const ClipPtr a = test::random_clip(random, 80), b = test::random_clip(random, 80);
        const FitOptions fit = test::random_fit(random);
        const Tree tree_a(a, fit), tree_b(b, fit);
        Placement place_a, place_b;
        test::random_placements(random, *a, *b, place_a, place_b);
        const PlacedTree placed_a(tree_a, place_a), placed_b(tree_b, place_b);
        const std::vector<Interval> expected = all_intervals(placed_a.placed_clip(), placed_b.placed_clip());
        ASSERT_EQ(contact_intervals(placed_a, placed_b), expected) << round;
        ASSERT_EQ(direct_contact_intervals(placed_a.placed_clip(), placed_b.placed_clip()), expected) << round;
        const std::optional<Contact> contact = query(placed_a, placed_b);
        ASSERT_EQ(contact.has_value(), !expected.empty());
        if (contact) {
            EXPECT_EQ(contact->time, expected[0].t0);
        }
        several += expected.size() > 1;
    }
    EXPECT_GT(several, 50);
}

TEST(Query, OneLevelTreeMeasuresTheCommonTimeOnly) {
    // The paper's "1 level": root boxes, then a binary search for the first pair and a walk through the overlap.
    const auto still = std::make_shared<const Clip>(0.01, std::vector<Disk>(1000, Disk{0, 0, 0.5}));
    std::vector<Disk> approach;
    for (int i = 0; i < 1000; ++i) approach.push_back({4 - 0.004 * i, 0, 0.5});
    const auto walker = std::make_shared<const Clip>(0.01, approach);
    const Tree tree_a(still, {.levels = 1}), tree_b(walker, {.levels = 1});
    Statistics statistics;
    // They share 10.5 frames, half a frame out of step: each sample has two partners but for the outermost.
    EXPECT_FALSE(query(PlacedTree(tree_a, {}), PlacedTree(tree_b, {.start = 9.895}), statistics));
    EXPECT_EQ(statistics.tests, (TestCounts{.time = 1, .obb2d = 1, .obb3d = 0, .samples = 21}));
}

}  // namespace
}  // namespace mobb
