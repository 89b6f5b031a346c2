// A run holds what the simulator promises, by the direct search.
#include "walker_moves.h"

#include <crowd/simulation/simulate.h>
#include <scene/crowd_run.h>
#include <scene/motion_graph.h>
#include <support/input_error.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <set>
#include <stdexcept>
#include <utility>

namespace mobbscope {
namespace {

class Simulate : public ::testing::Test {
  protected:
    const FittedScene fitted{walker_scene(), {}};
    const MoveSet moves{fitted};

    mobb::PlacedClip placed(const Play& play) const { return {moves.clip(play.move).clip(), play.placement}; }
    double end(const Play& play) const { return play.placement.start + moves.until_next(play.move); }

    /// Asks all pairs of plays of different agents that overlap in time; those that collide.
    std::vector<std::pair<const Play*, const Play*>> contacts(const CrowdRun& run) const {
        std::vector<std::pair<const Play*, const Play*>> found;
        for (std::size_t a = 0; a < run.agents.size(); ++a) {
            for (std::size_t b = a + 1; b < run.agents.size(); ++b) {
                for (const Play& p : run.agents[a].plays) {
                    for (const Play& q : run.agents[b].plays) {
                        if (end(p) <= q.placement.start || end(q) <= p.placement.start) continue;
                        if (mobb::direct_search(placed(p), placed(q))) found.emplace_back(&p, &q);
                    }
                }
            }
        }
        return found;
    }
};

SimulateOptions small_crowd(std::uint64_t seed) {
    SimulateOptions options;
    options.agents = 24;
    options.area = {14, 12};
    options.seconds = 30;
    options.seed = seed;
    return options;
}

TEST_F(Simulate, NobodyCollidesButWhoIsForcedTo) {
    std::int64_t free_pairs = 0;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        for (const double ahead : {0.0, 2.5}) {
            SimulateOptions options = small_crowd(seed);
            options.ahead = ahead;
            const Simulation simulation = simulate(moves, options);
            ASSERT_EQ(simulation.run.agents.size(), 24u);
            EXPECT_GT(simulation.counts.colliding, 100);
            EXPECT_GT(simulation.counts.off_floor, 100);
            EXPECT_LT(simulation.counts.forced, simulation.counts.choices / 10);
            for (const auto& [p, q] : contacts(simulation.run)) {
                EXPECT_TRUE(p->kind == PlayKind::forced || q->kind == PlayKind::forced)
                    << "seed " << seed << ", ahead " << ahead << ", at " << p->placement.start;
            }
            free_pairs += simulation.counts.plays - simulation.counts.forced;
        }
    }
    EXPECT_GT(free_pairs, 1000);
}

TEST_F(Simulate, AWayOnThatIsPlannedLeavesHardlyAnyForced) {
    std::int64_t without = 0, with = 0;
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        SimulateOptions options = small_crowd(seed);
        options.agents = 34;
        options.plan = 0;
        without += simulate(moves, options).counts.forced;
        options.plan = 4;
        with += simulate(moves, options).counts.forced;
    }
    EXPECT_GT(without, 20);
    EXPECT_LE(20 * with, without);
}

TEST_F(Simulate, NobodyLeavesTheFloor) {
    const Simulation simulation = simulate(moves, small_crowd(4));
    for (const CrowdAgent& agent : simulation.run.agents) {
        for (const Play& play : agent.plays) {
            const mobb::PlacedClip clip = placed(play);
            for (int i = 0; i < clip.count(); ++i) {
                const mobb::Disk disk = clip.disk(i);
                ASSERT_LE(std::abs(disk.x) + disk.r, 7.0);
                ASSERT_LE(std::abs(disk.y) + disk.r, 6.0);
            }
        }
    }
}

TEST_F(Simulate, MovesAreBackToBackFromBeforeTheBeginToTheEnd) {
    SimulateOptions options = small_crowd(5);
    options.ahead = 1.5;
    const Simulation simulation = simulate(moves, options);
    std::set<double> phases;
    std::int64_t plays = 0, pivots = 0, forced = 0;
    for (const CrowdAgent& agent : simulation.run.agents) {
        phases.insert(agent.plays.front().placement.start);
        EXPECT_LE(agent.plays.front().placement.start, 0);
        EXPECT_GE(end(agent.plays.front()), 0);
        EXPECT_GE(end(agent.plays.back()), options.seconds);
        plays += static_cast<std::int64_t>(agent.plays.size());
        for (std::size_t i = 1; i < agent.plays.size(); ++i) {
            const Play& before = agent.plays[i - 1];
            const Play& play = agent.plays[i];
            EXPECT_EQ(play.placement.start, end(before));
            EXPECT_EQ(play.chosen_at, std::max(0.0, play.placement.start - 1.5));
            EXPECT_LT(end(before), options.seconds);
            pivots += play.kind == PlayKind::pivoted;
            forced += play.kind == PlayKind::forced;
            EXPECT_TRUE(play.kind != PlayKind::chosen || moves.origin(play.move).turn_deg == 0);
            // Nobody faces another way all at once.
            EXPECT_EQ(play.placement,
                      moves.following(before.move, before.placement, {moves.origin(play.move).move, 0}));
        }
    }
    EXPECT_EQ(phases.size(), 24u);
    EXPECT_EQ(simulation.counts.plays, plays);
    EXPECT_EQ(simulation.counts.choices, plays - 24);
    EXPECT_EQ(simulation.counts.pivots, pivots);
    EXPECT_EQ(simulation.counts.forced, forced);
    EXPECT_GT(pivots, 0);
}

