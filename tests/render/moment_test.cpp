// The picture of one moment: who is there, what is marked, and that all of it is in the picture.
#include <import/skeleton/motion.h>
#include <mobb/predicate.h>
#include <render/drawlist/pick.h>
#include <render/parts/paths.h>
#include <render/pictures/build_draw_list.h>
#include <render/pictures/moment.h>
#include <support/folders.h>

#include "render/pictures.h"
#include "render/scenes.h"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>
#include <string>
#include <tuple>

namespace mobbscope {
namespace {

ViewState at(double time) {
    ViewState view;
    view.show = Show::moment;
    view.time = time;
    return view;
}

Scene crossing() { return load_scene(kCrossing); }
Scene collision() { return load_scene(std::string(MOBBSCOPE_SOURCE_DIR) + "/assets/scenes/collision.json"); }
FittedScene fitted(Scene scene) {
    const mobb::FitOptions options = scene.fit;
    return {std::move(scene), options};
}

Moment moment(const FittedScene& scene, const ViewState& view) {
    const std::vector<DrawnAgent> people = drawn_agents(scene, view);
    return moment_of(people, cylinder_heights(people), *view.time);
}

bool has_color(const DrawList& list, Rgba color) {
    const auto is = [&](Rgba c) { return glm::vec3(c) == glm::vec3(color); };
    return std::any_of(list.lines.begin(), list.lines.end(), [&](const LineInstance& l) { return is(l.color); }) ||
           std::any_of(list.boxes.begin(), list.boxes.end(), [&](const BoxInstance& b) { return is(b.fill); });
}

/// A crowd of walkers without skeletons in a square.
Scene crowd(int count, double side) {
    std::vector<mobb::Placement> placements;
    for (int i = 0; i < count; ++i) {
        const double x = side * std::fmod(i * 0.6180339887, 1.0);
        const double y = side * std::fmod(i * 0.7548776662, 1.0);
        placements.push_back({{x, y}, 37.0 * i, 0.01 * (i % 50)});
    }
    return testing::scene_of(placements);
}

TEST(Moment, TheFarthestJointTouchesTheWall) {
    const FittedScene scene = fitted(crossing());
    const std::vector<DrawnAgent> people = drawn_agents(scene, at(0));
    for (const DrawnAgent& agent : people) {
        ASSERT_TRUE(agent.skeleton);
        for (int sample = 0; sample < agent.clip().count(); ++sample) {
            const double time = 0.5 * (agent.clip().time(sample) + agent.clip().time(sample + 1));
            const Moment then = moment(scene, at(time));
            const auto body = std::find_if(then.bodies.begin(), then.bodies.end(),
                                           [&](const Body& b) { return b.agent == agent.index; });
            ASSERT_NE(body, then.bodies.end());
            EXPECT_EQ(body->sample, sample);
            ASSERT_TRUE(body->farthest);
            EXPECT_TRUE(sets_radius(*body));
            EXPECT_NEAR(body->farthest->distance, body->disk.r, 1e-4);
            const glm::dvec3 place = joint_place(*agent.skeleton, agent.clip(), sample, body->farthest->joint);
            EXPECT_NEAR(std::hypot(place.x - body->disk.x, place.y - body->disk.y), body->disk.r, 1e-4);
            for (int joint = 0; joint < static_cast<int>(agent.skeleton->joints.size()); ++joint) {
                const glm::dvec3 p = joint_place(*agent.skeleton, agent.clip(), sample, joint);
                EXPECT_LE(std::hypot(p.x - body->disk.x, p.y - body->disk.y), body->disk.r + 1e-4);
                EXPECT_LT(p.z, body->height);
            }
        }
    }
}

TEST(Moment, OnlyWhoIsThereHasABody) {
    // A walks from 0 s to 2 s, B from 1 s to 3 s.
    const FittedScene scene(testing::scene_of({{}, {{0, 3}, 0, 1}}), {});
    const std::pair<double, std::set<int>> cases[] = {{-0.1, {}},     {0, {0}}, {0.99, {0}}, {1, {0, 1}},
                                                      {1.99, {0, 1}}, {2, {1}}, {2.99, {1}}, {3, {}}};
    for (const auto& [time, who] : cases) {
        const DrawList list = build_draw_list(scene, at(time), kGoldenSize);
        EXPECT_EQ(who_has_a_disk(list), who) << time;
        ASSERT_TRUE(list.moment);
        EXPECT_EQ(*list.moment, time);
        EXPECT_EQ(list.headline.starts_with("Nobody"), who.empty()) << list.headline;
    }
    ViewState view = at(0);
    view.time.reset();
    EXPECT_EQ(who_has_a_disk(build_draw_list(scene, view, kGoldenSize)), std::set<int>{0});
}

/// A and B walk from step to step, at the places given.
FittedScene plan(std::vector<mobb::Disk> a, std::vector<mobb::Disk> b) {
    Scene scene;
    for (auto* path : {&a, &b}) {
        const std::string name = path == &a ? "A" : "B";
        scene.clips.push_back(
            {name, std::nullopt, {}, std::make_shared<const mobb::Clip>(1, *path, mobb::Motion::linear)});
        scene.agents.push_back({name, static_cast<int>(scene.agents.size()), {}, std::nullopt});
    }
    return {std::move(scene), {}};
}

TEST(Moment, WhoWaitsIsMarkedAndNamed) {
    const auto detail_of = [](const FittedScene& scene, double time) {
        const std::vector<DrawnAgent> people = drawn_agents(scene, at(time));
        const DrawList list = build_draw_list(scene, at(time), kGoldenSize);
        EXPECT_EQ(who_has_a_disk(list), (std::set<int>{0, 1})) << time;
        return moment_caption(list.palette, people, moment(scene, at(time)), people.size()).detail;
    };
    const FittedScene scene = plan({{0, 0, 0.2}, {1, 0, 0.2}, {1, 0, 0.2}, {1, 0, 0.2}},
                                   {{5, 0, 0.2}, {5, 0, 0.2}, {5, 1, 0.2}, {5, 2, 0.2}});
    const std::tuple<double, int, std::string> cases[] = {
        {0.5, 1, "B waits"}, {1, 0, "A waits"}, {2.5, 0, "A waits"}, {3, 0, "A waits"}};
    for (const auto& [time, who, words] : cases) {
        for (const Body& body : moment(scene, at(time)).bodies) EXPECT_EQ(body.waits, body.agent == who) << time;
        EXPECT_NE(detail_of(scene, time).find(words), std::string::npos) << time << detail_of(scene, time);
    }
    EXPECT_NE(detail_of(plan({{0, 0, 0.2}, {0, 0, 0.2}}, {{5, 0, 0.2}, {5, 0, 0.2}}), 0.5).find("A and B wait"),
              std::string::npos);
    EXPECT_EQ(detail_of(plan({{0, 0, 0.2}, {1, 0, 0.2}}, {{5, 0, 0.2}, {6, 0, 0.2}}), 0.5).find("wait"),
              std::string::npos);
    // A ring within the disk.
    const auto lines = [](const FittedScene& of) { return build_draw_list(of, at(0.5), kGoldenSize).lines.size(); };
    EXPECT_NE(lines(plan({{0, 0, 0.2}, {0, 0, 0.2}}, {{5, 0, 0.2}, {6, 0, 0.2}})),
              lines(plan({{0, 0, 0.2}, {1e-9, 0, 0.2}}, {{5, 0, 0.2}, {6, 0, 0.2}})));
}

TEST(Moment, TheFloorDiskIsTheSampleAndCanBePicked) {
    const FittedScene scene = fitted(crossing());
    const DrawList list = build_draw_list(scene, at(1.6), kGoldenSize);
    const Moment then = moment(scene, at(1.6));
    ASSERT_EQ(list.disks.size(), 2u);
    for (const Body& body : then.bodies) {
        const ObjectId id{body.agent, ObjectId::Kind::disk, body.sample};
        const auto disk =
            std::find_if(list.disks.begin(), list.disks.end(), [&](const DiskInstance& d) { return d.id == id; });
        ASSERT_NE(disk, list.disks.end());
        EXPECT_NEAR(disk->base.x + list.space.origin.x, body.disk.x, 1e-5);
        EXPECT_NEAR(disk->base.y + list.space.origin.y, body.disk.y, 1e-5);
        EXPECT_EQ(disk->base.z, 0);
        EXPECT_FLOAT_EQ(disk->radius, static_cast<float>(body.disk.r));
        // On the floor, and half-way up the wall.
        for (const float height : {0.02f, 0.9f}) {
            const auto pixel = list.projection.project(disk->base + glm::vec3(0, 0, height));
            ASSERT_TRUE(pixel);
            const std::vector<Pick> hits = pick(list, *pixel);
            ASSERT_FALSE(hits.empty());
            EXPECT_EQ(hits.front().id, id);
        }
    }
}

TEST(Moment, WhatIsMarkedAsAHitIsWhatThePredicateSays) {
    int hits = 0;
    int misses = 0;
    for (const FittedScene& scene : {fitted(crossing()), fitted(collision())}) {
        for (int i = 0; i < 60; ++i) {
            const ViewState view = at(0.1 * i + 0.013);
            const DrawList list = build_draw_list(scene, view, kGoldenSize);
            const Moment then = moment(scene, view);
            const bool hit = then.bodies.size() == 2 && mobb::collide(then.bodies[0].disk, then.bodies[1].disk);
            EXPECT_EQ(has_color(list, list.palette.hit), hit) << *view.time;
            EXPECT_EQ(list.headline.find("overlap") != std::string::npos, hit) << list.headline;
            ++(hit ? hits : misses);
        }
    }
    EXPECT_GT(hits, 3);
    EXPECT_GT(misses, 3);
}

TEST(Moment, TouchingIsNoHit) {
    Scene scene;
    for (const double x : {0.0, 1.0}) {
        auto clip = std::make_shared<const mobb::Clip>(1.0, std::vector<mobb::Disk>{{x, 0, 0.5}});
        scene.clips.push_back({"c" + std::to_string(scene.clips.size()), std::nullopt, {}, std::move(clip)});
    }
    const FittedScene touching(scene, {});
    const DrawList list = build_draw_list(touching, at(0.5), kGoldenSize);
    EXPECT_FALSE(has_color(list, list.palette.hit));
    EXPECT_EQ(list.headline, "c0 and c1 at 0.50 s; 0.000 m of clearance");
}

TEST(Moment, FindsAllPairsOfACrowd) {
    const FittedScene scene(crowd(120, 12), {});
    const Moment then = moment(scene, at(0.9));
    std::vector<std::pair<int, int>> expected;
    double nearest = 1e9;
    for (int a = 0; a < 120; ++a) {
        for (int b = a + 1; b < 120; ++b) {
            const mobb::Disk& p = then.bodies[static_cast<std::size_t>(a)].disk;
            const mobb::Disk& q = then.bodies[static_cast<std::size_t>(b)].disk;
            if (mobb::collide(p, q)) expected.emplace_back(a, b);
        }
    }
    std::vector<std::pair<int, int>> found;
    for (const BodyPair& pair : then.overlaps) found.emplace_back(pair.a, pair.b);
    EXPECT_GT(found.size(), 5u);
    EXPECT_EQ(found, expected);
    EXPECT_FALSE(then.nearest);

    const FittedScene sparse(crowd(40, 60), {});
    const Moment apart = moment(sparse, at(0.9));
    ASSERT_TRUE(apart.overlaps.empty());
    for (std::size_t a = 0; a < 40; ++a) {
        for (std::size_t b = a + 1; b < 40; ++b) {
            const mobb::Disk& p = apart.bodies[a].disk;
            const mobb::Disk& q = apart.bodies[b].disk;
            nearest = std::min(nearest, std::sqrt(mobb::squared_distance(p, q)) - p.r - q.r);
        }
    }
    ASSERT_TRUE(apart.nearest);
    EXPECT_DOUBLE_EQ(apart.nearest->clearance, nearest);
}

TEST(Moment, TheOverlapLiesInBothDisks) {
    const mobb::Disk a{1, 2, 0.5};
    for (const mobb::Disk& b :
         {mobb::Disk{1.6, 2.3, 0.4}, {1.1, 2.05, 0.2}, {1.45, 2, 0.2}, {1, 2, 0.5}, {1, 2, 0.3}}) {
        const DiskOverlap shared = disk_overlap(a, b, 17);
        double area = 0;
        for (std::size_t side : {0u, 1u}) {
            ASSERT_EQ(shared.sides[side].size(), 17u);
            for (const glm::dvec2& p : shared.sides[side]) {
                EXPECT_LE(std::hypot(p.x - a.x, p.y - a.y), a.r + 1e-9);
                EXPECT_LE(std::hypot(p.x - b.x, p.y - b.y), b.r + 1e-9);
            }
        }
        for (std::size_t i = 0; i < 17; ++i) area += glm::length(shared.sides[1][i] - shared.sides[0][i]);
        EXPECT_GT(area, 0.1);
    }
    EXPECT_TRUE(disk_overlap(a, {2, 2, 0.5}, 9).sides[0].empty());
}

TEST(Moment, PeopleAreInsideThePictureAndTheFrameStandsStill) {
    const FittedScene scenes[] = {fitted(collision()), fitted(crossing())};
    for (const auto& [index, preset] : {std::pair(0, CameraPreset::iso), std::pair(0, CameraPreset::top),
                                        std::pair(0, CameraPreset::front), std::pair(1, CameraPreset::iso)}) {
        const FittedScene& scene = scenes[index];
        ViewState view = at(0);
        view.camera.preset = preset;
        glm::mat4 frame(0);
        // Before, with one of them, both, both in one another, and after.
        for (const double time : {-1.0, 0.3, 1.6, 2.5, 3.1, 9.0}) {
            view.time = time;
            const DrawList list = build_draw_list(scene, view, kGoldenSize);
            if (frame != glm::mat4(0)) {
                EXPECT_EQ(list.projection.clip_from_world, frame) << time;
            }
            frame = list.projection.clip_from_world;
            const Rect picture{glm::vec2(0), glm::vec2(kGoldenSize.width, kGoldenSize.height)};
            for (const LineInstance& line : list.lines) {
                if (line.order.layer != DrawLayer::subject) continue;  // the floor may go beyond the people
                for (const glm::vec3& end : {line.from, line.to}) {
                    const auto pixel = list.projection.project(end);
                    ASSERT_TRUE(pixel);
                    EXPECT_TRUE(picture.contains({*pixel, *pixel})) << pixel->x << ' ' << pixel->y;
                }
            }
            for (const TextRun& text : list.texts) EXPECT_TRUE(picture.contains(text.box)) << text.text;
        }
    }
}

TEST(Moment, AQueryShowsItsTwoSidesAlone) {
    const FittedScene scene(testing::scene_of({{}, {{0, 3}, 0, 0}, {{0, 6}, 0, 0}}), {});
    ViewState view = at(0.5);
    view.query = 2;  // B against C
    const DrawList list = build_draw_list(scene, view, kGoldenSize);
    EXPECT_EQ(list.agents, (std::vector<std::string>{"B", "C"}));
    EXPECT_EQ(list.disks.size(), 2u);
    EXPECT_EQ(list.headline, "B and C at 0.50 s; 2.200 m of clearance");
}

TEST(Moment, PartsAreLeftOutAsTheViewSays) {
    const FittedScene scene = fitted(crossing());
    ViewState view = at(1.6);
    view.boxes = false;
    EXPECT_TRUE(build_draw_list(scene, view, kGoldenSize).boxes.empty());
    view.disks = false;
    EXPECT_TRUE(build_draw_list(scene, view, kGoldenSize).disks.empty());
    view.labels = false;
    EXPECT_TRUE(build_draw_list(scene, view, kGoldenSize).texts.empty());
}

TEST(Moment, ALargeCrowdIsBuiltQuickly) {
    const FittedScene scene(crowd(1000, 100), {});
    const auto begin = std::chrono::steady_clock::now();
    const DrawList list = build_draw_list(scene, at(0.9), PictureSize{1280, 720});
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    EXPECT_EQ(who_has_a_disk(list).size(), 1000u);
    EXPECT_LT(seconds, 0.5);
    RecordProperty("milliseconds", std::to_string(1000 * seconds));
}

}  // namespace
}  // namespace mobbscope
