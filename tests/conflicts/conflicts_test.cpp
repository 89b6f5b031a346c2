// Conflicts through the trees are those of the direct search, and few pairs are tested for them.
#include <conflicts/conflicts.h>
#include <mobb/random_motion.h>
#include <support/conflicts.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace mobbscope {
namespace {

/// Trees and where they are placed.
class Crowd {
  public:
    void add(mobb::ClipPtr clip, const mobb::Placement& placement, const mobb::FitOptions& fit = {}) {
        trees_.push_back(std::make_unique<mobb::Tree>(std::move(clip), fit));
        placed_.emplace_back(*trees_.back(), placement);
    }
    std::span<const mobb::PlacedTree> placed() const { return placed_; }

  private:
    std::vector<std::unique_ptr<mobb::Tree>> trees_;
    std::vector<mobb::PlacedTree> placed_;
};

/// Walks along x from x0 at 1 m/s for `count` samples of 0.1 s, radius 0.5 m.
mobb::ClipPtr walking(double x0, double y, int count) {
    std::vector<mobb::Disk> samples;
    for (int i = 0; i < count; ++i) samples.push_back({x0 + 0.1 * i, y, 0.5});
    return std::make_shared<const mobb::Clip>(0.1, std::move(samples));
}

struct Conflicts {
    std::vector<Conflict> found;  ///< by a, then b
    std::int64_t pairs_tested = 0;
};

/// Of a crowd in which each path is a person's.
Conflicts find_conflicts(std::span<const mobb::PlacedTree> crowd, Search search, const Progress& progress = {}) {
    std::vector<int> person_of(crowd.size());
    std::iota(person_of.begin(), person_of.end(), 0);
    const PeopleConflicts people(crowd, person_of, search, progress);
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
    for (const Search search : {Search::trees, Search::direct}) {
        const Conflicts conflicts = find_conflicts(crowd.placed(), search);
        ASSERT_EQ(conflicts.found.size(), 0u) << "1.0 m and 0.6 m apart is over 1 m";
    }
    crowd.add(walking(5, 0.6, 20), {.start = 5});  // walks beside the first one, at one x
    for (const Search search : {Search::trees, Search::direct}) {
        const Conflicts conflicts = find_conflicts(crowd.placed(), search);
        ASSERT_EQ(conflicts.found.size(), 1u);
        const Conflict& conflict = conflicts.found[0];
        EXPECT_EQ(conflict.a, 0);
        EXPECT_EQ(conflict.b, 4);
        ASSERT_EQ(conflict.intervals.size(), 1u);
        EXPECT_NEAR(conflict.intervals[0].t0, 5, 1e-12);
        EXPECT_NEAR(conflict.intervals[0].t1, 7, 1e-12);
        EXPECT_NEAR(conflict.least_clearance, -0.4, 1e-12);
        const mobb::Disk a = crowd.placed()[0].placed_clip().disk(conflict.a_sample);
        const mobb::Disk b = crowd.placed()[4].placed_clip().disk(conflict.b_sample);
        EXPECT_EQ(conflict.least_clearance, std::sqrt(mobb::squared_distance(a, b)) - (a.r + b.r));
        EXPECT_EQ(conflict.time, std::max(crowd.placed()[0].placed_clip().time(conflict.a_sample),
                                          crowd.placed()[4].placed_clip().time(conflict.b_sample)));
    }
}

TEST(Conflicts, OfEquallyDeepPairsTheEarliestIsTold) {
    Crowd crowd;
    crowd.add(std::make_shared<const mobb::Clip>(1, std::vector<mobb::Disk>(10, {0, 0, 1})), {});
    crowd.add(std::make_shared<const mobb::Clip>(1, std::vector<mobb::Disk>(10, {1, 0, 1})), {.start = 2.5});
    const Conflicts conflicts = find_conflicts(crowd.placed(), Search::trees);
    ASSERT_EQ(conflicts.found.size(), 1u);
    EXPECT_EQ(conflicts.found[0].time, 2.5);
    EXPECT_EQ(conflicts.found[0].a_sample, 2);
    EXPECT_EQ(conflicts.found[0].b_sample, 0);
    EXPECT_EQ(conflicts.found[0].least_clearance, -1);
    EXPECT_EQ(conflicts.found[0].intervals, (std::vector<mobb::Interval>{{2.5, 10}}));
}

TEST(Conflicts, RandomCrowdsAreAsTheDirectSearchHasThem) {
    mobb::test::Random random(7);
    std::size_t found = 0;
    std::int64_t spared = 0;
    for (int round = 0; round < 60; ++round) {
        Crowd crowd;
        const double spread = random.real(1, 15);
        const mobb::ClipPtr first = mobb::test::random_motion(random, mobb::test::random_clip(random, 300));
        for (int i = 0; i < 25; ++i) {
            const mobb::ClipPtr clip =
                mobb::test::random_motion(random, mobb::test::random_partner(random, *first, 300));
            mobb::Placement other, placement;
            mobb::test::random_placements(random, *first, *clip, other, placement);
            placement.translate += glm::dvec2{random.real(0, spread), random.real(0, spread)};
            crowd.add(clip, placement, mobb::test::random_fit(random));
        }
        const Conflicts trees = find_conflicts(crowd.placed(), Search::trees);
        const Conflicts direct = find_conflicts(crowd.placed(), Search::direct);
        expect_same(trees, direct);
        EXPECT_EQ(direct.pairs_tested, 300);
        found += direct.found.size();
        spared += direct.pairs_tested - trees.pairs_tested;
    }
    EXPECT_GT(found, 100u);
    EXPECT_GT(spared, 1000);
}

TEST(Conflicts, OfHairsBreadthsNothingIsLost) {
    mobb::test::Random random(11);
    std::size_t found = 0;
    for (int round = 0; round < 2000; ++round) {
        const mobb::ClipPtr a = mobb::test::random_motion(random, mobb::test::random_clip(random, 40));
        const mobb::ClipPtr b = mobb::test::random_motion(random, mobb::test::random_partner(random, *a, 40));
        mobb::Placement place_a, place_b;
        mobb::test::random_placements(random, *a, *b, place_a, place_b);
        Crowd crowd;
        crowd.add(a, place_a);
        crowd.add(b, place_b);
        const Conflicts direct = find_conflicts(crowd.placed(), Search::direct);
        expect_same(find_conflicts(crowd.placed(), Search::trees), direct);
        found += direct.found.size();
    }
    EXPECT_GT(found, 300u);
}

TEST(NearPairs, GrowWithTheCrowdNotWithItsSquare) {
    const auto tested = [](int side) {
        Crowd crowd;
        for (int x = 0; x < side; ++x) {
            for (int y = 0; y < side; ++y) crowd.add(walking(2.0 * x, 0.9 * y, 50), {});
        }
        return near_pairs(crowd.placed()).size();
    };
    const std::size_t small = tested(5);
    const std::size_t large = tested(15);
    EXPECT_GT(small, 0u);
    EXPECT_LT(large, 14 * small) << "nine times as many";
}

TEST(NearPairs, AbsurdPlacesAndSizesAreTaken) {
    Crowd crowd;
    const auto dot = [](double x, double y, double r) {
        return std::make_shared<const mobb::Clip>(1, std::vector<mobb::Disk>{{x, y, r}});
    };
    crowd.add(dot(0, 0, 1e9), {});
    crowd.add(dot(1e9, -1e9, 0), {});
    crowd.add(dot(1, 1, 1e-9), {});
    crowd.add(dot(-1e9, 1e9, 1e-300), {});
    EXPECT_EQ(find_conflicts(crowd.placed(), Search::trees).found.size(), 1u);
    Crowd points;
    points.add(dot(0, 0, 0), {});
    points.add(dot(0, 0, 0), {});
    EXPECT_TRUE(find_conflicts(points.placed(), Search::trees).found.empty()) << "points do not collide";
    EXPECT_TRUE(near_pairs({}).empty());
}

TEST(Conflicts, ProgressMayEndTheSearch) {
    Crowd crowd;
    for (int i = 0; i < 4; ++i) crowd.add(walking(0, 0.1 * i, 10), {});
    std::size_t told = 0;
    const auto stop = [&](std::size_t done, std::size_t all) {
        EXPECT_EQ(all, 6u);
        told = done;
        if (done == 3) throw std::runtime_error("stop");
    };
    EXPECT_THROW(find_conflicts(crowd.placed(), Search::trees, stop), std::runtime_error);
    EXPECT_EQ(told, 3u);
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
    for (const Search search : {Search::trees, Search::direct}) {
        const PeopleConflicts conflicts(crowd.placed(), person_of, search);
        EXPECT_EQ(conflicts.pairs(), 6u) << "of four people";
        EXPECT_EQ(conflicts.pairs_tested(), search == Search::direct ? 6u : 2u);
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
    EXPECT_EQ(conflict_count(1, 4, 0.25), "1 conflict among 4 agents, 0.25 s in all");
    EXPECT_EQ(PeopleConflicts({}, {}, Search::trees).pairs(), 0u);
}

/// More than are kept in full: the last of them are searched again.
TEST(PeopleConflicts, AreTheSameHoweverManyThereAre) {
    constexpr int kPeople = 150;
    constexpr double kApart = 0.001;
    Crowd crowd;
    for (int i = 0; i < kPeople; ++i) crowd.add(walking(kApart * i, 0, 3), {});
    std::vector<int> person_of(kPeople);
    std::iota(person_of.begin(), person_of.end(), 0);
    const PeopleConflicts conflicts(crowd.placed(), person_of, Search::trees);
    ASSERT_EQ(conflicts.size(), std::size_t{kPeople} * (kPeople - 1) / 2);
    for (const PeopleConflict& found : all_of(conflicts)) {
        ASSERT_NEAR(found.deepest.least_clearance, kApart * (found.b - found.a) - 1, 1e-9) << found.a << ' ' << found.b;
        ASSERT_EQ(found.intervals, found.deepest.intervals);
    }
}

}  // namespace
}  // namespace mobbscope
