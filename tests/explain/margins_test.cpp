// What margins promise is so: no change within them makes two paths collide.
#include <explain/margins.h>

#include "proven_query.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace mobbscope {
namespace {

/// Inside a convex polygon, anywhere.
glm::dvec2 point_in(const std::vector<glm::dvec2>& polygon, mobb::test::Random& random) {
    glm::dvec2 sum{0};
    double weights = 0;
    for (const glm::dvec2 corner : polygon) {
        const double weight = -std::log(random.real(1e-9, 1));
        sum += weight * corner;
        weights += weight;
    }
    return sum / weights;
}

/// Misses with their margins until so many shifts have been tried.
void try_shifts(int shifts, int times, const std::function<ProvenQuery(mobb::test::Random&)>& make) {
    mobb::test::Random random(36);
    constexpr int kEach = 100;
    int moved = 0, timed = 0, asked = 0, many_tiles = 0;
    for (; moved < shifts || timed < times; ++asked) {
        SCOPED_TRACE(asked);
        ASSERT_LT(asked, 20 * shifts / kEach) << moved << " shifts, " << timed << " in time";
        const ProvenQuery query = make(random);
        const auto margins = margins_of(query.a().placed_clip(), query.b().placed_clip(), query.proof);
        ASSERT_EQ(margins.has_value(), !query.proof.contact && !query.proof.tiles.empty());
        if (!margins) continue;
        many_tiles += query.proof.tiles.size() > 1 ? 1 : 0;
        EXPECT_FALSE(query.collides_grown(margins->growth));
        const Tile tightest = std::ranges::min(query.proof.tiles, {}, &Tile::gap);
        EXPECT_LE(room_left(query.proof, -(tightest.gap + 1e-6) * tightest.direction), 0);
        for (int i = 0; i < kEach && !margins->free_region.empty(); ++i, ++moved) {
            const glm::dvec2 shift = point_in(margins->free_region, random);
            EXPECT_GT(room_left(query.proof, shift), 0);
            EXPECT_FALSE(query.collides_shifted(shift, 0)) << shift.x << ' ' << shift.y;
        }
        const double most = std::min(margins->shift_in_time, 1e6);
        if (most == 0) continue;
        for (int i = 0; i < kEach / 5; ++i, ++timed) {
            const double later = i < 2 ? (i == 0 ? -most : most) : random.real(-most, most);
            EXPECT_FALSE(query.collides_shifted({0, 0}, later)) << later;
        }
    }
    EXPECT_GT(many_tiles, asked / 100);
}

TEST(Margins, NoChangeWithinThemCollides) { try_shifts(100'000, 20'000, random_proven_query); }

TEST(Margins, NoChangeOfRealClipsWithinThemCollides) {
    if (real_clips().empty()) GTEST_SKIP() << "no test data at " << MOBBSCOPE_SHARED_DATA;
    try_shifts(20'000, 4'000, random_real_query);
}

/// Disks of 0.5 m that stay for so many seconds.
mobb::ClipPtr standing(double seconds, glm::dvec2 at = {0, 0}) {
    return std::make_shared<const mobb::Clip>(seconds, std::vector<mobb::Disk>{{at.x, at.y, 0.5}});
}

TEST(Margins, OfTwoWhoStandAreHalfThePlane) {
    const ProvenQuery query(two_agents(standing(5), standing(5), {}, {{2, 0}, 0, 1}), {});
    const auto margins = margins_of(query.a().placed_clip(), query.b().placed_clip(), query.proof);
    ASSERT_TRUE(margins);
    EXPECT_NEAR(margins->growth, 0.5, 1e-9);
    EXPECT_FALSE(margins->bounded);
    EXPECT_EQ(margins->shift_in_time, std::numeric_limits<double>::infinity());
    double left = 0, area = 0;
    for (std::size_t i = 0; i < margins->free_region.size(); ++i) {
        const glm::dvec2 p = margins->free_region[i];
        const glm::dvec2 q = margins->free_region[(i + 1) % margins->free_region.size()];
        left = std::min(left, p.x);
        area += 0.5 * (p.x * q.y - p.y * q.x);
    }
    EXPECT_NEAR(left, -1, 1e-9);
    EXPECT_NEAR(area, 101 * 200, 1e-3) << "counter-clockwise";
    EXPECT_GT(room_left(query.proof, {-0.999999, 0}), 0);
    EXPECT_LE(room_left(query.proof, {-1.000001, 0}), 0);
    EXPECT_TRUE(query.collides_shifted({-1.000001, 0}, 0));
}

TEST(Margins, OfATouchAreNothing) {
    const ProvenQuery query(two_agents(standing(5), standing(5), {}, {{1, 0}, 0, 0}), {});
    const auto margins = margins_of(query.a().placed_clip(), query.b().placed_clip(), query.proof);
    ASSERT_TRUE(margins);
    EXPECT_NEAR(margins->growth, 0, 1e-9);
    EXPECT_TRUE(margins->free_region.empty());
    EXPECT_TRUE(margins->bounded);
}

TEST(Margins, ShiftInTimeReachesAsFarAsTheLineHolds) {
    // A stands where B will be from 3 s on, and leaves 0.5 s before.
    const auto walk = std::make_shared<const mobb::Clip>(
        1, std::vector<mobb::Disk>{{0, 3, 0.5}, {0, 3, 0.5}, {0, 3, 0.5}, {0, 0, 0.5}});
    const ProvenQuery query(two_agents(standing(2.5), walk, {}, {}), {});
    const auto margins = margins_of(query.a().placed_clip(), query.b().placed_clip(), query.proof);
    ASSERT_TRUE(margins);
    EXPECT_NEAR(margins->shift_in_time, 0.5, 1e-5);
    EXPECT_LE(margins->shift_in_time, 0.5);
    EXPECT_FALSE(query.collides_shifted({0, 0}, -margins->shift_in_time));
    EXPECT_TRUE(query.collides_shifted({0, 0}, -0.50001));
}

TEST(Margins, AreOfMissesAlone) {
    const ProvenQuery hit(two_agents(standing(5), standing(5), {}, {{0.5, 0}, 0, 1}), {});
    ASSERT_TRUE(hit.proof.contact);
    EXPECT_FALSE(margins_of(hit.a().placed_clip(), hit.b().placed_clip(), hit.proof));
    const ProvenQuery apart(two_agents(standing(5), standing(5), {}, {{0, 0}, 0, 9}), {});
    EXPECT_FALSE(margins_of(apart.a().placed_clip(), apart.b().placed_clip(), apart.proof));
}

}  // namespace
}  // namespace mobbscope
