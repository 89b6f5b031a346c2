// A run as a scene: who plays what around a time, and whose it is.
#include <import/skeleton/motion.h>
#include <scene/crowd_run.h>
#include <scene/crowd_scene.h>
#include <scene/drawn_agent.h>
#include <scene/motion_graph.h>

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

/// Two people on a straight way: moves of 1 s and 2 s that lead from the hub to itself.
Scene small_run() {
    Scene scene;
    for (const int seconds : {1, 2}) {
        std::vector<mobb::Disk> samples;
        for (int i = 0; i < 10 * seconds; ++i) samples.push_back({0.1 * i, 0, 0.3});
        const std::string name = seconds == 1 ? "short" : "long";
        scene.clips.push_back({name, std::nullopt, {}, std::make_shared<const mobb::Clip>(0.1, samples)});
    }
    MotionGraph graph;
    graph.hubs = {{"any"}};
    graph.moves = {{0, 0, 0, {{0, 0}, 0}, {{1, 0}, 0}}, {1, 0, 0, {{0, 0}, 0}, {{2, 0}, 0}}};
    CrowdRun run;
    run.area = {20, 20};
    run.seconds = 6;
    const auto play = [](int move, double x, double y, double start) {
        return Play{move, {{x, y}, 0, start}, start, PlayKind::chosen};
    };
    run.agents = {{"17", {play(0, 0, 0, -0.5), play(1, 1, 0, 0.5), play(0, 3, 0, 2.5)}},
                  {"42", {play(1, 0, 5, 0), play(0, 2, 5, 2)}}};
    scene.graph = std::make_shared<const MotionGraph>(graph);
    scene.crowd = std::make_shared<const CrowdRun>(run);
    return scene;
}

std::vector<std::string> names(const Scene& scene) {
    std::vector<std::string> out;
    for (const Agent& agent : scene.agents) out.push_back(agent.name);
    return out;
}

TEST(CrowdScene, AMomentHasThePeopleInTheirOrder) {
    const Scene run = small_run();
    ASSERT_TRUE(is_run(run));
    const Scene scene = scene_at(run, 1.0, {});
    EXPECT_FALSE(is_run(scene));
    EXPECT_EQ(names(scene), (std::vector<std::string>{"17", "42"}));
    EXPECT_EQ(scene.agents[0].play, 1);
    EXPECT_EQ(scene.agents[0].clip, 1);
    EXPECT_EQ(scene.agents[0].placement, run.crowd->agents[0].plays[1].placement);
    EXPECT_EQ(scene.agents[1].run_agent, 1);
    EXPECT_EQ(scene.graph, run.graph);
    EXPECT_EQ(scene.crowd, run.crowd);
}

/// The same with linear clips, each with a skeleton of one joint.
Scene linear_run() {
    Scene scene = small_run();
    for (SceneClip& clip : scene.clips) {
        const auto samples = clip.clip->samples();
        Skeleton skeleton;
        skeleton.joints.emplace_back();
        skeleton.rest.resize(1);
        skeleton.rotations.resize(samples.size());
        for (std::size_t i = 0; i < samples.size(); ++i)
            skeleton.positions.emplace_back(0, 0, 0.01F * static_cast<float>(i));
        clip.skeleton = std::make_shared<const Skeleton>(skeleton);
        clip.clip = std::make_shared<const mobb::Clip>(0.1, std::vector<mobb::Disk>(samples.begin(), samples.end()),
                                                       mobb::Motion::linear);
    }
    return scene;
}

TEST(CrowdScene, ALinearPlayHasAClipThatRunsOnToTheNextOne) {
    const Scene run = linear_run();
    const Scene scene = scene_at(run, 0.45, {});
    ASSERT_EQ(scene.clips.size(), 4u) << "behind those of the run one for each of the two";
    const SceneClip& clip = scene.clips[static_cast<std::size_t>(scene.agents[0].clip)];
    ASSERT_EQ(clip.clip->count(), 11);
    EXPECT_EQ(clip.clip->duration(), 1);
    EXPECT_NEAR(clip.clip->samples()[10].x, 1, 1e-12);
    EXPECT_EQ(clip.skeleton->positions.size(), 11u) << "a pose for each sample";
    EXPECT_EQ(clip.skeleton->rotations.size(), 11u);
    EXPECT_EQ(clip.skeleton->at(10)[0], clip.skeleton->at(9)[0]);
    // The last play has nothing behind it.
    EXPECT_EQ(scene_at(run, 2.6, {}).agents[0].clip, 0);
}

