// What branches and nodes cost, against the counters.
#include <explain/branch_costs.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "explain/random_query.h"

namespace mobbscope {
namespace {

using mobb::test::Random;

TEST(BranchCosts, AreTheEventsBelowEachPair) {
    Random random(365);
    std::size_t found = 0;
    for (int round = 0; round < 300; ++round) {
        const testing::RandomQuery asked = testing::random_query(random);
        const Recursion recursion = recursion_of(asked.trace, asked.a(), asked.b());
        FocusWindow focus;
        if (random.chance(0.4)) focus.branch = random.integer(0, static_cast<int>(recursion.pairs.size()) - 1);
        if (random.chance(0.4)) focus.time = mobb::Interval{asked.a().begin_time(), asked.a().begin_time() + 1};
        const InFocus inside = events_in(recursion, focus);
        const auto is_inside = [&](int event) {
            return inside.empty() || inside[static_cast<std::size_t>(event)] != 0;
        };
        std::map<int, int> below;  // by pair: events of it and its callers, without its own
        for (int event = 0; event < asked.trace.size(); ++event) {
            if (!is_inside(event)) continue;
            const int pair = recursion.pair_of[static_cast<std::size_t>(event)];
            for (int at = recursion.pairs[static_cast<std::size_t>(pair)].parent; at >= 0;
                 at = recursion.pairs[static_cast<std::size_t>(at)].parent) {
                const int last = recursion.pairs[static_cast<std::size_t>(at)].last;
                if (at != focus.branch.value_or(0) && is_inside(last)) ++below[at];
            }
        }
        const std::vector<BranchCost> all = costliest_branches(recursion, focus, inside, recursion.pairs.size());
        ASSERT_EQ(all.size(), below.size());
        for (const BranchCost& branch : all) EXPECT_EQ(branch.events, below[branch.pair]);
        EXPECT_TRUE(std::ranges::is_sorted(all, std::greater<>(), &BranchCost::events));
        EXPECT_LE(costliest_branches(recursion, focus, inside, 3).size(), 3u);
        found += all.size();
    }
    EXPECT_GT(found, 100u);
}

FittedScene crossing(Random& random) {
    Scene scene;
    for (int i = 0; i < 2; ++i) {
        SceneClip clip;
        clip.name = "clip" + std::to_string(i);
        clip.clip = mobb::test::random_clip(random, 300, 1.0 / 30);
        scene.clips.push_back(clip);
    }
    for (int i = 0; i < 5; ++i) {
        Agent agent;
        agent.name = "agent" + std::to_string(i);
        agent.clip = i % 2;
        const auto& clip = *scene.clips[static_cast<std::size_t>(i % 2)].clip;
        agent.placement.translate =
            glm::dvec2(random.real(-1, 1), random.real(-1, 1)) - glm::dvec2(clip.samples()[0].x, clip.samples()[0].y);
        scene.agents.push_back(agent);
    }
    mobb::FitOptions options;
    options.leaf = 4;
    return {scene, options};
}

TEST(BranchCosts, SumsPerNodeAreTheCounters) {
    Random random(366);
    std::int64_t tests = 0;
    for (int round = 0; round < 20; ++round) {
        const FittedScene fitted = crossing(random);
        std::size_t told = 0;
        const SceneCosts costs = scene_costs(fitted, [&](std::size_t done, std::size_t all) {
            EXPECT_EQ(done, ++told);
            EXPECT_EQ(all, fitted.queries().size());
        });
        EXPECT_EQ(told, fitted.queries().size());
        std::int64_t counted = 0;
        std::map<TreeNode, std::int64_t> roots;
        for (std::size_t i = 0; i < fitted.queries().size(); ++i) {
            const SceneQuery query = fitted.queries()[i];
            const std::int64_t of_query = record(fitted, query).tests.all();
            EXPECT_EQ(costs.tests[i], of_query);
            counted += of_query;
            roots[{query.a.clip, 0}] += of_query;
            roots[{query.b.clip, 0}] += of_query;
        }
        std::int64_t own = 0;
        for (const NodeCost& cost : costs.nodes) {
            own += cost.own;
            EXPECT_GE(cost.below, 0);
            if (cost.at.node == 0) {
                EXPECT_EQ(cost.own + cost.below, roots[cost.at]) << "all is below the roots";
            }
        }
        EXPECT_EQ(own, 2 * counted) << "each test is of a node of A and one of B";
        std::vector<std::int64_t> sorted = costs.tests;
        std::ranges::sort(sorted);
        EXPECT_EQ(tests_at(costs, 1), sorted.back());
        EXPECT_EQ(tests_at(costs, 0), sorted.front());
        EXPECT_EQ(costs.tests[static_cast<std::size_t>(costs.by_tests.front())], sorted.back());
        EXPECT_GE(tests_at(costs, 0.95), tests_at(costs, 0.5));
        tests += counted;
    }
    EXPECT_GT(tests, 5000);
}

TEST(BranchCosts, ASandwichIsWhatCalledANodeAndWhatThatCalled) {
    Random random(367);
    int above = 0;
    int below = 0;
    for (int round = 0; round < 20; ++round) {
        const FittedScene fitted = crossing(random);
        const SceneCosts costs = scene_costs(fitted);
        for (const NodeCost& cost : costs.nodes) {
            if (random.chance(0.9)) continue;
            const Sandwich around = sandwich_of(fitted, cost.at);
            EXPECT_EQ(around.of, cost.at);
            std::int64_t entered = 0;
            for (const Sandwich::Neighbour& neighbour : around.above) entered += neighbour.tests;
            std::int64_t left = 0;
            for (const Sandwich::Neighbour& neighbour : around.below) left += neighbour.tests;
            // Agents of one clip have the node on both sides at once: that is one visit, and two of its costs.
            EXPECT_TRUE(cost.at.node == 0 || entered <= cost.own + cost.below);
            EXPECT_LE(left, cost.below);
            EXPECT_TRUE(std::ranges::is_sorted(around.above, std::greater<>(), &Sandwich::Neighbour::tests));
            above += static_cast<int>(around.above.size());
            below += static_cast<int>(around.below.size());
        }
    }
    EXPECT_GT(above, 20);
    EXPECT_GT(below, 20);
}

}  // namespace
}  // namespace mobbscope
