// Moves that turn on the way: how fast, what stands in a run, and what is forced.
#include "walker_moves.h"

#include <crowd/simulation/choice.h>
#include <crowd/simulation/simulate.h>
#include <scene/clip_turn.h>
#include <scene/crowd_run.h>
#include <scene/motion_graph.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <vector>

namespace mobbscope {
namespace {

SimulateOptions turning_crowd() {
    SimulateOptions options;
    options.agents = 30;
    options.area = {13, 13};
    options.seconds = 20;
    return options;
}

/// Degrees that a step of a clip is turned by beside the same one of another.
double step_turned_by(const mobb::Clip& turned, const mobb::Clip& from, std::size_t i) {
    const auto heading = [&](const mobb::Clip& clip) {
        const mobb::Disk& a = clip.samples()[i];
        const mobb::Disk& b = clip.samples()[i + 1];
        return heading_of({b.x - a.x, b.y - a.y});
    };
    return std::remainder(heading(turned) - heading(from), 360.0);
}

TEST(TurnedMoves, NoneIsFasterThanTheRateAllows) {
    const FittedScene fitted(walker_scene(), {});
    for (const double rate : {40.0, 120.0, 500.0}) {
        const MoveSet moves(fitted, rate);
        EXPECT_GT(moves.count(), moves.unturned().size());
        for (int move = 0; move < static_cast<int>(moves.count()); ++move) {
            const PlannedMove& origin = moves.origin(move);
            const mobb::Clip& clip = moves.clip(move).clip();
            const mobb::Clip& from = moves.clip(origin.move).clip();
            ASSERT_EQ(clip.count(), from.count());
            double last = 0;
            for (std::size_t i = 0; i + 1 < clip.samples().size(); ++i) {
                const double now = step_turned_by(clip, from, i);
                const double change = std::abs(std::remainder(now - last, 360.0));
                // The first step is turned by what half a step has come to.
                ASSERT_LE(change, rate * clip.dt() * (i == 0 ? 0.5 : 1) + 1e-6) << move << " " << i;
                last = now;
                EXPECT_EQ(clip.samples()[i].r, from.samples()[i].r);
            }
            EXPECT_NEAR(std::remainder(last - origin.turn_deg, 360.0), 0, 1) << "it has turned where it ends";
            EXPECT_EQ(moves.exit(move).heading_deg, moves.exit(origin.move).heading_deg + origin.turn_deg);
        }
    }
    EXPECT_THROW(MoveSet(fitted, -1), std::invalid_argument);
    EXPECT_THROW(MoveSet(fitted, kMaxTurnRate + 1), std::invalid_argument);
    EXPECT_EQ(MoveSet(fitted, 0).count(), fitted.scene().graph->moves.size());
}

TEST(TurnedMoves, TheRoomAfterAMoveHoldsAllThatMayFollow) {
    const FittedScene fitted(walker_scene(), {});
    for (const double rate : {0.0, 120.0, kTurnsAtOnce}) {
        const MoveSet moves(fitted, rate);
        for (int i = 0; i < 36; ++i) {
            const int before = i % static_cast<int>(moves.count());
            const mobb::Placement at{{40.0 * i - 700, 3.0 * i}, 37.0 * i, 11.0 * i - 100};
            const auto holds = [](const MoveSet::Room& room, const FloorRect& rect) {
                return room.bounds.low.x <= rect.low.x && room.bounds.low.y <= rect.low.y &&
                       room.bounds.high.x >= rect.high.x && room.bounds.high.y >= rect.high.y;
            };
            std::size_t known = 0;
            for (const MoveSet::FollowerGroup& group : moves.followers(before)) {
                const double angle = std::abs(group.moves.front().planned.turn_deg);
                for (const MoveSet::Room& room :
                     {moves.room_after(before, at, group.room), moves.room_after(before, at, angle)}) {
                    for (const MoveSet::Follower& next : group.moves) {
                        const PlayedMove motion =
                            moves.motion(0, 1, next.played, moves.following(before, at, next.planned));
                        const glm::dvec2 end =
                            end_of(motion.at, moves.exit(next.played), moves.until_next(next.played)).position;
                        EXPECT_TRUE(holds(room, motion.bounds));
                        EXPECT_TRUE(holds(room, {end - next.last.r, end + next.last.r}));
                        EXPECT_LT(room.begin, motion.begin());
                        EXPECT_GT(room.end, motion.end());
                    }
                }
                known += group.moves.size();
            }
            EXPECT_GE(known, moves.after(before).size());
        }
    }
}

TEST(TurnedMoves, ARunHoldsThoseThatArePlayedAndIsReadAgain) {
    const FittedScene fitted(walker_scene(), {});
    const MoveSet moves(fitted);
    SimulateOptions options = turning_crowd();
    options.threads = 1;
    const Simulation simulation = simulate(moves, options);
    ASSERT_GT(simulation.counts.pivots, 20);
    const Scene run = scene_of_run(moves, simulation.run);
    const std::size_t unturned = fitted.scene().graph->moves.size();
    std::vector<int> played(run.graph->moves.size(), 0);
    for (const CrowdAgent& agent : run.crowd->agents) {
        for (const Play& play : agent.plays) ++played[static_cast<std::size_t>(play.move)];
    }
    EXPECT_GT(played.size(), unturned);
    EXPECT_EQ(std::count(played.begin() + static_cast<std::ptrdiff_t>(unturned), played.end(), 0), 0);
    // Reading checks every joint: place, heading and time.
    const std::string text = to_json(run);
    const Scene again = parse_scene(text, "run.json", "");
    EXPECT_EQ(*again.crowd, *run.crowd);
    EXPECT_EQ(*again.graph, *run.graph);
    // Choices of the file are made again from the moves that it holds.
    const FittedScene fitted_again(again, {});
    const MoveSet of_file(fitted_again);
    for (int agent = 0; agent < 10; ++agent) {
        const std::vector<Play>& plays = again.crowd->agents[static_cast<std::size_t>(agent)].plays;
        for (std::size_t i = 1; i < plays.size(); ++i)
            EXPECT_TRUE(comes_out_as(plays[i], choice_of(of_file, *again.crowd, agent, static_cast<int>(i))));
    }
    for (const int threads : {2, 7}) {
        options.threads = threads;
        EXPECT_EQ(to_json(scene_of_run(moves, simulate(moves, options).run)), text);
    }
    Scene bare = again;
    remove_run(bare);
    EXPECT_EQ(*bare.graph, *fitted.scene().graph);
    EXPECT_EQ(bare.clips.size(), fitted.scene().clips.size());
    EXPECT_FALSE(bare.crowd);
}

TEST(TurnedMoves, NobodyJumpsInAFileThatHasATurnRate) {
    const FittedScene fitted(walker_scene(), {});
    const MoveSet moves(fitted);
    Scene run = scene_of_run(moves, simulate(moves, turning_crowd()).run);
    CrowdRun edited = *run.crowd;
    Play& play = edited.agents[0].plays.back();
    play.kind = PlayKind::pivoted;
    play.placement.rotate_deg = play.placement.rotate_deg + 15;
    run.crowd = std::make_shared<const CrowdRun>(edited);
    EXPECT_THROW(parse_scene(to_json(run), "run.json", ""), InputError);
}

TEST(TurnedMoves, OfSamplesThatAreHardlyApartSomeRadiusIsTurned) {
    Scene scene;
    scene.clips = {walk("blink", 1.4, 0, 3, 3e-9, 0.4)};
    scene.graph = std::make_shared<MotionGraph>(graph_of_whole_clips(scene));
    const FittedScene fitted(scene, {});
    const std::optional<double> radius = MoveSet(fitted, kDefaultTurnRate).turning_radius(0);
    ASSERT_TRUE(radius);
    EXPECT_NEAR(*radius, 1.4 * 1.5 / (kDefaultTurnRate * 3.14159265358979 / 180), 1e-6);
}

TEST(TurnedMoves, WhatIsForcedHarmsForTheFewestSeconds) {
    const auto still = [](int samples) {
        return std::make_shared<mobb::Clip>(1.0 / 30,
                                            std::vector<mobb::Disk>(static_cast<std::size_t>(samples), {0, 0, 0.4}));
    };
    Scene scene;
    scene.clips = {walk("ahead", 1.4, 0, 45, 1.0 / 30, 0.4),
                   walk("aside", 1.4, 0, 45, 1.0 / 30, 0.4),
                   {"stand", {}, {}, still(45)},
                   {"blink", {}, {}, still(6)}};
    MotionGraph graph;
    graph.hubs = {{"walk"}, {"stand"}};
    // The second one walks to the left of what it is laid on.
    graph.moves = {{0, 0, 0, {{0, 0}, 0}, {{2.1, 0}, 0}},
                   {1, 0, 0, {{0, 0}, -90}, {{2.1, 0}, -90}},
                   {2, 1, 1, {{0, 0}, 0}, {{0, 0}, 0}},
                   {3, 1, 1, {{0, 0}, 0}, {{0, 0}, 0}}};
    scene.graph = std::make_shared<const MotionGraph>(graph);
    const FittedScene fitted(scene, {});
    const MoveSet moves(fitted, 0);
    CrowdRun crowd;
    crowd.area = {20, 20};
    ReservationTable reservations(moves, crowd.area, 0);
    ChoicePoint point;
    point.play = 1;
    point.before.placement = {{-2.1, 0}, 0, -1.5};
    // Two stand where the way ahead ends, which is met late and for long; one is beside for a moment, early.
    reservations.reserve(1, 0, {2, {{2.1, 0.3}, 0, 0}, 0});
    reservations.reserve(2, 0, {2, {{2.1, -0.3}, 0, 0}, 0});
    reservations.reserve(3, 0, {3, {{0, 0.9}, 0, 0.4}, 0});
    const Choice choice = choice_at(moves, reservations, crowd, point);
    ASSERT_EQ(choice.kind, PlayKind::forced);
    ASSERT_EQ(choice.candidates.size(), 2u);
    const auto first_contact = [&](const Candidate& candidate) {
        const PlayedMove motion = moves.motion(0, 1, candidate.played, candidate.placement);
        return reservations.motions().around(motion).contact_times(motion).first;
    };
    EXPECT_GT(first_contact(choice.candidates[0]), first_contact(choice.candidates[1]));
    EXPECT_EQ(choice.candidates[choice.taken].move, 1);
}

TEST(TurnedMoves, WhoStandsInFrontOfAWallTurnsAway) {
    Scene scene;
    scene.clips = {walk("stand", 0, 0, 30, 1.0 / 30, 0.3), walk("ahead", 1.2, 0, 60, 1.0 / 30, 0.3)};
    scene.graph = std::make_shared<MotionGraph>(graph_of_whole_clips(scene));
    const FittedScene fitted(scene, {});
    const MoveSet moves(fitted, 120);
    CrowdRun crowd;
    crowd.area = {12, 12};
    const ReservationTable reservations(moves, crowd.area, 1);
    const auto taken_after = [&](int move, double plan) {
        crowd.plan = plan;
        ChoicePoint point;
        point.play = 1;
        // Ends at (4.5, 0), with the wall a metre and a half ahead.
        point.before.move = move;
        point.before.placement = {{move == 0 ? 4.5 : 4.5 - 2.4, 0}, 0, move == 0 ? -1.0 : -2.0};
        const Choice choice = choice_at(moves, reservations, crowd, point);
        const Candidate& taken = choice.candidates[choice.taken];
        return std::tuple(choice.kind, taken.move, taken.turn_deg != 0);
    };
    EXPECT_EQ(taken_after(0, 4), std::tuple(PlayKind::pivoted, 1, true));
    EXPECT_EQ(taken_after(1, 4), std::tuple(PlayKind::chosen, 0, false)) << "who comes walking may stand";
    EXPECT_EQ(taken_after(0, 0), std::tuple(PlayKind::chosen, 0, false)) << "nor does the paper's crowd go first";
}

}  // namespace
}  // namespace mobbscope
