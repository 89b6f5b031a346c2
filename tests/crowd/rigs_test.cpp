// Which recordings are of one rig, and which of its joints poses are compared by.
#include <crowd/graph/rigs.h>
#include <import/skeleton/motion.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

using Names = std::vector<std::string>;

/// A body of one leg and one arm. Of the joints alone it is one rig, whatever the poses.
Skeleton body() {
    Skeleton out;
    out.joints = {{"floor", -1, false}, {"hips", 0, false},   {"thigh", 1, false}, {"shin", 2, false},
                  {"hand", 1, false},   {"finger", 4, false}, {"tip", 5, true}};
    out.root = 1;
    return out;
}

/// Its pose: the thigh is 0.1 m from the hips, the shin 0.4 m from the thigh, the finger 0.03 m from the hand.
std::vector<glm::vec3> standing() {
    return {{-5, 2, 0}, {0, 0, 1}, {0.1F, 0, 1}, {0.1F, 0, 0.6F}, {0, 0.3F, 1}, {0, 0.33F, 1}, {0, 0.9F, 1}};
}

/// A clip of the body in those poses.
SceneClip clip_of(const std::string& name, Skeleton skeleton, const std::vector<std::vector<glm::vec3>>& poses) {
    std::vector<mobb::Disk> disks(poses.size(), mobb::Disk{1, 2, 0.3});
    for (const auto& pose : poses) skeleton.positions.insert(skeleton.positions.end(), pose.begin(), pose.end());
    SceneClip out{name, {}, {}, std::make_shared<mobb::Clip>(1.0 / 30, disks), {}, {}};
    out.skeleton = std::make_shared<Skeleton>(std::move(skeleton));
    return out;
}

Names joints_that_count(const std::vector<SceneClip>& clips) {
    Scene scene;
    scene.clips = clips;
    return rigs_of(scene).rigs.front().joints;
}

TEST(Rigs, AreToldApartByTheirJoints) {
    Skeleton paw = body();
    paw.joints[4].name = "paw";
    Skeleton other_root = body();
    other_root.root = 2;
    Scene scene;
    scene.clips = {clip_of("a", body(), {standing()}), clip_of("b", paw, {standing()}),
                   clip_of("c", body(), {standing()}), SceneClip{"d", {}, {}, nullptr},
                   clip_of("e", other_root, {standing()})};
    const SceneRigs rigs = rigs_of(scene);
    EXPECT_EQ(rigs.of_clip, (std::vector<int>{0, 1, 0, -1, 2}));
    EXPECT_EQ(rigs.rigs.size(), 3u);
    EXPECT_EQ(rigs.rigs[1].joints, (Names{"hips", "thigh", "shin", "paw"}));
}

TEST(Rigs, ShortBonesAndTipsDoNotCount) {
    EXPECT_EQ(joints_that_count({clip_of("a", body(), {standing()})}), (Names{"hips", "thigh", "shin", "hand"}));
}

TEST(Rigs, TheUsualLengthCountsWhateverRecordingComesFirst) {
    // Damaged frames, as a capture that begins before the markers are found.
    std::vector<glm::vec3> damaged = standing();
    damaged[5] = {0, 9, 1};
    const SceneClip bad = clip_of("bad", body(), {damaged, standing(), standing(), standing()});
    const SceneClip good = clip_of("good", body(), {standing(), standing()});
    EXPECT_EQ(joints_that_count({bad, good}), (Names{"hips", "thigh", "shin", "hand"}));
    EXPECT_EQ(joints_that_count({good, bad}), (Names{"hips", "thigh", "shin", "hand"}));
}

TEST(Rigs, WhatCarriesThePathIsNoLimb) {
    const Names expected{"hips", "thigh", "shin", "hand"};
    // "floor" is metres away and above the root, so it is no joint of the body at all.
    EXPECT_EQ(joints_that_count({clip_of("a", body(), {standing()})}), expected);

    // With the floor as the root the hips are its offset: they count, but no joint is measured by their 1 m.
    Skeleton from_floor = body();
    from_floor.root = 0;
    std::vector<glm::vec3> pose = standing();
    pose[0] = {0, 0, -4};
    pose[4] = {0, 0.05F, 1};
    pose[5] = {0, 0.08F, 1};
    EXPECT_EQ(joints_that_count({clip_of("b", from_floor, {pose})}), (Names{"floor", "hips", "thigh", "shin", "hand"}));

    // A joint deeper down that goes its own way, 2 to 8 m from its parent.
    std::vector<std::vector<glm::vec3>> poses;
    for (int i = 0; i < 20; ++i) {
        std::vector<glm::vec3> far = standing();
        const glm::vec3 way{2 + 0.3F * static_cast<float>(i), 0, 0};
        for (std::size_t joint = 3; joint < far.size(); ++joint) far[joint] += way;
        far[4] = {0, 0.3F, 1};
        far[5] = {0, 0.36F, 1};
        poses.push_back(far);
    }
    const Names with_finger = joints_that_count({clip_of("c", body(), poses)});
    EXPECT_EQ(with_finger, (Names{"hips", "thigh", "shin", "hand", "finger"})) << "no limb is left but the finger";
}

TEST(Rigs, JointsAreFoundByTheirNames) {
    Skeleton skeleton = body();
    skeleton.joints[0].name = "hand";  // above the root
    skeleton.joints[3].name = "hand";
    skeleton.joints[6].name = "hand";  // an End Site
    skeleton.joints[5].name = "\xffinger";
    EXPECT_EQ(joints_of({{"thigh", "hand", "#5"}}, skeleton), (std::vector<std::size_t>{2, 3, 4, 5}));
    try {
        joints_of({{"hips", "wing"}}, skeleton);
        FAIL();
    } catch (const std::invalid_argument& error) {
        EXPECT_STREQ(error.what(), "there is no joint 'wing' below its root 'hips'");
    }
    EXPECT_EQ(joints_that_count({clip_of("a", skeleton, {standing()})}), (Names{"hips", "thigh", "hand"}));
}

TEST(Rigs, OfAGraphAreThoseOfItsMoves) {
    MotionGraph graph;
    graph.moves = {{1, 0, 0, {}, {}}, {2, 0, 0, {}, {}}, {0, 0, 0, {}, {}}};
    set_rigs(graph, {{{{"a"}}, {{"b"}}, {{"c"}}}, {2, 0, -1}});
    EXPECT_EQ(graph.rigs, (std::vector<GraphRig>{{{"a"}}, {{"c"}}}));
    EXPECT_EQ(graph.moves[0].rig, 0);
    EXPECT_EQ(graph.moves[1].rig, -1);
    EXPECT_EQ(graph.moves[2].rig, 1);
}

}  // namespace
}  // namespace mobbscope
