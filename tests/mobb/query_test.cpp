#include <gtest/gtest.h>
#include <mobb/blocks.h>
#include <mobb/query.h>
#include <mobb/random_motion.h>
#include <mobb/trace.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

namespace mobb {
namespace {

using test::query_budget;
using test::Random;

/// Every pair (i, j) with the overlap of its hold intervals in seconds (negative: apart): no order and no search.
template <class Visit>
void for_all_pairs(const PlacedClip& a, const PlacedClip& b, Visit visit) {
    for (int i = 0; i < a.count(); ++i) {
        for (int j = 0; j < b.count(); ++j) {
            visit(i, j, std::min(a.time(i + 1), b.time(j + 1)) - std::max(a.time(i), b.time(j)));
        }
    }
}

/// Eq. 1 as it stands, of held clips.
std::optional<Contact> earliest_of_held_pairs(const PlacedClip& a, const PlacedClip& b) {
    std::optional<Contact> earliest;
    for_all_pairs(a, b, [&](int i, int j, double overlap) {
        if (!(overlap > 1e-9)) return;
        const double dx = a.disk(i).x - b.disk(j).x, dy = a.disk(i).y - b.disk(j).y;
        const double reach = a.disk(i).r + b.disk(j).r;
        if (!(dx * dx + dy * dy < reach * reach)) return;
        const double time = std::max(a.time(i), b.time(j));
        if (!earliest || time < earliest->time) earliest = Contact{time, i, j, std::sqrt(dx * dx + dy * dy), reach};
    });
    return earliest;
}

/// Of the pairs whose disks collide as they run, the one that begins first.
std::optional<Contact> earliest_of_swept_pairs(const PlacedClip& a, const PlacedClip& b) {
    std::optional<Contact> earliest;
    double begin = 0;
    for_all_pairs(a, b, [&](int i, int j, double overlap) {
        if (!(overlap > 1e-9) || !approach_of(a, i, b, j).collides()) return;
        const double time = std::max(a.time(i), b.time(j));
        if (earliest && time >= begin) return;
        earliest = contact_of(a, i, b, j);
        begin = time;
    });
    return earliest;
}

TEST(DirectSearch, EqualsAllPairs) {
    Random random(10);
    int hits = 0;
    for (int round = 0; round < 4000; ++round) {
        const ClipPtr a = test::random_clip(random, 60), b = test::random_partner(random, *a, 60);
        Placement place_a, place_b;
        test::random_placements(random, *a, *b, place_a, place_b);
        const PlacedClip placed_a(*a, place_a), placed_b(*b, place_b);
        const std::optional<Contact> expected = earliest_of_held_pairs(placed_a, placed_b);
        ASSERT_EQ(direct_search(placed_a, placed_b), expected) << round;
        ASSERT_EQ(earliest_of_swept_pairs(placed_a, placed_b), expected) << round;
        hits += expected.has_value();
    }
    EXPECT_GT(hits, 800);
    EXPECT_LT(hits, 3200);
}

TEST(DirectSearch, EqualsAllPairsOfDisksThatRun) {
    Random random(40);
    int hits = 0;
    for (int round = 0; round < 4000; ++round) {
        const ClipPtr a = test::random_motion(random, test::random_clip(random, 60));
        const ClipPtr b = test::random_motion(random, test::random_partner(random, *a, 60));
        Placement place_a, place_b;
        test::random_placements(random, *a, *b, place_a, place_b);
        const PlacedClip placed_a(*a, place_a), placed_b(*b, place_b);
        const std::optional<Contact> expected = earliest_of_swept_pairs(placed_a, placed_b);
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
        const ClipPtr a = test::random_motion(random, test::random_clip(random));
        const ClipPtr b = test::random_motion(random, test::random_partner(random, *a));
        const FitOptions fit_a = test::random_any_fit(random);
        FitOptions fit_b = test::random_partner_fit(random, fit_a);
        // Trees of different scales do not compare free boxes: mostly the same, so that they do.
        if (random.chance(0.9)) fit_b.time_scale = fit_a.time_scale;
        const Tree tree_a(a, fit_a), tree_b(b, fit_b);
        for (int k = 0; k < 100; ++k, ++asked) {
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

TEST(Query, ANodeThatIsOtherChangesNoAnswer) {
    const int budget = query_budget() / 10;
    Random random(15);
    int asked = 0, hits = 0;
    while (asked < budget) {
        const ClipPtr a = test::random_motion(random, test::random_clip(random));
        const ClipPtr b = test::random_motion(random, test::random_partner(random, *a));
        const FitOptions fit_a = test::random_fit(random);
        FitOptions fit_b = test::random_partner_fit(random, fit_a);
        fit_b.time_scale = fit_a.time_scale;
        const NodeChange change = test::random_change(random, Tree(a, fit_a));
        const Tree tree_a(a, fit_a, change), tree_b(b, fit_b);
        for (int k = 0; k < 50; ++k, ++asked) {
            Placement place_a, place_b;
            test::random_placements(random, *a, *b, place_a, place_b);
            const PlacedTree placed_a(tree_a, place_a), placed_b(tree_b, place_b);
            const std::optional<Contact> expected = direct_search(placed_a.placed_clip(), placed_b.placed_clip());
            ASSERT_EQ(query(placed_a, placed_b), expected) << asked << ", node " << change.node;
            ASSERT_EQ(contact_intervals(placed_a, placed_b),
                      direct_contact_intervals(placed_a.placed_clip(), placed_b.placed_clip()));
            // A clip against itself meets the change with the change.
            const PlacedTree other(tree_a, place_b);
            ASSERT_EQ(query(placed_a, other), direct_search(placed_a.placed_clip(), other.placed_clip())) << asked;
            hits += expected.has_value();
        }
    }
    EXPECT_GT(hits, asked / 10);
    EXPECT_LT(hits, asked * 9 / 10);
}

TEST(Query, EveryLeafSizeFrom1To50) {
    Random random(12);
    for (int leaf = 1; leaf <= 50; ++leaf) {
        for (const TreeKind kind : kTreeKinds) {
            const ClipPtr a = test::random_motion(random, test::random_clip(random, 300));
            const ClipPtr b = test::random_motion(random, test::random_partner(random, *a, 300));
            const FitOptions fit{.tree = kind, .leaf = leaf};
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
        const ClipPtr a = test::random_motion(random, test::random_clip(random, 200));
        const ClipPtr b = test::random_motion(random, test::random_partner(random, *a, 200));
        const FitOptions fit_a = test::random_fit(random);
        const Tree tree_a(a, fit_a), tree_b(b, test::random_partner_fit(random, fit_a));
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
    for_all_pairs(a, b, [&](int i, int j, double overlap) {
        if (overlap <= -1e-6) return;
        m.overlap = std::min(m.overlap, std::abs(overlap));
        const double distance = std::sqrt(squared_distance(a.disk(i), b.disk(j)));
        m.clearance = std::min(m.clearance, std::abs(distance - (a.disk(i).r + b.disk(j).r)));
    });
    return m;
}

TEST(Query, MovingTheSceneFarAwayChangesNoClearAnswer) {
    Random random(14);
    int clear = 0, hits = 0;
    for (int round = 0; round < 6000; ++round) {
        const ClipPtr a = test::random_clip(random, 80), b = test::random_partner(random, *a, 80);
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
        const ClipPtr a = test::random_motion(random, test::random_clip(random, 200));
        const ClipPtr b = test::random_motion(random, test::random_partner(random, *a, 200));
        FitOptions fit_a = test::random_fit(random), fit_b = test::random_partner_fit(random, fit_a);
        fit_a.time_scale = random.real(0.01, 50);
        fit_b.time_scale = random.chance(0.5) ? fit_a.time_scale : random.real(0.01, 50);
        const Tree tree_a(a, fit_a), tree_b(b, fit_b);
        Placement place_a, place_b;
        test::random_placements(random, *a, *b, place_a, place_b);
        const PlacedTree placed_a(tree_a, place_a), placed_b(tree_b, place_b);
        ASSERT_EQ(query(placed_a, placed_b), direct_search(placed_a.placed_clip(), placed_b.placed_clip())) << round;
    }
}

/// Of boxes that follow a walk in space-time.
constexpr TreeKind kFlushKinds[] = {TreeKind::umobb, TreeKind::umobb, TreeKind::hybrid1, TreeKind::moving};

TEST(Query, WalksSideBySideThatOverlapByAHairAreHits) {
    // The boxes' sides lie flush against each other: only the slack keeps them from counting as separated.
    Random random(17);
    int hits = 0;
    for (int round = 0; round < 20000; ++round) {
        const double speed = random.real(0.3, 3), r = random.real(0.1, 0.6), heading = random.real(0, 360);
        std::vector<Disk> path;
        for (int i = 0; i < 24; ++i) path.push_back({speed * i / 30, 0, r});
        const auto clip = std::make_shared<const Clip>(1.0 / 30, path);
        FitOptions fit = test::random_fit(random);
        fit.tree = kFlushKinds[random.integer(0, 3)];
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

TEST(Query, BoxesApartByMoreThanTheSlackAreSeparated) {
    // Side by side along x. A larger slack changes no answer, so nothing else would see it.
    constexpr double kEpsilon = std::numeric_limits<double>::epsilon(), kRadius = 0.3, kSpeed = 1, kDt = 1.0 / 30;
    constexpr int kCount = 24;
    std::vector<Disk> path;
    for (int i = 0; i < kCount; ++i) path.push_back({kSpeed * kDt * i, 0, kRadius});
    // As RelativeFrame makes it.
    const double reach = path.back().x + kRadius, lengths = 2 * kRadius + 2 * reach, seconds = 2 * kCount * kDt;
    const double in_time = 256 * kEpsilon * seconds;
    for (const Motion motion : {Motion::held, Motion::linear}) {
        const auto clip = std::make_shared<const Clip>(kDt, path, motion);
        const double on_floor = 256 * kEpsilon * lengths + (motion == Motion::linear ? 1e-7 * lengths : 0);
        for (const auto& [kind, slack] : {std::pair(TreeKind::mobb, on_floor),
                                          {TreeKind::umobb, on_floor + in_time},
                                          {TreeKind::moving, 4 * on_floor + 2 * kSpeed * in_time},
                                          {TreeKind::aabb, on_floor}}) {
            const Tree tree(clip, {.tree = kind});
            TraceRecorder recorder;
            const PlacedTree a(tree, {}), b(tree, {.translate = {0, 2 * kRadius + 1.25 * slack}});
            EXPECT_FALSE(query(a, b, recorder));
            const Trace trace = recorder.take();
            ASSERT_EQ(trace.size(), 2) << name(kind) << ", linear " << (motion == Motion::linear);
            EXPECT_EQ(trace[1].outcome, Outcome::separated);
        }
    }
    // Bounds in single precision.
    const Clip one(1, std::vector<Disk>{{0, 0, kRadius}});
    const Blocks blocks(std::make_shared<const Clip>(one));
    const auto meet = [&](double apart) {
        return RootsApart(PlacedBlocks(blocks, {}), PlacedBlocks(blocks, {.translate = {apart, 0}})).meet;
    };
    EXPECT_TRUE(meet(2 * kRadius));
    EXPECT_FALSE(meet(2 * kRadius + 1e-5));
    EXPECT_LT(blocks.slack(), 1.5e-5F);
}

TEST(Query, ExtremeNumbersChangeNoAnswer) {
    // Starts, spacings, scales and sizes at the ends of what is taken: there every bit of the slack is needed.
    Random random(18);
    int hits = 0;
    const int rounds = std::min(query_budget(), 60'000) / 10;
    for (int round = 0; round < rounds; ++round) {
        const double size = std::pow(10, random.real(-6, 6));
        const double dt = std::pow(10, random.real(-4, 5));
        const double start = random.chance(0.5) ? std::pow(10, random.real(0, 10)) : 0;
        const double w = std::pow(10, random.real(-6, 6));
        std::vector<Disk> path;
        const int n = random.integer(2, 40);
        for (int i = 0; i < n; ++i) path.push_back({size * i, size * random.real(0, 0.1), size});
        const auto clip = std::make_shared<const Clip>(dt, path);
        const FitOptions fit{.tree = kFlushKinds[random.integer(0, 3)],
                             .leaf = random.integer(1, 5),
                             .axes = static_cast<Axes>(random.integer(0, 2)),
                             .time_scale = w};
        const Tree tree(clip, fit);
        for (int k = 0; k < 10; ++k) {
            Placement place_a{.translate = {0, 0}, .rotate_deg = random.real(0, 360), .start = start};
            Placement place_b = place_a;
            // Ahead in time by all but a hair of what they share, or beside each other by all but a hair.
            if (random.chance(0.5)) {
                place_b.start += dt * (n - 1) * (1 - random.integer(0, 3) * 1e-16);
                if (random.chance(0.5)) place_b.start = place_a.start + dt * n - std::max(2e-9, dt * 1e-12);
                place_b.translate = Rotation::from_degrees(place_a.rotate_deg)({size * (n - 1), 0});
            } else {
                place_b.translate =
                    Rotation::from_degrees(place_a.rotate_deg)({0, 2 * size * (1 - random.integer(0, 3) * 1e-16)});
            }
            const PlacedTree a(tree, place_a), b(tree, place_b);
            const std::optional<Contact> expected = direct_search(a.placed_clip(), b.placed_clip());
            ASSERT_EQ(query(a, b), expected)
                << round << " size " << size << " dt " << dt << " start " << start << " w " << w;
            ASSERT_EQ(query(b, a).has_value(), expected.has_value());
            hits += expected.has_value();
        }
    }
    EXPECT_GT(hits, rounds);
}

TEST(Query, LongClipsRoundTimesAndTheSlackKnows) {
    // Clips of years against disks of centimetres: w*t is so large that its roundings exceed every length. The one pair
    // that shares time, by the least a double can tell, is the only one that collides.
    Random random(21);
    int hits = 0;
    for (int round = 0; round < 10000; ++round) {
        const double dt = std::pow(10, random.real(3, 8));
        const int last_a = random.integer(0, 15), first_b = random.integer(0, 15);
        std::vector<Disk> path_a, path_b;
        for (int i = 0; i < 16; ++i) {
            path_a.push_back({0.1 * i, 0, i == last_a ? 0.02 : 0});
            path_b.push_back({0.1 * i, 0, i == first_b ? 0.02 : 0});
        }
        const FitOptions fit{.tree = random.chance(0.5) ? TreeKind::umobb : TreeKind::moving,
                             .leaf = random.integer(1, 4),
                             .axes = static_cast<Axes>(random.integer(0, 2)),
                             .time_scale = std::pow(10, random.real(-1, 6))};
        const Tree tree_a(std::make_shared<const Clip>(dt, path_a), fit);
        const Tree tree_b(std::make_shared<const Clip>(dt, path_b), fit);
        const PlacedTree a(tree_a, {.start = random.real(0, 1) * dt});
        const double meet = a.placed_clip().time(last_a + 1) - first_b * dt;
        const PlacedTree b(tree_b, {.translate = {0.1 * (last_a - first_b), 0},
                                    .start = std::nextafter(meet, -1e300) - random.integer(0, 3) * 1e-9});
        const std::optional<Contact> expected = direct_search(a.placed_clip(), b.placed_clip());
        ASSERT_EQ(query(a, b), expected) << round;
        hits += expected.has_value();
    }
    EXPECT_GT(hits, 2500);
}

TEST(Query, DisksSoSmallThatTheirSquaresVanish) {
    // The predicate squares the distance to 0 here; the boxes, which square nothing, must not know better.
    for (const double scale : {1e-162, 3e-162, 1e-160, 1e-155, 1e-150}) {
        const auto clip = std::make_shared<const Clip>(1, std::vector<Disk>{{0, 0, 0.8 * scale}});
        for (const TreeKind kind : test::kFittedTrees) {
            const Tree tree(clip, {.tree = kind});
            const PlacedTree a(tree, {.rotate_deg = 45});
            const PlacedTree b(tree, {.translate = {1.5 * scale, 1.5 * scale}, .rotate_deg = 45});
            const std::optional<Contact> expected = direct_search(a.placed_clip(), b.placed_clip());
            EXPECT_EQ(query(a, b), expected) << scale;
            EXPECT_EQ(expected.has_value(), scale == 1e-162) << scale;
        }
    }
}

TEST(Query, ThreadsShareTrees) {
    Random random(19);
    const ClipPtr a = test::random_clip(random, 400), b = test::random_clip(random, 400);
    const Tree tree_a(a, {}), tree_b(b, {.tree = TreeKind::umobb});
    std::vector<std::pair<Placement, Placement>> places(2000);
    std::vector<std::optional<Contact>> expected;
    for (auto& [place_a, place_b] : places) {
        test::random_placements(random, *a, *b, place_a, place_b);
        expected.push_back(direct_search(PlacedClip(*a, place_a), PlacedClip(*b, place_b)));
    }
    std::vector<int> wrong(8, 0);
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < wrong.size(); ++t) {
        threads.emplace_back([&, t] {
            for (std::size_t k = 0; k < places.size(); ++k) {
                wrong[t] +=
                    query(PlacedTree(tree_a, places[k].first), PlacedTree(tree_b, places[k].second)) != expected[k];
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(wrong, std::vector<int>(8, 0));
}

/// Maximal runs of colliding pairs, from all pairs.
std::vector<Interval> all_intervals(const PlacedClip& a, const PlacedClip& b) {
    std::vector<Interval> raw;
    for_all_pairs(a, b, [&](int i, int j, double overlap) {
        if (!(overlap > 1e-9) || !collide(a.disk(i), b.disk(j))) return;
        raw.push_back({std::max(a.time(i), b.time(j)), std::min(a.time(i + 1), b.time(j + 1))});
    });
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
        const ClipPtr a = test::random_clip(random, 80), b = test::random_partner(random, *a, 80);
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

/// Every pair of samples that was measured, and its squared distance.
struct PairLog : ObserverBase {
    struct Pair {
        int i, j;
        double squared_distance;
        friend bool operator==(const Pair&, const Pair&) = default;
    };
    std::vector<Pair> pairs;

    void sample_pair(int i, int j, double squared_distance) { pairs.push_back({i, j, squared_distance}); }
};

/// Starts whose distance in samples is whole, half, anything, or off a whole number by about kMinOverlap.
double shifted_start(Random& random, double dt, int samples) {
    constexpr double kOffsets[] = {0, 0, 0.5, 1e-9, -1e-9, 0.999999e-9, 1.000001e-9, 2e-9, 1e-13};
    const int which = random.integer(0, 9);
    const double whole = dt * random.integer(-samples, samples);
    if (which == 9) return whole + random.real(-dt, dt);
    return whole + kOffsets[which] * (which == 2 ? dt : 1);
}

TEST(Query, ClipsOfOneDtMeasureThePairsThatTheDirectSearchDoes) {
    Random random(21);
    constexpr double kSpacings[] = {1.0 / 30, 1.0, 0.1, 2.5e-9, 4e-9, 1e-8};
    int measured = 0, known = 0;
    for (int round = 0; round < 20000; ++round) {
        const double dt = kSpacings[std::max(0, random.integer(-20, 5))];
        const ClipPtr a = test::random_clip(random, 40, dt), b = test::random_clip(random, 40, dt);
        // 1 level, and never apart in space: what is measured is what shares time.
        const Tree tree_a(a, {.tree = TreeKind::mobb, .levels = 1}), tree_b(b, {.tree = TreeKind::aabb, .levels = 1});
        const double start = random.chance(0.2) ? random.real(-1e6, 1e6) : 0;
        const Placement place_a{.translate = {random.real(-3, 3), 0}, .rotate_deg = 77, .start = start};
        const Placement place_b{.start = start + shifted_start(random, dt, 50)};
        const PlacedTree placed_a(tree_a, place_a), placed_b(tree_b, place_b);
        const PlacedClip& samples_a = placed_a.placed_clip();
        const PlacedClip& samples_b = placed_b.placed_clip();
        PairLog of_tree, direct;
        EXPECT_EQ(query(placed_a, placed_b, of_tree), direct_search(samples_a, samples_b, direct));
        EXPECT_EQ(of_tree.pairs, direct.pairs);
        EXPECT_EQ(contact_intervals(placed_a, placed_b), direct_contact_intervals(samples_a, samples_b));
        measured += static_cast<int>(direct.pairs.size());
        known += SampleShift(placed_a.frame(), a->dt(), placed_b.frame(), b->dt()).is_known() ? 1 : 0;
    }
    EXPECT_GT(measured, 100000);
    EXPECT_GT(known, 8000);
    EXPECT_LT(known, 19500);
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
    TestCounts expected;
    expected[TestKind::time] = 1;
    expected[BoxKind::obb2d] = 1;
    expected[TestKind::samples] = 21;
    EXPECT_EQ(statistics.tests, expected);
}

}  // namespace
}  // namespace mobb
