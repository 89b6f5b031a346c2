// The people of a run, each as one agent with one clip.
#include "walker_moves.h"

#include <base/error.h>
#include <conflicts/conflicts.h>
#include <conflicts/crowd.h>
#include <crowd/simulation/simulate.h>
#include <mobb_tracks/crowds.h>
#include <scene/crowd_run.h>

#include <gtest/gtest.h>

#include <numeric>
#include <set>
#include <utility>

namespace mobbscope {
namespace {

/// A run of walks of one dt on a floor so small that some are forced.
Scene crowded_run() {
    Scene scene;
    scene.clips = {walk("ahead", 1.4, 0, 45, 1.0 / 30, 0.4), walk("left", 1.2, 60, 40, 1.0 / 30, 0.42),
                   walk("right", 1.2, -60, 40, 1.0 / 30, 0.42)};
    scene.graph = std::make_shared<MotionGraph>(graph_of_whole_clips(scene));
    return with_run(std::move(scene), 20, {9, 9});
}

TEST(People, TheirClipsAreWhatTheyPlay) {
    const Scene run = crowded_run();
    const Scene people = scene_of_people(run);
    ASSERT_EQ(people.agents.size(), 20u);
    for (std::size_t who = 0; who < 20; ++who) {
        const Agent& agent = people.agents[who];
        const mobb::PlacedClip whole(*people.clips[static_cast<std::size_t>(agent.clip)].clip, agent.placement);
        int sample = 0;
        for (const Play& play : run.crowd->agents[who].plays) {
            const mobb::PlacedClip part(*run.clips[static_cast<std::size_t>(play.move)].clip, play.placement);
            for (int i = 0; i < part.count(); ++i, ++sample) {
                ASSERT_EQ(whole.disk(sample).x, part.disk(i).x);
                ASSERT_EQ(whole.disk(sample).y, part.disk(i).y);
                ASSERT_NEAR(whole.time(sample), part.time(i), 1e-9);
            }
        }
        EXPECT_EQ(sample, whole.count());
    }
}

TEST(People, CollideWhereTheirPlaysDo) {
    const Scene run = crowded_run();
    std::set<std::pair<int, int>> expected;
    const auto& agents = run.crowd->agents;
    for (int a = 0; a < 20; ++a) {
        for (int b = a + 1; b < 20; ++b) {
            for (const Play& p : agents[static_cast<std::size_t>(a)].plays) {
                for (const Play& q : agents[static_cast<std::size_t>(b)].plays) {
                    const mobb::PlacedClip one(*run.clips[static_cast<std::size_t>(p.move)].clip, p.placement);
                    const mobb::PlacedClip other(*run.clips[static_cast<std::size_t>(q.move)].clip, q.placement);
                    if (mobb::direct_search(one, other)) expected.emplace(a, b);
                }
            }
        }
    }
    ASSERT_FALSE(expected.empty());
    const Scene people = scene_of_people(run);
    const std::vector<mobb::PlacedClip> crowd = Crowd(people).placed();
    std::set<std::pair<int, int>> found;
    std::vector<int> person_of(crowd.size());
    std::iota(person_of.begin(), person_of.end(), 0);
    for (const mobb::PeopleConflict& conflict : mobb::test::all_of({crowd, person_of})) {
        found.emplace(conflict.a, conflict.b);
    }
    EXPECT_EQ(found, expected);
}

TEST(People, GoOnAsAnotherAgentWhereTheStepChanges) {
    const Scene scene = walker_scene();
    ASSERT_NE(scene.clips[0].clip->dt(), scene.clips[3].clip->dt());
    Scene with_run = scene;
    CrowdRun run;
    run.agents = {{"6", {}},
                  {"7", {{0, {}, 0, PlayKind::chosen}, {3, {{2, 0}, 0, 1.5}, 1.5, PlayKind::chosen}}},
                  {"8", {{3, {{9, 0}, 0, 0.5}, 0.5, PlayKind::chosen}}}};
    with_run.crowd = std::make_shared<CrowdRun>(run);
    const Scene people = scene_of_people(with_run);
    ASSERT_EQ(people.agents.size(), 3u);
    EXPECT_EQ(people.agents[0].name, "7");
    EXPECT_EQ(people.agents[1].name, "7 from 1.5 s");
    EXPECT_EQ(people.agents[2].name, "8");
    EXPECT_EQ(people.agents[0].run_agent, 0);
    EXPECT_EQ(people.agents[1].run_agent, 0);
    EXPECT_EQ(people.agents[2].run_agent, 1) << "6 plays nothing";
    EXPECT_EQ(people.agents[1].placement.start, 1.5);
    EXPECT_EQ(people.clips[1].clip->dt(), scene.clips[3].clip->dt());
    EXPECT_EQ(people.clips[1].clip->count(), scene.clips[3].clip->count());
}

/// Plays of held and of linear walks of one dt, and of one of another.
Scene joining_plays(const std::vector<Play>& plays) {
    Scene scene;
    scene.clips = {walk("held", 1.4, 0, 45, 1.0 / 30, 0.4), walk("linear", 1.4, 30, 45, 1.0 / 30, 0.3),
                   walk("linear, slower", 1.4, 0, 30, 0.05, 0.5), walk("linear, one sample", 1.4, 0, 1, 1.5, 0.2)};
    const Scene linear = with_linear_clips(scene);
    for (std::size_t i = 1; i < scene.clips.size(); ++i) scene.clips[i] = linear.clips[i];
    scene.graph = std::make_shared<MotionGraph>(graph_of_whole_clips(scene));
    CrowdRun run;
    run.agents = {{"7", plays}};
    scene.crowd = std::make_shared<CrowdRun>(run);
    return scene;
}

mobb::Disk disk_of(const Scene& run, const Play& play, bool last) {
    const mobb::PlacedClip clip(*run.clips[static_cast<std::size_t>(play.move)].clip, play.placement);
    return clip.disk(last ? clip.count() - 1 : 0);
}

void expect_equal(const mobb::Disk& found, const mobb::Disk& expected) {
    EXPECT_EQ(found.x, expected.x);
    EXPECT_EQ(found.y, expected.y);
    EXPECT_EQ(found.r, expected.r);
}

TEST(People, LinearPlaysOfOneStepAreOneClip) {
    const std::vector<Play> plays{{1, {}, 0}, {1, {{3, 0}, 40, 1.5}, 1.5}, {1, {{4, 1}, 90, 3}, 3}};
    const Scene run = joining_plays(plays);
    const Scene people = scene_of_people(run);
    ASSERT_EQ(people.agents.size(), 1u);
    const mobb::Clip& whole = *people.clips[0].clip;
    EXPECT_EQ(whole.motion(), mobb::Motion::linear);
    ASSERT_EQ(whole.count(), 3 * 45);
    expect_equal(whole.samples()[44], disk_of(run, plays[0], true));
    expect_equal(whole.samples()[45], disk_of(run, plays[1], false));
    expect_equal(whole.samples().back(), disk_of(run, plays[2], true));
    EXPECT_EQ(whole.duration(), 134 * whole.dt()) << "it ends at the last sample of the last play";
}

TEST(People, ALinearClipLastsUntilTheNextOneBegins) {
    const std::vector<Play> plays{{0, {}, 0},
                                  {1, {{2, 0}, 0, 1.5}, 1.5},
                                  {1, {{4, 0}, 90, 3}, 3},
                                  {2, {{4, 2}, 90, 4.5}, 4.5},
                                  {0, {{5, 2}, 90, 6}, 6}};
    const Scene run = joining_plays(plays);
    const Scene people = scene_of_people(run);
    ASSERT_EQ(people.agents.size(), 4u);
    EXPECT_EQ(people.agents[1].name, "7 from 1.5 s");
    EXPECT_EQ(people.agents[2].name, "7 from 4.5 s");
    EXPECT_EQ(people.clips[0].clip->count(), 45) << "held ones have their last cylinder";
    ASSERT_EQ(people.clips[1].clip->count(), 91);
    expect_equal(people.clips[1].clip->samples().back(), disk_of(run, plays[3], false));
    ASSERT_EQ(people.clips[2].clip->count(), 31);
    expect_equal(people.clips[2].clip->samples().back(), disk_of(run, plays[3], true));
    for (std::size_t i = 0; i + 1 < people.agents.size(); ++i) {
        const mobb::Clip& clip = *people.clips[i].clip;
        EXPECT_NEAR(people.agents[i].placement.start + clip.duration(), people.agents[i + 1].placement.start, 1e-9);
    }
}

TEST(People, OneLinearSampleAtTheEndTakesNoTime) {
    const Scene joined = scene_of_people(joining_plays({{1, {}, 0}, {3, {{2, 0}, 0, 1.5}, 1.5}}));
    ASSERT_EQ(joined.agents.size(), 1u);
    EXPECT_EQ(joined.clips[0].clip->count(), 46);
    EXPECT_EQ(joined.clips[0].clip->samples().back().r, 0.2);
    EXPECT_EQ(scene_of_people(joining_plays({{3, {}, 0}})).clips[0].clip->duration(), 1.5) << "by itself it holds";
    const Scene between = scene_of_people(joining_plays({{3, {}, 0}, {1, {{2, 0}, 0, 1.5}, 1.5}}));
    ASSERT_EQ(between.agents.size(), 2u);
    EXPECT_EQ(between.clips[0].clip->count(), 2) << "it runs on to the next";
}

}  // namespace
}  // namespace mobbscope