TEST_F(Simulate, TheRunDependsOnTheSeedAndNotOnTheThreads) {
    // So many moves that candidates are asked in several tasks.
    Scene scene;
    for (int i = 0; i < 60; ++i) {
        scene.clips.push_back(walk("walk" + std::to_string(i), 0.8 + 0.02 * i, 5.0 * i - 150, 45, 1.0 / 30, 0.4));
    }
    scene.graph = std::make_shared<MotionGraph>(graph_of_whole_clips(scene));
    const FittedScene many(scene, {});
    const MoveSet walks(many);
    SimulateOptions options = small_crowd(6);
    options.threads = 1;
    const Simulation one = simulate(walks, options);
    for (const int threads : {2, 7}) {
        options.threads = threads;
        EXPECT_EQ(simulate(walks, options).run, one.run);
    }
    options.seed = 7;
    EXPECT_NE(simulate(walks, options).run.agents, one.run.agents);
}

TEST_F(Simulate, WhatIsRecordedIsWhatTheTreesWereAsked) {
    QuerySample all(Recorded::asked, 0, 1);
    const Simulation simulation = simulate(moves, small_crowd(8), &all);
    EXPECT_EQ(static_cast<std::int64_t>(all.offered()), simulation.counts.queries);
    const Scene workload = all.workload(moves);
    ASSERT_EQ(workload.queries.size(), all.offered());
    const FittedScene asked(workload, workload.fit);
    std::int64_t positive = 0;
    for (std::size_t i = 0; i < workload.queries.size(); ++i) {
        const SceneQuery query = asked.queries()[i];
        mobb::NoObserver nobody;
        positive += ask(asked, query, Search::trees, nobody).has_value();
    }
    // Each colliding candidate has one pair that collides at least; several agents may rule it out.
    EXPECT_GE(positive, simulation.counts.colliding);

    QuerySample some(Recorded::asked, 50, 1);
    simulate(moves, small_crowd(8), &some);
    EXPECT_EQ(some.offered(), all.offered());
    EXPECT_EQ(some.size(), 50u);
    QuerySample everybody(Recorded::all, 50, 1);
    simulate(moves, small_crowd(8), &everybody);
    EXPECT_GT(everybody.offered(), 5 * all.offered());
}

TEST_F(Simulate, ProgressIsToldAndMayEndTheRun) {
    SimulationCounts last;
    const Simulation simulation = simulate(moves, small_crowd(9), nullptr, [&](const auto& counts) { last = counts; });
    EXPECT_EQ(last.choices, simulation.counts.choices);
    EXPECT_EQ(last.simulated, 30);
    const auto stop = [](const SimulationCounts&) { throw std::runtime_error("enough"); };
    EXPECT_THROW(simulate(moves, small_crowd(9), nullptr, stop), std::runtime_error);
}

TEST_F(Simulate, AFullFloorIsRefused) {
    SimulateOptions options = small_crowd(1);
    options.agents = 2000;
    EXPECT_NE(input_error([&] { simulate(moves, options); }).find("no room for agent "), std::string::npos);
    options.area = {0.5, 50};
    EXPECT_NE(input_error([&] { simulate(moves, options); }).find("no room for agent 1 of 2000"), std::string::npos);
}

TEST_F(Simulate, SecondsThatDoublesCannotHoldAreRefused) {
    Scene scene = fitted.scene();
    const mobb::Clip& long_enough = *scene.clips[0].clip;
    scene.clips[0].clip = std::make_shared<const mobb::Clip>(
        2.1e-9, std::vector<mobb::Disk>(long_enough.samples().begin(), long_enough.samples().end()));
    const FittedScene fine(scene, {});
    const MoveSet of_fine(fine);
    SimulateOptions options = small_crowd(1);
    options.seconds = 1e6;
    const std::string said = input_error([&] { simulate(of_fine, options); });
    EXPECT_NE(said.find("move 0 of the graph has a dt of 2.1e-09 s: doubles tell its samples' times apart within "
                        "225180 s; simulate fewer than 1e+06 s, or give a larger dt"),
              std::string::npos)
        << said;
}

TEST_F(Simulate, OptionsOutOfRangeAreRefused) {
    const auto refused = [&](const auto& change) {
        SimulateOptions options;
        change(options);
        EXPECT_THROW(simulate(moves, options), std::invalid_argument);
    };
    refused([](SimulateOptions& o) { o.agents = 0; });
    refused([](SimulateOptions& o) { o.area.x = 0; });
    refused([](SimulateOptions& o) { o.area.y = std::nan(""); });
    refused([](SimulateOptions& o) { o.seconds = -1; });
    refused([](SimulateOptions& o) { o.ahead = -1; });
    refused([](SimulateOptions& o) { o.plan = -1; });
    refused([](SimulateOptions& o) { o.seed = kMaxSeed + 2; });
    refused([](SimulateOptions& o) { o.threads = -1; });
}

TEST(SimulateGraph, ADeadEndIsRefused) {
    Scene scene = walker_scene();
    MotionGraph graph = *scene.graph;
    graph.hubs.push_back({"ledge"});
    graph.moves[2].to = 1;
    scene.graph = std::make_shared<MotionGraph>(graph);
    const FittedScene fitted(scene, {});
    EXPECT_NE(input_error([&] { simulate(MoveSet(fitted), {}); }).find("hub 'ledge' of the graph is a dead end"),
              std::string::npos);
}

}  // namespace
}  // namespace mobbscope
