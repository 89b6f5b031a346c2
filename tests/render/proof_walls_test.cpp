// The proof of an answer as it is drawn: walls stand between the two, where the certificate says.
#include "render/scenes.h"

#include <render/pictures/build_draw_list.h>
#include <render/query/proof_walls.h>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace mobbscope {
namespace {

constexpr PictureSize kProofPicture{900, 700};

QueryProof proof_in(const FittedScene& fitted) {
    const SceneQuery query = fitted.queries()[0];
    const mobb::PlacedTree a = fitted.placed(query.a), b = fitted.placed(query.b);
    return proof_of(fitted, query, record(fitted, query), clearance_over_time(a.placed_clip(), b.placed_clip()));
}

ViewState last_step(Show show = Show::space_time) {
    ViewState view;
    view.query = 0;
    view.show = show;
    return view;
}

std::vector<BoxInstance> walls_of(const DrawList& list) {
    std::vector<BoxInstance> out;
    std::ranges::copy_if(list.boxes, std::back_inserter(out), [](const BoxInstance& box) {
        return box.order.layer == DrawLayer::findings && box.order.level == 2;
    });
    return out;
}

/// One who runs away from one who follows a little slower, both along x: a line between them moves.
FittedScene chase() {
    Scene scene = testing::scene_of({{}, {{1.2, 0}, 0, 0}});
    return {scene, {}};
}

void expect_between(const FittedScene& fitted) {
    const QueryProof proof = proof_in(fitted);
    ASSERT_FALSE(proof.lines.empty());
    const SceneQuery query = fitted.queries()[0];
    const mobb::PlacedTree a = fitted.placed(query.a), b = fitted.placed(query.b);
    const auto check = [&](const mobb::PlacedClip& clip, double side) {
        for (int i = 0; i < clip.count(); ++i) {
            for (const ProofLine& line : proof.lines) {
                const double from = std::max(clip.time(i), line.t0), to = std::min(clip.time(i + 1), line.t1);
                if (from >= to) continue;
                const mobb::Disk disk = clip.disk(i);
                for (const double t : {from, to}) {
                    const double at = glm::dot(line.direction, glm::dvec2(disk.x, disk.y) - line.at(t, 0));
                    EXPECT_GE(side * at - disk.r, 0.5 * line.gap - 1e-9);
                }
            }
        }
    };
    check(a.placed_clip(), -1);
    check(b.placed_clip(), 1);
}

TEST(ProofWalls, LinesRunInTheMiddleBetweenTheTwo) {
    expect_between(testing::miss_scene());
    expect_between(chase());
    expect_between(testing::hit_scene());
}

TEST(ProofWalls, StandWhereTheLinesAre) {
    for (const FittedScene& fitted : {testing::miss_scene(), chase()}) {
        const QueryProof proof = proof_in(fitted);
        const DrawList list = build_draw_list(fitted, last_step(), kProofPicture);
        const std::vector<BoxInstance> walls = walls_of(list);
        ASSERT_EQ(walls.size(), proof.lines.size());
        for (std::size_t i = 0; i < walls.size(); ++i) {
            const ProofLine& line = proof.lines[i];
            for (const double along : {line.along.t0, line.along.t1}) {
                for (const double time : {line.t0, line.t1}) {
                    const glm::dvec2 at = line.at(time, along);
                    const glm::vec3 corner = list.space.point(at.x, at.y, time);
                    EXPECT_TRUE(std::ranges::any_of(
                        box_corners(walls[i]), [&](glm::vec3 drawn) { return glm::length(drawn - corner) < 1e-4f; }));
                }
            }
        }
    }
    EXPECT_NE(proof_in(chase()).lines.front().speed, 0) << "a wall that leans";
    EXPECT_EQ(proof_in(testing::miss_scene()).lines.front().speed, 0);
}

TEST(ProofWalls, OfVeryManyTheTightestAreDrawn) {
    const FittedScene fitted = chase();
    QueryProof proof = proof_in(fitted);
    proof.lines.assign(kMostWalls + 500, proof.lines.front());
    for (std::size_t i = 0; i < proof.lines.size(); ++i) {
        proof.lines[i].gap = static_cast<double>(proof.lines.size() - i);
    }
    proof.tightest = proof.lines.size() - 1;
    DrawList list = build_draw_list(fitted, last_step(), kProofPicture);
    const std::size_t before = walls_of(list).size();
    add_proof_walls(list, proof, std::nullopt, 1);
    EXPECT_EQ(walls_of(list).size() - before, kMostWalls);
}

TEST(ProofWalls, StandInPlaceOfTheLastTestOfAMiss) {
    const FittedScene miss = testing::miss_scene(), hit = testing::hit_scene();
    const auto tested = [](const DrawList& list) { return std::ranges::count_if(list.boxes, &BoxInstance::pickable); };
    ViewState view = last_step();
    const DrawList proven = build_draw_list(miss, view, kProofPicture);
    EXPECT_EQ(tested(proven), 0);
    EXPECT_EQ(proven.headline, "A and B never collide");
    EXPECT_TRUE(std::ranges::any_of(proven.texts, [](const TextRun& t) { return t.role == TextRole::note; }));
    view.past = Past::all;
    EXPECT_GT(tested(build_draw_list(miss, view, kProofPicture)), 0) << "who asks for all tests sees them";
    view.past = Past::ancestors;
    view.proof = false;
    const DrawList last_test = build_draw_list(miss, view, kProofPicture);
    EXPECT_GT(tested(last_test), 0);
    EXPECT_TRUE(walls_of(last_test).empty());
    view.proof = true;
    view.step = {Step::Unit::event, 0};
    EXPECT_TRUE(walls_of(build_draw_list(miss, view, kProofPicture)).empty());
    const DrawList found = build_draw_list(hit, last_step(), kProofPicture);
    EXPECT_GT(tested(found), 0) << "a hit is its last test";
    EXPECT_FALSE(walls_of(found).empty()) << "and before it lines keep the two apart";
    view = last_step();
    view.hidden = {"B"};
    EXPECT_TRUE(walls_of(build_draw_list(miss, view, kProofPicture)).empty());
}

TEST(ProofWalls, TheLineAtTheTimeCursorStandsOut) {
    const FittedScene hit = testing::hit_scene();
    const QueryProof proof = proof_in(hit);
    for (const ProofLine& line : proof.lines) {
        ViewState view = last_step();
        view.time = line.nearest;
        const std::size_t now = *proof.at(*view.time);
        const std::vector<BoxInstance> walls = walls_of(build_draw_list(hit, view, kProofPicture));
        for (std::size_t i = 0; i < walls.size(); ++i) EXPECT_TRUE(i == now || walls[i].fill.a < walls[now].fill.a);
    }
    ViewState view = last_step(Show::moment);
    view.time = proof.lines.front().t0;
    EXPECT_EQ(walls_of(build_draw_list(hit, view, kProofPicture)).size(), 1u) << "at a moment its line alone";
}

TEST(ProofWalls, TheFreeRegionLiesWhereBMayStart) {
    const FittedScene miss = testing::miss_scene();
    const QueryProof proof = proof_in(miss);
    const auto in_region = [](const DrawList& list) {
        std::vector<glm::dvec3> out;
        for (const LineInstance& line : list.lines) {
            if (line.order.layer != DrawLayer::surroundings || line.order.level != 5) continue;
            for (const glm::vec3 end : {line.from, line.to}) out.push_back(list.space.place(end));
        }
        return out;
    };
    ViewState view = last_step();
    const std::vector<glm::dvec3> points = in_region(build_draw_list(miss, view, kProofPicture));
    ASSERT_FALSE(points.empty());
    const SceneQuery query = miss.queries()[0];
    const mobb::PlacedTree b = miss.placed(query.b);
    const mobb::Disk first = b.placed_clip().disk(0);
    for (const glm::dvec3 point : points) {
        EXPECT_GT(room_left(proof.certificate, glm::dvec2(point) - glm::dvec2(first.x, first.y)), -1e-4);
        EXPECT_NEAR(point.z, b.placed_clip().time(0), 1e-4);
    }
    view.free_region = false;
    EXPECT_TRUE(in_region(build_draw_list(miss, view, kProofPicture)).empty());
    EXPECT_TRUE(in_region(build_draw_list(testing::hit_scene(), last_step(), kProofPicture)).empty());
}

}  // namespace
}  // namespace mobbscope
