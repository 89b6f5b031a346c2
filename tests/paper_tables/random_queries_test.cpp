#include <mobb/predicate.h>
#include <paper_tables/built_in_clips.h>
#include <paper_tables/random_queries.h>

#include <gtest/gtest.h>

namespace mobbscope {
namespace {

const std::vector<mobb::ClipPtr>& clips() {
    static const std::vector<mobb::ClipPtr> made = walks_in_a_volume(14, 12, 1);
    return made;
}

TEST(RandomQueries, OverlapInTimeAsOftenAsThePapers) {
    // Table 2: 0.83 box tests of the roots a query.
    const std::vector<WorkloadQuery> queries = random_queries(clips(), 20000, {});
    int overlapping = 0;
    for (const WorkloadQuery& query : queries) {
        const double end_a = query.a.start + clips()[static_cast<std::size_t>(query.clip_a)]->duration();
        const double end_b = query.b.start + clips()[static_cast<std::size_t>(query.clip_b)]->duration();
        overlapping += mobb::overlap_in_time(query.a.start, end_a, query.b.start, end_b) ? 1 : 0;
    }
    EXPECT_NEAR(overlapping / 20000.0, 1 / 1.2, 0.01);
}

TEST(RandomQueries, ASeedGivesTheSameQueries) {
    const std::vector<WorkloadQuery> some = random_queries(clips(), 10, {.seed = 5});
    const std::vector<WorkloadQuery> same = random_queries(clips(), 10, {.seed = 5});
    const std::vector<WorkloadQuery> others = random_queries(clips(), 10, {.seed = 6});
    EXPECT_EQ(some[9].b, same[9].b);
    EXPECT_NE(some[9].b, others[9].b);
}

TEST(RandomQueries, TheMiddlesOfThePathsAreWithinTheRange) {
    // A clip far from its own origin is turned about its path, not about the origin.
    const auto far = std::make_shared<const mobb::Clip>(
        1.0, std::vector<mobb::Disk>{{1000, 2000, 0.3}, {1002, 2000, 0.3}, {1002, 2004, 0.3}});
    for (const WorkloadQuery& query : random_queries({far}, 100, {.range = 3})) {
        const mobb::PlacedClip a(*far, query.a), b(*far, query.b);
        const auto middle_x = [](const mobb::PlacedClip& clip) { return (clip.disk(0).x + clip.disk(2).x) / 2; };
        const auto middle_y = [](const mobb::PlacedClip& clip) { return (clip.disk(0).y + clip.disk(2).y) / 2; };
        EXPECT_NEAR(middle_x(a), 0, 1e-9);
        EXPECT_LE(std::abs(middle_x(b)), 3 + 1e-9);
        EXPECT_LE(std::abs(middle_y(b)), 3 + 1e-9);
    }
}

}  // namespace
}  // namespace mobbscope
