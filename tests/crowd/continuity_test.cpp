// What changes where moves join, on bodies whose motion is known.
#include "walker_moves.h"
#include "walking_body.h"

#include <crowd/graph/continuity.h>
#include <import/import.h>
#include <scene/crowd_run.h>

#include <gtest/gtest.h>

namespace mobbscope {
namespace {

constexpr int kWalkFrames = 20;
constexpr double kWalkStep = 0.04;  // metres a frame: 1.2 m/s

const LargestRatio& of(const Continuity& continuity, Change change) {
    return continuity.largest[static_cast<std::size_t>(change)];
}

/// A walk straight on into `heading_deg` of its clip.
SceneClip straight(double heading_deg) {
    const glm::dvec2 way(std::cos(radians(heading_deg)), std::sin(radians(heading_deg)));
    return body_clip("straight", kWalkFrames, [=](int i) {
        return BodyFrame{glm::dvec3(2.0 + way.x * kWalkStep * i, -1.0 + way.y * kWalkStep * i, 1.0), heading_deg};
    });
}

std::pair<Stance, Stance> stances_of_straight(double heading_deg, double beyond = 0) {
    const glm::dvec2 way(std::cos(radians(heading_deg)), std::sin(radians(heading_deg)));
    return {{{2, -1}, heading_deg}, {glm::dvec2(2, -1) + way * (kWalkStep * kWalkFrames + beyond), heading_deg}};
}

TEST(Continuity, WhatGoesOnAsBeforeHasRatioOne) {
    const Scene scene = body_scene({straight(30)}, {stances_of_straight(30)});
    const Continuity found = graph_continuity(scene);
    EXPECT_EQ(found.joins, 1u);
    EXPECT_EQ(found.measured, 1u);
    EXPECT_EQ(found.over, 0u);
    EXPECT_NEAR(of(found, Change::joint_position).across, kWalkStep, 1e-6);
    EXPECT_NEAR(of(found, Change::joint_position).ratio, 1, 1e-4);
    EXPECT_NEAR(of(found, Change::heading).ratio, 0, 1e-3);
    EXPECT_NEAR(of(found, Change::root_velocity).across, 0, 1e-5);
    EXPECT_NEAR(of(found, Change::joint_velocity).across, 0, 1e-4);
}

TEST(Continuity, AWalkInACircleGoesOnAsBeforeToo) {
    const double turn = 3;  // degrees a frame
    const double radius = 2;
    const auto place = [&](int i) {
        return glm::dvec3(radius * std::sin(radians(turn * i)), -radius * std::cos(radians(turn * i)), 1);
    };
    const SceneClip circle = body_clip("circle", kWalkFrames, [&](int i) {
        return BodyFrame{place(i), turn * i, {0.3, 0.2, 1.2}};
    });
    const Scene scene =
        body_scene({circle}, {{{glm::dvec2(place(0)), 0}, {glm::dvec2(place(kWalkFrames)), turn * kWalkFrames}}});
    const Continuity found = graph_continuity(scene);
    EXPECT_NEAR(of(found, Change::heading).across, turn, 1e-3);
    for (const Change change :
         {Change::joint_position, Change::heading, Change::root_velocity, Change::joint_velocity}) {
        EXPECT_NEAR(of(found, change).ratio, 1, 1e-3) << static_cast<int>(change);
        EXPECT_EQ(of(found, change).over, 0u);
    }
}

TEST(Continuity, AJumpOfTheWholeBodyIsSeen) {
    const Scene scene = body_scene({straight(30)}, {stances_of_straight(30, 0.1)});
    const Continuity found = graph_continuity(scene);
    EXPECT_EQ(found.over, 1u);
    EXPECT_NEAR(of(found, Change::joint_position).across, kWalkStep + 0.1, 1e-6);
    EXPECT_NEAR(of(found, Change::joint_position).ratio, 3.5, 1e-3);
    EXPECT_NEAR(of(found, Change::root_velocity).across, 0.1 / kBodyDt, 1e-4);
    EXPECT_EQ(of(found, Change::heading).over, 0u);
}

TEST(Continuity, AJumpOfOneJointIsSeenWhateverTheOthersDo) {
    // The hand waves by 0.2 m a frame; the foot of the second walk is 0.1 m higher.
    const auto walk = [](const std::string& name, double foot) {
        return body_clip(name, kWalkFrames, [=](int i) {
            return BodyFrame{{kWalkStep * i, 0, 1}, 0, {0.1, i % 2 * 0.2, 1.2}, {0, 0, foot}};
        });
    };
    const std::pair<Stance, Stance> stances{{{0, 0}, 0}, {{kWalkStep * kWalkFrames, 0}, 0}};
    const Scene scene = body_scene({walk("low", 0), walk("high", 0.1)}, {stances, stances});
    const Continuity found = graph_continuity(scene);
    EXPECT_EQ(found.joins, 4u);
    EXPECT_EQ(found.over, 2u);
    const LargestRatio& position = of(found, Change::joint_position);
    EXPECT_NEAR(position.across, std::hypot(kWalkStep, 0.1), 1e-6);
    EXPECT_NEAR(position.ratio, std::hypot(kWalkStep, 0.1) / kWalkStep, 1e-3);
    EXPECT_EQ(position.joint, 2);
    EXPECT_EQ(position.before, 0);  // of equal ones the first
    EXPECT_EQ(position.after, 1);
    EXPECT_EQ(position.over, 2u);
    EXPECT_EQ(of(found, Change::joint_velocity).joint, 2);
    EXPECT_NEAR(of(found, Change::joint_velocity).across, 0.1 / kBodyDt, 1e-3);
    EXPECT_EQ(joins_over(scene, {{0, 0}, {0, 1}, {1, 0}, {1, 1}}), (std::vector<bool>{false, true, true, false}));
}

TEST(Continuity, ATurnAtAJoinIsSeen) {
    auto [entry, exit] = stances_of_straight(30);
    exit.heading_deg += 20;
    const Continuity found = graph_continuity(body_scene({straight(30)}, {{entry, exit}}));
    EXPECT_NEAR(of(found, Change::heading).across, 20, 1e-3);
    EXPECT_NEAR(of(found, Change::heading).inside, 0.2, 1e-9);  // it never turns, so the least is taken
    EXPECT_EQ(of(found, Change::heading).joint, 0);
    // The first step goes 20 degrees beside the last one.
    EXPECT_NEAR(of(found, Change::root_velocity).across, 2 * kWalkStep / kBodyDt * std::sin(radians(10)), 1e-4);
}

TEST(Continuity, AChangeOfSpeedIsSeenOnEitherSideOfTheStepAcross) {
    const auto walk = [](const std::string& name, double step) {
        return body_clip(name, kWalkFrames, [=](int i) { return BodyFrame{{step * i, 0, 1}}; });
    };
    const double fast = 0.1;  // metres a frame
    for (const double across : {kWalkStep, fast}) {
        const Scene scene = body_scene({walk("slow", kWalkStep), walk("fast", fast)},
                                       {{{{0, 0}, 0}, {{kWalkStep * (kWalkFrames - 1) + across, 0}, 0}},
                                        {{{0, 0}, 0}, {{fast * kWalkFrames, 0}, 0}}});
        EXPECT_TRUE(joins_over(scene, {{0, 1}}).front());
        const Continuity found = graph_continuity(scene);
        EXPECT_NEAR(of(found, Change::root_velocity).across, (fast - kWalkStep) / kBodyDt, 1e-4);
        EXPECT_NEAR(of(found, Change::joint_position).ratio, across == fast ? 2.5 : 1, 1e-3);
    }
}

TEST(Continuity, WhatChangesLessThanTheLeastIsNoJump) {
    const SceneClip still = body_clip("still", kWalkFrames, [](int) { return BodyFrame{}; });
    const Continuity found = graph_continuity(body_scene({still}, {{{{0, 0}, 0}, {{0.002, 0}, 0.1}}}));
    EXPECT_NEAR(of(found, Change::joint_position).ratio, 1, 1e-3);
    EXPECT_NEAR(of(found, Change::heading).ratio, 0.5, 1e-2);
    EXPECT_NEAR(of(found, Change::root_velocity).ratio, 0.002 / kBodyDt / 0.02, 1e-2);
}

TEST(Continuity, OnlyMovesWithOneSkeletonAndOneRateAreCompared) {
    SceneClip other = straight(0);
    auto renamed = std::make_shared<Skeleton>(*other.skeleton);
    renamed->joints[2].name = "Paw";
    other.skeleton = renamed;
    SceneClip bare = straight(0);
    bare.skeleton = nullptr;
    const SceneClip quick = body_clip(
        "quick", kWalkFrames,
        [](int i) {
            return BodyFrame{{kWalkStep * i, 0, 1}};
        },
        0.01);
    const auto stances = stances_of_straight(0);
    const Scene scene =
        body_scene({straight(0), other, bare, quick}, {stances, stances, stances, {{{0, 0}, 0}, {{0.8, 0}, 0}}});
    const Continuity found = graph_continuity(scene);
    EXPECT_EQ(found.joins, 16u);
    EXPECT_EQ(found.measured, 3u);  // each with itself
    EXPECT_EQ(found.over, 0u);
    EXPECT_EQ(graph_continuity(body_scene({bare}, {stances})).measured, 0u);
}

TEST(Continuity, MovesOfFewFramesHaveJoinsToo) {
    for (const int frames : {1, 2}) {
        const SceneClip brief = body_clip("brief", frames, [](int i) { return BodyFrame{{kWalkStep * i, 0, 1}}; });
        const Continuity found = graph_continuity(body_scene({brief}, {{{{0, 0}, 0}, {{kWalkStep * frames, 0}, 0}}}));
        EXPECT_EQ(found.measured, 1u);
        EXPECT_NEAR(of(found, Change::joint_position).across, kWalkStep, 1e-6);
        EXPECT_NEAR(of(found, Change::root_velocity).across, 0, 1e-5);
    }
}

/// Plays of move 0 one behind the other; kinds and turns are those of the plays from the second on.
CrowdAgent agent_of(const Scene& scene, const std::vector<std::pair<PlayKind, double>>& plays) {
    CrowdAgent agent{"1", {Play{}}};
    agent.plays.front().placement = {{3, -4}, 100, 0};
    for (const auto& [kind, turn_deg] : plays) {
        Play play;
        play.kind = kind;
        play.placement = following(scene, 0, agent.plays.back().placement, 0);
        play.placement.rotate_deg = play.placement.rotate_deg + turn_deg;
        agent.plays.push_back(play);
    }
    return agent;
}

TEST(Continuity, OfARunJoinsAreCountedAsPlayedAndForcedOnesApart) {
    Scene scene = body_scene({straight(30)}, {stances_of_straight(30)});
    CrowdRun run;
    run.agents = {agent_of(scene, {{PlayKind::chosen, 0}, {PlayKind::chosen, 0}, {PlayKind::forced, -90}}),
                  agent_of(scene, {{PlayKind::pivoted, 15}, {PlayKind::chosen, 0}, {PlayKind::forced, 0}})};
    scene.crowd = std::make_shared<const CrowdRun>(run);
    Importer importer;
    const RunContinuity found = run_continuity(scene, importer);
    EXPECT_EQ(found.free.joins, 4u);
    EXPECT_EQ(found.free.different, 2u);
    EXPECT_EQ(found.free.over, 1u);
    EXPECT_NEAR(of(found.free, Change::heading).across, 15, 1e-3);
    EXPECT_NEAR(of(found.free, Change::joint_position).across, kWalkStep, 1e-6);  // it turns on the spot
    EXPECT_EQ(found.forced.joins, 2u);
    EXPECT_EQ(found.forced.over, 1u);
    EXPECT_NEAR(of(found.forced, Change::heading).across, 90, 1e-3);
}

}  // namespace
}  // namespace mobbscope
