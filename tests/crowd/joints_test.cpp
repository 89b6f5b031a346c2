// Between two plays of which the first is linear the agent runs on: it is there, and others keep clear of it.
#include "walker_moves.h"

#include <conflicts/conflicts.h>
#include <conflicts/crowd.h>
#include <crowd/simulation/choice.h>
#include <crowd/simulation/simulate.h>
#include <mobb/placed_chain.h>
#include <mobb/traversal.h>
#include <mobb_tracks/crowds.h>
#include <scene/crowd_scene.h>
#include <scene/drawn_agent.h>
#include <scene/view_state.h>

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace mobbscope {
namespace {

const mobb::Clip& clip_of_play(const Scene& run, const Play& play) {
    return *run.clips[static_cast<std::size_t>(run.graph->moves[static_cast<std::size_t>(play.move)].clip)].clip;
}

/// Runs of linear clips, and of held and linear ones.
struct RunOfJoints {
    const char* name;
    std::size_t every;  ///< which clips are linear
    double plan, ahead, turn_rate;
    bool one_dt = false;
    bool is_coarse = false;  ///< a joint is a quarter of a move
};

class JointsOfARun : public ::testing::TestWithParam<RunOfJoints> {
  protected:
    Scene run_of(std::uint64_t seed) const {
        Scene scene = walker_scene();
        if (GetParam().is_coarse) {
            scene.clips = {walk("ahead", 1.4, 0, 4, 0.4, 0.3), walk("left", 1.2, 60, 4, 0.4, 0.3),
                           walk("right", 1.2, -60, 4, 0.4, 0.3), walk("around", 0.9, 150, 6, 0.4, 0.3)};
        } else if (GetParam().one_dt) {
            scene.clips = {scene.clips[0], scene.clips[1], scene.clips[2], scene.clips[4]};
        }
        scene.graph = std::make_shared<MotionGraph>(graph_of_whole_clips(scene));
        SimulateOptions options;
        options.agents = 20;
        options.area = {9, 9};
        options.seconds = 12;
        options.plan = GetParam().plan;
        options.ahead = GetParam().ahead;
        options.seed = seed;
        const FittedScene fitted(with_linear_clips(std::move(scene), GetParam().every), {});
        const MoveSet moves(fitted, GetParam().turn_rate);
        return scene_of_run(moves, simulate(moves, options).run);
    }
};

INSTANTIATE_TEST_SUITE_P(, JointsOfARun,
                         ::testing::Values(RunOfJoints{"Linear", 1, 0, 0, 120}, RunOfJoints{"Planned", 1, 3, 0, 120},
                                           RunOfJoints{"Mixed", 2, 0, 0, 120}, RunOfJoints{"Ahead", 3, 2, 1, 120},
                                           RunOfJoints{"OneStep", 1, 0, 0, 120, true},
                                           RunOfJoints{"MixedOfOneStep", 2, 0, 0, 120, true},
                                           RunOfJoints{"Coarse", 1, 0, 0, 120, true, true},
                                           RunOfJoints{"CoarseAndPlanned", 1, 3, 0, 120, true, true},
                                           RunOfJoints{"CoarseAndMixed", 2, 0, 0, 120, true, true},
                                           RunOfJoints{"CoarseTurningAtOnce", 1, 0, 0, kTurnsAtOnce, true, true},
                                           RunOfJoints{"TurningAtOnce", 1, 0, 0, kTurnsAtOnce, true}),
                         [](const auto& tested) { return tested.param.name; });

TEST_P(JointsOfARun, SomebodyIsThereFromTheFirstPlayToTheLast) {
    const FittedScene fitted(run_of(1), {});
    const CrowdRun& run = *fitted.scene().crowd;
    const auto people_at = [&](double time) {
        ViewState view;
        view.time = time;
        view.show = Show::moment;
        const FittedScene moment = fitted_at(fitted, view);
        std::set<int> out;
        for (const DrawnAgent& agent : drawn_agents(moment, view)) {
            if (!sample_at(agent, time)) continue;
            EXPECT_TRUE(out.insert(agent.run_agent).second) << "twice at " << time;
        }
        return out.size();
    };
    for (int i = 0; i < 50; ++i) EXPECT_EQ(people_at(0.237 * i), run.agents.size());
    for (const CrowdAgent& agent : std::span(run.agents).first(6)) {
        for (std::size_t i = 1; i < agent.plays.size(); ++i) {
            const double next = agent.plays[i].placement.start;
            const double dt = clip_of_play(fitted.scene(), agent.plays[i - 1]).dt();
            if (next < dt || next >= run.seconds) continue;
            for (const double before : {0.999, 0.5, 0.001, 0.0})
                EXPECT_EQ(people_at(next - before * dt), run.agents.size()) << agent.name << " before play " << i;
        }
    }
}

TEST_P(JointsOfARun, ADrawnAgentRunsOnToItsNextPlay) {
    const FittedScene fitted(run_of(2), {});
    const Scene& run = fitted.scene();
    int joints = 0;
    for (int person = 0; person < 5; ++person) {
        const std::vector<Play>& plays = run.crowd->agents[static_cast<std::size_t>(person)].plays;
        for (std::size_t i = 1; i < plays.size(); ++i) {
            const mobb::PlacedClip before(clip_of_play(run, plays[i - 1]), plays[i - 1].placement);
            const mobb::PlacedClip next(clip_of_play(run, plays[i]), plays[i].placement);
            ViewState view;
            view.time = plays[i].placement.start - 0.25 * before.dt();
            view.show = Show::moment;
            if (*view.time < 0) continue;
            const FittedScene moment = fitted_at(fitted, view);
            const std::vector<DrawnAgent> drawn = drawn_agents(moment, view);
            const DrawnAgent& agent = drawn[static_cast<std::size_t>(person)];
            const std::optional<int> sample = sample_at(agent, *view.time);
            ASSERT_TRUE(sample);
            EXPECT_EQ(*sample, before.count() - 1) << "its skeleton stays in its last pose";
            const mobb::Disk found = mobb::swept(agent.clip(), *sample).at(*view.time);
            const mobb::Disk from = before.disk(before.count() - 1);
            const mobb::Disk to = before.is_linear() && next.is_linear() ? next.disk(0) : from;
            EXPECT_NEAR(found.x, 0.25 * from.x + 0.75 * to.x, 1e-9);
            EXPECT_NEAR(found.y, 0.25 * from.y + 0.75 * to.y, 1e-9);
            EXPECT_NEAR(found.r, 0.25 * from.r + 0.75 * to.r, 1e-9);
            joints += before.is_linear() ? 1 : 0;
        }
    }
    EXPECT_GT(joints, 5);
}

TEST_P(JointsOfARun, PlaysAreChosenBeforeTheirJoints) {
    const Scene run = run_of(3);
    for (const CrowdAgent& agent : run.crowd->agents) {
        EXPECT_LE(agent.plays.front().placement.start, 0);
        for (std::size_t i = 1; i < agent.plays.size(); ++i) {
            const mobb::Clip& before = clip_of_play(run, agent.plays[i - 1]);
            const double begin = agent.plays[i - 1].placement.start;
            const Play& play = agent.plays[i];
            EXPECT_NEAR(play.placement.start, begin + before.until_next(), 1e-9);
            EXPECT_NEAR(play.chosen_at, std::max(0.0, begin + before.duration() - run.crowd->ahead), 1e-9);
        }
        const Play& last = agent.plays.back();
        EXPECT_GE(last.placement.start + clip_of_play(run, last).duration(), run.crowd->seconds) << "it is there still";
    }
}

/// Pairs of people who collide, of a scene of people.
std::set<std::pair<int, int>> pairs_of(const Scene& people, bool direct) {
    std::vector<int> person_of;
    for (const Agent& who : people.agents) person_of.push_back(who.run_agent);
    mobb::ConflictSearch search;
    search.direct = direct;
    std::set<std::pair<int, int>> out;
    for (const mobb::PeopleConflict& found : mobb::test::all_of({Crowd(people).placed(), person_of, search}))
        out.emplace(found.a, found.b);
    return out;
}

TEST_P(JointsOfARun, OnlyForcedPlaysAndTheirJointsCollide) {
    int forced = 0;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const FittedScene fitted(run_of(seed), {});
        const CrowdRun& run = *fitted.scene().crowd;
        // What was forced may be met by what was chosen before it alone.
        const auto is_forced = [&](const PlacedAgent& who, int play) {
            return run.agents[static_cast<std::size_t>(who.agent)].plays[static_cast<std::size_t>(play)].kind ==
                   PlayKind::forced;
        };
        std::set<std::pair<int, int>> found;
        for (const SceneConflict& conflict : conflicts_in(fitted.scene())) {
            found.emplace(conflict.facts.a, conflict.facts.b);
            EXPECT_TRUE(is_forced(conflict.a, conflict.a_play) || is_forced(conflict.b, conflict.b_play))
                << conflict.a.name << " and " << conflict.b.name << " at " << conflict.begin();
        }
        // The same as of people each of whose plays are one clip.
        const Scene people = scene_of_people(fitted.scene());
        EXPECT_EQ(pairs_of(people, false), found);
        EXPECT_EQ(pairs_of(people, true), found);
        for (const CrowdAgent& agent : run.agents)
            for (const Play& play : agent.plays) forced += play.kind == PlayKind::forced ? 1 : 0;
    }
    EXPECT_TRUE(forced > 0 || GetParam().plan > 0);
}

TEST_P(JointsOfARun, ConflictsAreThoseOfChains) {
    if (!GetParam().one_dt) GTEST_SKIP() << "a chain has one dt";
    const FittedScene fitted(run_of(4), {});
    const Scene& run = fitted.scene();
    std::vector<mobb::ChainPartPtr> parts;
    for (std::size_t i = 0; i < run.clips.size(); ++i)
        parts.push_back(std::make_shared<const mobb::ChainPart>(fitted.shared_tree(static_cast<int>(i))));
    std::vector<mobb::Chain> chains;
    std::vector<double> begins;
    for (const CrowdAgent& agent : run.crowd->agents) {
        std::vector<mobb::ChainLink> links;
        for (const Play& play : agent.plays) {
            const int clip = run.graph->moves[static_cast<std::size_t>(play.move)].clip;
            links.push_back(
                {parts[static_cast<std::size_t>(clip)], play.placement.translate, play.placement.rotate_deg});
        }
        chains.emplace_back(links);
        begins.push_back(agent.plays.front().placement.start);
    }
    std::set<std::pair<int, int>> expected;
    for (std::size_t a = 0; a < chains.size(); ++a) {
        for (std::size_t b = a + 1; b < chains.size(); ++b) {
            const mobb::PlacedChain one(chains[a], {{0, 0}, 0, begins[a]});
            const mobb::PlacedChain other(chains[b], {{0, 0}, 0, begins[b]});
            if (mobb::direct_search(one, other)) expected.emplace(static_cast<int>(a), static_cast<int>(b));
        }
    }
    EXPECT_TRUE(!expected.empty() || GetParam().plan > 0);
    EXPECT_EQ(pairs_of(scene_of_people(run), true), expected);
}

/// Steps of 1 m in 0.5 s: "ahead" goes 4 m, and its joint from 3 m to 4 m takes from 1.5 s to 2 s. "wide" begins with a
/// larger disk. "post" stands for 0.3 s. One hub, and "post" leads nowhere that the others come from.
Scene post_scene(mobb::Motion motion = mobb::Motion::linear, double wide = 0.5) {
    Scene scene;
    scene.clips = {walk("ahead", 2, 0, 4, 0.5, 0.1), walk("wide", 2, 0, 4, 0.5, 0.1)};
    for (std::size_t i = 0; i < 2; ++i) {
        std::vector<mobb::Disk> disks;
        for (int x = 0; x < 4; ++x) disks.push_back({static_cast<double>(x), 0, x == 0 && i == 1 ? wide : 0.1});
        scene.clips[i].clip = std::make_shared<const mobb::Clip>(0.5, disks, motion);
    }
    scene.clips.push_back(
        {"post", {}, {}, std::make_shared<const mobb::Clip>(0.3, std::vector<mobb::Disk>{{0, 0, 0.1}})});
    MotionGraph graph;
    graph.hubs = {{"walking"}, {"standing"}};
    graph.moves = {
        {0, 0, 0, {{0, 0}, 0}, {{4, 0}, 0}}, {1, 0, 0, {{0, 0}, 0}, {{4, 0}, 0}}, {2, 1, 1, {{0, 0}, 0}, {{0, 0}, 0}}};
    scene.graph = std::make_shared<const MotionGraph>(graph);
    return scene;
}

/// The post, at a place and time.
Play post(glm::dvec2 at, double start) { return {2, {at, 0, start}, 0}; }

/// Whom candidates meet that follow "ahead", which began at the origin: by move; nobody turns.
std::vector<Met> met_after_ahead(const Scene& scene, const std::vector<std::vector<Play>>& others) {
    const FittedScene fitted(scene, {});
    const MoveSet moves(fitted, 0);
    CrowdRun run;
    run.area = {100, 100};
    run.grace = 0;
    ReservationTable reservations(moves, run.area, 0);
    for (std::size_t other = 0; other < others.size(); ++other) {
        for (std::size_t play = 0; play < others[other].size(); ++play)
            reservations.reserve(static_cast<int>(other) + 1, static_cast<int>(play), others[other][play]);
    }
    const ChoicePoint point{0, 1, {0, {}, 0}, moves.until_joint(0)};
    std::vector<Met> out;
    for (const Candidate& candidate : choice_at(moves, reservations, run, point).candidates)
        out.push_back(candidate.met);
    return out;
}

const std::vector<Met> kBothMeet{Met::play, Met::play};
const std::vector<Met> kNobodyMeets{Met::nobody, Met::nobody};

TEST(Joints, WhoStandsWhereOnlyTheJointPassesBlocksTheCandidate) {
    const Scene linear = post_scene();
    EXPECT_EQ(met_after_ahead(linear, {}), kNobodyMeets);
    EXPECT_EQ(met_after_ahead(linear, {{post({3.5, 0}, 1.6)}}), kBothMeet);
    EXPECT_EQ(met_after_ahead(linear, {{post({3.5, 0}, 1.1)}}), kNobodyMeets) << "gone before the joint is there";
    EXPECT_EQ(met_after_ahead(linear, {{post({2.5, 0}, 1.6)}}), kNobodyMeets) << "behind it";
    EXPECT_EQ(met_after_ahead(linear, {{post({3.5, 0.35}, 1.6)}}), (std::vector{Met::nobody, Met::play}))
        << "one widens to the first disk of the next move";
    // Held, the last disk stays where it is.
    EXPECT_EQ(met_after_ahead(post_scene(mobb::Motion::held), {{post({3.5, 0}, 1.6)}}), kNobodyMeets);
}

TEST(Joints, WhereAHeldMoveFollowsTheLastDiskStays) {
    Scene scene = post_scene();
    const mobb::Clip& linear = *scene.clips[1].clip;
    scene.clips[1].clip = std::make_shared<const mobb::Clip>(
        linear.dt(), std::vector<mobb::Disk>(linear.samples().begin(), linear.samples().end()));
    EXPECT_EQ(met_after_ahead(scene, {{post({3.5, 0}, 1.6)}}), (std::vector{Met::play, Met::nobody}));
    EXPECT_EQ(met_after_ahead(scene, {{post({3.1, 0}, 1.6)}}), (std::vector{Met::play, Met::play}));
}

TEST(Joints, OfOthersTheyAreReserved) {
    // Somebody crosses from (3.5, -3.5) to (3.5, 4.5): only the joint of the two plays passes where ours does then.
    const Play first{0, {{3.5, -3.5}, 90, 0}, 0}, second{0, {{3.5, 0.5}, 90, 2}, 1.5};
    const Scene scene = post_scene(mobb::Motion::linear, 0.1);
    EXPECT_EQ(met_after_ahead(scene, {{first, second}}), kBothMeet);
    EXPECT_EQ(met_after_ahead(scene, {{first}}), kNobodyMeets);
    EXPECT_EQ(met_after_ahead(scene, {{second}}), kNobodyMeets);
    Play planned = first;
    planned.plan = {{0, 0}};
    EXPECT_EQ(met_after_ahead(scene, {{planned}}), (std::vector{Met::plan, Met::plan}));
}

TEST(Joints, APlanIsTestedOnThem) {
    const FittedScene fitted(post_scene(), {});
    const MoveSet moves(fitted, 0);
    CrowdRun run;
    run.area = {100, 100};
    run.grace = 0;
    run.plan = 4;
    const auto seconds = [&](const std::optional<Play>& other) {
        ReservationTable reservations(moves, run.area, 0);
        if (other) reservations.reserve(1, 0, *other);
        PlanSearch search(moves, reservations, run);
        search.start(0, 0);
        const bool found = search.look(0, {});
        EXPECT_EQ(found, search.seconds() >= 4);
        return search.seconds();
    };
    EXPECT_EQ(seconds({}), 4);
    EXPECT_EQ(seconds(post({3.5, 0}, 1.6)), 0);
    EXPECT_EQ(seconds(post({7.5, 0}, 3.6)), 2);
    EXPECT_EQ(seconds(post({11.5, 0}, 5.6)), 4) << "behind all that was asked for";
}

TEST(Joints, TheirContactIsHarm) {
    // Both meet the second post as long as each other; "wide" meets the first one too, in its joint.
    const FittedScene fitted(post_scene(), {});
    const MoveSet moves(fitted, 0);
    CrowdRun run;
    run.area = {100, 100};
    run.grace = 0;
    for (run.seed = 1; run.seed <= 8; ++run.seed) {
        ReservationTable reservations(moves, run.area, 0);
        reservations.reserve(1, 0, post({3.5, 0.35}, 1.6));
        reservations.reserve(2, 0, post({6.5, 0}, 3.1));
        const ChoicePoint point{0, 1, {0, {}, 0}, 1.5};
        const Choice choice = choice_at(moves, reservations, run, point);
        EXPECT_EQ(choice.kind, PlayKind::forced);
        EXPECT_EQ(choice.candidates[choice.taken].move, 0) << "seed " << run.seed;
    }
}

TEST(Joints, AChoiceMadeAgainTellsWhoIsMetOnThem) {
    Scene scene = post_scene();
    CrowdRun run;
    run.area = {100, 100};
    run.grace = 0;
    run.turn_rate = 0;
    run.agents = {{"walker", {{0, {}, 0}, {0, {{4, 0}, 0, 2}, 1.5}}}, {"post", {post({3.5, 0}, 1.6)}}};
    scene.crowd = std::make_shared<const CrowdRun>(run);
    const FittedScene fitted(scene, {});
    const MoveSet moves(fitted);
    const Choice choice = choice_of(moves, run, 0, 1);
    ASSERT_EQ(choice.candidates.size(), 2u);
    for (const Candidate& candidate : choice.candidates) {
        ASSERT_TRUE(candidate.blocker);
        ASSERT_TRUE(candidate.joint);
        EXPECT_TRUE(candidate.blocker->before_candidate);
        EXPECT_FALSE(candidate.blocker->is_joint);
        EXPECT_EQ(candidate.blocker->agent, 1);
        const mobb::PlacedClip joint(*candidate.joint->clip, candidate.joint->placement);
        const mobb::PlacedClip other(*candidate.blocker->clip, candidate.blocker->placement);
        const auto contact = mobb::direct_search(joint, other);
        ASSERT_TRUE(contact);
        EXPECT_EQ(contact->time, candidate.blocker->contact.time);
        EXPECT_GE(contact->time, 1.6);
        EXPECT_LT(contact->time, 1.9);
        EXPECT_EQ(joint.time(0), 1.5);
        EXPECT_EQ(joint.time(2), 2);
    }
    // The play is forced then; the conflict is its choice's, and tells the joint.
    const std::vector<SceneConflict> found = conflicts_in(fitted.scene());
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].a_play, 1);
    ASSERT_TRUE(found[0].a_joint);
    EXPECT_EQ(found[0].a_joint->count(), 2);
    EXPECT_FALSE(found[0].b_joint);
}

TEST(Joints, OfOneSampleMovesTheyAreAllThereIs) {
    Scene scene = walker_scene();
    scene.clips = {scene.clips[0], scene.clips[6], walk("one", 1, 0, 1, 1.0 / 30, 0.3)};
    scene.graph = std::make_shared<MotionGraph>(graph_of_whole_clips(scene));
    const Scene run = with_run(with_linear_clips(std::move(scene)), 12, {7, 7});
    int ones = 0;
    for (const CrowdAgent& agent : run.crowd->agents)
        for (const Play& play : agent.plays) ones += clip_of_play(run, play).count() == 1 ? 1 : 0;
    EXPECT_GT(ones, 20);
    const FittedScene fitted(run, {});
    std::set<std::pair<int, int>> found;
    for (const SceneConflict& conflict : conflicts_in(fitted.scene()))
        found.emplace(conflict.facts.a, conflict.facts.b);
    EXPECT_EQ(pairs_of(scene_of_people(run), true), found);
}

}  // namespace
}  // namespace mobbscope
