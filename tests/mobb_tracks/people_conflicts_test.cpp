// Conflicts through a sweep and through trees are those of the direct search, and few pairs are tested for them.
#include <mobb_tracks/crowds.h>
#include <mobb_tracks/people_conflicts.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

namespace mobb::test {
namespace {

enum class Way { sweep, trees, direct };
constexpr Way kWays[] = {Way::sweep, Way::trees, Way::direct};

/// Walks along x from x0 at 1 m/s for `count` samples of 0.1 s, radius 0.5 m.
ClipPtr walking(double x0, double y, int count) {
    std::vector<Disk> samples;
    for (int i = 0; i < count; ++i) samples.push_back({x0 + 0.1 * i, y, 0.5});
    return std::make_shared<const Clip>(0.1, std::move(samples));
}

struct Conflicts {
    std::vector<Conflict> found;  ///< by a, then b
    std::int64_t pairs_tested = 0;
};

ConflictSearch search_by(Way way, const Crowd& crowd) {
    ConflictSearch search;
    search.direct = way == Way::direct;
    if (way == Way::trees) search.trees = crowd.trees();
    return search;
}

/// Of a crowd in which each path is a person's.
Conflicts find_conflicts(const Crowd& crowd, Way way) {
    const PeopleConflicts people = crowd.conflicts(search_by(way, crowd));
    std::vector<PeopleConflict> all = all_of(people);
    std::ranges::sort(all, {}, [](const PeopleConflict& found) { return std::pair(found.a, found.b); });
    Conflicts out{{}, static_cast<std::int64_t>(people.pairs_tested())};
    for (const PeopleConflict& found : all) {
        EXPECT_EQ(found.intervals, found.deepest.intervals) << "there is one pair of paths";
        out.found.push_back(found.deepest);
    }
    return out;
}

void expect_same(const Conflicts& a, const Conflicts& b) {
    ASSERT_EQ(a.found.size(), b.found.size());
    for (std::size_t i = 0; i < a.found.size(); ++i) {
        EXPECT_EQ(a.found[i].a, b.found[i].a);
        EXPECT_EQ(a.found[i].b, b.found[i].b);
        EXPECT_EQ(a.found[i].intervals, b.found[i].intervals);
        EXPECT_EQ(a.found[i].least_clearance, b.found[i].least_clearance);
        EXPECT_EQ(a.found[i].time, b.found[i].time);
        EXPECT_EQ(a.found[i].a_sample, b.found[i].a_sample);
        EXPECT_EQ(a.found[i].b_sample, b.found[i].b_sample);
    }
}

TEST(Conflicts, TellWhoWhenAndHowDeep) {
    Crowd crowd;
    crowd.add(walking(0, 0, 100), {});
    crowd.add(walking(50, 0, 10), {});               // far away
    crowd.add(walking(5, 0.6, 1), {.start = 4.05});  // stands 0.6 m aside of the way, for 0.1 s
    crowd.add(walking(8, 0, 1), {.start = 20});      // on the way, but later
    for (const Way way : kWays) {
        const Conflicts conflicts = find_conflicts(crowd, way);
        ASSERT_EQ(conflicts.found.size(), 0u) << "1.0 m and 0.6 m apart is over 1 m";
    }
    crowd.add(walking(5, 0.6, 20), {.start = 5});  // walks beside the first one, at one x
    for (const Way way : kWays) {
        const Conflicts conflicts = find_conflicts(crowd, way);
        ASSERT_EQ(conflicts.found.size(), 1u);
        const Conflict& conflict = conflicts.found[0];
        EXPECT_EQ(conflict.a, 0);
        EXPECT_EQ(conflict.b, 4);
        ASSERT_EQ(conflict.intervals.size(), 1u);
        EXPECT_NEAR(conflict.intervals[0].t0, 5, 1e-12);
        EXPECT_NEAR(conflict.intervals[0].t1, 7, 1e-12);
        EXPECT_NEAR(conflict.least_clearance, -0.4, 1e-12);
        const Disk a = crowd.clip(0).disk(conflict.a_sample);
        const Disk b = crowd.clip(4).disk(conflict.b_sample);
        EXPECT_EQ(conflict.least_clearance, std::sqrt(squared_distance(a, b)) - (a.r + b.r));
        EXPECT_EQ(conflict.time,
                  std::max(crowd.clip(0).time(conflict.a_sample), crowd.clip(4).time(conflict.b_sample)));
    }
}

TEST(Conflicts, OfEquallyDeepPairsTheEarliestIsTold) {
    Crowd crowd;
    crowd.add(std::make_shared<const Clip>(1, std::vector<Disk>(10, {0, 0, 1})), {});
    crowd.add(std::make_shared<const Clip>(1, std::vector<Disk>(10, {1, 0, 1})), {.start = 2.5});
    const Conflicts conflicts = find_conflicts(crowd, Way::sweep);
    ASSERT_EQ(conflicts.found.size(), 1u);
    EXPECT_EQ(conflicts.found[0].time, 2.5);
    EXPECT_EQ(conflicts.found[0].a_sample, 2);
    EXPECT_EQ(conflicts.found[0].b_sample, 0);
    EXPECT_EQ(conflicts.found[0].least_clearance, -1);
    EXPECT_EQ(conflicts.found[0].intervals, (std::vector<Interval>{{2.5, 10}}));
}

TEST(Conflicts, RandomCrowdsAreAsTheDirectSearchHasThem) {
    Random random(7);
    std::size_t found = 0;
    std::int64_t spared = 0;
    for (int round = 0; round < 60; ++round) {
        const Crowd crowd = random_crowd(random, 25, 300, random.real(1, 15));
        const Conflicts sweep = find_conflicts(crowd, Way::sweep);
        const Conflicts direct = find_conflicts(crowd, Way::direct);
        expect_same(sweep, direct);
        expect_same(find_conflicts(crowd, Way::trees), direct);
        EXPECT_EQ(direct.pairs_tested, 300);
        found += direct.found.size();
        spared += direct.pairs_tested - sweep.pairs_tested;
    }
    EXPECT_GT(found, 100u);
    EXPECT_GT(spared, 1000);
}

TEST(Conflicts, OfHairsBreadthsNothingIsLost) {
    Random random(11);
    std::size_t found = 0;
    for (int round = 0; round < 2000; ++round) {
        const ClipPtr a = random_motion(random, random_clip(random, 40));
        const ClipPtr b = random_motion(random, random_partner(random, *a, 40));
        Placement place_a, place_b;
        random_placements(random, *a, *b, place_a, place_b);
        Crowd crowd;
        crowd.add(a, place_a);
        crowd.add(b, place_b);
        const Conflicts direct = find_conflicts(crowd, Way::direct);
        expect_same(find_conflicts(crowd, Way::sweep), direct);
        found += direct.found.size();
    }
    EXPECT_GT(found, 300u);
}

TEST(Conflicts, PairsTestedGrowWithTheCrowdNotWithItsSquare) {
    const auto tested = [](int side) {
        Crowd crowd;
        for (int x = 0; x < side; ++x) {
            for (int y = 0; y < side; ++y) crowd.add(walking(2.0 * x, 0.9 * y, 50), {});
        }
        return crowd.conflicts().pairs_tested();
    };
    const std::size_t small = tested(5);
    const std::size_t large = tested(15);
    EXPECT_GT(small, 0u);
    EXPECT_LT(large, 14 * small) << "nine times as many";
}

TEST(Conflicts, AbsurdPlacesAndSizesAreTaken) {
    Crowd crowd;
    const auto dot = [](double x, double y, double r) {
        return std::make_shared<const Clip>(1, std::vector<Disk>{{x, y, r}});
    };
    crowd.add(dot(0, 0, 1e9), {});
    crowd.add(dot(1e9, -1e9, 0), {});
    crowd.add(dot(1, 1, 1e-9), {});
    crowd.add(dot(-1e9, 1e9, 1e-300), {});
    EXPECT_EQ(find_conflicts(crowd, Way::sweep).found.size(), 1u);
    Crowd points;
    points.add(dot(0, 0, 0), {});
    points.add(dot(0, 0, 0), {});
    EXPECT_TRUE(find_conflicts(points, Way::sweep).found.empty()) << "points do not collide";
    EXPECT_TRUE(Crowd().conflicts().empty());
}

TEST(Conflicts, ProgressMayEndTheSearch) {
    Crowd crowd;
    for (int i = 0; i < 4; ++i) crowd.add(walking(0, 0.1 * i, 10), {});
    for (const Way way : kWays) {
        std::size_t told = 0;
        ConflictSearch search = search_by(way, crowd);
        search.progress = [&](std::size_t done, std::size_t all) {
            EXPECT_EQ(all, 4u);
            told = done;
            if (done == 2) throw std::runtime_error("stop");
        };
        EXPECT_THROW(crowd.conflicts(search), std::runtime_error);
        EXPECT_EQ(told, 2u);
    }
}

TEST(Conflicts, SayWhatTheyTakeWhichMayEndTheSearch) {
    Crowd crowd;
    for (int i = 0; i < 4; ++i) crowd.add(walking(0, 0.1 * i, 10), {});
    ConflictSearch search;
    search.spend = [](std::size_t bytes) {
        if (bytes > 100) throw std::runtime_error("too much");
    };
    EXPECT_THROW(crowd.conflicts(search), std::runtime_error);
}

TEST(PeopleConflicts, AreOneForAPairThatMeetsOftenAndTheDeepestComesFirst) {
    Crowd crowd;
    std::vector<int> person_of;
    const auto add = [&](int person, double x, double y, double start) {
        crowd.add(walking(x, y, 20), {.start = start});
        person_of.push_back(person);
    };
    add(0, 0, 0, 0);
    add(0, 2, 0, 2);  // goes on
    add(0, 4, 0, 3);  // a second before that has ended: no conflict with oneself
    add(1, 0, 0.9, 0.5);
    add(1, 2, 0.8, 2.5);
    add(2, 4, -0.3, 3);
    add(3, 90, 0, 0);
    for (const Way way : kWays) {
        const PeopleConflicts conflicts(crowd.clips(), person_of, search_by(way, crowd));
        EXPECT_EQ(conflicts.pairs(), 6u) << "of four people";
        EXPECT_EQ(conflicts.pairs_tested(), way == Way::direct ? 6u : 2u);
        ASSERT_EQ(conflicts.size(), 2u);
        const PeopleConflict worst = conflicts[0];
        EXPECT_EQ(std::pair(worst.a, worst.b), std::pair(0, 2));
        EXPECT_EQ(worst.deepest.a, 2);
        EXPECT_NEAR(worst.deepest.least_clearance, -0.7, 1e-12);
        const PeopleConflict often = conflicts[1];
        EXPECT_EQ(std::pair(often.a, often.b), std::pair(0, 1));
        for (std::size_t i = 1; i < often.intervals.size(); ++i)
            EXPECT_GT(often.intervals[i].t0, often.intervals[i - 1].t1 + 1e-9) << "what touches is one";
        EXPECT_LE(often.worst().t0, often.deepest.time);
        EXPECT_GE(often.worst().t1, often.deepest.time);
        EXPECT_EQ(often.begins.intervals.front().t0, often.worst().t0);
    }
    EXPECT_EQ(PeopleConflicts({}, {}).pairs(), 0u);
}

TEST(PeopleConflicts, AreTheSameHoweverManyThereAre) {
    constexpr int kPeople = 150;
    constexpr double kApart = 0.001;
    Crowd crowd;
    for (int i = 0; i < kPeople; ++i) crowd.add(walking(kApart * i, 0, 3), {});
    const PeopleConflicts conflicts = crowd.conflicts();
    ASSERT_EQ(conflicts.size(), std::size_t{kPeople} * (kPeople - 1) / 2);
    for (const PeopleConflict& found : all_of(conflicts)) {
        ASSERT_NEAR(found.deepest.least_clearance, kApart * (found.b - found.a) - 1, 1e-9) << found.a << ' ' << found.b;
        ASSERT_EQ(found.intervals, found.deepest.intervals);
    }
}

}  // namespace
}  // namespace mobb::test
