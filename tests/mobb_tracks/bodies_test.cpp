// People who are several disks, on floors: found as by asking every pair of their disks, whole and in parts.
#include <mobb/body.h>
#include <mobb_tracks/crowds.h>
#include <mobb_tracks/parts.h>
#include <mobb_tracks/people_conflicts.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

namespace mobb::test {
namespace {

struct Bodies {
    Crowd paths;
    std::vector<int> person_of;
    std::vector<int> floor_of;
};

/// People of one to four disks who turn as they like; held and linear, of one dt and of others.
Bodies random_bodies(Random& random, int people, double side) {
    Bodies out;
    const ClipPtr first = random_motion(random, random_clip(random, 60));
    for (int person = 0; person < people; ++person) {
        const ClipPtr clip = random_motion(random, random_partner(random, *first, 60));
        Placement other, placement;
        random_placements(random, *first, *clip, other, placement);
        placement.translate += glm::dvec2{random.real(0, side), random.real(0, side)};
        std::vector<double> headings = headings_of(*clip);
        if (random.chance(0.5)) {
            for (double& heading : headings) heading = random.real(-180, 180);
        }
        const int disks = random.integer(1, 4);
        for (int disk = 0; disk < disks; ++disk) {
            const BodyDisk of{random.real(-1, 1), random.real(-1, 1), random.real(0, 0.5)};
            out.paths.add(std::make_shared<const Clip>(member_of(*clip, headings, of)), placement);
            out.person_of.push_back(person);
        }
        out.floor_of.push_back(random.integer(0, 3));
    }
    return out;
}

/// By people: when they touch, from every pair of their disks alone.
std::map<std::pair<int, int>, std::vector<Interval>> asked_one_by_one(const Bodies& bodies) {
    std::map<std::pair<int, int>, std::vector<Interval>> out;
    const int count = static_cast<int>(bodies.person_of.size());
    for (int a = 0; a < count; ++a) {
        for (int b = a + 1; b < count; ++b) {
            const int one = bodies.person_of[static_cast<std::size_t>(a)];
            const int other = bodies.person_of[static_cast<std::size_t>(b)];
            const int floor_one = bodies.floor_of[static_cast<std::size_t>(one)];
            const int floor_other = bodies.floor_of[static_cast<std::size_t>(other)];
            if (one == other || (floor_one > 0 && floor_other > 0 && floor_one != floor_other)) continue;
            const auto found = direct_contact_intervals(bodies.paths.clip(a), bodies.paths.clip(b));
            if (found.empty()) continue;
            std::vector<Interval>& all = out[{one, other}];
            all.insert(all.end(), found.begin(), found.end());
        }
    }
    for (auto& [pair, all] : out) {
        std::ranges::sort(all, {}, &Interval::t0);
        std::vector<Interval> joined;
        for (const Interval& next : all) {
            if (joined.empty() || next.t0 > joined.back().t1 + 1e-9) {
                joined.push_back(next);
            } else {
                joined.back().t1 = std::max(joined.back().t1, next.t1);
            }
        }
        all = std::move(joined);
    }
    return out;
}

TEST(Bodies, AreFoundAsTheirDisksAreWholeAndInParts) {
    Random random(54);
    std::size_t all = 0, apart = 0;
    for (int round = 0; round < 60; ++round) {
        const Bodies bodies = random_bodies(random, 30, random.real(0, 6));
        const auto expected = asked_one_by_one(bodies);
        all += expected.size();
        const auto find = [&](const auto& change) {
            ConflictSearch search;
            search.floor_of = bodies.floor_of;
            change(search);
            return PeopleConflicts(bodies.paths.clips(), bodies.person_of, search);
        };
        const PeopleConflicts whole = find([](ConflictSearch&) {});
        const PeopleConflicts direct = find([](ConflictSearch& search) { search.direct = true; });
        const PeopleConflicts trees = find([&](ConflictSearch& search) { search.trees = bodies.paths.trees(); });
        EXPECT_EQ(direct.pairs_tested(), whole.pairs());
        apart += 30 * 29 / 2 - whole.pairs();
        for (const PeopleConflicts* found : {&whole, &direct, &trees}) {
            ASSERT_EQ(found->size(), expected.size());
            for (std::size_t i = 0; i < found->size(); ++i) {
                const PeopleConflict conflict = (*found)[i];
                EXPECT_EQ(conflict.intervals, expected.at({conflict.a, conflict.b}));
                EXPECT_EQ(conflict.deepest.least_clearance, whole[i].deepest.least_clearance);
            }
        }
        for (const double within : {0.0, 0.4}) {
            const PeopleConflicts together = find([&](ConflictSearch& search) { search.within = within; });
            std::vector<std::tuple<double, int, int>> wanted, of_parts;
            for (const PeopleConflict& found : all_of(together))
                wanted.emplace_back(found.deepest.least_clearance, found.a, found.b);
            for (const int parts : {2, 6}) {
                of_parts.clear();
                std::size_t tested = 0;
                for (int part = 0; part < parts; ++part) {
                    const PeopleConflicts of_part = find([&](ConflictSearch& search) {
                        search.within = within;
                        search.region = region_of_part(bodies.paths.clips(), part, parts);
                    });
                    tested += of_part.pairs_tested();
                    for (const PeopleConflict& found : all_of(of_part))
                        of_parts.emplace_back(found.deepest.least_clearance, found.a, found.b);
                }
                EXPECT_EQ(tested, together.pairs_tested());
                std::ranges::sort(wanted);
                std::ranges::sort(of_parts);
                EXPECT_EQ(of_parts, wanted);
            }
        }
    }
    EXPECT_GT(all, 500u);
    EXPECT_GT(apart, 1000u);
}

}  // namespace
}  // namespace mobb::test
