// Agents of several disks: one agent in the picture, with all its disks.
#include <render/pictures/build_draw_list.h>
#include <render/pictures/moment.h>
#include <scene/scene.h>

#include "render/pictures.h"
#include "render/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

namespace mobbscope {
namespace {

constexpr int kDisks = 3, kSteps = 9;

/// Two cars side by side, and one across, that meets both.
FittedScene cars() {
    std::vector<mobb::Disk> samples;
    for (int i = 0; i <= kSteps; ++i) samples.push_back({2.0 * i, 0, 2});
    SceneClip clip{"car", {}, {}, std::make_shared<const mobb::Clip>(0.5, samples, mobb::Motion::linear)};
    clip.body = {{-1, 0, 0.9}, {0, 0, 0.9}, {1, 0, 0.9}};
    make_members(clip);
    Scene scene;
    scene.clips.push_back(std::move(clip));
    scene.agents = {{"left", 0, {{0, 2}, 0, 0}, {}}, {"right", 0, {}, {}}, {"across", 0, {{9, -9}, 90, 0}, {}}};
    return {std::move(scene), {}};
}

TEST(BodiesPicture, HasAllDisksOfEachAgent) {
    const DrawList list = build_draw_list(cars(), {}, kGoldenSize);
    EXPECT_EQ(list.agents, (std::vector<std::string>{"left", "right", "across"}));
    ASSERT_EQ(list.disks.size(), std::size_t{3} * kDisks * kSteps);
    std::set<std::pair<int, int>> picked;
    for (const DiskInstance& disk : list.disks) {
        EXPECT_FLOAT_EQ(disk.radius, 0.9f);
        picked.insert({disk.id.agent, disk.id.index});
    }
    EXPECT_EQ(picked.size(), std::size_t{3} * kSteps);
}

TEST(BodiesPicture, OfAQueryNamesTheTwoDisksThatAreAsked) {
    const FittedScene fitted = cars();
    ViewState view;
    view.query = 1;  // left against across
    view.step = {Step::Unit::percent, 100};
    const DrawList list = build_draw_list(fitted, view, kGoldenSize);
    ASSERT_EQ(list.agents.size(), 2u);
    EXPECT_EQ(list.agents[0].find("left (disk "), 0u) << list.agents[0];
    EXPECT_EQ(list.agents[1].find("across (disk "), 0u) << list.agents[1];
    EXPECT_EQ(list.disks.size(), std::size_t{2} * kDisks * kSteps) << "the others are drawn, too";
    const auto hit = [&](const DiskInstance& disk) { return glm::vec3(disk.color) == glm::vec3(list.palette.hit); };
    EXPECT_EQ(std::ranges::count_if(list.disks, hit), 2) << "one of each";
    view.step = {};
    EXPECT_NO_THROW(build_draw_list(fitted, view, kGoldenSize));
    view.query = 0;
    EXPECT_NO_THROW(build_draw_list(fitted, view, kGoldenSize));
}

TEST(BodiesPicture, OfAMomentHasOnePairHoweverManyDisksOverlap) {
    const FittedScene fitted = cars();
    ViewState view;
    view.show = Show::moment;
    const std::vector<DrawnAgent> agents = drawn_agents(fitted, view);
    const std::vector<double> heights = cylinder_heights(agents);
    const Moment apart = moment_of(agents, heights, 0);
    EXPECT_EQ(apart.bodies.size(), std::size_t{3} * kDisks);
    EXPECT_EQ(people_in(apart), 3u);
    EXPECT_TRUE(apart.overlaps.empty()) << "its own disks are nobody's conflict";
    ASSERT_TRUE(apart.nearest);
    EXPECT_NEAR(apart.nearest->clearance, 0.2, 1e-9) << "left and right";
    const Moment met = moment_of(agents, heights, 2.25);
    ASSERT_EQ(met.overlaps.size(), 2u) << "across is in both";
    EXPECT_NEAR(met.overlaps[0].clearance, 1 - 1.8, 1e-9) << "the deepest two of their disks";
    EXPECT_NEAR(met.overlaps[1].clearance, -1.8, 1e-9);
    for (const double time : {0.0, 2.25}) {
        view.time = time;
        EXPECT_NO_THROW(build_draw_list(fitted, view, kGoldenSize));
    }
    view.query = 0;
    EXPECT_NO_THROW(build_draw_list(fitted, view, kGoldenSize));
}

}  // namespace
}  // namespace mobbscope
