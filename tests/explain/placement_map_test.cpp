// Each cell of a map is what a query says with B placed there.
#include <explain/clearance.h>
#include <explain/placement_map.h>
#include <mobb/query.h>

#include "mobb/random_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope {
namespace {

using mobb::ClipPtr;
using mobb::Placement;
using mobb::test::Random;

/// Held and linear, touching, far away, of one sample and of many, with any kind of trees.
FittedScene random_scene(Random& random, std::optional<mobb::TreeKind> kind = {}) {
    const ClipPtr a = mobb::test::random_motion(random, mobb::test::random_clip(random, 200));
    const ClipPtr b = mobb::test::random_motion(random, mobb::test::random_partner(random, *a, 200));
    Scene scene;
    scene.clips = {{"a", {}, {}, a}, {"b", {}, {}, b}};
    scene.agents = {{"A", 0, {}, {}}, {"B", 1, {}, {}}};
    mobb::test::random_placements(random, *a, *b, scene.agents[0].placement, scene.agents[1].placement);
    mobb::FitOptions fit = mobb::test::random_any_fit(random);
    fit.tree = kind.value_or(fit.tree);
    return {std::move(scene), fit};
}

MapOrder random_order(Random& random, MapShow show) {
    MapOrder order;
    const auto axis = [&] { return static_cast<MapAxis>(random.integer(0, static_cast<int>(kMapAxes) - 1)); };
    order.across.axis = axis();
    do order.up.axis = axis();
    while (order.up.axis == order.across.axis);
    for (MapRange* range : {&order.across, &order.up}) {
        const double reach = range->axis == MapAxis::dheading ? 200 : 3;
        range->from = random.real(-reach, 0);
        range->to = random.real(0.01, reach);
    }
    order.width = random.integer(1, 20);
    order.height = random.integer(1, 20);
    order.show = show;
    return order;
}

TEST(PlacementMap, EachCellIsWhatItsQuerySays) {
    Random random(35);
    std::size_t hits = 0, cells = 0, alone = 0;
    for (int round = 0; round < 150; ++round) {
        const auto show = static_cast<MapShow>(round % 3);
        // All kinds in turn.
        const mobb::TreeKind kind = mobb::kTreeKinds[static_cast<std::size_t>(round / 3) % mobb::kTreeKinds.size()];
        const FittedScene fitted = random_scene(random, kind);
        const SceneQuery query = fitted.queries()[0];
        MapOrder order = random_order(random, show);
        if (random.chance(0.2)) order.search = Search::direct;
        const PlacementMap map = map_placements(fitted, query, order);
        ASSERT_EQ(map.step, 1);
        for (int sampled = 0; sampled < 20; ++sampled) {
            const int x = random.integer(0, order.width - 1), y = random.integer(0, order.height - 1);
            SceneQuery there = query;
            there.b.placement = moved(query.b.placement, order, order.middle(x, y));
            mobb::Statistics statistics;
            const bool collides = ask(fitted, there, order.search, statistics).has_value();
            SCOPED_TRACE(std::string(name(show)) + " of round " + std::to_string(round));
            ASSERT_EQ(map.hit(x, y), collides);
            const mobb::PlacedTree a = fitted.placed(there.a), b = fitted.placed(there.b);
            const Clearance clearance = clearance_over_time(a.placed_clip(), b.placed_clip());
            switch (show) {
                case MapShow::answer:
                    ASSERT_EQ(map.value(x, y), collides ? 1 : 0);
                    break;
                case MapShow::clearance:
                    if (clearance.least) {
                        ASSERT_EQ(map.value(x, y), clearance.pieces[*clearance.least].clearance);
                    } else {
                        ASSERT_EQ(map.value(x, y), std::numeric_limits<double>::infinity());
                        ++alone;
                    }
                    break;
                case MapShow::tests:
                    ASSERT_EQ(map.value(x, y), static_cast<double>(statistics.tests.boxes() +
                                                                   statistics.tests[mobb::TestKind::samples]));
                    break;
            }
            const PlacedAnswer answer = answer_at(fitted, there, show, order.search);
            ASSERT_EQ(answer.hit, collides) << "asked of that place alone";
            ASSERT_EQ(answer.value, map.value(x, y));
            hits += collides ? 1 : 0;
            ++cells;
        }
    }
    EXPECT_EQ(cells, 3000U);
    EXPECT_GT(hits, 300U);
    EXPECT_LT(hits, 2700U);
    EXPECT_GT(alone, 0U);
}

TEST(PlacementMap, AnswersAreTheSameForEveryKindOfTree) {
    Random random(36);
    for (int round = 0; round < 10; ++round) {
        const FittedScene fitted = random_scene(random);
        MapOrder order = random_order(random, MapShow::answer);
        const PlacementMap expected = map_placements(fitted, fitted.queries()[0], order);
        for (const mobb::TreeKind kind : mobb::kTreeKinds) {
            mobb::FitOptions fit = fitted.options();
            fit.tree = kind;
            const FittedScene other(fitted.scene(), fit, &fitted);
            order.show = MapShow::tests;  // asks the trees themselves
            EXPECT_EQ(map_placements(other, other.queries()[0], order).hits, expected.hits) << mobb::name(kind);
            order.show = MapShow::answer;
            EXPECT_EQ(map_placements(other, other.queries()[0], order).hits, expected.hits) << mobb::name(kind);
        }
    }
}

TEST(PlacementMap, ComesCoarseFirstAndAsksEachCellOnce) {
    Random random(37);
    const FittedScene fitted = random_scene(random);
    MapOrder order{{MapAxis::dx, -2, 2}, {MapAxis::dy, -2, 2}, 37, 21, MapShow::clearance};
    std::vector<int> steps;
    std::vector<PlacementMap> passes;
    std::size_t asked = 0;
    const PlacementMap whole = map_placements(
        fitted, fitted.queries()[0], order,
        [&](const PlacementMap& map) {
            steps.push_back(map.step);
            passes.push_back(map);
        },
        [&](std::size_t done, std::size_t all) {
            EXPECT_EQ(all, 37U * 21U);
            asked = std::max(asked, done);
        });
    EXPECT_EQ(steps, (std::vector{8, 4, 2, 1}));
    EXPECT_EQ(asked, 37U * 21U);
    for (const PlacementMap& pass : passes) {
        for (int y = 0; y < order.height; ++y) {
            for (int x = 0; x < order.width; ++x) {
                ASSERT_EQ(pass.value(x, y), whole.value(x - x % pass.step, y - y % pass.step));
            }
        }
    }
}

TEST(PlacementMap, APlaceIsSaidWithAsManyDigitsAsShowIt) {
    EXPECT_EQ(placed_words(MapShow::clearance, {true, -0.0174}), "they collide, overlapping by 0.017 m");
    EXPECT_EQ(placed_words(MapShow::clearance, {false, 0.0051}), "they never collide, at least 0.005 m apart");
    EXPECT_EQ(placed_words(MapShow::clearance, {true, -0.0000123}), "they collide, overlapping by 0.0000123 m");
    EXPECT_EQ(placed_words(MapShow::clearance, {false, std::numeric_limits<double>::infinity()}), "they share no time");
    EXPECT_EQ(placed_words(MapShow::answer, {true, 1}), "they collide");
    EXPECT_EQ(placed_words(MapShow::tests, {false, 1}), "they never collide: 1 test");
    const mobb::Placement b{{1, 2}, 730, 3};
    EXPECT_EQ(placed_at(b, {{MapAxis::dheading}, {MapAxis::dx}}, {-10, 0.1}), (mobb::Placement{{0.1, 2}, -10, 3}));
}

TEST(PlacementMap, EndsWhenToldTo) {
    struct Enough {};
    Random random(38);
    const FittedScene fitted = random_scene(random);
    const MapOrder order{{MapAxis::dx, -2, 2}, {MapAxis::dy, -2, 2}, 64, 64, MapShow::answer};
    int passes = 0;
    const auto enough = [](std::size_t done, std::size_t all) {
        if (done > all / 4) throw Enough();
    };
    EXPECT_THROW(map_placements(
                     fitted, fitted.queries()[0], order, [&](const PlacementMap&) { ++passes; }, enough),
                 Enough);
    EXPECT_LT(passes, 4);
}

TEST(PlacementMap, RefusesWhatIsNoMap) {
    const MapOrder good{{MapAxis::dx, -5, 5}, {MapAxis::dy, -5, 5}};
    const mobb::Clip clip(1.0, {{0, 0, 0.5}});
    check(good, {}, clip);
    const auto refused = [&](auto change, const std::string& word) {
        MapOrder order = good;
        change(order);
        try {
            check(order, {}, clip);
            ADD_FAILURE() << "taken, but for " << word;
        } catch (const std::invalid_argument& error) {
            EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
        }
    };
    refused([](MapOrder& order) { order.up.axis = MapAxis::dx; }, "both axes are dx");
    refused([](MapOrder& order) { std::swap(order.up.from, order.up.to); }, "dy must go from");
    refused([](MapOrder& order) { order.up.to = order.up.from; }, "dy must go from");
    refused([](MapOrder& order) { order.across.to = std::nan(""); }, "dx must go from");
    refused([](MapOrder& order) { order.across.to = std::numeric_limits<double>::infinity(); }, "dx must go from");
    refused([](MapOrder& order) { order.width = 0; }, "1 to 2048 cells");
    refused([](MapOrder& order) { order.height = kMostMapCells + 1; }, "1 to 2048 cells");
    refused([](MapOrder& order) { order.across.to = 2 * mobb::kMaxLength; }, "where none may");
}

TEST(PlacementMap, RangesChosenHoldAllMeetingsAndNoMuchMore) {
    Random random(39);
    for (int round = 0; round < 60; ++round) {
        const FittedScene fitted = random_scene(random);
        const SceneQuery query = fitted.queries()[0];
        MapOrder order{{MapAxis::dx}, {MapAxis::dy}, 40, 40, MapShow::answer};
        choose_ranges(fitted.placed(query.a).placed_clip(), fitted.placed(query.b).placed_clip(), order);
        EXPECT_NEAR(order.across.to - order.across.from, order.up.to - order.up.from, 1e-6);
        const PlacementMap map = map_placements(fitted, query, order);
        for (int i = 0; i < 40; ++i) {
            EXPECT_FALSE(map.hit(i, 0) || map.hit(i, 39) || map.hit(0, i) || map.hit(39, i));
        }
    }
}

TEST(PlacementMap, BoundaryOfOneDiskIsACircle) {
    Scene scene;
    scene.clips = {{"a", {}, {}, std::make_shared<const mobb::Clip>(1.0, std::vector<mobb::Disk>{{0, 0, 0.7}})}};
    scene.agents = {{"A", 0, {}, {}}, {"B", 0, {{0.5, 0}, 0, 0}, {}}};
    const FittedScene fitted(std::move(scene), {});
    for (const MapShow show : {MapShow::answer, MapShow::clearance, MapShow::tests}) {
        const MapOrder order{{MapAxis::dx, -3, 2}, {MapAxis::dy, -2, 2}, 100, 80, show};
        const PlacementMap map = map_placements(fitted, fitted.queries()[0], order);
        double length = 0;
        for (const MapLine& line : map.boundary) {
            // B stands half a metre to the right of A.
            const double radius = std::hypot(line.from.x + 0.5, line.from.y);
            EXPECT_NEAR(radius, 1.4, 1e-3);
            length += std::hypot(line.to.x - line.from.x, line.to.y - line.from.y);
        }
        EXPECT_NEAR(length, 2 * M_PI * 1.4, 0.01);
    }
}

}  // namespace
}  // namespace mobbscope
