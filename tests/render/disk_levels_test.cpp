#include <render/drawlist/shown_points.h>
#include <render/gl/disk_levels.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace mobbscope {
namespace {

constexpr float kTolerance = 0.95f;  // pixels: the program's

/// A camera from the side that shows so many pixels per metre.
ViewProjection lens_of(float pixels_per_metre, double pitch_deg = 20) {
    const float half_width = 640 / pixels_per_metre;
    const std::vector<glm::vec3> points{{-half_width, -half_width, -half_width}, {half_width, half_width, half_width}};
    Camera camera;
    camera.preset = CameraPreset::free;
    camera.perspective = false;
    camera.yaw_deg = -90;
    camera.pitch_deg = pitch_deg;
    const PictureSize size{1280, 12800};
    return make_projection(camera, ShownPoints(points), nullptr, size);
}

/// A path of 60 disks, 0.1 m high each.
std::vector<DiskInstance> path() {
    std::vector<DiskInstance> disks(60);
    for (int i = 0; i < 60; ++i) {
        DiskInstance& disk = disks[static_cast<std::size_t>(i)];
        const float t = static_cast<float>(i);
        disk.base = {0.03f * t, 0.5f * std::sin(0.1f * t), 0.1f * t};
        disk.radius = 0.4f + 0.02f * std::sin(0.3f * t);
        disk.stand_upright(0.1f);
        disk.color = {0.2f, 0.4f, 0.6f, 1};
        disk.id = {0, ObjectId::Kind::disk, i};
        disk.order = {DrawLayer::surroundings, 0, i};
    }
    return disks;
}

/// What is drawn of one block at a level.
struct Drawn {
    std::vector<DiskPiece> tubes, disks;
};

Drawn drawn(DiskLevels& levels, std::size_t block, int level) {
    const DiskLevels::Level& made = levels.level(level);
    const auto pieces = [&](DiskLevels::Range range) {
        const auto first = made.pieces.begin() + static_cast<std::ptrdiff_t>(range.first);
        return std::vector<DiskPiece>(first, first + static_cast<std::ptrdiff_t>(range.count));
    };
    return {pieces(made.tubes[block]), pieces(made.disks[block])};
}

/// The level that a camera chooses for all of a path.
Drawn seen(DiskLevels& levels, const ViewProjection& projection) {
    EXPECT_EQ(levels.blocks().size(), 1u);
    return drawn(levels, 0, DiskLevels::choose(levels.blocks()[0], PixelScale(projection).near(), projection));
}

bool has(const std::vector<DiskPiece>& disks, int sample) {
    return std::any_of(disks.begin(), disks.end(), [&](const DiskPiece& piece) {
        return ObjectId::decode(piece.id[0], piece.id[1])->index == sample;
    });
}

TEST(DiskLevels, DisksKnowWhichStandOnThemAndWhichTheyStandOn) {
    std::vector<DiskInstance> disks = path();
    disks[20].id.index = 100;  // the path has a gap there
    const std::vector<DiskPiece> pieces = pieces_of(disks);
    for (std::size_t i = 0; i + 1 < disks.size(); ++i) {
        const glm::vec3 step = disks[i + 1].base - disks[i].base;
        const bool gap = i == 19 || i == 20;
        EXPECT_EQ(pieces[i].above, gap ? glm::vec3(0) : glm::vec3(step.x, step.y, disks[i + 1].radius)) << i;
        EXPECT_EQ(pieces[i + 1].below, gap ? glm::vec3(0) : glm::vec3(-step.x, -step.y, disks[i].radius)) << i;
    }
    EXPECT_EQ(pieces.front().below, glm::vec3(0));
    EXPECT_EQ(pieces.back().above, glm::vec3(0));
}

/// The same path, run along from disk to disk.
std::vector<DiskInstance> running_path() {
    std::vector<DiskInstance> disks = path();
    for (std::size_t i = 0; i + 1 < disks.size(); ++i) {
        disks[i].top = disks[i + 1].base;
        disks[i].top_radius = disks[i + 1].radius;
    }
    return disks;
}

TEST(DiskLevels, WhatRunsGoesOnInTheSameFaceAndJoinsUpInSmoothTubes) {
    DiskLevels levels(running_path());
    const std::vector<DiskPiece> pieces = pieces_of(levels.disks());
    for (std::size_t i = 0; i + 1 < pieces.size(); ++i) {
        EXPECT_EQ(pieces[i].top, pieces[i + 1].base) << i;
        EXPECT_EQ(pieces[i].above, glm::vec3(0, 0, pieces[i].top_radius)) << i;
        EXPECT_EQ(pieces[i + 1].below, glm::vec3(0, 0, pieces[i].top_radius)) << i;
    }
    EXPECT_EQ(levels.blocks()[0].widest_step, 0);
    EXPECT_NEAR(levels.most_lean(), 0.064f, 3e-3f);
    const Drawn far = seen(levels, lens_of(8));
    ASSERT_FALSE(far.tubes.empty());
    for (const DiskPiece& tube : far.tubes) EXPECT_EQ(tube.id, run_id(0, true));
    for (int level = 1; level < DiskLevels::kLevels; ++level) {
        EXPECT_EQ(drawn(levels, 0, level).disks.size(), 1u) << "the last, at level " << level;
    }
    DiskLevels upright(path());
    for (const DiskPiece& tube : seen(upright, lens_of(8)).tubes) EXPECT_EQ(tube.id, run_id(0, false));
}

/// From above the height of a disk is not seen, but how far it leans.
TEST(DiskLevels, DisksThatLeanFarStayAsTheyAreFromAbove) {
    auto disks = running_path();
    const auto tubes = [&](double pitch) {
        DiskLevels levels(disks);
        return seen(levels, lens_of(25, pitch)).tubes.size();
    };
    EXPECT_GT(tubes(90), 0u);
    for (DiskInstance& disk : disks) {
        disk.base.x *= 3;
        disk.top.x *= 3;
    }
    EXPECT_EQ(tubes(90), 0u);
}

TEST(DiskLevels, FarDisksJoinUp) {
    DiskLevels levels(path());
    const Drawn far = seen(levels, lens_of(8));
    EXPECT_LT(far.tubes.size() + far.disks.size(), 20u);
    EXPECT_TRUE(has(far.disks, 59)) << "the last stays, as its upper face is seen";
}

TEST(DiskLevels, NearDisksStayAsTheyAre) {
    DiskLevels levels(path());
    const Drawn near = seen(levels, lens_of(100));
    EXPECT_EQ(near.disks.size(), 60u);
    EXPECT_TRUE(near.tubes.empty());
}

/// Every disk is there, or lies within the tolerance of a tube; tubes and disks leave no gap.
TEST(DiskLevels, TubesFollowTheirDisks) {
    const auto disks = path();
    DiskLevels levels(disks);
    for (const float pixels : {2.0f, 4.0f, 8.0f, 14.0f}) {
        const ViewProjection projection = lens_of(pixels);
        ASSERT_NEAR(projection.pixels_per_metre(glm::vec3(0)), pixels, 0.05f);
        const Drawn far = seen(levels, projection);
        ASSERT_FALSE(far.tubes.empty());
        for (const DiskInstance& disk : disks) {
            float nearest = has(far.disks, disk.id.index) ? 0 : std::numeric_limits<float>::max();
            for (const DiskPiece& tube : far.tubes) {
                const float t = (disk.base.z - tube.base.z) / (tube.top.z - tube.base.z);
                if (t < -1e-3f || t > 1 + 1e-3f) continue;
                const glm::vec3 middle = tube.base + t * (tube.top - tube.base);
                const float radius = tube.radius + t * (tube.top_radius - tube.radius);
                nearest = std::min(nearest, std::hypot(disk.base.x - middle.x, disk.base.y - middle.y) +
                                                std::abs(disk.radius - radius));
            }
            EXPECT_LE(nearest * pixels, kTolerance * 1.01f) << "sample " << disk.id.index << " at " << pixels;
        }
    }
}

/// What tubes may be off is used nearly in full at whatever distance: fewer are drawn.
TEST(DiskLevels, TheChosenLevelIsNearlyAsCoarseAsItMayBe) {
    auto disks = path();
    for (DiskInstance& disk : disks) {
        disk.base.z *= 0.1f;
        disk.stand_upright(0.01f);
    }
    const DiskLevels levels(disks);
    for (float pixels = 6; pixels < 80; pixels *= 1.07f) {
        const int level = DiskLevels::choose(levels.blocks()[0], pixels, lens_of(pixels, 0));
        EXPECT_GT(DiskLevels::tolerance(level) * pixels, 0.79f) << pixels;
        EXPECT_LE(DiskLevels::tolerance(level) * pixels, kTolerance) << pixels;
    }
}

/// Somebody who nearly stands, and now and then takes a step that is a leap beside that, yet too small to be seen.
TEST(DiskLevels, LeapsCutTubesOnlyWhereTheyAreSeen) {
    std::vector<DiskInstance> disks = path();
    for (std::size_t i = 0; i < disks.size(); ++i) {
        disks[i].base = {0.05f * static_cast<float>(i / 10), 0, 0.1f * static_cast<float>(i)};
        disks[i].radius = 0.4f;
        disks[i].stand_upright(0.1f);
    }
    DiskLevels levels(disks);
    EXPECT_EQ(drawn(levels, 0, DiskLevels::kLevels - 1).disks.size(), 1u) << "the last";
    EXPECT_GT(drawn(levels, 0, 1).disks.size(), 5u) << "0.05 m are much beside 8 mm";
}

TEST(DiskLevels, TheUsualRadiusIsTheMeanUnlessOneIsFarWider) {
    std::vector<DiskInstance> disks = path();
    const auto widen = [&](std::size_t i, float radius) { disks[i].radius = disks[i].top_radius = radius; };
    for (std::size_t i = 0; i < disks.size(); ++i) widen(i, i % 2 == 0 ? 0.4f : 0.5f);
    EXPECT_NEAR(DiskLevels(disks).blocks()[0].usual_radius, 0.45f, 1e-5f);
    widen(7, 3);
    EXPECT_NEAR(DiskLevels(disks).blocks()[0].usual_radius, 2, 1e-5f);
}

TEST(DiskLevels, EveryLevelCoversThePath) {
    auto disks = path();
    for (int i = 0; i < 400; ++i) {
        disks.push_back(disks.back());
        disks.back().id.index = disks.back().id.index + 1;
        disks.back().order.index = disks.back().order.index + 1;
        disks.back().base += glm::vec3(0.01f, 0.02f * static_cast<float>(i % 7), 0.1f);
        disks.back().stand_upright(0.1f);
    }
    DiskLevels levels(disks);
    ASSERT_GT(levels.blocks().size(), 2u);
    for (int level = 0; level < DiskLevels::kLevels; ++level) {
        float height = 0;
        for (std::size_t block = 0; block < levels.blocks().size(); ++block) {
            const Drawn all = drawn(levels, block, level);
            for (const auto& pieces : {all.tubes, all.disks}) {
                for (const DiskPiece& piece : pieces) height += piece.top.z - piece.base.z;
            }
        }
        EXPECT_NEAR(height, 46, 0.01) << "level " << level;
        EXPECT_EQ(levels.level(level).pieces.size(), levels.level(level).sources.size());
        if (level > 0) {
            EXPECT_LE(levels.level(level).pieces.size(), levels.level(level - 1).pieces.size());
        }
    }
}

TEST(DiskLevels, WhatStandsOutIsDrawnDiskByDisk) {
    auto disks = path();
    DiskLevels levels(disks);
    EXPECT_FALSE(seen(levels, lens_of(8)).tubes.empty());
    disks[30].color = {1, 0, 0, 1};
    std::vector<const DiskInstance*> pointers;
    for (const DiskInstance& disk : disks) pointers.push_back(&disk);
    EXPECT_TRUE(levels.take_colors(pointers));
    EXPECT_TRUE(seen(levels, lens_of(8)).tubes.empty());
    EXPECT_EQ(levels.disks()[30].color, disks[30].color);
    disks[30].radius *= 2;
    EXPECT_FALSE(levels.take_colors(pointers)) << "another shape";
    pointers.pop_back();
    EXPECT_FALSE(levels.take_colors(pointers)) << "fewer";
}

TEST(DiskLevels, PathsDoNotJoinUp) {
    auto disks = path();
    // A second path goes on where the first ends.
    for (std::size_t i = 30; i < disks.size(); ++i) disks[i].id.agent = 1;
    DiskLevels levels(disks);
    ASSERT_EQ(levels.blocks().size(), 2u);
    for (const std::size_t block : {0u, 1u}) {
        const Drawn coarse = drawn(levels, block, DiskLevels::kLevels - 1);
        EXPECT_FALSE(coarse.tubes.empty());
        EXPECT_EQ(coarse.disks.size(), 1u) << "its last";
    }
}

TEST(DiskLevels, ThePixelScaleIsTheLens) {
    for (const bool perspective : {true, false}) {
        Camera camera;
        camera.preset = CameraPreset::free;
        camera.perspective = perspective;
        const std::vector<glm::vec3> points{{-3, -2, 0}, {3, 2, 5}};
        const ViewProjection projection = make_projection(camera, ShownPoints(points), nullptr, {640, 360});
        const PixelScale scale(projection);
        for (const glm::vec3& p : {points[0], points[1], glm::vec3(1, -1, 2)}) {
            EXPECT_NEAR(scale.at(p), projection.pixels_per_metre(p), 1e-3f * scale.at(p));
        }
        // The middle of a large disk may lie behind the eye, and its rim be seen.
        if (perspective) {
            EXPECT_NEAR(scale.at(projection.eye + projection.back), scale.near() / projection.near_depth, 1e-3f);
        }
    }
}

}  // namespace
}  // namespace mobbscope