TEST(CrowdScene, AtTheBorderOfTwoLinearPlaysAPersonIsThereOnce) {
    const FittedScene run(linear_run(), {});
    const auto plays_at = [&](double time) {
        ViewState view;
        view.show = Show::moment;
        view.time = time;
        const FittedScene moment = fitted_at(run, view);
        std::vector<int> out;
        for (const DrawnAgent& agent : drawn_agents(moment, view)) {
            const int play = moment.scene().agents[static_cast<std::size_t>(agent.index)].play;
            if (agent.run_agent == 0 && sample_at(agent, time)) out.push_back(play);
        }
        return out;
    };
    EXPECT_EQ(plays_at(0.45), std::vector{0});
    EXPECT_EQ(plays_at(0.5), std::vector{1});
    EXPECT_EQ(plays_at(2.5), std::vector{2});
    EXPECT_EQ(plays_at(3.4), std::vector{2}) << "when it was last seen";
    EXPECT_EQ(plays_at(3.41), std::vector<int>{});
}

TEST(CrowdScene, TheWindowAddsThePlaysAroundBehindThePeople) {
    const Scene scene = scene_at(small_run(), 1.5, {1.5, 1.0});
    EXPECT_EQ(names(scene), (std::vector<std::string>{"17", "42", "17 -1", "42 +1"}));
    EXPECT_EQ(scene.agents[2].run_agent, 0);
    EXPECT_EQ(scene.agents[2].play, 0);
    EXPECT_EQ(scene.agents[3].run_agent, 1);
    EXPECT_EQ(scene.agents[3].play, 1);
    // The window is half open: what begins at its end is not on.
    EXPECT_EQ(names(scene_at(small_run(), 1.5, {1.5, 0.5})), (std::vector<std::string>{"17", "42", "17 -1"}));
    EXPECT_EQ(names(scene_at(small_run(), 1.5, {1.0, 0.5})), (std::vector<std::string>{"17", "42"}));
}

TEST(CrowdScene, BorderOfTwoPlaysBelongsToTheLater) {
    const Scene run = small_run();
    const CrowdAgent& agent = run.crowd->agents[0];
    EXPECT_EQ(play_at(agent, 0.499), 0u);
    EXPECT_EQ(play_at(agent, 0.5), 1u);
    EXPECT_EQ(play_at(agent, -100), 0u);
    EXPECT_EQ(play_at(agent, 100), 2u);
}

TEST(CrowdScene, OutsideTheRunEverybodyKeepsTheNearestPlay) {
    EXPECT_EQ(names(scene_at(small_run(), -50, {1, 1})), (std::vector<std::string>{"17", "42"}));
    EXPECT_EQ(scene_at(small_run(), 50, {1, 1}).agents[0].play, 2);
}

TEST(CrowdScene, TreesAreShared) {
    const FittedScene run(small_run(), {});
    ViewState view;
    view.time = 1.5;
    view.time_window = 1;
    const FittedScene seen = fitted_at(run, view);
    EXPECT_EQ(&seen.tree(0), &run.tree(0));
    EXPECT_EQ(&seen.tree(1), &run.tree(1));
    EXPECT_GT(seen.placed_agents().size(), 2u);
}

TEST(CrowdScene, ARunAsksNoQueries) {
    EXPECT_EQ(query_count(small_run()), 0u);
    EXPECT_EQ(query_count(scene_at(small_run(), 1, {5, 5})), 0u);
}

TEST(CrowdScene, WithoutATimeTheMiddleIsSeen) {
    ViewState view;
    EXPECT_EQ(run_time(small_run(), view), 3);
    view.time = 1;
    EXPECT_EQ(run_time(small_run(), view), 1);
}

TEST(CrowdScene, PeopleAreFoundByName) {
    const Scene run = small_run();
    const CrowdRun& crowd = *run.crowd;
    EXPECT_EQ(run_agent_by_name(crowd, "42"), 1);
    EXPECT_EQ(run_agent_by_name(crowd, "4"), std::nullopt);
}

}  // namespace
}  // namespace mobbscope
