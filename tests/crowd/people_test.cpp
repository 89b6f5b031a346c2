// The people of a run, each as one agent with one clip.
#include "walker_moves.h"

#include <base/error.h>
#include <conflicts/conflicts.h>
#include <crowd/simulation/simulate.h>
#include <scene/crowd_run.h>

#include <gtest/gtest.h>

#include <numeric>
#include <set>
#include <utility>

namespace mobbscope {
namespace {

using testing::walk;
using testing::walker_scene;

/// A run of walks of one dt on a floor so small that some are forced.
Scene crowded_run() {
    Scene scene;
    scene.clips = {walk("ahead", 1.4, 0, 45, 1.0 / 30, 0.4), walk("left", 1.2, 60, 40, 1.0 / 30, 0.42),
                   walk("right", 1.2, -60, 40, 1.0 / 30, 0.42)};
    scene.graph = std::make_shared<MotionGraph>(graph_of_whole_clips(scene));
    return testing::with_run(std::move(scene), 20, {9, 9});
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
    const FittedScene people(scene_of_people(run), {});
    std::vector<mobb::PlacedTree> crowd;
    for (const PlacedAgent& run_agent : people.placed_agents()) crowd.push_back(people.placed(run_agent));
    std::set<std::pair<int, int>> found;
    std::vector<int> person_of(crowd.size());
    std::iota(person_of.begin(), person_of.end(), 0);
    for (const PeopleConflict& conflict : find_people_conflicts(crowd, person_of, Search::trees).found) {
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

TEST(People, WhoPlaysLinearClipsIsAnAgentForEachPlay) {
    Scene scene;
    const SceneClip held = walk("held", 1.4, 0, 45, 1.0 / 30, 0.4);
    SceneClip linear = held;
    linear.name = "linear";
    const auto samples = held.clip->samples();
    linear.clip = std::make_shared<const mobb::Clip>(
        held.clip->dt(), std::vector<mobb::Disk>(samples.begin(), samples.end()), mobb::Motion::linear);
    scene.clips = {held, linear};
    scene.graph = std::make_shared<MotionGraph>(graph_of_whole_clips(scene));
    CrowdRun run;
    run.agents = {{"7",
                   {{0, {}, 0, PlayKind::chosen},
                    {0, {{2, 0}, 0, 1.5}, 1.5, PlayKind::chosen},
                    {1, {{4, 0}, 90, 3}, 3, PlayKind::chosen},
                    {1, {{4, 2}, 90, 4.5}, 4.5, PlayKind::chosen}}}};
    scene.crowd = std::make_shared<CrowdRun>(run);
    const Scene people = scene_of_people(scene);
    ASSERT_EQ(people.agents.size(), 3u) << "held plays are one clip; the last disk of a linear one stays by itself";
    EXPECT_EQ(people.clips[0].clip->count(), 2 * held.clip->count());
    EXPECT_EQ(people.clips[0].clip->motion(), mobb::Motion::held);
    EXPECT_EQ(people.agents[1].name, "7 from 3 s");
    EXPECT_EQ(people.clips[1].clip, linear.clip);
    EXPECT_EQ(people.agents[1].placement.translate, glm::dvec2(4, 0));
    EXPECT_EQ(people.agents[1].placement.rotate_deg, 90);
    EXPECT_EQ(people.agents[2].placement.start, 4.5);
}

}  // namespace
}  // namespace mobbscope
