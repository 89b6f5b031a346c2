// Choices made again are those of the simulation.
#include "walker_moves.h"

#include <crowd/simulation/choice.h>
#include <crowd/simulation/plan_search.h>
#include <crowd/simulation/simulate.h>

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <utility>

namespace mobbscope {
namespace {

class ChoiceTest : public ::testing::Test {
  protected:
    explicit ChoiceTest(Scene scene = walker_scene()) : fitted(std::move(scene), {}) {}

    const FittedScene fitted;
    const MoveSet moves{fitted};

    Simulation run(std::uint64_t seed, double ahead, double plan = 4) const {
        SimulateOptions options;
        options.agents = 30;
        options.area = {13, 13};
        options.seconds = 20;
        options.seed = seed;
        options.ahead = ahead;
        options.plan = plan;
        return simulate(moves, options);
    }

    /// Makes every choice of a run again, and checks it against the play.
    void expect_same(const Simulation& simulation) const {
        SimulationCounts counts;
        for (int agent = 0; agent < static_cast<int>(simulation.run.agents.size()); ++agent) {
            const std::vector<Play>& plays = simulation.run.agents[static_cast<std::size_t>(agent)].plays;
            for (int i = 1; i < static_cast<int>(plays.size()); ++i) {
                const Choice choice = choice_of(moves, simulation.run, agent, i);
                const Play& play = plays[static_cast<std::size_t>(i)];
                const Candidate& taken = choice.candidates.at(choice.taken);
                ASSERT_EQ(choice.kind, play.kind) << agent << " " << i;
                EXPECT_EQ(choice.time, play.chosen_at);
                EXPECT_TRUE(comes_out_as(play, choice));
                EXPECT_EQ(taken.played, play.move);
                EXPECT_EQ(moves.origin(play.move), (PlannedMove{taken.move, taken.turn_deg}));
                EXPECT_EQ(taken.placement, play.placement);
                EXPECT_EQ(choice.plan, play.plan);
                EXPECT_EQ(taken.leaves_floor || taken.met == Met::play, play.kind == PlayKind::forced);
                if (play.kind != PlayKind::forced) {
                    EXPECT_EQ(taken.turn_deg == 0, play.kind == PlayKind::chosen) << agent << " " << i;
                }
                counts.candidates += static_cast<std::int64_t>(choice.candidates.size());
                counts.queries += choice.queries;
                for (const Candidate& candidate : choice.candidates) {
                    counts.off_floor += candidate.leaves_floor;
                    counts.colliding += !candidate.leaves_floor && candidate.met != Met::nobody;
                    counts.no_way_on += candidate.is_free() && candidate.no_way_on;
                    ASSERT_EQ(candidate.blocker.has_value(), candidate.met != Met::nobody);
                    if (candidate.blocker) {
                        EXPECT_NE(candidate.blocker->agent, agent);
                        EXPECT_EQ(candidate.blocker->planned > 0, candidate.met == Met::plan);
                    }
                }
            }
        }
        EXPECT_EQ(counts.candidates, simulation.counts.candidates);
        EXPECT_EQ(counts.queries, simulation.counts.queries);
        EXPECT_EQ(counts.off_floor, simulation.counts.off_floor);
        EXPECT_EQ(counts.colliding, simulation.counts.colliding);
        EXPECT_EQ(counts.no_way_on, simulation.counts.no_way_on);
    }
};

/// How many choices of a run do not come out as it says.
std::size_t others(const MoveSet& moves, const CrowdRun& run) {
    std::size_t count = 0;
    for (int agent = 0; agent < static_cast<int>(run.agents.size()); ++agent) {
        const std::vector<Play>& plays = run.agents[static_cast<std::size_t>(agent)].plays;
        for (std::size_t i = 1; i < plays.size(); ++i)
            count += !comes_out_as(plays[i], choice_of(moves, run, agent, static_cast<int>(i)));
    }
    return count;
}

TEST_F(ChoiceTest, ChoicesOfAnEditedRunDoNotComeOut) {
    const CrowdRun simulated = run(1, 0).run;
    EXPECT_EQ(others(moves, simulated), 0u);
    CrowdRun edited = simulated;
    edited.seed = 2;
    EXPECT_GT(others(moves, edited), 10u) << "another seed";
    edited = simulated;
    edited.grace = 0;
    EXPECT_GT(others(moves, edited), 0u) << "another grace";
    edited = simulated;
    edited.agents[3].plays[1].kind = PlayKind::forced;
    EXPECT_EQ(others(moves, edited), 1u) << "another kind";
    // Other disks in the same places: what a changed source is.
    Scene wider = walker_scene();
    for (SceneClip& clip : wider.clips) {
        std::vector<mobb::Disk> disks(clip.clip->samples().begin(), clip.clip->samples().end());
        for (mobb::Disk& disk : disks) disk.r *= 1.5;
        clip.clip = std::make_shared<mobb::Clip>(clip.clip->dt(), std::move(disks));
    }
    const FittedScene fitted_wider(wider, {});
    EXPECT_GT(others(MoveSet(fitted_wider), simulated), 0u) << "other sources";
}

/// An agent at the left wall that walks into it, and has so many metres left.
ChoicePoint at_wall(const MoveSet& moves, glm::dvec2 area, double left = 0.7) {
    ChoicePoint point;
    point.agent = 0;
    point.play = 1;
    point.before.placement.rotate_deg = 180;
    const double exit = moves.move(0).exit.position.x;
    point.before.placement.translate = {-area.x / 2 + left + exit, 0};
    point.time = moves.until_next(0);
    return point;
}

TEST_F(ChoiceTest, EveryChoiceOfARunIsMadeAgain) { expect_same(run(1, 0)); }

TEST_F(ChoiceTest, EveryChoiceOfARunWithAHorizonIsMadeAgain) { expect_same(run(2, 3)); }

TEST_F(ChoiceTest, EveryChoiceOfARunWithoutPlansIsMadeAgain) {
    const Simulation simulation = run(1, 0, 0);
    expect_same(simulation);
    EXPECT_EQ(simulation.counts.no_way_on, 0);
}

class LinearChoiceTest : public ChoiceTest {
  protected:
    LinearChoiceTest() : ChoiceTest(with_linear_clips(walker_scene())) {}
};

class MixedChoiceTest : public ChoiceTest {
  protected:
    MixedChoiceTest() : ChoiceTest(with_linear_clips(walker_scene(), 2)) {}
};

TEST_F(LinearChoiceTest, EveryChoiceOfARunIsMadeAgain) { expect_same(run(1, 0)); }
TEST_F(LinearChoiceTest, EveryChoiceOfARunWithAHorizonIsMadeAgain) { expect_same(run(2, 3)); }
TEST_F(LinearChoiceTest, EveryChoiceOfARunWithoutPlansIsMadeAgain) { expect_same(run(1, 0, 0)); }
TEST_F(MixedChoiceTest, EveryChoiceOfARunIsMadeAgain) { expect_same(run(1, 0)); }
TEST_F(MixedChoiceTest, EveryChoiceOfARunWithoutPlansIsMadeAgain) { expect_same(run(3, 0, 0)); }

TEST_F(ChoiceTest, WhatWasPlannedStaysFreeUntilTheNextChoice) {
    for (const double ahead : {0.0, 3.0}) {
        const Simulation simulation = run(3, ahead);
        ASSERT_EQ(simulation.counts.forced, 0);
        EXPECT_GT(simulation.counts.no_way_on, 0);
        int asked = 0;
        for (int agent = 0; agent < 30; ++agent) {
            const std::vector<Play>& plays = simulation.run.agents[static_cast<std::size_t>(agent)].plays;
            for (int i = 1; i < static_cast<int>(plays.size()); ++i) {
                const Play& before = plays[static_cast<std::size_t>(i) - 1];
                if (before.plan.empty()) continue;
                for (const Candidate& candidate : choice_of(moves, simulation.run, agent, i).candidates) {
                    if (candidate.move != before.plan[0].move || candidate.turn_deg != before.plan[0].turn_deg)
                        continue;
                    EXPECT_TRUE(candidate.is_free()) << agent << " " << i;
                    ++asked;
                }
            }
        }
        EXPECT_GT(asked, 100);
    }
}

TEST_F(ChoiceTest, APlanIsRoomThatIsKept) {
    CrowdRun crowd;
    crowd.area = {30, 30};
    crowd.plan = 1;
    ReservationTable reservations(moves, crowd.area, 0);
    ChoicePoint point;
    point.play = 1;
    point.time = moves.until_next(0);
    // Agent 1 ends 3.5 m before agent 0 just then, and plans to go on towards it.
    const double exit = moves.move(0).exit.position.x;
    const Play other{0, {{2 * exit + 3.5, 0}, 180, 0}, 0, PlayKind::chosen, {{0, 0}, {2, 15}}};
    reservations.reserve(1, 0, other);
    const auto met = [&] {
        int planned = 0;
        for (const Candidate& candidate : choice_at(moves, reservations, crowd, point).candidates) {
            EXPECT_NE(candidate.met, Met::play);
            planned += candidate.met == Met::plan;
        }
        return planned;
    };
    EXPECT_GT(met(), 0);
    // Once it has chosen another way the room is free.
    reservations.reserve(1, 1, {0, {{2 * exit + 3.5, 20}, 180, point.time}, point.time, PlayKind::chosen, {}});
    EXPECT_EQ(met(), 0);
}

TEST_F(ChoiceTest, AChoiceHasAPlanThatLastsAsLongAsAsked) {
    CrowdRun crowd;
    crowd.area = {20, 20};
    crowd.plan = 4;
    ReservationTable reservations(moves, crowd.area, crowd.grace);
    const ChoicePoint point = at_wall(moves, crowd.area, 2);
    const Choice choice = choice_at(moves, reservations, crowd, point);
    EXPECT_FALSE(choice.candidates[choice.taken].no_way_on);
    double seconds = 0;
    for (const PlannedMove& next : choice.plan) seconds += moves.until_next(next.move);
    EXPECT_GE(seconds, 4);
    EXPECT_LT(seconds - moves.until_next(choice.plan.back().move), 4);
    // Where the floor leaves no second step the first is taken that there is.
    crowd.area = {2.1, 2.1};
    crowd.grace = 0;
    ReservationTable alone(moves, crowd.area, 0);
    PlanSearch search(moves, alone, crowd);
    search.start(0, 1);
    EXPECT_FALSE(search.look(0, mobb::Placement{{50, 50}, 0, 0}));
    EXPECT_TRUE(search.plan().empty());
}

TEST_F(ChoiceTest, WithinAChoiceEachLookIsTold) {
    // Of a thousand moves one choice may look for minutes.
    CrowdRun crowd;
    crowd.area = {20, 20};
    crowd.plan = 4;
    ReservationTable reservations(moves, crowd.area, crowd.grace);
    int ticks = 0;
    PlanSearch search(moves, reservations, crowd, [&ticks] { ++ticks; });
    const Choice choice = choose(moves, reservations, crowd, at_wall(moves, crowd.area, 2), search);
    EXPECT_GT(ticks, 0);
    EXPECT_EQ(search.looks(), ticks);
    PlanSearch ended(moves, reservations, crowd, [] { throw std::runtime_error("enough"); });
    EXPECT_THROW(choose(moves, reservations, crowd, at_wall(moves, crowd.area, 2), ended), std::runtime_error);
}

TEST_F(ChoiceTest, AFirstPlayWasPlaced) {
    const Simulation simulation = run(1, 0);
    const Choice choice = choice_of(moves, simulation.run, 4, 0);
    ASSERT_EQ(choice.candidates.size(), 1u);
    EXPECT_EQ(choice.candidates[0].placement, simulation.run.agents[4].plays[0].placement);
    EXPECT_TRUE(choice.candidates[0].is_free());
    EXPECT_THROW(choice_of(moves, simulation.run, 30, 0), std::out_of_range);
    EXPECT_THROW(choice_of(moves, simulation.run, -1, 0), std::out_of_range);
    EXPECT_THROW(choice_of(moves, simulation.run, 0, 1000), std::out_of_range);
}

TEST_F(ChoiceTest, AtAWallItTurnsAsLittleAsItMust) {
    CrowdRun crowd;
    crowd.area = {20, 20};
    ReservationTable reservations(moves, crowd.area, crowd.grace);
    const Choice choice = choice_at(moves, reservations, crowd, at_wall(moves, crowd.area, 1.1));
    EXPECT_EQ(choice.kind, PlayKind::pivoted);
    double least = 360;
    for (const Candidate& candidate : choice.candidates) {
        EXPECT_EQ(candidate.met, Met::nobody);
        if (candidate.is_free() && !candidate.in_the_way) least = std::min(least, std::abs(candidate.turn_deg));
    }
    EXPECT_EQ(std::abs(choice.candidates[choice.taken].turn_deg), least);
    EXPECT_FALSE(choice.candidates[choice.taken].in_the_way);
    EXPECT_GT(least, 0);
    // No heading was looked at beyond the one that left a candidate.
    for (const Candidate& candidate : choice.candidates) EXPECT_LE(std::abs(candidate.turn_deg), least);
}

TEST_F(ChoiceTest, RoomIsKeptWhereOthersEnd) {
    CrowdRun crowd;
    crowd.area = {30, 30};
    ChoicePoint point;
    point.play = 1;
    point.time = moves.until_next(0);
    // Agent 1 ends 1.5 m before agent 0, when agent 0 has gone half of its next move; it goes on from there.
    const double exit = moves.move(0).exit.position.x;
    const Play other{0, {{2 * exit + 1.5, 0}, 180, -0.8}, -0.8, PlayKind::chosen};
    for (const double grace : {0.0, 1.0}) {
        ReservationTable reservations(moves, crowd.area, grace);
        reservations.reserve(1, 0, other);
        const Choice choice = choice_at(moves, reservations, crowd, point);
        int in_the_way = 0;
        for (const Candidate& candidate : choice.candidates) {
            if (candidate.turn_deg == 0) in_the_way += candidate.in_the_way;
        }
        EXPECT_EQ(in_the_way > 0, grace > 0);
        EXPECT_FALSE(choice.candidates[choice.taken].in_the_way);
        // Once agent 1 has chosen, its room moves on with it.
        reservations.reserve(1, 1, {0, {{2 * exit + 1.5, 20}, 180, 0.7}, 0.7, PlayKind::chosen});
        for (const Candidate& candidate : choice_at(moves, reservations, crowd, point).candidates) {
            EXPECT_FALSE(candidate.in_the_way);
        }
    }
}

TEST_F(ChoiceTest, WithNobodyFreeTheLeastContactIsForcedAndTheFloorKept) {
    CrowdRun crowd;
    crowd.area = {20, 20};
    ReservationTable reservations(moves, crowd.area, crowd.grace);
    const ChoicePoint point = at_wall(moves, crowd.area, 1.2);
    // Somebody stands all around: slow walkers at the very spot, a little later.
    for (int other = 1; other < 4; ++other) {
        const mobb::Placement at{{-9.3 + 0.2 * other, 0.1 * other}, 90.0 * other, point.time + 0.1 * other};
        reservations.reserve(other, 0, {4, at, 0, PlayKind::chosen});
    }
    const Choice choice = choice_at(moves, reservations, crowd, point);
    ASSERT_EQ(choice.kind, PlayKind::forced);
    const Candidate& taken = choice.candidates[choice.taken];
    EXPECT_FALSE(taken.leaves_floor);
    ASSERT_EQ(taken.met, Met::play);
    const auto seconds = [&](const Candidate& candidate) {
        const PlayedMove motion = moves.motion(0, 1, candidate.played, candidate.placement);
        return reservations.motions().around(motion).contact_times(motion).seconds;
    };
    for (const Candidate& candidate : choice.candidates) {
        EXPECT_FALSE(candidate.is_free());
        if (!candidate.leaves_floor) {
            EXPECT_GE(seconds(candidate), seconds(taken));
        }
    }
}

TEST_F(ChoiceTest, OnNoFloorAtAllTheLeastContactIsStillFound) {
    CrowdRun crowd;
    crowd.area = {0.5, 0.5};
    ReservationTable reservations(moves, crowd.area, crowd.grace);
    const ChoicePoint point = at_wall(moves, crowd.area);
    const Choice choice = choice_at(moves, reservations, crowd, point);
    EXPECT_EQ(choice.kind, PlayKind::forced);
    EXPECT_TRUE(choice.candidates[choice.taken].leaves_floor);
    // In a room of one's own there is none.
    EXPECT_EQ(choice.candidates[choice.taken].met, Met::nobody);
}

}  // namespace
}  // namespace mobbscope
