#include <render/gl/disk_runs.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace mobbscope {
namespace {

constexpr float kTolerance = 0.9f;  // the program's

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
    return make_projection(camera, points, nullptr, {{0, 0}, {1280, 12800}}, size);
}

/// A path of 60 disks, 0.1 m high each.
std::vector<DiskInstance> path() {
    std::vector<DiskInstance> disks(60);
    for (int i = 0; i < 60; ++i) {
        DiskInstance& disk = disks[static_cast<std::size_t>(i)];
        const float t = static_cast<float>(i);
        disk.base = {0.03f * t, 0.5f * std::sin(0.1f * t), 0.1f * t};
        disk.radius = 0.4f + 0.02f * std::sin(0.3f * t);
        disk.height = 0.1f;
        disk.color = {0.2f, 0.4f, 0.6f, 1};
        disk.id = {0, ObjectId::Kind::disk, i};
        disk.order = {0, 0, i};
    }
    return disks;
}

DiskGroups group(const std::vector<DiskInstance>& disks, const ViewProjection& projection) {
    std::vector<const DiskInstance*> pointers;
    for (const DiskInstance& disk : disks) pointers.push_back(&disk);
    return group_runs(pointers, projection, kTolerance);
}

TEST(DiskRuns, FarDisksJoinUp) {
    const auto disks = path();
    const ViewProjection projection = lens_of(8);
    const DiskGroups groups = group(disks, projection);
    EXPECT_LT(groups.single.size() + groups.runs.size(), 20u);
    // The last stays, as its upper face is seen.
    ASSERT_FALSE(groups.single.empty());
    EXPECT_EQ(groups.single.back(), &disks.back());
}

TEST(DiskRuns, TheFirstDiskStaysWhereItsLowerFaceIsSeen) {
    const auto disks = path();
    const DiskGroups groups = group(disks, lens_of(8, -20));
    ASSERT_FALSE(groups.runs.empty());
    ASSERT_FALSE(groups.single.empty());
    EXPECT_EQ(groups.single.front(), &disks.front());
    EXPECT_NE(group(disks, lens_of(8)).single.front(), &disks.front()) << "from above it is hidden";
}

TEST(DiskRuns, NearDisksStayAsTheyAre) {
    const auto disks = path();
    const DiskGroups groups = group(disks, lens_of(100));
    EXPECT_EQ(groups.single.size(), disks.size());
    EXPECT_TRUE(groups.runs.empty());
}

/// Every disk is there, or lies within the tolerance of a tube.
TEST(DiskRuns, TubesFollowTheirDisks) {
    const auto disks = path();
    for (const float pixels : {2.0f, 4.0f, 8.0f, 14.0f}) {
        const ViewProjection projection = lens_of(pixels);
        ASSERT_NEAR(projection.pixels_per_metre(glm::vec3(0)), pixels, 0.05f);
        const DiskGroups groups = group(disks, projection);
        ASSERT_FALSE(groups.runs.empty());
        for (const DiskInstance& disk : disks) {
            float nearest = std::numeric_limits<float>::max();
            for (const DiskInstance* single : groups.single) {
                if (single == &disk) nearest = 0;
            }
            for (const DiskRun& run : groups.runs) {
                const float t = (disk.base.z - run.base.z) / (run.top.z - run.base.z);
                if (t < -1e-3f || t > 1 + 1e-3f) continue;
                const glm::vec3 middle = run.base + t * (run.top - run.base);
                const float radius = run.radius + t * (run.top_radius - run.radius);
                nearest = std::min(nearest, std::hypot(disk.base.x - middle.x, disk.base.y - middle.y) +
                                                std::abs(disk.radius - radius));
            }
            EXPECT_LE(nearest * pixels, kTolerance * 1.01f) << "sample " << disk.id.index << " at " << pixels;
        }
    }
}

TEST(DiskRuns, WhatStandsOutStaysAlone) {
    auto disks = path();
    disks[30].color = {1, 0, 0, 1};
    const DiskGroups groups = group(disks, lens_of(8));
    EXPECT_NE(std::find(groups.single.begin(), groups.single.end(), &disks[30]), groups.single.end());
    for (const DiskRun& run : groups.runs) EXPECT_NE(run.color, disks[30].color);
}

TEST(DiskRuns, PathsDoNotJoinUp) {
    auto disks = path();
    // A second path goes on where the first ends.
    for (std::size_t i = 30; i < disks.size(); ++i) disks[i].id.participant = 1;
    const DiskGroups groups = group(disks, lens_of(8));
    EXPECT_NE(std::find(groups.single.begin(), groups.single.end(), &disks[29]), groups.single.end());
}

TEST(DiskRuns, ThePixelScaleIsTheLens) {
    for (const bool perspective : {true, false}) {
        Camera camera;
        camera.preset = CameraPreset::free;
        camera.perspective = perspective;
        const std::vector<glm::vec3> points{{-3, -2, 0}, {3, 2, 5}};
        const ViewProjection projection = make_projection(camera, points, nullptr, {{40, 30}, {600, 300}}, {640, 360});
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
