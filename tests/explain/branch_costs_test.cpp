// What branches and nodes cost, against the counters.
#include <explain/branch_costs.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <numeric>
#include <set>
#include <vector>

#include "explain/random_query.h"

namespace mobbscope {
namespace {

using mobb::test::Random;

TEST(BranchCosts, AreTheEventsBelowEachPair) {
    Random random(365);
    std::size_t found = 0;
    for (int round = 0; round < 300; ++round) {
        const RandomQuery asked = random_query(random);
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

using Nodes = std::array<TreeNode, 2>;

bool is_of(const Nodes& nodes, TreeNode node) { return nodes[0] == node || nodes[1] == node; }

/// Calls `use` with each event of each query, as its tests and the nodes on the way to it: its own first, the root's
/// last.
template <class Use>
void for_each_test(const FittedScene& fitted, const Use& use) {
    for (std::size_t i = 0; i < fitted.queries().size(); ++i) {
        const SceneQuery query = fitted.queries()[i];
        const RecordedQuery recorded = record(fitted, query);
        const mobb::Trace& trace = recorded.trace;
        for (int event = 0; event < trace.size(); ++event) {
            std::vector<Nodes> way;
            for (int at = event; at >= 0; at = trace[at].parent) {
                way.push_back({TreeNode{query.a.clip, trace[at].a}, TreeNode{query.b.clip, trace[at].b}});
            }
            use(trace.counts(event + 1).all() - trace.counts(event).all(), way);
        }
    }
}

/// Test by test.
std::map<TreeNode, NodeCost> node_costs(const FittedScene& fitted) {
    std::map<TreeNode, NodeCost> out;
    for_each_test(fitted, [&](std::int64_t tests, const std::vector<Nodes>& way) {
        std::set<TreeNode> above;
        for (const Nodes& nodes : way) above.insert(nodes.begin(), nodes.end());
        for (const TreeNode& node : above) {
            NodeCost& cost = out[node];
            (is_of(way.front(), node) ? cost.own : cost.below) += tests;
        }
    });
    return out;
}

std::int64_t box_tests_of_roots(const FittedScene& fitted) {
    std::int64_t out = 0;
    for (std::size_t i = 0; i < fitted.queries().size(); ++i) {
        const RecordedQuery recorded = record(fitted, fitted.queries()[i]);
        for (int event = 0; event < recorded.trace.size(); ++event) {
            const mobb::Trace::Event at = recorded.trace[event];
            out += at.a == 0 && at.b == 0 && at.test.is_box() ? 1 : 0;
        }
    }
    return out;
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
            if (query.b.clip != query.a.clip) roots[{query.b.clip, 0}] += of_query;
        }
        const std::map<TreeNode, NodeCost> expected = node_costs(fitted);
        ASSERT_EQ(costs.nodes.size(), expected.size());
        for (const NodeCost& cost : costs.nodes) {
            EXPECT_EQ(cost.own, expected.at(cost.at).own);
            EXPECT_EQ(cost.below, expected.at(cost.at).below);
            if (cost.at.node == 0) {
                EXPECT_EQ(cost.own + cost.below, roots[cost.at]) << "all is below the roots";
            }
        }
        EXPECT_EQ(costs.in_part, 0);
        mobb::TestCounts kinds, in_levels;
        for (std::size_t i = 0; i < fitted.queries().size(); ++i) {
            const mobb::TestCounts of_query = record(fitted, fitted.queries()[i]).tests;
            for (const mobb::TestKind kind : mobb::kTestKinds) kinds[kind] += of_query[kind];
        }
        for (const mobb::TestCounts& level : costs.levels) {
            for (const mobb::TestKind kind : mobb::kTestKinds) in_levels[kind] += level[kind];
        }
        EXPECT_EQ(costs.kinds, kinds);
        EXPECT_EQ(in_levels, kinds);
        EXPECT_EQ(costs.levels.front().boxes(), costs.nodes.empty() ? 0 : box_tests_of_roots(fitted));
        const std::int64_t of_nodes =
            std::accumulate(costs.nodes.begin(), costs.nodes.end(), std::int64_t{0},
                            [](std::int64_t sum, const NodeCost& cost) { return sum + cost.boxes; });
        EXPECT_EQ(of_nodes, 2 * kinds.boxes()) << "each test is of two nodes";
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

TEST(BranchCosts, QueriesRecordedInPartAreCounted) {
    Random random(368);
    const FittedScene fitted = crossing(random);
    const SceneCosts whole = scene_costs(fitted);
    std::vector<std::int64_t> events;
    for (std::size_t i = 0; i < fitted.queries().size(); ++i) {
        events.push_back(record(fitted, fitted.queries()[i]).trace.events());
    }
    const std::int64_t most = *std::ranges::max_element(events) - 1;
    const SceneCosts part = scene_costs(fitted, {}, {.events = static_cast<int>(most)});
    EXPECT_EQ(part.in_part, std::ranges::count_if(events, [&](std::int64_t of_query) { return of_query > most; }));
    EXPECT_GT(part.in_part, 0);
    EXPECT_EQ(part.tests, whole.tests) << "all tests of a query are known";
    EXPECT_EQ(part.by_tests, whole.by_tests);
}

TEST(BranchCosts, ASandwichIsWhatCalledANodeAndWhatThatCalled) {
    Random random(367);
    using Sums = std::map<Nodes, std::int64_t>;
    const auto sums_of = [](const std::vector<Sandwich::Neighbour>& neighbours) {
        EXPECT_TRUE(std::ranges::is_sorted(neighbours, std::greater<>(), &Sandwich::Neighbour::tests));
        Sums out;
        for (const Sandwich::Neighbour& neighbour : neighbours) out[neighbour.nodes] += neighbour.tests;
        EXPECT_EQ(out.size(), neighbours.size()) << "each is listed once";
        return out;
    };
    std::size_t above = 0;
    std::size_t below = 0;
    for (int round = 0; round < 20; ++round) {
        const FittedScene fitted = crossing(random);
        const SceneCosts costs = scene_costs(fitted);
        for (const NodeCost& cost : costs.nodes) {
            if (random.chance(0.9)) continue;
            Sums called, was_called;
            for_each_test(fitted, [&](std::int64_t tests, const std::vector<Nodes>& way) {
                for (std::size_t i = 0; i + 1 < way.size(); ++i) {
                    const bool callee = is_of(way[i], cost.at);
                    const bool caller = is_of(way[i + 1], cost.at);
                    if (callee && !caller) called[way[i + 1]] += tests;
                    if (caller && !callee) was_called[way[i]] += tests;
                }
            });
            const Sandwich around = sandwich_of(fitted, cost.at);
            EXPECT_EQ(around.of, cost.at);
            EXPECT_EQ(sums_of(around.above), called);
            EXPECT_EQ(sums_of(around.below), was_called);
            above += called.size();
            below += was_called.size();
        }
    }
    EXPECT_GT(above, 20u);
    EXPECT_GT(below, 20u);
}

}  // namespace
}  // namespace mobbscope
